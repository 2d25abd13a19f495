"""Reads run files: groups as xarray datasets, floe outlines as arrays."""
from __future__ import annotations

import dataclasses
import os
import tomllib
from typing import Any

import h5py
import numpy
import xarray

from .errors import GemError

GROUPS = ("shape", "boundary", "floes", "platform", "events", "stats", "contacts")
SCHEMA = "1"


@dataclasses.dataclass(frozen=True)
class Outlines:
    """The floes of one frame in the world.

    `time` [s]; `floe`, shape (n,): index of each floe in the file; `corners`, n arrays of shape (corners, 2): x and y [m],
    counter-clockwise, the first corner is not repeated; `speed` [m/s], `spin` [rad/s], `thickness` [m]: shape (n,).
    """

    time: float
    floe: numpy.ndarray
    corners: list[numpy.ndarray]
    speed: numpy.ndarray
    spin: numpy.ndarray
    thickness: numpy.ndarray


def _text(value: Any) -> Any:
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else value


def _attributes(item: Any) -> dict[str, Any]:
    hidden = ("DIMENSION_LIST", "REFERENCE_LIST", "CLASS", "NAME", "_Netcdf4Dimid")
    return {name: _text(value) for name, value in item.attrs.items() if name not in hidden}


def _opened(path: str) -> h5py.File:
    try:
        return h5py.File(path, "r")
    except OSError as fault:
        try:
            return h5py.File(path, "r", swmr=True)  # a run that is being written, or was killed, opens only so
        except (OSError, ValueError):
            reason = fault.strerror or str(fault)
            raise GemError(f"cannot read {path} ({reason}); check that it is a run file") from fault


class RunFile:
    """An open run file. Close it with `close()`, or use it in a `with` statement.

    The groups `shape`, `boundary`, `floes`, `platform`, `events`, `stats` and, where it was recorded, `contacts` are
    `xarray.Dataset`s with the units and long names of the file as attributes. `time` [s] is the coordinate of floes, platform and stats; rows of `floe`
    and `event` count from 0. They are read when they are first asked for and then kept. `floes` reads every frame; `frame()` and
    `outlines()` read one.
    """

    def __init__(self, path: str | os.PathLike[str], allow_incomplete: bool = False):
        self.path = os.fspath(path)
        self._file = _opened(self.path)
        self._groups: dict[str, xarray.Dataset] = {}
        self.attributes: dict[str, Any] = _attributes(self._file)
        try:
            self._check(allow_incomplete)
        except GemError:
            self.close()
            raise

    def _check(self, allow_incomplete: bool) -> None:
        if "gem_status" not in self.attributes:
            raise GemError(f"{self.path}: not a run file (it has no gem_status); check the path")
        schema = str(self.attributes.get("gem_schema"))
        if schema != SCHEMA:
            raise GemError(f"{self.path}: layout {schema!r} (this package reads {SCHEMA!r}); use the package of the program "
                           "that wrote it")
        if self.status not in ("complete", "stopped:until") and not allow_incomplete:
            raise GemError(f"{self.path}: the run is not complete (status: {self.status}); finish it, or open it with "
                           "allow_incomplete=True")

    def __enter__(self) -> RunFile:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<gem.RunFile {self.path!r}: {self.name!r}, {self.status}>"

    def close(self) -> None:
        """Closes the file. What was read stays."""
        self._file.close()

    def refresh(self) -> None:
        """Forgets what was read, to see the rows that a running run wrote since."""
        self._file.close()
        self._file = _opened(self.path)
        self.attributes = _attributes(self._file)
        self._groups.clear()

    @property
    def name(self) -> str:
        """The name of the run."""
        return str(self.attributes.get("title", ""))

    @property
    def status(self) -> str:
        """`running` (or killed), `complete` or `stopped:REASON`."""
        return str(self.attributes["gem_status"])

    @property
    def verdict(self) -> str:
        """`good`, `doubtful` or `bad`; empty while the run runs and after a kill."""
        return str(self.attributes.get("gem_verdict", ""))

    @property
    def state_hash(self) -> str:
        """16 hex digits. Same bits, same hash."""
        return str(self.attributes.get("gem_state_hash", ""))

    @property
    def case(self) -> dict[str, Any]:
        """The case with all its keys, e.g. `run.case["mooring"]["stiffness_N_per_m"]`."""
        text = self.attributes.get("gem_case_toml")
        if text is None:  # a long case is a dataset
            text = _text(self._file["gem_case_toml"][()])
        try:
            return tomllib.loads(str(text))
        except tomllib.TOMLDecodeError as fault:
            raise GemError(f"{self.path}: its case cannot be read ({fault}); the file may be damaged") from fault

    def group(self, name: str) -> xarray.Dataset:
        """One of GROUPS as a dataset. Raises GemError for another name, and for a group that is damaged."""
        if name not in GROUPS:
            raise GemError(f"no group {name!r} (there are {', '.join(GROUPS)}); correct the name")
        if name not in self._groups:
            self._groups[name] = self._read(name)
        return self._groups[name]

    shape = property(lambda self: self.group("shape"), doc="What a floe is: outlines, thickness, mass.")
    boundary = property(lambda self: self.group("boundary"), doc="The fixed bodies in the world.")
    floes = property(lambda self: self.group("floes"), doc="Every frame of the floes: (time, floe).")
    platform = property(lambda self: self.group("platform"), doc="Motion of the platform and forces on it: (time,).")
    events = property(lambda self: self.group("events"), doc="Hits of floes on the platform: (event,).")
    contacts = property(lambda self: self.group("contacts"), doc="Forces between bodies at the frames, where recorded: (contact,).")
    stats = property(lambda self: self.group("stats"), doc="Books and quality of the run: (time,).")

    def datasets(self) -> dict[str, xarray.Dataset]:
        """All groups by name."""
        return {name: self.group(name) for name in GROUPS if name in self._file}

    def tree(self) -> Any:
        """All groups as one `xarray.DataTree`. Raises GemError where xarray has none (before 2024.10)."""
        if not hasattr(xarray, "DataTree"):
            raise GemError("this xarray has no DataTree (it is older than 2024.10); use datasets()")
        root = xarray.Dataset(attrs=self.attributes)
        # Dimensions of one name differ between groups, so that no group may inherit them from the root.
        return xarray.DataTree.from_dict({"/": root, **self.datasets()})

    def _read(self, name: str) -> xarray.Dataset:
        if name not in self._file:
            raise GemError(f"{self.path}: no group {name} (the run did not record it); look at the others")
        variables: dict[str, tuple[tuple[str, ...], h5py.Dataset]] = {}
        for key, item in self._file[name].items():
            if not isinstance(item, h5py.Dataset) or "units" not in item.attrs:
                continue  # a dimension without values
            variables[key] = (self._dimensions(item), item)
        rows: dict[str, int] = {}
        for dimensions, item in variables.values():
            item.refresh()
            for dimension, length in zip(dimensions, item.shape):
                rows[dimension] = min(length, rows.get(dimension, length))  # while it is written, lengths may differ
        data = {key: (dimensions, item[tuple(slice(rows[d]) for d in dimensions)], _attributes(item))
                for key, (dimensions, item) in variables.items()}
        dataset = xarray.Dataset(data, attrs={"run": self.name})
        return dataset.set_coords("time") if "time" in data and data["time"][0] in (("event",), ("contact",), ("split",)) else dataset

    def _dimensions(self, item: h5py.Dataset) -> tuple[str, ...]:
        if h5py.h5ds.is_scale(item.id):
            return (item.name.rsplit("/", 1)[-1],)
        try:
            return tuple(axis[0].name.rsplit("/", 1)[-1] for axis in item.dims)
        except (RuntimeError, KeyError, IndexError) as fault:
            raise GemError(f"{self.path}: {item.name} has no named dimensions ({fault}); the file may be damaged") from fault

    def frame_times(self) -> numpy.ndarray:
        """Times of the floe frames [s], shape (frames,)."""
        return numpy.asarray(self._file["floes/time"][...])

    def frame(self, time: float | None = None) -> xarray.Dataset:
        """The floe frame nearest to `time` [s], by default the last: x, y, theta, vx, vy, omega, active along `floe`.

        Raises GemError without frames, and for a time outside the record.
        """
        times = self.frame_times()
        if len(times) == 0:
            raise GemError(f"{self.path}: no frame of the floes (the run ended before the first); run it again")
        time = float(times[-1]) if time is None else float(time)
        step = float(times[-1] - times[-2]) if len(times) > 1 else 0.0
        if not -1e-6 <= time <= times[-1] + 0.5 * step + 1e-6:
            raise GemError(f"{self.path}: no frame at {time} s (the record is 0 to {times[-1]} s); choose a time in it")
        index = int(numpy.argmin(numpy.abs(times - time)))
        group = self._file["floes"]
        values = {name: ("floe", group[name][index], _attributes(group[name]))
                  for name in ("x", "y", "theta", "vx", "vy", "omega", "active")}
        return xarray.Dataset(values, coords={"time": ((), times[index], {"units": "s"})})

    def outlines(self, time: float | None = None) -> Outlines:
        """The active floes of the frame nearest to `time` [s], by default the last. Raises as `frame()`."""
        frame = self.frame(time)
        local = self._outlines_of("shape")
        if len(local) != frame.sizes["floe"]:
            raise GemError(f"{self.path}: {len(local)} outlines for {frame.sizes['floe']} floes; the file may be damaged")
        active = numpy.flatnonzero(frame.active.values)
        corners = []
        for i in active:
            turn = float(frame.theta[i])
            c, s = numpy.cos(turn), numpy.sin(turn)
            corners.append(local[i] @ numpy.array([[c, s], [-s, c]]) + [float(frame.x[i]), float(frame.y[i])])
        speed = numpy.hypot(frame.vx.values, frame.vy.values)[active]
        return Outlines(float(frame.time), active, corners, speed, frame.omega.values[active],
                        self.shape.thickness.values[active])

    def platform_outline(self, time: float | None = None) -> numpy.ndarray:
        """Corners of the platform at its last sample at or before `time` [s], shape (corners, 2) [m]; no rows without one."""
        outline = self.shape.platform_xy.values if "platform_xy" in self.shape else numpy.zeros((0, 2))
        times = self.platform.time.values
        if len(outline) == 0 or len(times) == 0:
            return numpy.zeros((0, 2))
        last = times[-1] if time is None else time
        at = max(0, int(numpy.searchsorted(times, last + 1e-6 * (1 + abs(last)), side="right")) - 1)
        here = self.platform.isel(time=at)
        c, s = numpy.cos(float(here.psi)), numpy.sin(float(here.psi))
        return numpy.asarray(outline @ numpy.array([[c, s], [-s, c]]) + [float(here.x), float(here.y)])

    def platform_pieces(self, time: float | None = None) -> list[numpy.ndarray]:
        """Corners of each convex piece of the platform, as `platform_outline()`; one array for a platform of one piece."""
        corners = self.platform_outline(time)
        if len(corners) == 0 or "platform_first" not in self.shape:
            return [corners] if len(corners) else []
        return list(numpy.split(corners, self.shape.platform_first.values[1:]))

    def boundary_outlines(self) -> list[numpy.ndarray]:
        """Corners of each fixed body in the world, arrays of shape (corners, 2) [m]."""
        return self._outlines_of("boundary")

    def _outlines_of(self, name: str) -> list[numpy.ndarray]:
        counts, corners = self.group(name).vertex_count.values, self.group(name).vertex_xy.values
        if len(counts) == 0:
            return []
        if counts.min() < 3 or counts.sum() != len(corners):
            raise GemError(f"{self.path}: {name}/vertex_count does not fit {name}/vertex_xy; the file may be damaged")
        return list(numpy.split(corners, numpy.cumsum(counts)[:-1]))


def open(path: str | os.PathLike[str], allow_incomplete: bool = False) -> RunFile:  # noqa: A001, the name that users expect
    """Opens a run file, also one that is being written (with `allow_incomplete`).

    Raises GemError if it cannot be read, is no run file or is not complete.
    """
    return RunFile(path, allow_incomplete)
