"""Run files of gem in Python, and the program started from there.

Everything is in SI units; angles are in radians, counter-clockwise. See gem/manual/python.md.

    import gem
    run = gem.open("first.h5")
    run.platform.mooring_force_x.max()
    gem.plot_field(run, time=600.0)
"""
from .errors import GemError, GemWarning, ProgramError
from .plots import field_patches, plot_field, plot_orbit, plot_spectrum, spectrum
from .program import RunResult, analyse, collect, program, run, sweep
from .run_file import Outlines, RunFile, open

__version__ = "0.1.0"
__all__ = ["GemError", "GemWarning", "Outlines", "ProgramError", "RunFile", "RunResult", "analyse", "collect",
           "field_patches", "open", "plot_field", "plot_orbit", "plot_spectrum", "program", "run", "spectrum", "sweep"]
