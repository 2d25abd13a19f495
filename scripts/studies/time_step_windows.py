"""Runs bench/speed_against_error over the windows of the time step study and keeps its rows in bench/results/time_step.

Every length of the time step is given as the drift in it, U dt, so that a speed only changes the clock."""
import argparse
import subprocess
import sys
import tempfile

from pages import ROOT

OUT = ROOT / "bench" / "results" / "time_step"
FINEST = 0.025 / 16.0  # U dt [m]
REFERENCE = 2.0 * FINEST
INDEPENDENT = 'contact.solver="independent" contact.manifold="chord_middle"'

# U dt [m], iterations; 0: independent
EVERY = [(0.025, 48), (0.05, 24), (0.05, 32), (0.05, 48), (0.05, 96), (0.1, 32), (0.1, 48), (0.2, 48)]
CLOSER = [(REFERENCE, 48), (0.025, 96), (0.025, 192), (0.05, 96), (0.05, 192), (0.1, 384)]
LONG = [(0.025, 96), (0.05, 24), (0.05, 32), (0.05, 48), (0.1, 32), (0.1, 48), (0.05, 0)]
# name: case, speed [m/s], starts [s], length [s], settings, U dt of the reference [m] or none
WINDOWS = {
    "errors_004_400_25": ("cases/004_400_25.toml", 0.25, "1000,3500", 32, EVERY, REFERENCE),
    "errors_400_200_100": ("cases/table1.toml#27", 1.0, "300,600", 10, EVERY, REFERENCE),
    "errors_400_300_100": ("cases/table1.toml#24", 1.0, "300,600", 10, EVERY, REFERENCE),
    "closer_400_200_100": ("cases/table1.toml#27", 1.0, "300", 10, CLOSER, FINEST),
    "forces_400_200_100": ("cases/table1.toml#27", 1.0, "300", 60, LONG, None),
    "forces_400_200_100_late": ("cases/table1.toml#27", 1.0, "600", 40, LONG, None),
    "forces_004_400_25": ("cases/004_400_25.toml", 0.25, "2000", 600, LONG, None),
}


def setting(drift, iterations, speed, label=None):
    """One line of a settings file; 0 iterations: independent."""
    label = label or f"{100 * drift:.4g} cm/{iterations or 'independent'}"
    how = f'numerics.iteration="gradient" numerics.iterations_maximum={iterations}' if iterations else INDEPENDENT
    how = f"output.platform_interval_s=1 numerics.time_step_s={drift / speed:.10g} {how}"
    return f"{label} | cpu | warm={1 if iterations else 0} | {how}"


def run(name):
    case, speed, starts, length, chosen, reference = WINDOWS[name]
    lines = [setting(drift, n, speed) for drift, n in chosen]
    if reference:
        lines.insert(0, setting(reference, 48, speed, "reference"))
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as settings:
        settings.write("\n".join(lines) + "\n")
        settings.flush()
        command = [ROOT / "build/speed_against_error", ROOT / case, starts, str(length), "0", settings.name]
        done = subprocess.run(command + ["reference"] * bool(reference), stdout=subprocess.PIPE, text=True, check=True)
    OUT.mkdir(parents=True, exist_ok=True)
    (OUT / f"{name}.csv").write_text(done.stdout, encoding="ascii")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(WINDOWS) + "; all without a name; one that was run is run again")
    for name in parser.parse_args().names or WINDOWS:
        print(name, file=sys.stderr)
        run(name)

