"""Reads what gem writes the way its users do, with ncdump, h5py and xarray. Exit code 1: wrong; 77: no reader is installed.

usage: /usr/bin/python3 scripts/check_files.py run GEM CASE.toml        runs the case and reads its run file
       /usr/bin/python3 scripts/check_files.py summary GEM SWEEP.toml   runs the sweep, collects it and reads the summary
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

try:
    import h5py
    import numpy
except ImportError:
    h5py = None
try:
    import h5netcdf
    import h5netcdf.legacyapi as netcdf
    import xarray
except ImportError:
    xarray = None

HEADER = ("group: platform", "time = UNLIMITED", 'ice_force_x:units = "N"', 'gem_status = "complete"')
GROUPS = {"shape": None, "boundary": None, "floes": "time", "platform": "time", "stats": "time", "events": "event"}


# Has every column that a run file can have but for forces between bodies.
SHIP = {"output.side_loads": "true", "platform.outline": '"ship"', "platform.length_m": 90, "platform.beam_m": 20,
        "platform.bow_length_m": 25, "platform.stern_length_m": 15}


def check_h5py(path):
    with h5py.File(path, "r") as file:
        status = file.attrs["gem_status"]
        status = status.decode() if isinstance(status, bytes) else str(status)
        assert status == "complete", status
        assert "[run]" in str(file.attrs["gem_case_toml"]) or "gem_case_toml" in file
        for group, unlimited in GROUPS.items():
            for name, dataset in file[group].items():
                if h5py.h5ds.is_scale(dataset.id) and name in ("event", "boundary", "boundary_vertex", "platform_vertex"):
                    continue
                assert dataset.attrs["units"] and dataset.attrs["long_name"], dataset.name
                for axis in dataset.dims if not h5py.h5ds.is_scale(dataset.id) else []:
                    assert len(axis) == 1, f"{dataset.name}: an axis without dimension scale"
                values = dataset[...]
                assert numpy.isfinite(values).all(), f"{dataset.name}: not finite"
                assert unlimited is None or dataset.maxshape[0] is None, dataset.name
        for group in ("floes", "platform", "stats"):
            time = file[group]["time"][...]
            assert (numpy.diff(time) > 0).all(), f"{group}: time does not increase"
            rows = {name: dataset.shape[0] for name, dataset in file[group].items()}
            assert len(set(rows.values())) == 1, rows
        print(f"h5py: {status}, {file['floes/time'].shape[0]} frames, {file['platform/time'].shape[0]} platform samples, "
              f"{file['events/time'].shape[0]} events")


def check_xarray(path):
    """What xarray and h5netcdf read is what h5py reads, number by number."""
    compared = 0
    for group, unlimited in GROUPS.items():
        with xarray.open_dataset(path, engine="h5netcdf", group=group) as data, h5py.File(path, "r") as file:
            assert unlimited is None or unlimited in data.dims, group
            assert not any(name.startswith("phony") for name in data.dims), data.dims
            if "time" in data:
                assert data["time"].dtype == numpy.float64, "time was decoded as a date"
            data.load()
            for name in data.variables:
                wanted = file[group][name][...]
                assert data[name].shape == wanted.shape and data[name].values.tobytes() == wanted.tobytes(), f"{group}/{name}"
                compared += 1
            print(f"xarray: {group}: {dict(data.sizes)}")
    assert compared > 60, compared
    print(f"xarray: {compared} variables have the numbers of h5py")


def check_ncdump(path):
    header = subprocess.run(["ncdump", "-h", path], check=True, stdout=subprocess.PIPE, text=True).stdout
    for word in HEADER:
        assert word in header, f"ncdump: no '{word}'"
    assert "phony" not in header, "ncdump: an axis without a name"
    print("ncdump: reads the file")


def check_running(gem, case, folder):
    """A file that is being written, then one whose writer was killed: no row of zeros, all columns readable."""
    path = pathlib.Path(folder, "running.h5")
    run = subprocess.Popen([gem, "run", case, "--quiet", "--until", "10000000", "--out", path])
    try:
        for _ in range(300):
            if path.exists():
                break
            time.sleep(0.1)
        for state in ("running", "killed"):
            with h5py.File(path, "r", swmr=True) as file:
                for group in ("floes", "platform", "stats"):
                    times = file[group]["time"][...]
                    assert len(times) > 0 and (numpy.diff(times) > 0).all(), f"{state}: {group}/time does not increase"
                    for dataset in file[group].values():
                        assert numpy.isfinite(dataset[...]).all(), dataset.name
            info = json.loads(subprocess.run([gem, "info", path, "--json"], check=True, stdout=subprocess.PIPE).stdout)
            assert info["gem_status"] == "running" and info["end_s"] > 0, info
            if xarray:
                with h5netcdf.File(path, "r", swmr=True) as file:
                    data = xarray.open_dataset(xarray.backends.H5NetCDFStore(file, group="platform"))
                    assert data.sizes["time"] > 0 and (numpy.diff(data["time"]) > 0).all(), state
            print(f"{state}: read up to {info['end_s']} s")
            run.kill()
            run.wait()
    finally:
        run.kill()
        run.wait()


def run(gem, case, folder):
    path = f"{folder}/run.h5"
    more = [word for key, value in SHIP.items() for word in ("--set", f"{key}={value}")]
    subprocess.run([gem, "run", case, "--quiet", "--set", "run.duration_s=120", "--out", path, *more], check=True)
    readers = {"ncdump (package netcdf-bin)": (shutil.which("ncdump"), check_ncdump),
               "h5py (package python3-h5py)": (h5py, check_h5py),
               "xarray with h5netcdf (packages python3-xarray python3-h5netcdf)": (xarray and h5py, check_xarray)}
    for name, (there, check) in readers.items():
        if there:
            check(path)
        else:
            print(f"not installed: {name}")
    if h5py:
        check_running(gem, case, folder)
    if not any(there for there, _ in readers.values()):
        print("skipped: no ncdump, h5py or xarray")
        return False
    return True


def summary(gem, sweep, folder):
    if xarray is None:
        print("skipped: no xarray with h5netcdf (packages python3-xarray python3-h5netcdf)")
        return False

    def call(*arguments, to=None):
        done = subprocess.run([gem, *arguments], check=True, stdout=subprocess.PIPE if to else None, text=True)
        if to:
            pathlib.Path(folder, to).write_text(done.stdout, encoding="utf-8")

    runs = f"{folder}/runs"
    call("sweep", "run", sweep, "--quiet", "--threads", "1", "--out", runs)
    call("sweep", "status", runs, "--json", to="status.json")
    call("analyse", "--json", f"{runs}/middle_4000000.h5", to="analyse.json")
    call("sweep", "collect", runs, "--out", f"{folder}/summary.nc.h5")
    call("sweep", "collect", runs, "--out", f"{folder}/exact.nc.h5", "--index", "2-3", "--series", "0.5", "--exact")
    call("sweep", "collect", runs, "--out", f"{folder}/lean.nc.h5", "--series", "0")
    check_summary(folder)
    return True


def check_summary(folder):
    with open(f"{folder}/status.json") as file:
        status = json.load(file)
    with open(f"{folder}/analyse.json") as file:
        findings = json.load(file)["findings"]
    with xarray.open_dataset(f"{folder}/summary.nc.h5", engine="h5netcdf") as data:
        data.load()
    assert data.sizes == {"run": 6, "time": 3}, data.sizes
    settings = {"run", "time", "seed", "current_speed_m_per_s", "gap_m", "ice_thickness_m", "platform.mass_kg",
                "current.velocity_m_per_s.x", "current.velocity_m_per_s.y"}
    assert set(data.coords) == settings, set(data.coords) ^ settings
    assert list(data.run.values) == [row["name"] for row in status]
    assert list(data.state_hash.values) == [row["state_hash"] for row in status]
    assert (data["platform.mass_kg"].values == [4e6, 5e6] * 3).all()
    assert (data.current_speed_m_per_s.values == [0.4, 0.4, 0.5, 0.5, 0.6, 0.6]).all()
    assert (data.impacts.values > 0).all() and (data.events.values >= data.impacts.values).all()
    assert (data.residual_energy.values < 1e-8).all() and (data.residual_momentum.values < 1e-11).all()
    for name in ("x_period_by_spectrum_s", "x_period_by_crossings_s", "x_period_by_maxima_s"):
        assert {name, name + "_low", name + "_high"} <= set(data.variables), name

    row = data.sel(run="middle_4000000")
    compared = 0
    for name, finding in findings.items():
        if finding is None:
            assert numpy.isnan(row[name]), name
            continue
        for part, suffix in (("value", ""), ("low", "_low"), ("high", "_high")):
            if part in finding:
                assert float(row[name + suffix]) == finding[part], name + suffix
                compared += 1
    assert compared >= 20, compared

    with netcdf.Dataset(f"{folder}/runs/middle_4000000.h5", "r") as run:
        x = run.groups["platform"].variables["x"][:]
        assert numpy.allclose(row.displacement_x.values, x[[0, 50, 100]].astype("f4"), atol=0)
        with xarray.open_dataset(f"{folder}/exact.nc.h5", engine="h5netcdf") as exact:
            assert list(exact.run.values) == ["slow_5000000", "middle_4000000"], exact.run.values
            kept = exact.sel(run="middle_4000000")
            rest = x[0] - float(kept.displacement_x[0])
            assert list(exact.time.values) == [0.0, 0.5, 1.0, 1.5, 2.0], exact.time.values
            assert (kept.displacement_x.values == x[::25] - rest).all(), "exact means to the last bit"
            assert (kept.velocity_x.values == run.groups["platform"].variables["vx"][::25]).all()
    with xarray.open_dataset(f"{folder}/lean.nc.h5", engine="h5netcdf") as lean:
        assert "time" not in lean.sizes and "displacement_x" not in lean.variables
        assert lean.sizes["run"] == 6 and all(text.startswith("gem ") for text in lean["source"].values)
    assert row.displacement_x.values[-1] > 0, "the ice pushed nothing"
    print(f"xarray: {dict(data.sizes)}, {len(data.data_vars)} variables, {compared} findings compared")


def main():
    what, gem, case = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as folder:
        if not {"run": run, "summary": summary}[what](gem, case, folder):
            sys.exit(77)


if __name__ == "__main__":
    main()
