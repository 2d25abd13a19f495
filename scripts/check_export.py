"""Reads what `gem export` writes with VTK, which is what ParaView reads with, and compares with the run file.

usage: /usr/bin/python3 scripts/check_export.py GEM CASE.toml     runs the case; exit code 1: wrong; 77: VTK is not installed
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

try:
    import h5py
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError as missing:
    print(f"skipped: {missing} (packages python3-vtk9 python3-h5py)")
    sys.exit(77)

FLOES = {"floe": 1, "class": 1, "thickness": 1, "mass": 1, "velocity": 3, "speed": 1, "spin": 1}
PLATFORM = {"velocity": 3, "yaw": 1, "spin": 1, "ice_force": 3, "ice_force_mean": 3, "mooring_force": 3, "drag_force": 3}
FORCES = {"floe_a": 1, "floe_b": 1, "force": 3, "force_size": 1}
HITS = {"time": 1, "floe": 1, "normal": 3, "closing_speed": 1, "impulse": 1, "force_peak": 1}


def read(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    assert reader.GetErrorCode() == 0 and data is not None, path
    return data


def arrays(attributes):
    return {attributes.GetArrayName(i): vtk_to_numpy(attributes.GetArray(i)) for i in range(attributes.GetNumberOfArrays())}


def check_names(found, wanted, name):
    shape = {key: 1 if values.ndim == 1 else values.shape[1] for key, values in found.items()}
    assert shape == wanted, f"{name}: {shape}"


def outlines(run, frame):
    """Corners of every active floe in the world, as the run file says."""
    ends = numpy.cumsum(run["shape/vertex_count"][...])
    corners = numpy.split(run["shape/vertex_xy"][...], ends[:-1])
    x, y, theta, active = (run[f"floes/{name}"][frame].astype(float) for name in ("x", "y", "theta", "active"))
    turned = []
    for i in numpy.flatnonzero(active):
        c, s = numpy.cos(theta[i]), numpy.sin(theta[i])
        turned.append(corners[i] @ numpy.array([[c, s], [-s, c]]) + [x[i], y[i]])
    return turned


def check_floes(data, run, frame):
    wanted = outlines(run, frame)
    active = numpy.flatnonzero(run["floes/active"][frame])
    assert data.GetNumberOfPolys() == len(wanted) == data.GetNumberOfCells(), "number of floes"
    assert data.GetNumberOfPoints() == sum(len(corners) for corners in wanted), "number of corners"
    for i in (0, len(wanted) // 2, len(wanted) - 1):
        points = vtk_to_numpy(data.GetCell(i).GetPoints().GetData())
        assert numpy.allclose(points[:, :2], wanted[i], rtol=1e-7, atol=1e-6), f"corners of floe {i}"
    # float32: half a unit in the last place of the largest coordinate
    joined = numpy.concatenate(wanted)
    bounds = numpy.array([joined[:, 0].min(), joined[:, 0].max(), joined[:, 1].min(), joined[:, 1].max()])
    assert numpy.allclose(data.GetBounds()[:4], bounds, rtol=1e-7, atol=1e-6), (data.GetBounds(), bounds)
    cells = arrays(data.GetCellData())
    check_names(cells, FLOES, "floes")
    assert (cells["floe"] == active).all()
    for name, dataset in (("thickness", "shape/thickness"), ("mass", "shape/mass"), ("class", "shape/class")):
        assert (cells[name] == run[dataset][...][active].astype(cells[name].dtype)).all(), name
    velocity = numpy.stack([run["floes/vx"][frame][active], run["floes/vy"][frame][active]], axis=1)
    assert (cells["velocity"][:, :2] == velocity).all() and (cells["velocity"][:, 2] == 0).all()
    assert (cells["spin"] == run["floes/omega"][frame][active]).all()
    assert numpy.allclose(cells["speed"], numpy.hypot(*velocity.T), rtol=1e-6)


def check_platform(data, run, time):
    assert data.GetNumberOfCells() == 1 and data.GetNumberOfPoints() == len(run["shape/platform_xy"])
    cells = arrays(data.GetCellData())
    check_names(cells, PLATFORM, "platform")
    sample = numpy.searchsorted(run["platform/time"][...], time + 1e-6 * (1 + time), side="right") - 1
    assert cells["yaw"][0] == run["platform/psi"][sample]
    for name in ("ice_force", "mooring_force"):
        wanted = [run[f"platform/{name}_{axis}"][sample] for axis in "xy"]
        assert (cells[name][0, :2] == numpy.float32(wanted)).all(), name
    c, s = numpy.cos(run["platform/psi"][sample]), numpy.sin(run["platform/psi"][sample])
    wanted = run["shape/platform_xy"][...] @ numpy.array([[c, s], [-s, c]]) + [run["platform/x"][sample], run["platform/y"][sample]]
    assert numpy.allclose(vtk_to_numpy(data.GetPoints().GetData())[:, :2], wanted, rtol=1e-7, atol=1e-5), "corners of the platform"


def check_forces(data, run, time):
    """One line for each force of the frame, over the point of contact to the centroid of the second floe. Returns their number."""
    here = run["contacts/time"][...] == time
    assert data.GetNumberOfLines() == here.sum() == data.GetNumberOfCells(), "number of forces"
    cells = arrays(data.GetCellData())
    check_names(cells, FORCES, "contacts")
    if here.sum() == 0:
        return 0
    first = int(run.attrs["gem_first_floe_body"])
    b = run["contacts/body_b"][here] - first
    a = run["contacts/body_a"][here]
    assert (cells["floe_b"] == b).all() and (cells["floe_a"] == numpy.where(a >= first, a - first, -1 - a)).all()
    for k, axis in enumerate("xy"):
        assert (cells["force"][:, k] == run[f"contacts/force_{axis}"][here]).all(), "forces"
    frame = int(numpy.searchsorted(run["floes/time"][...], time))
    point = numpy.stack([run["contacts/x"][here], run["contacts/y"][here]], axis=1)
    for i in (0, here.sum() // 2, here.sum() - 1):
        line = vtk_to_numpy(data.GetCell(int(i)).GetPoints().GetData())[:, :2]
        assert numpy.allclose(line[-2], point[i], rtol=1e-6)
        assert numpy.allclose(line[-1], [run["floes/x"][frame][b[i]], run["floes/y"][frame][b[i]]], rtol=1e-6)
    return int(here.sum())


def check_film(folder, run):
    entries = {}
    for entry in xml.etree.ElementTree.parse(folder / "film.pvd").iter("DataSet"):
        entries.setdefault(entry.get("name"), []).append((float(entry.get("timestep")), folder / entry.get("file")))
    times = run["floes/time"][...]
    assert set(entries) == {"floes", "platform", "hits", "track", "fixed", "contacts"}, set(entries)
    for name, listed in entries.items():
        assert [time for time, _ in listed] == list(times), f"times of {name}"
    for frame in (0, len(times) // 2, len(times) - 1):
        data = read(entries["floes"][frame][1])
        check_floes(data, run, frame)
        assert arrays(data.GetFieldData())["TimeValue"][0] == times[frame]
        check_platform(read(entries["platform"][frame][1]), run, times[frame])
    hits = [arrays(read(path).GetPointData()) for _, path in entries["hits"]]
    check_names(hits[0], HITS, "hits")
    impulse = sorted(numpy.concatenate([one["impulse"] for one in hits]))
    assert impulse == sorted(run["events/impulse"][...]) and len(impulse) > 0, "every hit once"
    forces = sum(check_forces(read(path), run, time) for time, path in entries["contacts"])
    assert forces == len(run["contacts/time"]) > 100, "every force once"
    track = read(entries["track"][0][1])
    assert track.GetNumberOfLines() == 1 and (arrays(track.GetPointData())["time"] == run["platform/time"][...]).all()
    assert read(entries["fixed"][0][1]).GetNumberOfCells() == len(run["boundary/vertex_count"])
    print(f"VTK: {len(times)} frames, {len(impulse)} hits, {forces} forces; cells, corners, arrays and bounds of three frames are the run's")


def check_damaged(gem, folder):
    """A file that lies is refused, and nothing is written."""
    damages = {"floes/time": lambda data: data[::-1], "floes/x": lambda data: data * numpy.nan,
               "shape/vertex_count": lambda data: data + 1, "shape/thickness": lambda data: data * numpy.inf,
               "platform/x": lambda data: data * numpy.nan, "contacts/time": lambda data: data[::-1]}
    for dataset, damage in damages.items():
        path = folder / "damaged.h5"
        shutil.copy(folder / "run.h5", path)
        with h5py.File(path, "a") as run:
            run[dataset][...] = damage(run[dataset][...])
        done = subprocess.run([gem, "export", path, folder / "damaged.pvd"], stderr=subprocess.PIPE, text=True)
        assert done.returncode == 4 and "damaged.h5" in done.stderr, (dataset, done)
        left = [entry.name for entry in folder.iterdir() if "damaged" in entry.name]
        assert left == ["damaged.h5"], left
    print(f"{len(damages)} damaged files are refused")


# A ship that is turned, with loads by side, in place of the platform of the case.
SHIP = {"outline": '"ship"', "length_m": 90, "beam_m": 20, "bow_length_m": 25, "stern_length_m": 15, "start_yaw_rad": 0.4}


def export_run(gem, case, folder, settings):
    more = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
    subprocess.run([gem, "run", case, "--quiet", "--set", "run.duration_s=120", "--set", "output.contact_forces=true",
                    "--engine", "cpu", "--overwrite", "--out", folder / "run.h5", *more], check=True)
    subprocess.run([gem, "export", folder / "run.h5", folder / "film.pvd", "--overwrite"], check=True)
    with h5py.File(folder / "run.h5", "r") as run:
        check_film(folder, run)


def main():
    gem, case = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        export_run(gem, case, folder, {"output.side_loads": "true", **{f"platform.{key}": value for key, value in SHIP.items()}})
        export_run(gem, case, folder, {})
        check_damaged(gem, folder)
        few = subprocess.run([gem, "export", folder / "run.h5", folder / "few.pvd", "--every", "1min"], check=True,
                             stdout=subprocess.PIPE, text=True).stdout
        assert "3 frames" in few, few


if __name__ == "__main__":
    main()
