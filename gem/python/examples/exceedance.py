"""How often the mooring force exceeds a level, of several seeds: maxima of its cycles, as a designer counts them.

A cycle's maximum is the largest force between two upcrossings of the mean. usage: python3 exceedance.py [PICTURE.png]
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
SEEDS = 4
ARRIVAL_S = 100.0  # the ice is at the barge


def cycle_maxima(force):
    """Maxima between upcrossings of the mean, in descending order; shape (cycles,)."""
    above = force > force.mean()
    starts = numpy.flatnonzero(~above[:-1] & above[1:]) + 1
    return numpy.sort([part.max() for part in numpy.split(force, starts)[1:-1]])[::-1]


def main(picture="exceedance.png"):
    figure, axes = pyplot.subplots(figsize=(8, 5), constrained_layout=True)
    every, hours = [], 0.0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(1, SEEDS + 1):
            result = gem.run(CASES / "first.toml", pathlib.Path(folder, f"s{seed}.h5"), run__seed=seed, run__duration_s=600.0,
                             floes__count=500, floes__length_m=250.0, floes__start_x_m=-300.0)
            with result.open() as run:
                record = run.platform.sel(time=slice(ARRIVAL_S, None))
            maxima = cycle_maxima(-record.mooring_force_x.values)  # it pulls against the drift
            duration = float(record.time[-1] - record.time[0]) / 3600
            axes.step(maxima / 1e3, numpy.arange(1, len(maxima) + 1) / duration, where="post", color="#8a8f98", linewidth=0.8)
            every.append(maxima)
            hours += duration
    maxima = numpy.sort(numpy.concatenate(every))[::-1]
    axes.step(maxima / 1e3, numpy.arange(1, len(maxima) + 1) / hours, where="post", color="#31688e",
              label=f"{SEEDS} seeds together, {len(maxima)} cycles in {hours:.2g} h")
    axes.set_yscale("log")
    axes.set(xlabel="level of the mooring force against the drift [kN]", ylabel="cycles above the level, per hour",
             title="Exceedance of the mooring force; grey: each seed")
    axes.grid(True, which="both", color="#e6e8eb", linewidth=0.6)
    axes.legend(frameon=False)
    figure.savefig(picture, dpi=100)


if __name__ == "__main__":
    main(*sys.argv[1:])
