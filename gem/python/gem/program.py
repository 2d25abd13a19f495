"""Starts the program gem: runs, sweeps, analyses. It is a process of its own."""
from __future__ import annotations

import dataclasses
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import IO, Any

import xarray

from .errors import GemError, GemWarning, ProgramError
from .run_file import RunFile

Path = str | os.PathLike[str]
Progress = Callable[[dict[str, Any]], None]


@dataclasses.dataclass(frozen=True)
class RunResult:
    """A run that was made: its file, and the summary of `gem run --json`."""

    path: str
    summary: dict[str, Any]

    @property
    def verdict(self) -> str:
        """`good`, `doubtful` or `bad`."""
        return str(self.summary["verdict"])

    def open(self) -> RunFile:
        """The run file."""
        return RunFile(self.path)


def program(chosen: Path | None = None) -> str:
    """The program: `chosen`, else the environment's GEM_PROGRAM, else gem of the search path. Raises GemError if there is none."""
    name = os.fspath(chosen) if chosen is not None else os.environ.get("GEM_PROGRAM", "gem")
    found = shutil.which(name)
    if found is None:
        raise GemError(f"the program {name} was not found (it is not on the search path); install gem, or set GEM_PROGRAM")
    return found


def _toml_text(text: str) -> str:
    """A text in TOML. JSON escapes the same characters, but for DEL; and its pairs for characters beyond 16 bits, as emoji,
    are no TOML, so these stay as they are."""
    try:
        text.encode("utf-8")
    except UnicodeEncodeError as fault:
        raise GemError(f"{text!r} cannot be written in a case ({fault.reason}); leave such characters out") from fault
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _toml(value: Any) -> str:
    """A value of a case in TOML. JSON has the same lists."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if hasattr(value, "item") and not isinstance(value, (str, bytes)):
        value = value.item()  # a number of numpy
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return _toml_text(value)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_toml_text(str(key))} = {_toml(one)}" for key, one in value.items()) + "}"
    if isinstance(value, Sequence):
        return "[" + ", ".join(_toml(one) for one in value) + "]"
    raise GemError(f"{value!r} cannot be written in a case (allowed are numbers, texts, lists and tables); convert it")


def setting_arguments(settings: Mapping[str, Any]) -> list[str]:
    """`--set` for each setting; `section__key` means `section.key`, since a dot is no part of a Python name."""
    arguments: list[str] = []
    for key, value in settings.items():
        arguments += ["--set", f"{key.replace('__', '.')}={_toml(value)}"]
    return arguments


class _Messages:
    """Sorts the lines of standard error into progress, warnings and the error."""

    def __init__(self, progress: Progress | None):
        self.progress = progress
        self.error = ""
        self.others: list[str] = []

    def take(self, line: str) -> None:
        try:
            message = json.loads(line)
            level = message["level"]
        except (ValueError, KeyError, TypeError):
            self.others.append(line.strip())
            return
        if level == "progress" and self.progress is not None:
            self.progress(message)
        elif level == "warning":
            warnings.warn(str(message.get("message")), GemWarning, stacklevel=5)
        elif level == "error":
            self.error = str(message.get("message"))


def _stop(process: subprocess.Popen[str]) -> None:
    """Ends the program in order: it closes its file and writes a checkpoint."""
    process.send_signal(signal.SIGINT)
    try:
        process.wait(timeout=30)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _call(arguments: list[str], progress: Progress | None, accepted: tuple[int, ...] = (0,)) -> str:
    """Runs the program and returns its standard output. Raises ProgramError for another exit code."""
    messages = _Messages(progress)
    with tempfile.TemporaryFile("w+", encoding="utf-8") as output:
        # Output goes to a file: a pipe that nobody reads would stop the program while its messages are read. A session of
        # its own: Ctrl-C reaches the program once, from _stop(); a second signal would end it out of order.
        with subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.PIPE, encoding="utf-8",
                              errors="replace", start_new_session=True) as process:
            try:
                lines: IO[str] | None = process.stderr
                for line in lines or ():
                    messages.take(line)
                code = process.wait()
            except BaseException:
                _stop(process)
                raise
        if code not in accepted:
            raise ProgramError(messages.error or " ".join(messages.others[-3:]) or "it gave no reason", code)
        output.seek(0)
        return output.read()


def _json_of(text: str) -> Any:
    try:
        return json.loads(text)
    except ValueError as fault:
        raise GemError(f"the program's answer is no JSON ({fault}); its version may not fit this package") from fault


_MESSAGES = ["--json", "--progress", "json", "--log-format", "json"]


def run(case: Path | None = None, out: Path | None = None, *, from_run: Path | None = None, from_time: float | None = None,
        engine: str = "auto", threads: int | None = None, overwrite: bool = False, strict: bool = False,
        progress: Progress | None = None, gem: Path | None = None, **settings: Any) -> RunResult:
    """Runs a case and returns its file and summary.

    `case`: a case file; None: the built-in case, which needs settings. `out`: the run file; by default the run's name with
    .h5 in the working folder. `from_run`: begins with the floes and the platform of that run file, at its frame at
    `from_time` [s], by default the last. `settings`: keys of the case, `section__key=value`, e.g. `run__duration_s=600.0`;
    lists and tables as in TOML.
    `progress` is called with a dict for each line of progress: `fraction` (0 to 1), `time_s`, `wall_time_s`, `left_s`,
    `sim_rate`. `strict`: a bad verdict is an error. `gem`: the program.

    Raises ProgramError with the message and the exit code of the program, e.g. 3 for a case that is rejected; GemError if
    there is no program. Warnings of the program are GemWarnings. What a callback raises, and Ctrl-C, stop the run in order.
    """
    arguments = [program(gem), "run", *_MESSAGES, "--engine", engine, *setting_arguments(settings)]
    arguments += ["--threads", str(threads)] if threads is not None else []
    arguments += ["--overwrite"] if overwrite else []
    arguments += ["--strict"] if strict else []
    if from_time is not None and from_run is None:
        raise GemError("from_time needs from_run, the run that it is a time of; give both")
    if from_run is not None:
        arguments += ["--from", os.fspath(from_run) + ("" if from_time is None else f"@{float(from_time)!r}")]
    arguments += ["--out", os.fspath(out)] if out is not None else []
    arguments += ["--", os.fspath(case)] if case is not None else []
    summary = _json_of(_call(arguments, progress))
    return RunResult(str(summary["file"]), summary)


def sweep(file: Path, out: Path, *, jobs: int | None = None, engine: str = "auto", overwrite: bool = False,
          progress: Progress | None = None, gem: Path | None = None, **settings: Any) -> list[RunResult]:
    """Makes every run of a sweep file in the folder `out` and returns them in the order of the file.

    What is done already is not run again. `jobs`: processes at a time. The others as in `run()`; progress has `done`,
    `running`, `failed`, `runs`. Raises ProgramError if a run failed; all others were made then.
    """
    arguments = [program(gem), "sweep", "run", *_MESSAGES, "--engine", engine, "--out", os.fspath(out)]
    arguments += setting_arguments(settings)
    arguments += ["--jobs", str(jobs)] if jobs is not None else []
    arguments += ["--overwrite"] if overwrite else []
    answer = _json_of(_call([*arguments, "--", os.fspath(file)], progress))
    folder = pathlib.Path(out)
    return [RunResult(str(folder / member["file"]), member) for member in answer["runs"]]


def analyse(*runs: Path, start: float = 0.0, gem: Path | None = None) -> dict[str, Any]:
    """Periods, orbit, contact and loads: the answer of `gem analyse --json`.

    One run: `findings`, a dict of `{"value": ..., "low": ..., "high": ...}` with the 95 % interval where there is one,
    None where the run does not resolve it. Several runs of one condition: `over_runs` and `extremes`. `start` [s]: the
    record before is ignored. Raises ProgramError.
    """
    arguments = [program(gem), "analyse", "--json", "--from", repr(float(start)), "--", *[os.fspath(one) for one in runs]]
    return dict(_json_of(_call(arguments, None)))


def collect(folder: Path, out: Path, *, gem: Path | None = None) -> xarray.Dataset:
    """The summary of a sweep's folder, one row per run, from `gem sweep collect`; it is written to `out`.

    Settings are coordinates along `run`, findings variables. Needs h5netcdf. Raises ProgramError, e.g. if `out` exists.
    """
    _call([program(gem), "sweep", "collect", "--out", os.fspath(out), "--", os.fspath(folder)], None)
    with xarray.open_dataset(out, engine="h5netcdf") as table:
        return table.load()
