"""Writes the generated part of validation/time_step_study.md from the rows in bench/results/time_step.

scripts/studies time_step_windows and build/law_study make the rows."""
import csv
import math

from measured import table
from pages import ROOT, replace_generated

ROWS = ROOT / "bench" / "results" / "time_step"
PAGE = ROOT / "validation" / "time_step_study.md"
EXACT = 1e-9  # errors below are rounding or what the iterations left [m, m/s]
TODAY = "5 cm/32"


def read(name):
    with open(ROWS / name, newline="", encoding="ascii") as file:
        return list(csv.DictReader(file))


def orders(errors):
    """Observed order between neighbouring time steps, each half of the one before."""
    return ", ".join("-" if min(a, b) < EXACT else f"{math.log2(a / b):.1f}" for a, b in zip(errors, errors[1:]))


def laws():
    groups = {}
    for row in read("laws.csv"):
        groups.setdefault((row["law"], row["resolution"], row["judge"]), []).append(row)
    rows = []
    for (law, resolution, judge), group in groups.items():
        place, velocity = ([float(row[key]) for row in group] for key in ("place_m", "velocity_m_per_s"))
        shown = [("exact" if max(e) < EXACT else f"{e[0]:.1e} … {e[-1]:.1e}") for e in (place, velocity)]
        rows.append([law, resolution, judge, f"{float(group[0]['moment_s']):g} … {float(group[-1]['moment_s']):g}",
                     shown[0], orders(place), shown[1], orders(velocity)])
    return table(["law", "resolution", "judge", "dt [s]", "error of place [m]", "orders", "error of velocity [m/s]",
                  "orders"], rows)


def relative(row, judge):
    force = float(judge["ice_force_x_N"])
    return "" if force == 0.0 else f"{100 * (float(row['ice_force_x_N']) / force - 1):+.1f}"


def small(metres):
    """In mm."""
    return f"{1e3 * float(metres):.2g}" if float(metres) > EXACT else "0"


def by_setting(rows):
    starts = sorted({float(row["start_s"]) for row in rows})
    settings = {}
    for row in rows:
        settings.setdefault(row["setting"], {})[float(row["start_s"])] = row
    return starts, settings


def mean_cost(rows):
    return sum(float(row["user_s_per_s"]) for row in rows) / len(rows)


def windows(name):
    rows = read(name)
    starts, settings = by_setting(rows)
    judge = settings.pop("reference")
    base = TODAY if TODAY in settings else "2.5 cm/96"
    today = mean_cost(settings[base].values())
    body = []
    for setting, at in settings.items():
        cells = [f"{1e3 * float(at[t]['floe_distance_rms_m']):.3g}; {small(at[t]['platform_distance_m'])}; "
                 f"{relative(at[t], judge[t])}" for t in starts]
        deepest = max(float(at[t]["overlap_maximum_m"]) for t in starts)
        most = max(float(at[t]["overlap_999_m"]) for t in starts)
        cost = mean_cost(at.values())
        body.append([setting, *cells, f"{1e3 * deepest:.2g}; {1e3 * most:.2g}", f"{cost:.4f}", f"{cost / today:.2f}"])
    lines = [f"\n#### {rows[0]['case']}: {len(starts)} windows of {rows[0]['window_s']} s\n"]
    lines += table(["U dt/iterations"] + [f"from {t:g} s" for t in starts] +
                   ["overlap: largest; 99.9 % [mm]", "user s per s", f"cost, {base}: 1"], body)
    if base == TODAY:
        shown = [orders([float(settings[f"{d} cm/48"][t]["floe_distance_rms_m"]) for d in ("20", "10", "5", "2.5")])
                 for t in starts]
        lines.append(f"Observed orders from 20, 10, 5 and 2.5 cm with 48 iterations: {'; '.join(shown)}.\n")
    return lines


def forces(name):
    rows = read(name)
    starts, settings = by_setting(rows)
    judge = settings["2.5 cm/96"]
    today = mean_cost(settings[TODAY].values())
    body = [[setting, *(f"{1e-3 * float(at[t]['ice_force_x_N']):.4g} ({relative(at[t], judge[t])})" for t in starts),
             f"{mean_cost(at.values()):.4f}", f"{mean_cost(at.values()) / today:.2f}"] for setting, at in settings.items()]
    lines = [f"\n#### {rows[0]['case']}: {rows[0]['window_s']} s\n"]
    return lines + table(["U dt/iterations"] + [f"from {t:g} s: kN (% of 2.5 cm/96)" for t in starts] +
                         ["user s per s", f"cost, {TODAY}: 1"], body)


def main():
    names = sorted(path.name for path in ROWS.glob("*.csv"))
    commits = sorted({row["commit"] for name in names for row in read(name)})
    lines = ["`build/law_study cases > bench/results/time_step/laws.csv`, `scripts/studies time_step_windows` and "
             f"`scripts/studies time_step_study`, programs of commit {', '.join(commits)}, one thread. User times were taken on "
             "a shared machine and count for ratios only.", "", "### Each law", "",
             "Mean over time and bodies of the distance to the closed form, or to a time step 64 times shorter than the "
             "shortest; orders between each dt and its half. Contacts resolved to 1e-10 of the speed.", "", *laws(),
             "### Windows restarted from one state", "",
             "The state is what the case's own settings lead to; each setting starts from the leader's impulses, scaled "
             "to its dt. Cells: rms distance of the floes [mm]; distance of the platform [mm]; mean ice force against "
             "the reference [%]. Reference: U dt = 2.5 cm / 8 with 48 iterations. `5 cm/32`: U dt = 5 cm, 32 iterations, "
             "the default of `gradient`."]
    for name in names:
        if name.startswith("errors_"):
            lines += windows(name)
    closer = [name for name in names if name.startswith("closer_")]
    if closer:
        lines += ["### Where the reference itself stands, and more iterations", "",
                  "Here the reference is U dt = 2.5 cm / 16 with 48 iterations."]
    for name in closer:
        lines += windows(name)
    lines += ["### Mean ice force over long windows", ""]
    for name in names:
        if name.startswith("forces_"):
            lines += forces(name)
    replace_generated(PAGE, "time_step_study", lines)
