"""Part B of validation/baseline/speed_against_error.md: errors in short windows against what they cost."""
import csv
import math
import random
import re

import chart
from measured import FIGURES, ROOT, figure, grouped, median, read, rms, stamp, table

# The paper's own speeds (ICETECH 2014, one GPU of that year): dated marks, other hardware.
PAPER = ((1.0 / 6.0, "paper 2014, GPU: 6x real time"), (1.0 / 2.0, "paper 2014, GPU: 2x real time"))
COST = "wall time per simulated second [s/s]"
KINDS = (("places", "places [m]"), ("force", "ice force, relative"))
# Curves: title, colour, settings that belong to it; what is left is drawn as points of its family.
CURVES = (
    ("gem coupled, moment", "gem", r"gem (dt/\d|dt|2dt)"),
    ("gem coupled, 2 threads", "gem2", r"gem (dt/\d|dt|2dt) 2 threads"),
    ("gem coupled, iterations", "iterations", r"gem dt( \d+ iterations)?"),
    ("gem independent, moment", "independent", r"gem independent (dt/\d|dt|2dt)"),
    ("gem independent, 2 threads", "independent2", r"gem independent (dt/\d|dt|2dt) 2 threads"),
    ("Box2D, iterations", "Box2D", r"Box2D \d+/\d+ dt"),
    ("Box2D, moment", "Box2D moment", r"Box2D 8/3 (dt/\d|dt|2dt)"),
    ("Box2D thin skin, iterations", "thin", r"Box2D thin skin \d+/\d+ dt"),
    ("Box2D thin skin, moment", "thin moment", r"Box2D thin skin 8/3 (dt/\d|dt|2dt)"),
)
JUDGED = ("Box2D thin skin 8/3 dt", "Box2D 8/3 dt")
# What is dropped, from which setting.
DROPPED = (("friction", "gem dt", "gem without friction"), ("yaw", "gem dt", "gem without yaw"),
           ("elastic stress", "gem independent dt", "gem independent without elastic stress"))
# Where bench/cuda_speed.cpp measures: its phases by case and time; windows that begin within `NEAR_S` after it are the same scene.
CUDA_PHASES = {"drift": ("004_400_25", 60.0), "plug": ("004_400_25", 1800.0), "jam": ("400_200_100", 600.0)}
NEAR_S = 900.0


def error_of(rows, kind):
    if kind == "places":
        return rms([float(r["all_rms_m"]) for r in rows])
    scale = rms([float(r["reference_ice_force_x_N"]) for r in rows])
    error = rms([float(r["ice_force_x_N"]) - float(r["reference_ice_force_x_N"]) for r in rows])
    return error / scale if scale > 0.0 else math.nan


def points_of(group, kind):
    """Setting -> (cost, error) over the windows in `group`."""
    return {setting: (median(rows, "wall_s_per_s"), error_of(rows, kind))
            for (setting,), rows in grouped(group, "setting").items() if not setting.startswith("reference")}


def cuda_points(group, points):
    """One scene on a GPU, by its fastest layout, and the fastest batch of that scene's seeds, with the error of the same settings on
    the processor: their bits agree."""
    fastest = {}
    for path in sorted((ROOT / "bench" / "results").glob("cuda*.csv")):
        with open(path, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                batch = row.get("measure") == "batch" and row["scenes"] != "1"
                place = CUDA_PHASES.get("drift" if batch else row.get("phase"))
                single = row.get("measure") == "moment" and row["scenes"] == "1"
                if not (batch or single) or not place or place[0] != group[0]["case"]:
                    continue
                if not any(0.0 <= float(r["start_s"]) - place[1] < NEAR_S for r in group):
                    continue
                key, cost = (row["resolution"], batch), 1.0 / float(row["x_real_time"])
                if key not in fastest or cost < fastest[key][0]:
                    fastest[key] = (cost, row["device"], row["commit"], row["scenes"])
    found = {}
    for (resolution, batch), (cost, device, commit, scenes) in fastest.items():
        source = "gem dt" if resolution == "coupled" else "gem independent dt"
        if source in points:
            found[f"CUDA {resolution} dt, {f'batch of {scenes}, ' if batch else ''}{device}"] = (cost, points[source][1], commit)
    return found


def pareto_front(points):
    """Settings that no other beats in both, by rising cost; a gain of less than 1 % is none."""
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
    panel.extra.append("set key font ',9'")
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
        panel.curve(name, chart.COLOURS["cuda"], [(cost, error)], "points pt 9 ps 1.2")
    front = pareto_front(points)
    panel.curve("Pareto front of the processor", "#000000", staircase(front), "lines lw 1 dt 3")
    for setting, (cost, error) in front:
        panel.text(cost, error, setting, chart.colour_of(setting))
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


def ratios(points, judged, threads):
    """(speed at Box2D's error, error at Box2D's speed) of gem's settings with all options, as factors; NaN: none is there."""
    cost, error = points[judged]
    end = r"( 2 threads| \d+ iterations)?" if threads == 2 else r"( \d+ iterations)?"
    mine = [p for s, p in points.items() if re.fullmatch(r"gem( independent)? (dt/\d|dt|2dt)" + end, s)]
    as_exact = [c for c, e in mine if e <= error]
    as_fast = [e for c, e in mine if c <= cost]
    return (cost / min(as_exact) if as_exact else math.nan,
            error / min(as_fast) if as_fast and min(as_fast) > 0.0 else math.nan)


def with_interval(group, kind, judged, threads):
    """Both ratios with 90 % intervals from windows drawn again."""
    draw = random.Random(1)
    windows = [rows for _, rows in sorted(grouped(group, "window", "start_s").items())]
    again = []
    for _ in range(200 if len(windows) > 2 else 0):
        rows = [row for window in draw.choices(windows, k=len(windows)) for row in window]
        again.append(ratios(points_of(rows, kind), judged, threads))
    cells = []
    for k, value in enumerate(ratios(points_of(group, kind), judged, threads)):
        drawn = sorted(r[k] for r in again if r[k] == r[k])
        text = "none" if value != value else f"{value:.3g}"
        if value == value and len(drawn) >= 20:
            text += f" ({drawn[len(drawn) // 20]:.3g} to {drawn[-1 - len(drawn) // 20]:.3g})"
        cells.append((value, text))
    return cells


def ratio_table(regimes):
    body = []
    for regime, group in regimes:
        for kind, _ in KINDS:
            for judged in JUDGED:
                points = points_of(group, kind)
                if judged not in points or points[judged][1] != points[judged][1]:
                    continue
                for threads in (1, 2):
                    (speed, speed_text), (error, error_text) = with_interval(group, kind, judged, threads)
                    body.append([f"{regime}, {kind}", judged, str(threads), speed_text, error_text,
                                 f"{'yes' if speed >= 3.0 else 'no'}, {'yes' if error >= 10.0 else 'no'}"])
    return ["### gem at Box2D's own error and speed", "",
            "Faster: Box2D's time over that of gem's cheapest setting whose error is no larger. More exact: Box2D's error over the",
            "least error of gem's settings that take no more time. Settings that drop an option are left out; nothing is interpolated.",
            "Box2D has one thread, gem 1, or up to 2. In brackets: 90 % of draws of the windows. Bars: 3 times faster, 10 times more",
            "exact.", ""] + table(["regime, error of", "Box2D's setting", "gem's threads", "times faster", "times more exact",
                                   "bars met?"], body)


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
        return []
    lines = ["## B. Short windows", "",
             "The reference (a sixteenth of the case's moment, converged to 1e-6 of the current's speed) takes over from a run of",
             "gem a quarter of a window before it begins, and every setting starts from its state there. Errors are the root of the mean",
             "square over time, over floes and platform and over all windows; the force's is relative to the reference's. Times are paired: the",
             "settings run one after the other in every window; stated is the median. Floes that gem left touching begin inside Box2D's",
             "usual skins, so windows judge its thin skin; the usual skin needs the ensembles.", ""]
    panels, regimes = [], [(regime, group) for (regime,), group in grouped(rows, "regime").items()]
    for regime, group in regimes:
        fronts = {}
        for kind, what in KINDS:
            panel, fronts[kind] = panel_of(f"{regime}: {what}", group, kind, what)
            panels.append(panel)
        windows = len({(r["window"], r["start_s"]) for r in group})
        lines += [f"### {regime}: {group[0]['case']}, {windows} windows of {float(group[0]['window_s']):g} s", ""]
        lines += settings_table(group, fronts)
        places = points_of(group, "places")
        for name, (cost, error, commit) in cuda_points(group, places).items():
            beside = [f"{places[s][0] / cost:.3g} times as fast as {s} ({1e3 * places[s][1]:.3g} mm)" for s in JUDGED if s in places]
            lines += [f"{name}: {1 / cost:.4g} x real time, {', '.join(beside)}; commit `{commit}`. Its bits, and so its error of "
                      f"{1e3 * error:.3g} mm, are the processor's.", ""]
    lines += ratio_table(regimes) + dropped_table(regimes)
    chart.write_figure(FIGURES / "windows.svg", panels, 2, 820, 440, stamp("windows"))
    return lines + figure("windows", "Part B: error against cost in windows; dashed upright: the paper's speeds of 2014.")
