"""Pictures of a run with matplotlib."""
from __future__ import annotations

from typing import Any

import numpy

from .errors import GemError
from .run_file import RunFile

PLATFORM_COLOUR = "#c2571a"
FIXED_COLOUR = "#b9bec6"
WATER_COLOUR = "#eef2f5"
COLOURS = {"speed": "speed [m/s]", "spin": "spin [rad/s]", "thickness": "thickness [m]"}
CHANNELS = {"x": "m", "y": "m", "psi": "rad", "ice_force_x": "N", "ice_force_y": "N", "mooring_force_x": "N",
            "mooring_force_y": "N"}


def _plain(text: str) -> str:
    """A text of a run file without signs that matplotlib would take as formulas, and without control characters."""
    return "".join(c if c.isprintable() else " " for c in text[:200]).replace("$", r"\$")


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    try:
        from matplotlib import pyplot
    except ImportError as missing:
        raise GemError("no matplotlib (pictures need it); install python3-matplotlib") from missing
    return pyplot.subplots(figsize=(8, 5), constrained_layout=True)[1]


def field_patches(run: RunFile, time: float | None = None, colour: str = "speed", **style: Any) -> Any:
    """The floes of the frame nearest to `time` [s] as one `matplotlib.collections.PolyCollection`.

    `colour`: speed, spin or thickness, which becomes the collection's array, shape (n,). `style` goes to matplotlib.
    Raises GemError for another colour, and as `RunFile.frame()`.
    """
    from matplotlib.collections import PolyCollection

    if colour not in COLOURS:
        raise GemError(f"colour {colour!r} is unknown (there are {', '.join(COLOURS)}); choose one of these")
    outlines = run.outlines(time)
    return PolyCollection(outlines.corners, array=getattr(outlines, colour), **{"cmap": "viridis", "edgecolors": "none", **style})


def plot_field(run: RunFile, time: float | None = None, colour: str = "speed", ax: Any = None, **style: Any) -> Any:
    """Draws the floes, the platform and the fixed bodies to scale at the frame nearest to `time` [s]. Returns the axes.

    The view shows all floes; set other limits on the axes. Raises as `field_patches()`.
    """
    ax = _axes(ax)
    patches = field_patches(run, time, colour, **style)
    at = float(run.frame(time).time)
    platform = run.platform_pieces(at)
    ax.set_facecolor(WATER_COLOUR)
    for outline in run.boundary_outlines():
        ax.fill(*outline.T, color=FIXED_COLOUR, zorder=0)
    ax.add_collection(patches, autolim=False)
    for piece in platform:
        ax.fill(*piece.T, color=PLATFORM_COLOUR, zorder=3)
    shown = [corners for corners in [*run.outlines(time).corners, *platform] if len(corners)]
    if shown:
        points = numpy.concatenate(shown)
        rim = 0.02 * float(numpy.ptp(points[:, 0])) + 5.0
        ax.set_xlim(points[:, 0].min() - rim, points[:, 0].max() + rim)
        ax.set_ylim(points[:, 1].min() - rim, points[:, 1].max() + rim)
    ax.set_aspect("equal")
    ax.set(xlabel="x [m]", ylabel="y [m]", title=f"{_plain(run.name)}, t = {at:g} s")
    ax.figure.colorbar(patches, ax=ax, label=COLOURS[colour], shrink=0.8)
    return ax


def plot_orbit(run: RunFile, ax: Any = None, **style: Any) -> Any:
    """Draws the path of the platform's centre about the anchor [m], coloured by time. Returns the axes.

    Raises GemError for a run without a platform.
    """
    from matplotlib.collections import LineCollection

    ax = _axes(ax)
    if run.platform.sizes["time"] < 2:
        raise GemError(f"{run.path}: no path of a platform (the run has none, or fewer than two samples); plot the field")
    anchor = run.case["platform"]["anchor_m"]
    path = numpy.stack([run.platform.x - anchor[0], run.platform.y - anchor[1]], axis=1)
    pieces = numpy.stack([path[:-1], path[1:]], axis=1)
    lines = LineCollection(pieces, array=run.platform.time.values[:-1], **{"cmap": "viridis", "linewidths": 1.0, **style})
    ax.add_collection(lines)
    ax.plot(0, 0, "+", color=PLATFORM_COLOUR, markersize=10)
    ax.autoscale_view()
    ax.set_aspect("equal", adjustable="datalim")
    ax.set(xlabel="surge from the anchor [m]", ylabel="sway from the anchor [m]", title=f"{_plain(run.name)}: orbit")
    ax.figure.colorbar(lines, ax=ax, label="time [s]", shrink=0.8)
    return ax


def spectrum(time: numpy.ndarray, values: numpy.ndarray, segments: int = 3) -> tuple[numpy.ndarray, numpy.ndarray]:
    """One-sided power spectral density by Welch's method: Hann windows over `segments` stretches that overlap by half.

    `time` and `values`: shape (n,), evenly sampled [s] [u]. Returns frequencies [Hz] and densities [u2/Hz], shape (m,); the
    integral is the variance. Raises GemError for fewer than 16 samples in a stretch or uneven samples.
    Source: P. D. Welch, IEEE Trans. Audio Electroacoustics 15 (1967) 70-73.
    """
    length = 2 * len(values) // (segments + 1)
    if length < 16:
        raise GemError(f"{len(values)} samples are too few for a spectrum of {segments} stretches (16 each are needed); use "
                       "fewer stretches or a longer run")
    step = (time[-1] - time[0]) / (len(time) - 1)
    if not numpy.allclose(numpy.diff(time), step, rtol=1e-3):
        raise GemError("the samples are not evenly spaced (a spectrum needs that); resample them")
    window = 0.5 - 0.5 * numpy.cos(2 * numpy.pi * numpy.arange(length) / length)
    scale = 2.0 * step / float(numpy.sum(window**2))
    total = numpy.zeros(length // 2 + 1)
    starts = range(0, len(values) - length + 1, length // 2)
    for start in starts:
        part = values[start:start + length]
        total += scale * numpy.abs(numpy.fft.rfft(window * (part - part.mean()))) ** 2
    total[0] /= 2.0
    if length % 2 == 0:
        total[-1] /= 2.0
    return numpy.fft.rfftfreq(length, step), total / len(starts)


def plot_spectrum(run: RunFile, channel: str = "x", start: float = 0.0, ax: Any = None, **style: Any) -> Any:
    """Draws the power spectral density of a channel of the platform over the period [s]; the natural period of the mooring
    is marked. Returns the axes.

    `start` [s]: the record before is ignored. `channel`: x, y, psi, ice_force_x, ... Raises GemError for another channel,
    and as `spectrum()`.
    """
    if channel not in CHANNELS:
        raise GemError(f"channel {channel!r} is unknown (there are {', '.join(CHANNELS)}); choose one of these")
    ax = _axes(ax)
    record = run.platform.sel(time=slice(start, None))
    frequency, density = spectrum(record.time.values, record[channel].values)
    ax.loglog(1.0 / frequency[1:], density[1:], **style)
    case = run.case
    stiffness, mass = case["mooring"]["stiffness_N_per_m"], case["platform"]["mass_kg"]
    if stiffness > 0 and channel in ("x", "y"):
        natural = 2 * numpy.pi * (mass / stiffness) ** 0.5
        ax.axvline(natural, color=PLATFORM_COLOUR, linestyle="--", linewidth=1, label=f"natural period {natural:.3g} s")
        ax.legend(frameon=False)
    ax.set(xlabel="period [s]", ylabel=f"power spectral density of {channel} [{CHANNELS[channel]}²/Hz]",
           title=f"{_plain(run.name)}: spectrum")
    ax.grid(True, which="both", color="#e6e8eb", linewidth=0.6)
    return ax
