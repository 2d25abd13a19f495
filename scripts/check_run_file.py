#!/usr/bin/env python3
"""Reads a run file the way its users do: h5py, and xarray if it is there. Prints what it found; exit 1 if wrong.

Usage: check_run_file.py RUN.h5 [--incomplete]
"""
import sys

try:
    import h5py
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

GROUPS = {"shape": None, "boundary": None, "floes": "time", "platform": "time", "stats": "time", "events": "event"}


def check_h5py(path, incomplete):
    with h5py.File(path, "r") as file:
        status = file.attrs["gem_status"]
        status = status.decode() if isinstance(status, bytes) else str(status)
        assert incomplete or status == "complete", status
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
            assert incomplete or len(set(rows.values())) == 1, rows
        print(f"h5py: {status}, {file['floes/time'].shape[0]} frames, {file['platform/time'].shape[0]} platform samples, "
              f"{file['events/time'].shape[0]} events")


def check_xarray(path):
    try:
        import h5netcdf  # noqa: F401
        import xarray
    except ImportError as missing:
        print(f"xarray: not checked ({missing})")
        return
    for group, unlimited in GROUPS.items():
        with xarray.open_dataset(path, engine="h5netcdf", group=group) as data:
            assert unlimited is None or unlimited in data.dims, group
            assert not any(name.startswith("phony") for name in data.dims), data.dims
            if "time" in data:
                assert data["time"].dtype == numpy.float64, "time was decoded as a date"
            data.load()
            print(f"xarray: {group}: {dict(data.sizes)}")


if __name__ == "__main__":
    is_incomplete = "--incomplete" in sys.argv
    check_h5py(sys.argv[1], is_incomplete)
    check_xarray(sys.argv[1])
