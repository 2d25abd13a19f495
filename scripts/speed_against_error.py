#!/usr/bin/env python3
"""Writes validation/baseline/speed_against_error.md and its figures from the tables in bench/results/speed_against_error.

scripts/measure.sh makes the tables; rows of other engines lie beside them in other/ and are told by their header."""
import csv
import math
import pathlib
import statistics

import chart

ROOT = pathlib.Path(__file__).resolve().parent.parent
ROWS = ROOT / "bench" / "results" / "speed_against_error"
FOLDER = ROOT / "validation" / "baseline"
FIGURES = FOLDER / "figures"
# The paper's own speeds (ICETECH 2014, one GPU of that year): dated marks, other hardware.
PAPER = ((1.0 / 6.0, "paper 2014, GPU: 6x real time"), (1.0 / 2.0, "paper 2014, GPU: 2x real time"))
COST = "user time per simulated second [s/s]"


def read(name):
    """Rows of one table and those of other engines with the same header."""
    path = ROWS / name
    if not path.exists():
        return []
    with open(path, newline="", encoding="utf-8") as file:
        head = file.readline()
        rows = list(csv.DictReader(file, fieldnames=head.strip().split(",")))
    for other in sorted((ROWS / "other").glob("*.csv")):
        with open(other, newline="", encoding="utf-8") as file:
            if file.readline() == head:
                rows += csv.DictReader(file, fieldnames=head.strip().split(","))
    return rows


def grouped(rows, *keys):
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return groups


def median(rows, key):
    values = [float(row[key]) for row in rows if row[key] not in ("", "nan")]
    return statistics.median(values) if values else math.nan


def rms(values):
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else math.nan


def pareto_front(points):
    """Points (cost, error, label) that no other beats in both, by rising cost; a gain of less than 1 % is none."""
    front = []
    for point in sorted(p for p in points if p[1] == p[1]):
        if not front or point[1] < 0.99 * front[-1][1]:
            front.append(point)
    return front


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "|---|" + "---:|" * (len(head) - 1)] + [
        "| " + " | ".join(row) + " |" for row in rows] + [""]


def figure(name, text):
    return [f"![{text}](figures/{name}.svg)", "", f"*{text} Numbers: `bench/results/speed_against_error`.*", ""]


def family(label):
    """A curve joins settings that differ in the moment only."""
    words = [w for w in label.split() if not (w.endswith("dt") or w.startswith("dt"))]
    return " ".join(words)


def stepped(x):
    """Corners of a staircase through a front."""
    corners = []
    for k, (cost, error, _) in enumerate(x):
        if k:
            corners.append((cost, x[k - 1][1]))
        corners.append((cost, error))
    return corners


def cloud(panel, points):
    """Settings as points, those that differ in the moment only as curves, the front as a staircase with its names."""
    curves, told = {}, set()
    for cost, error, label in points:
        curves.setdefault(family(label), []).append((cost, error))
    for name, members in curves.items():
        key = chart.family_of(name)
        panel.curve(None if key in told else chart.FAMILIES[key], chart.COLOURS[key], sorted(members))
        told.add(key)
    front = pareto_front(points)
    panel.curve("Pareto front", "#000000", stepped(front), "lines lw 1 dt 3")
    for cost, error, label in front:
        panel.text(cost, error, label, chart.colour_of(label))
    return [label for _, _, label in front]


def part_a():
    rows = read("closed_form_errors.csv")
    if not rows:
        return []
    panels, lines = [], []
    for (case,), group in grouped(rows, "case").items():
        for key, what, unit in (("place_L1_m", "place", "m"), ("velocity_L1_m_per_s", "velocity", "m/s")):
            panel = chart.Panel(f"{case}: {what}", COST, f"mean error of {what} [{unit}]")
            for (setting,), curve in grouped(group, "setting").items():
                panel.curve(setting, chart.colour_of(setting),
                            sorted((float(r["user_s_per_s"]), float(r[key])) for r in curve))
            panels.append(panel)
    chart.write_figure(FIGURES / "closed_form_errors.svg", panels, 2, 640, 300)
    lines += ["## A. Closed forms", "",
              "Mean over time of the error of place and velocity (velocities jump at impacts, so their largest error does",
              "not shrink with the moment); impacts are spread evenly over a moment. Along each curve the moment is halved.",
              "V33 begins with touching floes, inside Box2D's skins, which push them apart: with the usual skin that is its",
              "error. V42 has no contacts: its path is the mooring's exact one on every engine.", ""]
    return lines + figure("closed_form_errors", "Part A: error against cost on five closed forms.")


def window_points(group, key):
    points = []
    for (setting,), rows in grouped(group, "setting").items():
        if setting.startswith("reference"):
            continue
        if key == "force":
            scale = rms([float(r["reference_ice_force_x_N"]) for r in rows])
            error = rms([float(r["ice_force_x_N"]) - float(r["reference_ice_force_x_N"]) for r in rows]) / scale \
                if scale > 0.0 else math.nan
        else:
            error = rms([float(r[key]) for r in rows])
        points.append((median(rows, "user_s_per_s"), error, setting))
    return points


def part_b():
    rows = read("windows.csv")
    if not rows:
        return []
    lines = ["## B. Short windows", "",
             "The reference (a sixteenth of the case's moment, converged to 1e-6 of the current's speed) takes over from a run of",
             "gem 10 s before each window, and every setting starts from its state there. Errors are the root of the",
             "mean square over time, over floes and platform and over all windows; the force's is relative to the",
             "reference's. Times are paired: the settings run one after the other in every window; stated is the median. Floes that gem left touching begin inside Box2D's usual",
             "skins, so windows judge its thin skin; the usual skin needs the ensembles below.", ""]
    panels = []
    for (regime,), group in grouped(rows, "regime").items():
        fronts = {}
        for key, what in (("all_rms_m", "places [m]"), ("force", "ice force, relative")):
            panel = chart.Panel(f"{regime}: {what}", COST, f"error of {what}")
            fronts[key] = cloud(panel, window_points(group, key))
            for mark in PAPER:
                panel.mark(*mark)
            panels.append(panel)
        places = {s: (c, e) for c, e, s in window_points(group, "all_rms_m")}
        forces = {s: e for _, e, s in window_points(group, "force")}
        case, windows = group[0]["case"], len({(r["window"], r["start_s"]) for r in group})
        lines += [f"### {regime}: {case}, {windows} windows of {float(group[0]['window_s']):g} s", ""]
        body = []
        for setting, (cost, error) in sorted(places.items(), key=lambda item: item[1]):
            mine = [r for r in group if r["setting"] == setting]
            shown = "" if math.isnan(forces[setting]) else f"{100 * forces[setting]:.3g}"
            fronted = ", ".join(word for key, word in (("all_rms_m", "places"), ("force", "force"))
                                if setting in fronts[key])
            body.append([setting, f"{1e3 * cost:.3g}", f"{1 / cost:.3g}" if cost > 0 else "", f"{1e3 * error:.3g}",
                         f"{1e3 * rms([float(r['platform_rms_m']) for r in mine]):.2g}", shown,
                         f"{1e3 * max(float(r['overlap_maximum_m']) for r in mine):.2g}", fronted])
        lines += table(["setting", "ms/s", "x real time", "places [mm]", "platform [mm]", "force [%]",
                        "deepest overlap [mm]", "on the front of"], body)
    chart.write_figure(FIGURES / "windows.svg", panels, 2, 760, 400)
    return lines + figure("windows", "Part B: error against cost in windows; dashed: the paper's speeds of 2014.")


def ensemble_values():
    values = {}
    for row in read("ensemble_rows.csv"):
        values.setdefault((row["case"], row["setting"]), {}).setdefault(row["quantity"], []).append(float(row["value"]))
    return values


def part_c():
    values = ensemble_values()
    cases = [case for case, setting in values if setting == "fine"]
    if not cases:
        return []
    lines = ["## C. Statistics", "",
             "Mean square error of an ensemble's mean, bias^2 + variance / N, against the cost of its N members; the bias is",
             "the difference from the ensemble `fine` (a quarter of the moment, 400 iterations) and holds its own scatter,",
             "stated as noise. Cost is wall time on one core with recording.", ""]
    panels = []
    for case in dict.fromkeys(cases):
        fine = values[(case, "fine")]
        body = []
        for quantity in ("offset_x_mean_m", "offset_x_deviation_m", "ice_force_x_mean_N", "hits_per_s"):
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
    chart.write_figure(FIGURES / "statistics.svg", panels, 2, 760, 400)
    return lines + figure("statistics", "Part C: what an ensemble's mean costs and misses, for N = 1 to 100 members.")


def part_paths():
    rows = read("paths.csv")
    if not rows:
        return []
    panels = []
    for (regime,), group in grouped(rows, "regime").items():
        for key, what in (("floes_rms_m", "floes, root mean square"), ("platform_m", "platform")):
            panel = chart.Panel(f"{regime}: {what}", "time from one identical state [s]", "distance [m]", "y")
            for (setting,), path in grouped(group, "setting").items():
                if not setting.startswith("reference"):
                    panel.curve(setting, chart.colour_of(setting),
                                [(float(r["time_s"]), float(r[key])) for r in path if float(r[key]) > 1e-12])
            panels.append(panel)
    chart.write_figure(FIGURES / "paths.svg", panels, 2, 760, 360)
    return ["## Path by path, before runs part", "",
            "All settings start from one identical state; the distance is from the same scene at a quarter of the moment,",
            "converged. Where the curves level off the paths are no longer the same and only statistics compare.", ""
            ] + figure("paths", "Distance of floes and platform from the reference over time.")


def part_speed():
    rows = read("speed.csv")
    if not rows:
        return []
    lines = ["## Real-time factors", "",
             "Every engine runs the whole case in one process, taking turns block by block; recording is off. Whole run:",
             "simulated time over the sum of wall times. Ratio: Box2D's wall time over gem's, median over the blocks with its",
             "quartiles; above 1 gem is faster.", ""]
    body = []
    for (case,), group in grouped([r for r in rows if r["case"] != "growth"], "case").items():
        settings = grouped(group, "setting")
        total = {s[0]: sum(float(r["wall_s"]) for r in b) for s, b in settings.items()}
        span = max(float(r["to_s"]) for r in group)
        cells = [case, f"{span:g}"] + [f"{span / total[s]:.3g}" if total.get(s) else "" for s in SPEED_SETTINGS]
        blocks = {s[0]: {r["block"]: float(r["wall_s"]) for r in b} for s, b in settings.items()}
        both = [blocks["Box2D 8/3"][k] / blocks["gem"][k] for k in blocks.get("gem", {})
                if blocks.get("Box2D 8/3", {}).get(k) and blocks["gem"][k] > 0.0]
        if len(both) >= 2:
            low, middle, high = statistics.quantiles(both, n=4)
            cells.append(f"{middle:.2f} ({low:.2f} to {high:.2f})")
        body.append(cells + [""] * (6 - len(cells)))
    lines += table(["case", "simulated [s]"] + [f"{s}, x real time" for s in SPEED_SETTINGS] + ["Box2D / gem"], body)
    panel = chart.Panel("Growth with the number of floes", "floes", "wall time per simulated second [s/s]")
    grown = [r for r in rows if r["case"] == "growth"]
    for (setting,), group in grouped(grown, "setting").items():
        points = []
        for (floes,), blocks in grouped(group, "floes").items():
            costs = [float(r["wall_s"]) / (float(r["to_s"]) - float(r["from_s"])) for r in blocks]
            points.append((float(floes), statistics.median(costs)))
        panel.curve(setting, chart.colour_of(setting), sorted(points))
    if chart.write_figure(FIGURES / "growth.svg", [panel]):
        lines += figure("growth", "Cost over the number of floes: run 2 of Table 1 with its field, channel and gap scaled.")
    return lines


SPEED_SETTINGS = ("gem", "gem independent", "Box2D 8/3")


def conditions():
    path = ROWS / "conditions.txt"
    text = path.read_text(encoding="utf-8").rstrip().splitlines() if path.exists() else ["(none recorded)"]
    commits = sorted({r["commit"] for name in ("closed_form_errors.csv", "windows.csv", "speed.csv") for r in read(name)})
    return ["Commit of the programs: " + ", ".join(f"`{c}`" for c in commits) + ". Conditions:", "", "```"] + text + ["```", ""]


def main():
    FIGURES.mkdir(exist_ok=True)
    page = ["# Speed against error", "",
            "gem and Box2D 2.4.1 on the same scenes: what a second of simulated time costs and how wrong it is. Made by",
            "`scripts/speed_against_error.sh` from measurements of `scripts/measure.sh`; nothing here is typed.", ""]
    page += conditions() if any(ROWS.glob("*.csv")) else ["Not measured yet.", ""]
    for part in (part_a, part_b, part_c, part_paths, part_speed):
        page += part()
    (FOLDER / "speed_against_error.md").write_text("\n".join(page).rstrip() + "\n", encoding="utf-8")
    print(f"{(FOLDER / 'speed_against_error.md').relative_to(ROOT)} is up to date")


if __name__ == "__main__":
    main()
