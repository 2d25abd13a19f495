"""Part B of validation/baseline/speed_against_error.md: errors in short windows against what they cost."""
import csv
import math
import re

import chart
from bars_page import JUDGED, KINDS, points_of
from measured import FIGURES, ROOT, figure, grouped, provenance, read, rms, same_results, stamp, table, wrapped

# The paper's own speeds (ICETECH 2014, one GPU of that year): dated marks, other hardware.
PAPER = ((1.0 / 6.0, "2014: 6x"), (1.0 / 2.0, "2014: 2x"))
COST = "wall time per simulated second [s/s]"
# Curves: title, colour, settings that belong to it; what is left is drawn as points of its family.
CURVES = (
    ("gem coupled, time step", "gem", r"gem (dt/\d|dt|2dt)"),
    ("gem coupled, 2 threads", "gem2", r"gem (dt/\d|dt|2dt) 2 threads"),
    ("gem coupled, iterations", "iterations", r"gem dt( \d+ iterations)?"),
    ("gem independent, time step", "independent", r"gem independent (dt/\d|dt|2dt)"),
    ("gem independent, 2 threads", "independent2", r"gem independent (dt/\d|dt|2dt) 2 threads"),
    ("Box2D, iterations", "Box2D", r"Box2D \d+/\d+ dt"),
    ("Box2D, time step", "Box2D moment", r"Box2D 8/3 (dt/\d|dt|2dt)"),
    ("Box2D thin skin, iterations", "thin", r"Box2D thin skin \d+/\d+ dt"),
    ("Box2D thin skin, time step", "thin moment", r"Box2D thin skin 8/3 (dt/\d|dt|2dt)"),
)
# What is dropped, from which setting.
DROPPED = (("friction", "gem dt", "gem without friction"), ("yaw", "gem dt", "gem without yaw"),
           ("elastic stress", "gem independent dt", "gem independent without elastic stress"))
# The phases of bench/cuda_speed.cpp: case and time from which it is timed. A regime whose windows begin there is the same scene.
CUDA_PHASES = {"drift": ("004_400_25", 60.0), "plug": ("004_400_25", 1800.0), "jam": ("400_200_100", 600.0)}


def cuda_points(group, points):
    """The regime's scene on a GPU by its fastest layout, alone and as the fastest batch of copies, with the error of the same
    settings on the processor: only where case and start agree and the commits have the same bits."""
    commits = {r["commit"] for r in group}
    begins = {(r["case"], float(r["start_s"])) for r in group}
    fastest = {}
    for path in sorted((ROOT / "bench" / "results").glob("cuda*.csv")):
        with open(path, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                if row.get("arithmetic", "strict") != "strict" or row["measure"] not in ("moment", "copies") or CUDA_PHASES.get(row["phase"]) not in begins:
                    continue
                if not all(same_results(row["commit"], commit) for commit in commits):
                    continue
                key, cost = (row["resolution"], row["measure"] == "copies"), 1.0 / float(row["x_real_time"])
                if key not in fastest or cost < fastest[key][0]:
                    fastest[key] = (cost, row["device"], row["commit"], row["scenes"])
    found = {}
    for (resolution, batch), (cost, device, commit, scenes) in fastest.items():
        source = "gem dt" if resolution == "coupled" else "gem independent dt"
        if source in points:
            found[f"CUDA {resolution} dt, {f'{scenes} copies, ' if batch else ''}{device}"] = (cost, points[source][1], commit)
    return found


def pareto_front(points):
    """Settings that no other beats in both, by rising cost; a gain of less than 1 % is none. Settings that drop an option of the
    scene are not asked."""
    front = []
    for setting, (cost, error) in sorted(points.items(), key=lambda item: item[1]):
        if error == error and (not front or error < 0.99 * front[-1][1][1]):
            front.append((setting, (cost, error)))
    return front


def staircase(front):
    corners = []
    for k, (_, (cost, error)) in enumerate(front):
        if k:
            corners.append((cost, front[k - 1][1][1]))
        corners.append((cost, error))
    return corners


def panel_of(title, group, kind, what):
    points = points_of(group, kind)
    gpu = cuda_points(group, points)
    panel = chart.Panel(title, COST, f"error of {what}")
    panel.key = "below Left reverse width -2 maxrows 5 font ',9'"
    drawn = set()
    for name, colour, pattern in CURVES:
        members = {s: p for s, p in points.items() if re.fullmatch(pattern, s)}
        drawn |= set(members)
        dashes = "" if " moment" in f" {colour}" or colour in ("gem", "independent") else " dt 2"
        panel.curve(name, chart.COLOURS[colour], sorted(members.values()), "linespoints pt 7 ps 0.5 lw 1.5" + dashes)
    for family in ("gem", "dropped", "Box2D", "thin"):
        rest = [p for s, p in points.items() if s not in drawn and chart.family_of(s) == family]
        panel.curve(f"{chart.FAMILIES[family]}, other", chart.COLOURS[family], rest, "points pt 6 ps 0.7")
    for name, (cost, error, _) in gpu.items():
        label, point = ("a batch of copies", 11) if "copies" in name else ("one scene", 9)
        resolution, filled = ("coupled", point) if "coupled" in name else ("independent", point - 1)
        panel.curve(f"GPU {resolution}, {label}", chart.COLOURS["cuda"], [(cost, error)], f"points pt {filled} ps 1.2")
    front = pareto_front({s: p for s, p in points.items() if chart.family_of(s) != "dropped"})
    panel.curve("Pareto front of the processor", "#000000", staircase(front), "lines lw 1 dt 3")
    for setting, (cost, error) in front:
        panel.text(cost, error, setting, chart.COLOURS["thin moment"] if chart.family_of(setting) == "thin" else chart.colour_of(setting))
    for mark in PAPER:
        panel.mark(*mark)
    return panel, [setting for setting, _ in front]


def settings_table(group, fronts):
    places, forces = points_of(group, "places"), points_of(group, "force")
    body = []
    for setting, (cost, error) in sorted(places.items(), key=lambda item: item[1]):
        mine = [r for r in group if r["setting"] == setting]
        force = forces[setting][1]
        body.append([setting, f"{1e3 * cost:.3g}", f"{1 / cost:.3g}" if cost > 0 else "", f"{1e3 * error:.3g}",
                     f"{1e3 * rms([float(r['platform_rms_m']) for r in mine]):.2g}",
                     "" if math.isnan(force) else f"{100 * force:.3g}",
                     f"{1e3 * max(float(r['overlap_maximum_m']) for r in mine):.2g}",
                     ", ".join(kind for kind, _ in KINDS if setting in fronts[kind])])
    return table(["setting", "wall, ms/s", "x real time", "places [mm]", "platform [mm]", "force [%]", "deepest overlap [mm]",
                  "on the front of"], body)


def dropped_table(regimes):
    body = []
    for regime, group in regimes:
        points = {kind: points_of(group, kind) for kind, _ in KINDS}
        for what, full, without in DROPPED:
            if full not in points["places"] or without not in points["places"]:
                continue
            cells = [regime, what, full, f"{points['places'][without][0] / points['places'][full][0]:.2f}"]
            for kind, scale in (("places", 1e3), ("force", 100.0)):
                cells += [f"{scale * points[kind][s][1]:.3g}" if points[kind][s][1] == points[kind][s][1] else ""
                          for s in (full, without)]
            body.append(cells)
    return ["### What an option costs and buys", "",
            "The error is against the reference with every option of the scene, so that of a dropped option is what the scene loses;",
            "cost is that without the option over that with it.", ""] + table(
                ["regime", "dropped", "from", "cost", "places with [mm]", "without", "force with [%]", "without"], body)


def part_b():
    rows = read("windows.csv")
    if not rows:
        return ["## B. Short windows", "", "Not measured.", ""]
    lines = ["## B. Short windows", "",
             "The reference (a sixteenth of the case's time step, converged to 1e-6 of the current's speed) takes over from a run of",
             "gem a quarter of a window before it begins, and every setting starts from its state there. Errors are the root of the mean",
             "square over time, over floes and platform and over all windows; the force's is relative to the reference's. Times are paired: the",
             "settings run one after the other in every window; stated is the median. Floes that gem left touching begin inside Box2D's",
             "usual skins, so windows judge its thin skin; the usual skin needs the ensembles.", ""]
    panels, regimes = [], [(regime, group) for (regime,), group in grouped(rows, "regime").items()]
    for regime, group in regimes:
        fronts = {}
        for kind, what in KINDS:
            panel, fronts[kind] = panel_of(f"{regime} ({group[0]['case']}): error of {kind}", group, kind, what)
            panels.append(panel)
        windows = len({(r["window"], r["start_s"]) for r in group})
        lines += [f"### {regime}: {group[0]['case']}, {windows} windows of {float(group[0]['window_s']):g} s", "",
                  provenance("windows", group), ""]
        lines += settings_table(group, fronts)
        places = points_of(group, "places")
        for name, (cost, error, commit) in cuda_points(group, places).items():
            beside = [f"{places[s][0] / cost:.3g} times as fast as {s} ({1e3 * places[s][1]:.3g} mm)" for s in JUDGED if s in places]
            lines += [wrapped(f"{name}: {1 / cost:.4g} x real time, {', '.join(beside)}; commit `{commit}`. Timed over 256 "
                      f"time steps from the first window's start; its bits are the processor's, so its error of {1e3 * error:.3g} mm is that of "
                      "gem dt over these windows, and Box2D's time is that of the table."), ""]
    lines += dropped_table(regimes)
    chart.write_figure(FIGURES / "windows.svg", panels, 2, 760, 500, stamp("windows"))
    return lines + figure("windows", "Part B: error against cost in windows; dashed upright: the paper's speeds of 2014, 6 and 2 times "
                          "real time on a GPU of then. "
                          "Labels name the settings on the front as far as there is room; the tables name all.")
