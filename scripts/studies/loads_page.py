"""Table and figure of gem/manual/how_sure.md, from the ensembles in bench/results that bench/load_ensemble.cpp made."""
import csv
import math
import statistics

import chart
from pages import ROOT, replace_generated, table_of

PAGE = ROOT / "gem" / "manual" / "how_sure.md"
FIGURE = ROOT / "gem" / "manual" / "images" / "how_sure.svg"
LOADS = {"mean_N": "mean", "sd_0.2s_N": "standard deviation, 0.2 s", "max_0.2s_N": "largest, 0.2 s", "max_1s_N": "largest, 1 s"}
COLOURS = dict(zip(LOADS, ("#0b5394", "#38761d", "#a61c00", "#e6a23c")))
# file in bench/results, its variants and what they change
ENSEMBLES = {
    "compliance_crowd.txt": {"sub4": "four times the substeps", "dt2": "half the time step", "stiff4": "four times the stiffness",
                             "rigid": "rigid ice (coupled)"},
}
# 95 % point of Student's t, by the degrees of freedom: for a 90 % interval
STUDENT = {10: 1.812, 12: 1.782, 15: 1.753, 20: 1.725, 25: 1.708, 30: 1.697, 60: 1.671}


def runs_of(name):
    """Rows by variant and seed."""
    runs = {}
    with open(ROOT / "bench" / "results" / name, encoding="ascii") as file:
        lines = [line for line in file if "," in line and not line.startswith("#")]
    for row in csv.DictReader(lines):
        runs.setdefault(row["variant"], {})[row["seed"]] = row
    return runs


def ratio(base, other, load):
    """Geometric mean of the ratios by seed, and the half width of its 90 % interval."""
    logs = [math.log(float(other[seed][load]) / float(base[seed][load])) for seed in other if seed in base]
    freedom = max(n for n in STUDENT if n < len(logs))
    mean = math.exp(statistics.mean(logs))
    return mean, mean * STUDENT[freedom] * statistics.stdev(logs) / math.sqrt(len(logs))


def main():
    rows, places = [], []
    for name, variants in ENSEMBLES.items():
        runs = runs_of(name)
        for variant, title in variants.items():
            ratios = [ratio(runs["default"], runs[variant], load) for load in LOADS]
            seeds = len(set(runs[variant]) & set(runs["default"]))
            rows.append([title, str(seeds)] + [f"{mean:.2f} ± {half:.2f}" for mean, half in ratios])
            places.append((title, ratios))
    replace_generated(PAGE, "loads", table_of(["changed", "seeds", *LOADS.values()], rows))
    panel = chart.Panel("Loads over those of the defaults, with 90 % intervals", "ratio", "", "")
    ticks = ", ".join(f'"{title}" {len(places) - k}' for k, (title, _) in enumerate(places))
    panel.extra += [f"set ytics ({ticks})", "set ytics noenhanced font ',10'", f"set yrange [0.3:{len(places) + 0.7}]", "set xrange [0.6:2.3]"]
    panel.mark(1.0, "")
    for j, (load, title) in enumerate(LOADS.items()):
        points = [(r[j][0], len(places) - k + 0.15 * (1.5 - j), r[j][0] - r[j][1], r[j][0] + r[j][1]) for k, (_, r) in enumerate(places)]
        panel.curve(title, COLOURS[load], points, "xerrorbars pt 7 ps 0.6 lw 1.5")
    chart.write_figure(FIGURE, [panel], 1, 900, 460, "cases/crowd.toml, bench/results/compliance_crowd.txt")


if __name__ == "__main__":
    main()
