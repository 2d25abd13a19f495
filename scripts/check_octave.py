"""Reads a run file with Octave's load and compares with h5py, number by number.

usage: /usr/bin/python3 scripts/check_octave.py GEM CASE.toml     runs the case; exit code 1: wrong; 77: no Octave
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

try:
    import h5py
    import numpy
except ImportError as missing:
    print(f"skipped: {missing} (package python3-h5py)")
    sys.exit(77)

DATASETS = ("platform/time", "platform/x", "platform/side_impulse", "platform/mooring_force_x", "platform/contacts", "floes/x", "floes/omega",
            "floes/active", "events/impulse", "events/body_b", "shape/vertex_xy", "shape/vertex_count", "stats/overlap_count")
# Octave's matrices have the dimensions in the opposite order, so that column by column is the order of the file.
SCRIPT = """run = load('-hdf5', 'run.h5');
for name = {%s}
  parts = strsplit(name{1}, '/');
  values = run.(parts{1}).(parts{2});
  file = fopen(strrep(name{1}, '/', '_'), 'w');
  fwrite(file, double(values(:)), 'double');
  fclose(file);
end
"""


def main():
    gem, case = sys.argv[1:3]
    octave = shutil.which("octave-cli") or shutil.which("octave")
    if octave is None:
        print("skipped: Octave is not installed (package octave)")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        subprocess.run([gem, "run", case, "--quiet", "--set", "run.duration_s=120", "--set", "output.side_loads=true", "--out",
                        path / "run.h5"], check=True)
        (path / "compare.m").write_text(SCRIPT % ", ".join(f"'{name}'" for name in DATASETS), encoding="utf-8")
        subprocess.run([octave, "--no-gui", "--no-init-file", "--quiet", "compare.m"], cwd=folder, check=True, timeout=120)
        with h5py.File(path / "run.h5", "r") as run:
            for name in DATASETS:
                read = numpy.fromfile(path / name.replace("/", "_"), dtype=float)
                wanted = run[name][...].astype(float).ravel()
                assert len(wanted) > 0 and (read == wanted).all(), name
    print(f"Octave: {len(DATASETS)} datasets are equal")


if __name__ == "__main__":
    main()
