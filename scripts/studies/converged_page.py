"""Writes the generated part of validation/paper/converged.md: the paper's statements and loads with contacts that are iterated to their end.

usage: python3 scripts/studies converged GEM_PAPER            writes the page
       python3 scripts/studies converged GEM_PAPER --check    compares the page with what would be written
       python3 scripts/studies converged --collect            writes bench/results/paper_splitting/runs.csv anew (needs h5py)
"""
import argparse
import difflib
import json
import math
import pathlib
import shutil
import statistics
import sys
import tempfile

import converged_runs
from pages import ROOT, replace_generated, table_of

PAGE = ROOT / "validation" / "paper" / "converged.md"
RUN_1 = "004_400_25"
SEEDS = 16
OF_RUN_1 = {"P48"}  # named `all`, but a number of run 1
STUDENT = {11: 2.228, 16: 2.131, 30: 2.045}  # 97.5 % quantile by the number of values

# What the table of run 1 shows: label, key, unit, and the digits of the unit.
LOADS = [("mean ice force [kN]", "ice_mean_N", 1e3), ("deviation of x [mm]", "x_deviation_m", 1e-3), ("deviation of y [mm]", "y_deviation_m", 1e-3),
         ("largest excursion [mm]", "orbit_largest_m", 1e-3), ("period of x [s]", "x_period_by_spectrum_s", 1.0),
         ("peak mooring force [kN]", "mooring_peak_N", 1e3), ("largest ice force over 1 s [kN]", "ice_peak_window_N", 1e3),
         ("largest ice force over 0.2 s [kN]", "ice_peak_sample_N", 1e3), ("largest crushing peak of a hit [kN]", "ice_peak_crushing_N", 1e3),
         ("hits on the platform", "platform_touches", 1.0), ("deepest overlap [mm]", "maximum_overlap_m", 1e-3)]
# What the table of the other conditions shows of each run.
SHOWN = [("mean ice force [kN]", "ice_mean_N", 1e3), ("largest excursion [mm]", "orbit_largest_m", 1e-3), ("deepest overlap [mm]", "maximum_overlap_m", 1e-3)]

# Why a verdict changed; {names}: the number by the first 16 seeds of the page's runs, by `gradient` made again, and converged.
REASONS = {
    "P27": "Fewer seeds. The first 16 seeds of the page's own runs, {page_16}, leave it open too.",
    "P46": "Fewer runs. All of them obey, but the interval of their share must lie above nine of ten, and so few runs cannot show that.",
    "P48": "Too few peaks. `gradient` made again leaves it open too, {gradient}; the first 16 seeds of the page's runs gave {page_16}. No difference "
           "of contacts is shown.",
    "P49": "Hits are counted otherwise; contacts are not the cause. Today a hit is one event from the first touch to the release. When the page's runs were made, a "
           "floe that lay on the barge counted again whenever its force came back. `gradient` made again gives {gradient} as well. The rule, more than 1000, "
           "was set for that count."}
# Numbers that moved far while the verdict stands.
MOVED = {
    "P28": "It holds by less: the first 16 seeds of the page's runs gave {page_16}, `gradient` made again gives {gradient}, which decides "
           "nothing. The null model is hit as often as the platform, and hits are counted otherwise now. P31 is alike.",
    "P50": "Contacts are the cause. Iterations that do not end smear a hit over several time steps, so the largest force over 0.2 s was too small: {page_16} by the "
           "first 16 seeds of the page, {gradient} by `gradient` made again, {converged} converged. The statement holds by a wider margin.",
    "P52": "Hits are counted otherwise: only the first touch of a hit has a crushing peak now. Before, a floe that lay on the barge had one whenever its force came back, and "
           "such flat touches have large peaks. `gradient` made again gives {gradient}, converged {converged}."}


def values(rows, key, unit=1.0):
    return [float(row[key]) / unit for row in rows]


def half_width(sample):
    """Of the 95 % interval of the mean."""
    return STUDENT[len(sample)] * statistics.stdev(sample) / math.sqrt(len(sample))


def mean_text(sample):
    mean, half = statistics.mean(sample), half_width(sample)
    return f"{mean:.3g} ({mean - half:.3g} … {mean + half:.3g})" if mean < 999.5 else f"{mean:.0f} ({mean - half:.0f} … {mean + half:.0f})"


def percent(value, half):
    return f"{100.0 * value:+.1f} ± {100.0 * half:.1f}" if abs(half) < 0.1 else f"{100.0 * value:+.0f} ± {100.0 * half:.0f}"


def difference(base, sample):
    """Of the means of two groups of runs, over the first, with the half width of its 95 % interval."""
    mean = statistics.mean(base)
    half = STUDENT[SEEDS] * math.sqrt(statistics.variance(base) / len(base) + statistics.variance(sample) / len(sample))
    return statistics.mean(sample) / mean - 1.0, half / mean


def difference_of_one(base, value):
    """Of one run from the mean of others. The half width is how far one more of them would lie off (95 %)."""
    mean = statistics.mean(base)
    return value / mean - 1.0, STUDENT[len(base)] * statistics.stdev(base) * math.sqrt(1.0 + 1.0 / len(base)) / mean


def common_difference(pairs):
    """Of single runs, each from the runs of its own condition: by the mean of the logarithms and its 95 % interval, in per cent."""
    logs = [math.log(value) - statistics.mean(map(math.log, base)) for base, value in pairs]
    mean, half = statistics.mean(logs), half_width(logs)
    middle, low, high = (f"{100.0 * math.expm1(end):+.2g}" for end in (mean, mean - half, mean + half))
    return f"{middle} ({low} … {high})"


def number(row):
    """Result of a statement with its interval."""
    if row is None or not row["result"]:
        return "-"
    value, low, high = (f"{float(row[key]):.3g}" if float(row[key]) < 1000 else f"{float(row[key]):.0f}" for key in ("result", "low", "high"))
    return value if low == high else f"{value} ({low} … {high})"


def marked(verdict):
    return f"**{verdict}**" if verdict == "not reproduced" else verdict


def rule(row):
    expected = f"{float(row['expected']):g}"
    return {"within": f"{expected} ± {row['tolerance']}", "above": f"> {expected}", "below": f"< {expected}", "significant": f"p < {expected}"}[row["kind"]]


class Verdicts:
    """The statements judged by each set of runs."""

    def __init__(self, gem_paper, folder):
        self.page = converged_runs.statements_in(ROOT / "validation" / "paper" / "rows.csv")
        first = {f"seeds_run1_{seed}.h5" for seed in range(1, SEEDS + 1)}
        open_water = lambda file: file.endswith(".h5") and not file.startswith("g")
        chosen = {"page": lambda file: file in first, "gradient": lambda file: file.endswith(".h5"), "converged": open_water}
        judged = {}
        for name, fits in chosen.items():
            runs = converged_runs.unpacked(name, folder / name, fits)
            judged[name] = converged_runs.judged(gem_paper, runs, folder / f"judged_{name}")
        self.page_16, self.gradient, self.converged = judged["page"], judged["gradient"], judged["converged"]
        said = json.loads((ROOT / "validation" / "paper" / "paper.json").read_text(encoding="utf-8"))["statements"]
        self.says = {one["id"]: one["says"] for one in said}
        self.alike = {one["id"] for one in said if one.get("alike")}

    def measured(self):
        """Statements that contacts can change and that these runs have a number for."""
        return [key for key, row in self.converged.items() if row["result"] and key not in self.alike]

    def changed(self):
        return [key for key in self.measured() if self.page[key]["verdict"] != self.converged[key]["verdict"]]

    def missing(self):
        return [key for key, row in self.converged.items() if not row["result"]]

    def undecided(self):
        return [key for key in self.measured() if self.page[key]["verdict"] == self.converged[key]["verdict"] == "undecidable"]


def statements(verdicts):
    rows = []
    for key in verdicts.measured():
        if key in verdicts.undecided():
            continue
        old, new = verdicts.page[key], verdicts.converged[key]
        changed = old["verdict"] != new["verdict"]
        again = verdicts.gradient[key] if new["case"] == RUN_1 or key in OF_RUN_1 else None
        rows.append([key, verdicts.says[key], rule(new), number(old), number(again), number(new),
                     f"{old['verdict']} → {marked(new['verdict'])}" if changed else marked(new["verdict"])])
    return table_of(["", "the paper", "rule", "gradient, the runs of the page", "gradient, made again", "converged", "verdict"], rows)


def run_1(runs):
    rows = []
    for label, key, unit in LOADS:
        old, again, new = (values(runs[(name, RUN_1)], key, unit) for name in ("page", "gradient", "converged"))
        rows.append([label, mean_text(old), mean_text(again), mean_text(new), percent(*difference(old, new)), percent(*difference(again, new))])
    return table_of(["run 1", "gradient, 30 seeds of the page", "gradient, made again, 16", "converged, 16", "from the page [%]", "from made again [%]"], rows)


def others(runs):
    """One row for each other condition, and the mean of those with the 400 m gap."""
    rows, pairs = [], {key: [] for _, key, _ in SHOWN}
    for name, run in sorted(runs, key=lambda one: ("_400_" not in one[1], one[1])):
        if name != "converged" or run == RUN_1:
            continue
        (new,), old = runs[(name, run)], runs[("page", run)]
        row = [run, f"{new['time_step_s']}", f"{100.0 * float(new['unfinished']):.2g}", new["verdict"]]
        for _, key, unit in SHOWN:
            base, value = values(old, key, unit), float(new[key]) / unit
            row += [mean_text(base), f"{value:.3g}" if value < 999.5 else f"{value:.0f}"]
            row += [percent(*difference_of_one(base, value))] if key != "maximum_overlap_m" else []
            pairs[key] += [(base, value)] if "_400_" in run else []
        rows.append(row)
    count = len(pairs["ice_mean_N"])
    mean = [common_difference(pairs[key]) for _, key, _ in SHOWN]
    rows.insert(count, [f"these {count} together", "", "", "", "", "", mean[0], "", "", mean[1], "", f"{mean[2]} %"])
    head = ["run", "time step [s]", "unfinished [%]", "verdict"]
    for label, key, _ in SHOWN:
        head += [f"{label}: gradient", "converged"] + (["difference [%]"] if key != "maximum_overlap_m" else [])
    return table_of(head, rows)


def check_listed(runs):
    """The rows must be of the runs that status.txt lists."""
    listed = converged_runs.listed()
    found = {row["state_hash"]: row["verdict"] for (name, _), rows in runs.items() if name == "converged" for row in rows}
    if listed != found:
        sys.exit("runs.csv and status.txt do not list the same runs and verdicts (one is older); run: python3 scripts/studies converged --collect")


def of_run_1(runs, name):
    """Verdicts and unfinished time steps of the seeds of run 1."""
    rows = runs[(name, RUN_1)]
    good = sum(row["verdict"] == "good" for row in rows)
    share = sorted(100.0 * value for value in values(rows, "unfinished"))
    return f"{good} of {len(rows)} good, {share[0]:.2g} to {share[-1]:.2g} % of the time steps unfinished, median {statistics.median(share):.2g} %"


def explained(verdicts, reasons):
    lines = []
    for key, reason in reasons.items():
        old, new = verdicts.page[key], verdicts.converged[key]
        named = {name: number(getattr(verdicts, name)[key]) for name in ("page_16", "gradient", "converged")}
        verdict = f"{old['verdict']} → {marked(new['verdict'])}" if old["verdict"] != new["verdict"] else f"still {new['verdict']}"
        lines.append(f"- **{key}**, {verdicts.says[key]}: {verdict}; {number(old)} → {number(new)}. {reason.format(**named)}")
    return lines


def generated(verdicts, runs):
    if set(verdicts.changed()) != set(REASONS):
        sys.exit(f"the verdicts of {', '.join(verdicts.changed())} changed, and REASONS says why of {', '.join(REASONS)} (a reason is missing or out of date)")
    return ["## What changed", "", "Verdicts:", "", *explained(verdicts, REASONS), "",
            "Numbers whose verdict stands:", "", *explained(verdicts, MOVED), "",
            "## Statements", "", *statements(verdicts), "",
            f"Undecidable with both: {', '.join(verdicts.undecided())}.",
            f"Set by the case or the ice field, and not by contacts: {', '.join(sorted(verdicts.alike))}.",
            f"Cannot be judged by these runs: {', '.join(key for key in verdicts.missing() if key not in verdicts.alike)}.", "",
            "## Loads", "", *run_1(runs), "", *others(runs), "", f"Run 1, converged: {of_run_1(runs, 'converged')}. Run 1, `gradient` made again: {of_run_1(runs, 'gradient')}."]


def main():
    parser = argparse.ArgumentParser(prog="studies converged", description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("gem_paper", nargs="?", help="the program gem_paper")
    parser.add_argument("--check", action="store_true", help="compare the page with what would be written")
    parser.add_argument("--collect", action="store_true", help="write runs.csv anew from the summaries (needs h5py)")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        if arguments.collect:
            converged_runs.collect(folder)
            return
        if not arguments.gem_paper:
            parser.error("GEM_PAPER or --collect is needed")
        runs = converged_runs.stored()
        check_listed(runs)
        written = pathlib.Path(shutil.copy(PAGE, folder))
        replace_generated(written, "converged", generated(Verdicts(arguments.gem_paper, folder), runs))
        before, after = PAGE.read_text(encoding="utf-8"), written.read_text(encoding="utf-8")
    if not arguments.check:
        PAGE.write_text(after, encoding="utf-8")
    elif before != after:
        sys.stdout.writelines(difflib.unified_diff(before.splitlines(True), after.splitlines(True), PAGE.name, "now"))
        sys.exit(f"{PAGE.name} is out of date (lines with + are new); write it anew: python3 scripts/studies converged GEM_PAPER")


if __name__ == "__main__":
    main()
