#!/usr/bin/env python3
"""Opens a sweep's summary with xarray and compares it with `gem sweep status` and `gem analyse`; exit 1 if wrong.

Usage: check_summary.py FOLDER    with summary.nc.h5, exact.nc.h5, lean.nc.h5, status.json, analyse.json and runs/ from check_summary.sh
"""
import json
import sys

import h5netcdf.legacyapi as netcdf
import numpy
import xarray


def main(folder):
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


if __name__ == "__main__":
    main(sys.argv[1])
