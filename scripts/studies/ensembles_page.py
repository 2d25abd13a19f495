"""Writes the ensembles' part of validation/baseline/README.md, ensembles.csv beside it and their figures from the tables in
bench/results/speed_against_error, which scripts/measure.sh makes."""
import csv
import math
import shutil

import chart
from measured import FOLDER, ROOT, ROWS, provenance, since, stamp, table, wrapped
from pages import replace_generated

PAGE = FOLDER / "README.md"
SIDES = {"equivalent": "yes", "beyond the margin": "no", "undecided": "undecided", "too few runs": "too few runs"}


def read(name):
    with open(ROWS / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text):
    return float(text) if text not in ("", "nan") else math.nan


def shown(value, low, high):
    if number(low) == number(high) == 0.0 and number(value) == 0.0:
        return "-"
    return f"{number(value):.4g} ({number(low):.4g} to {number(high):.4g})"


def share(row, key):
    """Of the margin, in per cent of it."""
    return number(row[key]) / number(row["margin"]) if number(row["margin"]) > 0.0 else math.nan


def agreement(rows):
    lines = []
    for case in dict.fromkeys(r["case"] for r in rows):
        mine = [r for r in rows if r["case"] == case and r["part"] == "agreement"]
        for setting in dict.fromkeys(r["setting"] for r in mine):
            these = [r for r in mine if r["setting"] == setting]
            lines += [f"### {case}: gem and {setting}, {these[0]['runs_first']} and {these[0]['runs']} runs", ""]
            lines += table(["quantity", "gem (95 %)", f"{setting} (95 %)", "difference (90 %)", "margin", "p (Holm)",
                            "the same?"],
                           [[r["quantity"], shown(r["first_mean"], r["first_low"], r["first_high"]),
                             shown(r["mean"], r["low"], r["high"]),
                             shown(r["difference"], r["difference_low"], r["difference_high"]),
                             f"{number(r['margin']):.3g}", f"{number(r['p_holm']):.2g}",
                             SIDES[r["verdict"]]] for r in these])
    return lines


def in_margins(row):
    """Paired difference with half of its 95 % interval, both over the margin."""
    if row is None or row["verdict"] == "too few runs":
        return "-"
    return (f"{share(row, 'paired_difference'):+.2f} +- "
            f"{0.5 * (share(row, 'paired_high') - share(row, 'paired_low')):.2f}")


def experiments(rows):
    """What each setting changes against gem: where Box2D's own difference shrinks, that setting explains it."""
    lines = []
    chosen = ("offset_x_mean_m", "offset_x_deviation_m", "ice_force_x_mean_N", "ice_force_1s_deviation_N", "hits_per_s",
              "landings_per_s", "energy_loss_W", "share_upstream")
    for case in dict.fromkeys(r["case"] for r in rows if r["part"] == "experiment"):
        body = []
        for setting in dict.fromkeys(r["setting"] for r in rows if r["case"] == case and r["part"] != "error"):
            these = {r["quantity"]: r for r in rows if r["case"] == case and r["setting"] == setting}
            runs = next(iter(these.values()))["runs"]
            body.append([f"{setting} ({runs})"] + [in_margins(these.get(q)) for q in chosen])
        lines += [f"### {case}: differences from gem in margins, by setting", ""]
        lines += table(["setting (runs)"] + [q for q in chosen], body)
    return lines


def forest(rows):
    """Differences with their intervals in margins: inside -1 to 1 is the same."""
    panels = []
    for case in dict.fromkeys(r["case"] for r in rows):
        these = [r for r in rows if r["case"] == case and r["part"] == "agreement"]
        if not these:
            continue
        settings = list(dict.fromkeys(r["setting"] for r in these))
        quantities = list(dict.fromkeys(r["quantity"] for r in these))
        panel = chart.Panel(f"{case}: difference from gem over the margin", "difference / margin with its 90 % interval; dashed: the margin", "", "")
        ticks = ", ".join(f'"{q}" {len(quantities) - k}' for k, q in enumerate(quantities))
        panel.extra += [f"set ytics ({ticks})", "set ytics noenhanced font ',9'", f"set yrange [0.3:{len(quantities) + 0.7}]",
                        "set xrange [-6:6]"]
        for at in (-1, 1):
            panel.mark(at, "")
        for j, setting in enumerate(settings):
            points = [(share(r, "difference"), len(quantities) - quantities.index(r["quantity"]) - 0.15 * j,
                       share(r, "difference_low"), share(r, "difference_high"))
                      for r in these if r["setting"] == setting and r["verdict"] != "too few runs"]
            panel.curve(setting, chart.colour_of(setting), points, "xerrorbars pt 7 ps 0.6 lw 1.5")
        panels.append(panel)
    return chart.write_figure(FOLDER / "figures" / "ensembles.svg", panels, 1, 900, 380, stamp("ensembles"))


def maps(rows):
    lines, counts = [], {}
    for row in rows:
        count = counts.setdefault((row["case"], row["setting"]), [0, 0, 0.0])
        count[0] += 1
        count[1] += int(row["equivalent"])
        count[2] += (number(row["share"]) - number(row["first_share"])) ** 2
    body = [[case, setting, str(n), f"{100 * same / n:.0f}", f"{math.sqrt(square / n):.3f}"]
            for (case, setting), (n, same, square) in counts.items()]
    lines += ["### Maps of concentration", "",
              "Cells of 20 m, mean over the judged time and the runs; a cell is the same if the 90 % interval of its",
              "difference lies within 0.10 of cover.", ""]
    return lines + table(["case", "setting", "cells", "the same [%]", "rms difference of cover"], body)


def map_figure(rows, setting="Box2D 8/3"):
    panels = []
    for case in dict.fromkeys(r["case"] for r in rows):
        these = [r for r in rows if r["case"] == case and r["setting"] == setting]
        for key, title in (("first_share", f"{case}: gem"), ("share", f"{case}: {setting}")):
            panel = chart.Panel(title, "x [m]", "y [m]", "")
            panel.extra += ["unset key", "set size ratio -1", "set palette defined (0 '#f2f6fa', 0.5 '#6fa8dc', 1 '#073763')",
                            "set cbrange [0:1]", "set cblabel 'share covered by ice'", "set xrange [-400:100]", "set yrange [-200:200]"]
            points = [(-390 + 20 * int(r["column"]), -190 + 20 * int(r["row"]), number(r[key])) for r in these]
            panel.curve(None, None, points, "image pixels")
            panels.append(panel)
    return chart.write_figure(FOLDER / "figures" / "concentration.svg", panels, 2, 560, 420, stamp("ensembles"))


def hits():
    """What explains the different numbers of hits: rows of a study that is over."""
    path = ROOT / "bench" / "results" / "hits.csv"
    if not path.exists():
        return []
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))

    def rate(setting, slower, gap):
        values = [float(r["per_s"]) for r in rows if (r["setting"], float(r["slower_left_out_m_per_s"]), float(r["gap_s"]))
                  == (setting, slower, gap)]
        return f"{sum(values) / len(values):.3f}"

    commits = dict.fromkeys(r["commit"] for r in rows)
    body, changed = [], dict.fromkeys(wrapped(f"{since(c)}.") for c in commits if since(c))
    for setting in dict.fromkeys(r["setting"] for r in rows):
        seeds = len({r["seed"] for r in rows if r["setting"] == setting})
        body.append([f"{setting.replace('moment', 'time step')} ({seeds})", rate(setting, 0.01, 1.0)] +
                    [rate(setting, 0.0, gap) for gap in (0.15, 0.3, 1.0, 3.0, 10.0)])
    return ["### Why Box2D has more hits and not more landings", "",
            "004_400_50 from 300 to 900 s, per second (in brackets: runs). A hit is a floe's first event faster than 0.01 m/s after a",
            "second without one; the other columns count a floe's first touch of any speed after so long without. Both engines agree on",
            "how often a floe comes to the platform (3 s and more). They differ in what floes do that lie there, pressed by those behind:",
            "with 8 velocity iterations started from the last step's impulses Box2D leaves closing speed in the rows, a floe's force on",
            "the platform pauses and comes back with a jerk. Skin and pushing apart do not matter, the time step little: 50 iterations or cold",
            "starts bring the pauses down towards gem's, gem held to 4 iterations has more of them than Box2D, and with 400 fewer than",
            "with its own 32. So rates of hits measure how far rows converge; landings measure how much ice arrives. Made by",
            f"`scripts/hits_study.sh` at commit 1044b66, rows of commit {', '.join(f'`{c}`' for c in commits)} (machine not recorded).", *changed, ""] + table(["setting (runs)", "hits", "touch after 0.15 s", "0.3 s", "1 s", "3 s: landings", "10 s"], body)


def main():
    if not (ROWS / "ensembles.csv").exists():
        print("ensembles: none measured yet; README.md is left as it is")
        return
    rows, cells = read("ensembles.csv"), read("map_means.csv")
    (FOLDER / "figures").mkdir(exist_ok=True)
    shutil.copy(ROWS / "ensembles.csv", FOLDER / "ensembles.csv")
    lines = ["", "Settings, cases, judged times and margins were written down before the runs that are judged: `ensembles.txt`.",
             "Every setting runs the same seeds, each another field. \"The same\" means equivalent within the margin at 5 %: two one-sided",
             "Welch tests (`gem/analysis/statistics/equivalence.h`) over runs, adjusted by Holm for all quantities of a case and setting;",
             "\"no\": the whole 90 % interval lies outside the margin. Samples of one run are never tested: they are correlated.",
             "Intervals of means are bootstraps over runs.", "", provenance("ensembles"), ""]
    lines += agreement(rows)
    if forest(rows):
        lines += ["![Differences between gem and Box2D](figures/ensembles.svg)", ""]
    lines += maps(cells)
    if map_figure(cells):
        lines += ["![Maps of concentration](figures/concentration.svg)", ""]
    lines += hits() + experiments(rows)
    replace_generated(PAGE, "speed_against_error", lines, "<!-- end of the ensembles -->")
    print(f"ensembles: {len(rows)} comparisons; {PAGE.relative_to(ROOT)} is up to date")

