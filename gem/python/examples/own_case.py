"""A case of one's own: writes it, runs it, draws the field, the orbit and the mooring force.

usage: python3 own_case.py [PICTURE.png]
"""
import pathlib
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

import gem  # noqa: E402

CASE = """
[run]
name = "barge in a channel"
duration_s = 600.0
[current]
velocity_m_per_s = [0.5, 0.0]
[floes]
count = 300
length_m = 250.0
width_m = 180.0
start_x_m = -290.0
size_mean_m = 8.0
[boundary]
inlet_x_m = -300.0
inlet_width_m = 180.0
taper_start_x_m = -300.0
gap_m = 150.0
[platform]
diameter_m = 60.0
mass_kg = 2.5e7
[mooring]
stiffness_N_per_m = 2e5
damping_ratio = 0.05
[numerics]
time_step_s = 0.1
"""


def main(picture="own_case.png"):
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder, "barge.toml")
        case.write_text(CASE, encoding="utf-8")
        result = gem.run(case, pathlib.Path(folder, "barge.h5"),
                         progress=lambda line: print(f"{100 * line['fraction']:.0f} %", end=" ", flush=True))
        print(f"\n{result.verdict}, state hash {result.summary['state_hash']}")
        with result.open() as run:
            figure, axes = pyplot.subplot_mosaic([["field", "field"], ["orbit", "force"]], figsize=(11, 9),
                                                 constrained_layout=True)
            gem.plot_field(run, time=400.0, ax=axes["field"])
            gem.plot_orbit(run, ax=axes["orbit"])
            force = (run.platform.mooring_force_x**2 + run.platform.mooring_force_y**2) ** 0.5
            axes["force"].plot(run.platform.time, force / 1e3, linewidth=1)
            axes["force"].set(xlabel="time [s]", ylabel="mooring force [kN]", title=f"largest {float(force.max()) / 1e3:.3g} kN")
            figure.savefig(picture, dpi=100)


if __name__ == "__main__":
    main(*sys.argv[1:])
