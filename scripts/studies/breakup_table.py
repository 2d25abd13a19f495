"""Table of validation/breakup.md: mean and largest load of cases/splitting_thickness.toml, whole and splitting.

gem sweep run cases/splitting_thickness.toml -o DIR --engine cpu; scripts/studies breakup DIR
"""
import argparse
import pathlib

import h5py
import numpy

BEGIN = 300.0  # [s]: the ice has then closed on the barge


def loads(path):
    """Mean ice force on the barge and largest 1 s mean [kN], and the number of splits."""
    with h5py.File(path) as file:
        platform = file["platform"]
        late = platform["time"][()] > BEGIN
        splits = int((file["splits/piece_left"][()] > 0).sum()) if "splits" in file else 0
        return (platform["ice_force_x"][()][late].mean() / 1e3, platform["ice_force_mean_x"][()].max() / 1e3, splits)


def main():
    parser = argparse.ArgumentParser(prog="studies breakup", description=__doc__.split("\n\n")[0])
    parser.add_argument("folder", help="of gem sweep run cases/splitting_thickness.toml", type=pathlib.Path)
    folder = parser.parse_args().folder
    print("| thickness m | whole: mean kN | splitting: mean kN | ratio | whole: largest kN | splitting: largest kN | splits |")
    print("|---|---|---|---|---|---|---|")
    for name, thickness in (("h025", 0.25), ("h050", 0.5), ("h100", 1.0), ("h200", 2.0)):
        whole = numpy.array([loads(p) for p in sorted(folder.glob(f"{name}_0_*.h5"))])
        split = numpy.array([loads(p) for p in sorted(folder.glob(f"{name}_1000_*.h5"))])
        a, b = whole.mean(axis=0), split.mean(axis=0)
        each = "; ".join(f"{x:.2f}" for x in split[:, 0] / whole[:, 0])
        print(f"| {thickness} | {a[0]:.0f} | {b[0]:.0f} | {b[0] / a[0]:.2f} ({each}) | {a[1]:.0f} | {b[1]:.0f} | {b[2]:.0f} |")


if __name__ == "__main__":
    main()
