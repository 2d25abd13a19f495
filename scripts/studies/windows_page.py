"""Part B of validation/baseline/speed_against_error.md: errors in short windows against what they cost."""
import csv
import math
import re

import chart
from bars_page import JUDGED, KINDS, points_of
from measured import FIGURES, ROOT, figure, grouped, provenance, read, rms, stamp, table, wrapped

# The paper's own speeds (ICETECH 2014, one GPU of that year): dated marks, other hardware.
PAPER = ((1.0 / 6.0, "2014: 6x"), (1.0 / 2.0, "2014: 2x"))
COST = "wall time per simulated second [s/s]"
# Curves: title, colour, settings that belong to it; what is left is drawn as points of its family.
CURVES = (
    ("gem, time step", "gem", r"gem (dt/\d|\d?dt)"),
    ("gem, 2 threads", "gem2", r"gem (dt/\d|\d?dt) 2 threads"),
    ("gem, tolerance 1e-2, 2 threads", "tolerance", r"gem \d?dt tolerance 1e-2 2 threads"),
    ("gem, 32 iterations, 2 threads", "iterations", r"gem \d?dt 32 iterations 2 threads"),
    ("gem gradient, time step", "gradient", r"gem gradient (dt/\d|\d?dt)"),
    ("gem gradient, iterations", "gradient iterations", r"gem gradient dt( \d+ iterations)?"),
    ("gem independent, time step", "independent", r"gem independent (dt/\d|dt|2dt)"),
    ("gem independent, 2 threads", "independent2", r"gem independent (dt/\d|dt|2dt) 2 threads"),
    ("Box2D, iterations", "Box2D", r"Box2D \d+/\d+ dt"),
    ("Box2D, time step", "Box2D moment", r"Box2D 8/3 (dt/\d|dt|2dt)"),
    ("Box2D thin skin, iterations", "thin", r"Box2D thin skin \d+/\d+ dt"),
    ("Box2D thin skin, time step", "thin moment", r"Box2D thin skin 8/3 (dt/\d|dt|2dt)"),
)
# What is dropped, from which setting.
DROPPED = (("friction", "gem gradient dt", "gem gradient without friction"),
           ("elastic stress", "gem independent dt", "gem independent without elastic stress"))
# Settings of bench/cuda_splitting.cpp, which are by the case's own time step, and the same on the processor. In the drift that step
# is half of the one here.
CROWDED = {"gradient 32 dt": "gem gradient dt", "gradient 200 dt": "gem gradient dt 200 iterations", "splitting dt": "gem dt",
           "splitting 4dt": "gem 4dt"}
CUDA_SETTINGS = {"drift": {"gradient 32 dt": "gem gradient dt/2", "splitting 4dt": "gem 2dt"}, "plug": CROWDED, "jam": CROWDED}


def cuda_points(regime, points):
    """The regime's scene on a GPU, alone and as a batch of copies, with the error of the same settings on the processor."""
    found = {}
    with open(ROOT / "bench" / "results" / "splitting" / "cuda.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            source = CUDA_SETTINGS[regime].get(row["setting"])
            if row["phase"] == regime and source in points:
                copies = int(row["scenes"])
                name = f"CUDA {source.removeprefix('gem ')}, {f'{copies} copies, ' if copies > 1 else ''}{row['device'].split(' 80GB')[0]}"
                found[name] = (1e-3 * float(row["ms_per_s"]) / copies, points[source][1], row["commit"])
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
    gpu = cuda_points(group[0]["regime"], points)
    panel = chart.Panel(title, COST, f"error of {what}")
    panel.key = "below Left reverse width -2 maxrows 5 font ',9'"
    drawn = set()
    for name, colour, pattern in CURVES:
        members = {s: p for s, p in points.items() if re.fullmatch(pattern, s)}
        drawn |= set(members)
        dashes = "" if " moment" in f" {colour}" or colour in ("gem", "independent") else " dt 2"
        panel.curve(name, chart.COLOURS[colour], sorted(members.values()), "linespoints pt 7 ps 0.5 lw 1.5" + dashes)
    for family in ("gem", "gradient", "dropped", "Box2D", "thin"):
        rest = [p for s, p in points.items() if s not in drawn and chart.family_of(s) == family]
        panel.curve(f"{chart.FAMILIES[family]}, other", chart.COLOURS[family], rest, "points pt 6 ps 0.7")
    told = set()
    for name, (cost, error, _) in gpu.items():
        label, point = ("a batch of copies", 11) if "copies" in name else ("one scene", 9)
        iteration, filled = ("gradient", point - 1) if "gradient" in name else ("splitting", point)
        title = f"GPU {iteration}, {label}"
        panel.curve(None if title in told else title, chart.COLOURS["cuda"], [(cost, error)], f"points pt {filled} ps 1.2")
        told.add(title)
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
             "dt is 5 cm of drift: 0.2 s in the drift, 0.05 s in plug and jam. The reference has a sixteenth of it and up to 1000",
             "iterations of `gradient` towards 1e-6 of the current's",
             "speed; in the jam most of its steps end at that limit (bench/notebook.md says how sure it is). It takes over from a run with",
             "`gradient` a second before a window begins, and every setting starts from its state there. The error of places is the root of",
             "the mean square over floes and platform at the end of a window, and over all windows. The force is the mean of a window, and",
             "its error is relative to the reference's. Times are paired: the settings run one after the other in every window; stated is the",
             "median. Floes that gem left touching begin inside Box2D's usual skins, so windows judge its thin skin; the usual skin needs the",
             "ensembles.", ""]
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
        for name, (cost, error, commit) in cuda_points(regime, places).items():
            beside = [f"{places[s][0] / cost:.3g} times as fast as {s} ({1e3 * places[s][1]:.3g} mm)" for s in JUDGED if s in places]
            lines += [wrapped(f"{name}: {1 / cost:.4g} x real time, {', '.join(beside)}; measured at commit `{commit}`. Beside it "
                              f"stands the error of the same setting on a processor in these windows, {1e3 * error:.3g} mm; Box2D's time is that of the table."), ""]
    lines += dropped_table(regimes)
    chart.write_figure(FIGURES / "windows.svg", panels, 2, 760, 500, stamp("windows", rows=rows))
    return lines + figure("windows", "Part B: error against cost in windows; dashed upright: the paper's speeds of 2014, 6 and 2 times "
                          "real time on a GPU of then. "
                          "Labels name the settings on the front as far as there is room; the tables name all.")
