"""An ensemble: one case with several seeds, the mean of the mooring force with its interval, and the extremes.

usage: python3 ensemble.py [PICTURE.png]
"""
import pathlib
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import numpy  # noqa: E402
from matplotlib import pyplot  # noqa: E402

import gem  # noqa: E402

CASES = pathlib.Path(__file__).resolve().parents[3] / "cases"
SEEDS = 6
STUDENT_95 = 2.571  # quantile 0.975 of Student's t with SEEDS - 1 = 5 degrees of freedom


def main(picture="ensemble.png"):
    with tempfile.TemporaryDirectory() as folder:
        paths = []
        for seed in range(1, SEEDS + 1):
            out = pathlib.Path(folder, f"s{seed}.h5")
            paths.append(gem.run(CASES / "first.toml", out, run__seed=seed, run__duration_s=400.0, floes__count=500,
                                 floes__length_m=250.0, floes__start_x_m=-300.0).path)
        forces = []
        for path in paths:
            with gem.open(path) as run:
                forces.append(-run.platform.mooring_force_x.values / 1e3)
                time = run.platform.time.values
        largest = gem.analyse(*paths)["over_runs"]["mooring_force_largest_N"]["mean"]
    mean = numpy.mean(forces, axis=0)
    half = STUDENT_95 * numpy.std(forces, axis=0, ddof=1) / SEEDS**0.5
    figure, axes = pyplot.subplots(figsize=(9, 5), constrained_layout=True)
    for force in forces:
        axes.plot(time, force, color="#8a8f98", linewidth=0.5)
    axes.fill_between(time, mean - half, mean + half, color="#31688e", alpha=0.35, label="95 % interval of the mean")
    axes.plot(time, mean, color="#31688e", label=f"mean of {SEEDS} seeds")
    axes.set(xlabel="time [s]", ylabel="mooring force against the drift [kN]",
             title=f"largest mooring force {largest['value'] / 1e3:.3g} kN ({largest['low'] / 1e3:.3g} to "
                   f"{largest['high'] / 1e3:.3g} kN)")
    axes.legend(frameon=False)
    figure.savefig(picture, dpi=100)


if __name__ == "__main__":
    main(*sys.argv[1:])
