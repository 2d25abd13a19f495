#!/usr/bin/python3
"""Runs bench/speed_against_error over the windows of the moment study and keeps its rows in bench/results/moment.

Every length of the moment is given as the drift in it, U dt, so that a speed only changes the clock.
Usage: scripts/moment_windows.py [NAME...]      (without names all; a window that was run is run again)"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
OUT = ROOT / "bench" / "results" / "moment"
DRIFTS = [0.025, 0.05, 0.1, 0.2]  # U dt [m]
ITERATIONS = [12, 24, 48, 96]
FINEST = 0.025 / 16.0  # U dt of the reference [m]
INDEPENDENT = 'contact.resolution="independent" contact.manifold="chord_middle"'

EVERY = [(drift, n) for drift in DRIFTS for n in ITERATIONS] + [(drift, 0) for drift in DRIFTS]
SOME = [(0.025, 24), (0.025, 96), (0.05, 12), (0.05, 24), (0.05, 48), (0.05, 96), (0.1, 12), (0.1, 24), (0.1, 96),
        (0.2, 24), (0.2, 96), (0.05, 0)]
CLOSER = [(FINEST * 2.0, 48), (0.025, 96), (0.025, 192), (0.05, 96), (0.05, 192), (0.05, 384), (0.1, 384)]
FEW = [(0.025, 24), (0.025, 96), (0.05, 24), (0.05, 48), (0.05, 96), (0.1, 48), (0.1, 96)]
# name: case, speed [m/s], starts [s], length [s], settings, with a reference
WINDOWS = {
    "errors_004_400_25": ("cases/004_400_25.toml", 0.25, "100,1000,2000,3500,5000", 32, EVERY + CLOSER[:1], True),
    "errors_400_200_100": ("cases/table1.toml#27", 1.0, "100,300,600", 10, EVERY, True),
    "errors_400_300_100": ("cases/table1.toml#24", 1.0, "100,400", 10, EVERY, True),
    "closer_400_200_100": ("cases/table1.toml#27", 1.0, "300", 10, CLOSER, True),
    "forces_400_200_100": ("cases/table1.toml#27", 1.0, "300", 60, SOME, False),
    "forces_400_200_100_late": ("cases/table1.toml#27", 1.0, "600", 40, FEW, False),
    "forces_004_400_25": ("cases/004_400_25.toml", 0.25, "2000", 600, SOME, False),
}


def setting(drift, iterations, speed):
    """One line of a settings file; 0 iterations: independent."""
    label = f"{100 * drift:.4g} cm/{iterations or 'independent'}"
    how = f"numerics.iterations_maximum={iterations}" if iterations else INDEPENDENT
    return f"{label} | cpu | warm={1 if iterations else 0} | output.platform_interval_s=1 numerics.moment_s={drift / speed:.10g} {how}"


def run(name):
    case, speed, starts, length, chosen, with_reference = WINDOWS[name]
    lines = [setting(drift, n, speed) for drift, n in chosen]
    if with_reference:
        lines.insert(0, "reference" + setting(FINEST, 48, speed)[len(f"{100 * FINEST:.4g} cm/48"):])
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as settings:
        settings.write("\n".join(lines) + "\n")
        settings.flush()
        command = [ROOT / "build/speed_against_error", ROOT / case, starts, str(length), "0", settings.name]
        done = subprocess.run(command + ["reference"] * with_reference, stdout=subprocess.PIPE, text=True, check=True)
    OUT.mkdir(parents=True, exist_ok=True)
    (OUT / f"{name}.csv").write_text(done.stdout, encoding="ascii")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(WINDOWS))
    for name in parser.parse_args().names or WINDOWS:
        print(name, file=sys.stderr)
        run(name)


if __name__ == "__main__":
    main()
