"""Data, figures and pages of speed against error: validation/baseline/speed_against_error.md and the ensembles' part of
validation/baseline/README.md, from the tables in bench/results/speed_against_error. scripts/measure.sh makes the tables;
rows of other engines lie beside them in other/ and are told by their header."""
import argparse
import math
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tarfile
import tempfile

import chart
import ensembles_page
from bars_page import bars
from measured import FIGURES, FOLDER, ROOT, ROWS, commit_of, conditions, figure, grouped, provenance, read, stamp, table
from windows_page import part_b

# As bench/closed_form_errors.cpp says.
CLOSED_FORMS = {"V06": "a corner on a wall", "V17": "a corner on a wall with friction", "V26": "a floe drifts onto a wall",
                "V33": "a column of ten pressed to a wall", "V10": "a floe on the moored platform"}


def part_a():
    rows = read("closed_form_errors.csv")
    if not rows:
        return ["## A. Closed forms", "", "Not measured.", ""]
    panels, lines = [], []
    for (case,), group in grouped(rows, "case").items():
        for key, what, unit in (("place_L1_m", "place", "m"), ("velocity_L1_m_per_s", "velocity", "m/s")):
            panel = chart.Panel(f"{case}, {CLOSED_FORMS[case]}: {what}", "user time per simulated second [s/s]", f"mean error of {what} [{unit}]")
            panel.key = "below Left reverse width -1 maxrows 2 font ',9'"
            for (setting,), curve in grouped(group, "setting").items():
                panel.curve(setting, chart.colour_of(setting),
                            [(float(r["user_s_per_s"]), float(r[key])) for r in sorted(curve, key=lambda r: -float(r["moment_s"]))])
            panels.append(panel)
    chart.write_figure(FIGURES / "closed_form_errors.svg", panels, 2, 560, 340, stamp("closed_form", rows=rows))
    lines += ["## A. Closed forms", "",
              "Mean over time of the error of place and velocity (velocities jump at impacts, so their largest error does",
              "not shrink with the time step); impacts are spread evenly over a time step. Along each curve the time step is halved.",
              "V33 begins with touching floes, inside Box2D's skins, which push them apart: with the usual skin that is its error.", "", provenance("closed_form", rows), ""]
    return lines + figure("closed_form_errors", "Part A: error against cost on five closed forms.")


def ensemble_values():
    values = {}
    for row in read("ensemble_rows.csv"):
        values.setdefault((row["case"], row["setting"]), {}).setdefault(row["quantity"], []).append(float(row["value"]))
    return values


def part_c():
    values = ensemble_values()
    cases = [case for (case, setting), numbers in values.items()
             if setting == "fine" and len(numbers["offset_x_mean_m"]) >= 3]
    if not cases:
        return ["## C. Statistics", "", "Not measured: the ensemble `fine`, from which biases are measured, was not made. The ensembles",
                "that were made compare gem with Box2D: [README.md](README.md).", ""]
    lines = ["## C. Statistics", "",
             "Mean square error of an ensemble's mean, bias^2 + variance / N, against the cost of its N members; the bias is",
             "the difference from the ensemble `fine` (a quarter of the time step, 400 iterations) and holds its own scatter,",
             "stated as noise. Cost is wall time on one core with recording.", "", provenance("ensembles"), ""]
    panels = []
    for case in dict.fromkeys(cases):
        fine = values[(case, "fine")]
        body = []
        for quantity in ("offset_x_mean_m", "offset_x_deviation_m", "ice_force_x_mean_N", "landings_per_s"):
            truth = statistics.mean(fine[quantity])
            noise = statistics.stdev(fine[quantity]) / math.sqrt(len(fine[quantity])) / abs(truth)
            panel = chart.Panel(f"{case}: {quantity}", "wall time of N members per simulated second [s/s]",
                                "root mean square error, relative")
            for (name, setting), numbers in values.items():
                sample = [v for v in numbers.get(quantity, []) if v == v]
                if name != case or setting == "fine" or len(sample) < 3:
                    continue
                bias = (statistics.mean(sample) - truth) / truth
                deviation = statistics.stdev(sample) / abs(truth)
                cost = statistics.median(numbers["wall_s_per_s"])
                panel.curve(setting, chart.colour_of(setting),
                            [(n * cost, math.sqrt(bias * bias + deviation ** 2 / n)) for n in (1, 2, 5, 10, 20, 50, 100)])
                body.append([quantity, setting, f"{100 * bias:+.2g}", f"{100 * noise:.2g}", f"{100 * deviation:.2g}",
                             f"{cost:.3g}"])
            panels.append(panel)
        lines += [f"### {case}", ""] + table(["quantity", "setting", "bias [%]", "noise of the bias [%]",
                                              "scatter of one run [%]", "wall [s/s]"], body)
    chart.write_figure(FIGURES / "statistics.svg", panels, 2, 760, 400, stamp("ensembles"))
    return lines + figure("statistics", "Part C: what an ensemble's mean costs and misses, for N = 1 to 100 members.")


def part_paths():
    rows = read("paths.csv")
    if not rows:
        return ["## Path by path, before runs part", "", "Not measured.", ""]
    panels = []
    for (regime,), group in grouped(rows, "regime").items():
        for key, what in (("floes_rms_m", "floes, root mean square"), ("platform_m", "platform")):
            panel = chart.Panel(f"{regime}: {what}", "time from one identical state [s]", "distance [m]", "y")
            for (setting,), path in grouped(group, "setting").items():
                if not setting.startswith("reference"):
                    panel.curve(setting, chart.colour_of(setting),
                                [(float(r["time_s"]), float(r[key])) for r in path if float(r[key]) > 1e-12])
            panels.append(panel)
    chart.write_figure(FIGURES / "paths.svg", panels, 2, 760, 360, stamp("paths"))
    return ["## Path by path, before runs part", "",
            "All settings start from one identical state; the distance is from the same scene at a quarter of the time step,",
            "converged. Where the curves level off the paths are no longer the same and only statistics compare.", "",
            provenance("paths"), ""] + figure("paths", "Distance of floes and platform from the reference over time.")


def part_speed():
    rows = read("speed.csv")
    if not rows:
        return ["## Real-time factors", "", "Not measured.", ""]
    lines = ["## Real-time factors", "",
             "Every engine runs the case from its beginning for the time stated, one thread each, in one process, taking turns block by",
             "block; recording is off. The factor is simulated time over the sum of wall times. Ratio: Box2D's wall time over gem's,",
             "median over the blocks with its quartiles; above 1 gem is faster. gem and Box2D take the same time step here, so this is speed",
             "without regard to error.", "", provenance("speed", rows), ""]
    body, middles = [], []
    shown = [s for s in SPEED_SETTINGS if any(r["setting"] == s for r in rows)]
    mine_is = "gem" if "gem" in shown else "gem gradient"
    for (case,), group in sorted(grouped([r for r in rows if r["case"] != "growth"], "case").items()):
        settings = grouped(group, "setting")
        total = {s[0]: sum(float(r["wall_s"]) for r in b) for s, b in settings.items()}
        span = max(float(r["to_s"]) for r in group)
        cells = [case, f"{span:g}"] + [f"{span / total[s]:.3g}" if total.get(s) else "" for s in shown]
        blocks = {s[0]: {r["block"]: float(r["wall_s"]) for r in b} for s, b in settings.items()}
        mine = blocks.get(mine_is, {})
        both = [blocks["Box2D 8/3"][k] / mine[k] for k in mine if blocks.get("Box2D 8/3", {}).get(k) and mine[k] > 0.0]
        if len(both) >= 2:
            low, middle, high = statistics.quantiles(both, n=4)
            middles.append(middle)
            cells.append(f"{middle:.2f} ({low:.2f} to {high:.2f})")
        body.append(cells + [""] * (3 + len(shown) - len(cells)))
    lines += table(["case", "simulated [s]"] + [f"{s}, x real time" for s in shown] + [f"Box2D / {mine_is}"], body)
    if middles:
        lines += [f"Over {len(middles)} cases {mine_is} takes 1/{min(middles):.2f} to 1/{max(middles):.2f} of Box2D's time, in the middle "
                  f"1/{statistics.median(middles):.2f}.", ""]
    panel = chart.Panel("Growth with the number of floes", "floes", "wall time per simulated second [s/s]")
    powers, grown = [], [r for r in rows if r["case"] == "growth"]
    for (setting,), group in grouped(grown, "setting").items():
        points = []
        for (floes,), blocks in grouped(group, "floes").items():
            costs = [float(r["wall_s"]) / (float(r["to_s"]) - float(r["from_s"])) for r in blocks]
            points.append((float(floes), statistics.median(costs)))
        panel.curve(setting, chart.colour_of(setting), sorted(points))
        if len(points) >= 2:
            powers.append(f"{setting} {statistics.linear_regression(*zip(*((math.log(x), math.log(y)) for x, y in points))).slope:.2f}")
    if chart.write_figure(FIGURES / "growth.svg", [panel], stamp=stamp("speed")):
        lines += figure("growth", "Cost over the number of floes: run 2 of Table 1 with its field, channel and gap scaled.")
        lines += ["Cost grows with the number of floes to the power: " + ", ".join(powers) + ".", ""]
    return lines


SPEED_SETTINGS = ("gem", "gem gradient", "gem independent", "Box2D 8/3")


# What the page is made of: part of the measurement, its table, what it shows.
TABLES = (("closed_form", "closed_form_errors.csv", "A. Closed forms"), ("windows", "windows.csv", "bars; B. Short windows"),
          ("ensembles", "ensemble_rows.csv", "README.md: ensembles"), ("paths", "paths.csv", "Path by path"),
          ("speed", "speed.csv", "Real-time factors"))


def stated_conditions():
    """Which tables were measured, and what was noted then."""
    parts = {part for part, name, _ in TABLES if read(name)}
    body = []
    for part, name, shows in TABLES:
        rows = read(name)
        commits = dict.fromkeys(r["commit"] for r in rows if "commit" in r) or dict.fromkeys(
            commit_of(run) for run in conditions()[1] if part in run["parts"])
        body.append([shows, f"`{name}`", str(len(rows)) if rows else "not measured",
                     ", ".join(f"`{c}`" for c in commits) if rows else ""])
        if part == "ensembles" and not any(r["setting"] == "fine" for r in rows):
            body.append(["C. Statistics", f"`{name}`, setting `fine`", "not measured", ""])
    text = conditions()[0] if parts else []
    return ["## Where the numbers come from", "", "Tables of `bench/results/speed_against_error`:", ""] + table(
        ["part", "table", "rows", "commits"], body) + ["What `scripts/measure.sh` noted as it ran, and notes on what was joined:", "",
                                                       "```"] + (text or ["(nothing measured)"]) + ["```", ""]


KEPT = ("closed_form_errors.csv", "windows.csv", "paths.csv", "speed.csv", "ensemble_rows.csv", "ensembles.csv",
        "map_means.csv")


def keep(folder):
    """Its tables are those of the pages from now on."""
    ROWS.mkdir(parents=True, exist_ok=True)
    for name in KEPT:
        if (folder / name).exists():
            shutil.copy(folder / name, ROWS / name)
    if (folder / "conditions.txt").exists():
        add_conditions((folder / "conditions.txt").read_text(encoding="utf-8"))


def add_conditions(text):
    """Adds the measurements in `text` that are not known yet."""
    path = ROWS / "conditions.txt"
    known = path.read_text(encoding="utf-8") if path.exists() else ""
    for part in ("\n" + text).split("\nbegun ")[1:]:
        if "begun " + part.split("\n", 1)[0] not in known:
            known += "begun " + part.rstrip("\n") + "\n"
    path.write_text(known, encoding="utf-8")


def measure(jobs, *parts):
    if not (ROOT / "build" / "window_errors").exists():
        sys.exit("no build/window_errors (not built); run: cmake --build build --target gem_measurements")
    out = ROOT / "runs" / "measurement"
    code = subprocess.run([ROOT / "scripts" / "measure.sh", ROOT / "build", out, jobs, *parts]).returncode
    if code not in (0, 8):
        sys.exit(code)
    keep(out / "results")
    if code == 8:
        sys.exit("tasks are left (see above): measure again, which continues")


def take(archive):
    with tempfile.TemporaryDirectory() as folder, tarfile.open(archive) as tar:
        tar.extractall(folder, [m for m in tar.getmembers() if m.isfile() and pathlib.Path(m.name).parent == pathlib.Path("results")])
        keep(pathlib.Path(folder) / "results")


def write_page():
    FIGURES.mkdir(exist_ok=True)
    page = ["# Speed against error", "",
            "gem and Box2D 2.4.1 on the same scenes: what a second of simulated time costs and how wrong it is. Made by",
            "`scripts/studies speed_against_error` from measurements of `scripts/measure.sh`; nothing here is typed.",
            "`gem` is the default: operator splitting, a tolerance of 3e-3 of the current's speed and at most 384 iterations",
            "(1e-3 and 192 in part A, the default when it was measured). `gem gradient`",
            "is `numerics.iteration = \"gradient\"`, 32 iterations, the default until 25 November 2026.", ""]
    for part in (bars, part_a, part_b, part_c, part_paths, part_speed, stated_conditions):
        page += part()
    (FOLDER / "speed_against_error.md").write_text("\n".join(page).rstrip() + "\n", encoding="utf-8")
    print(f"{(FOLDER / 'speed_against_error.md').relative_to(ROOT)} is up to date")


def main():
    parser = argparse.ArgumentParser(description=__doc__, epilog="Without an option the pages are made again.")
    chosen = parser.add_mutually_exclusive_group()
    chosen.add_argument("--measure", nargs="*", metavar=("JOBS", "PART"), help="measure here first, by scripts/measure.sh")
    chosen.add_argument("--take", metavar="RESULTS.tar.gz", help="take a measurement made elsewhere first")
    chosen.add_argument("--with", dest="other", metavar="FILE.csv", help="add another engine's rows of any of the tables")
    options = parser.parse_args()
    if options.measure is not None:
        measure(*(options.measure or [str(os.cpu_count())]))
    elif options.take:
        take(options.take)
    elif options.other:
        (ROWS / "other").mkdir(parents=True, exist_ok=True)
        shutil.copy(options.other, ROWS / "other")
    write_page()
    ensembles_page.main()
