"""Writes the generated part of validation/paper/scatter36.md and its figure from what scripts/scatter_gpu.sh made.

usage: python3 scripts/studies scatter36 FOLDER       (its shares/*.json and shares/*.csv are read)
"""
import argparse
import json
from pathlib import Path
from statistics import median

from pages import ROOT, replace_generated, table_of
from scatter_page import MEASURES, part, share

PAGE = ROOT / "validation" / "paper" / "scatter36.md"
FIGURE = PAGE.parent / "figures" / "scatter36.svg"
COLOURS = ["#4477aa", "#66ccee", "#228833", "#ccbb44", "#ee6677", "#aa3377"]
BAR, GAP, HEIGHT, LEFT = 20, 4, 110, 60


def share_of(entry):
    """Share by a monotone trend; for the field the variance between runs of one draw."""
    return part(entry, "total") if entry["key"] == "run.seed" else part(entry, "monotone", "share")


def kilonewtons(estimate):
    return "-" if estimate is None else f"{1e-3 * estimate['value']:.4g}"


def by_measure(study):
    """{measure: [(condition, its numbers)]}"""
    return {name: [(c["condition"], m) for c in study["conditions"] for m in c["measures"] if m["measure"] == name]
            for name in MEASURES}


def middle(values):
    """Median, and the range without the smallest and the largest tenth."""
    ordered = sorted(v for v in values if v is not None)
    if not ordered:
        return "-"
    cut = len(ordered) // 10
    return f"{100 * median(ordered):.0f} ({100 * ordered[cut]:.0f} to {100 * ordered[-1 - cut]:.0f})"


def summary(measures, inputs):
    rows = [[entry["input"]] + [middle([part(share_of(m["inputs"][k]), "value") for _, m in runs]) for runs in measures.values()]
            for k, entry in enumerate(inputs)]
    spread = [middle([m["deviation"]["value"] / abs(m["mean"]["value"]) for _, m in runs
                      if part(m["mean"], "value") and part(m["deviation"], "value") is not None])
              for runs in measures.values()]
    return table_of(["median share [%]"] + [MEASURES[name] for name in measures], rows + [["scatter, sd over mean [%]"] + spread])


def details(runs, inputs):
    rows = [[name, str(m["runs"]), kilonewtons(m["mean"]), kilonewtons(m["deviation"])] +
            [share(share_of(entry)) for entry in m["inputs"]] for name, m in runs]
    return table_of(["run", "made", "mean [kN]", "sd [kN]"] + [entry["input"] for entry in inputs], rows)


def bars(measures, inputs):
    """One row of stacked bars for each load, one bar for each run."""
    count = max(len(runs) for runs in measures.values())
    width, height = max(LEFT + count * (BAR + GAP) + 10, LEFT + 110 * len(inputs)), len(measures) * (HEIGHT + 40) + 120
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" font-size="11">',
             f'<rect width="{width}" height="{height}" fill="white"/>']
    for k, entry in enumerate(inputs):
        lines += [f'<rect x="{LEFT + 110 * k}" y="8" width="12" height="12" fill="{COLOURS[k % len(COLOURS)]}"/>',
                  f'<text x="{LEFT + 110 * k + 16}" y="18">{entry["input"]}</text>']
    for row, (name, runs) in enumerate(measures.items()):
        bottom = 60 + row * (HEIGHT + 40) + HEIGHT
        lines += [f'<text x="{LEFT}" y="{bottom - HEIGHT - 6}">{MEASURES[name]}</text>',
                  f'<text x="{LEFT - 6}" y="{bottom}" text-anchor="end">0</text>',
                  f'<text x="{LEFT - 6}" y="{bottom - HEIGHT + 8}" text-anchor="end">100 %</text>',
                  f'<path d="M{LEFT} {bottom}h{count * (BAR + GAP)}" stroke="black"/>']
        for column, (_, m) in enumerate(runs):
            shares = [max(part(share_of(entry), "value") or 0.0, 0.0) for entry in m["inputs"]]
            scale, y = HEIGHT / max(sum(shares), 1.0), float(bottom)
            for k, value in enumerate(shares):
                y -= scale * value
                lines.append(f'<rect x="{LEFT + column * (BAR + GAP)}" y="{y:.1f}" width="{BAR}" height="{scale * value:.1f}" '
                             f'fill="{COLOURS[k % len(COLOURS)]}"/>')
    for column, (name, _) in enumerate(next(iter(measures.values()))):
        x, y = LEFT + column * (BAR + GAP) + 14, len(measures) * (HEIGHT + 40) + 28
        lines.append(f'<text transform="translate({x} {y}) rotate(-90)" text-anchor="end">{name}</text>')
    return "\n".join(lines + ["</svg>"]) + "\n"


def lines_of(study):
    measures = by_measure(study)
    inputs = study["conditions"][0]["measures"][0]["inputs"]
    lines = [f"{study['runs']} of {study['listed']} runs were made. The inputs, drawn independently in a Latin hypercube:", ""]
    lines += table_of(["input", "key", "distribution"], [[i["input"], f"`{i['key']}`", i["law"]] for i in inputs])
    lines += ["", "Over the 36 runs: the median share, in brackets the range without the smallest and the largest tenth.", ""]
    lines += summary(measures, inputs) + ["", f"![Shares of all runs]({FIGURE.parent.name}/{FIGURE.name})"]
    for name, runs in measures.items():
        lines += ["", f"## {MEASURES[name][0].upper()}{MEASURES[name][1:]}", ""] + details(runs, inputs)
    return lines


def study_in(folder):
    """The conditions of all files as one study, in the order of Table 1."""
    ice = ["004", "040", "400", "121"]

    def place(name):
        parts = name.split("_")
        return (ice.index(parts[0]) if parts[0] in ice else len(ice), [-int(p) if k == 0 else int(p) for k, p in enumerate(parts[1:])])
    studies = [json.loads(path.read_text()) for path in sorted(folder.glob("*.json"))]
    conditions = [c for study in studies for c in study["conditions"]]
    return {"runs": sum(s["runs"] for s in studies), "listed": studies[0]["listed"],
            "conditions": sorted(conditions, key=lambda c: place(c["condition"]))}


def all_runs(folder):
    """The tables of all files under one head."""
    texts = [path.read_text().splitlines() for path in sorted(folder.glob("*.csv"))]
    return "\n".join(texts[0][:1] + [line for text in texts for line in text[1:]]) + "\n"


def main():
    parser = argparse.ArgumentParser(prog="studies scatter36", description=__doc__.split("\n\n")[0])
    parser.add_argument("folder", help="folder that scripts/scatter_gpu.sh made", type=Path)
    folder = parser.parse_args().folder / "shares"
    study = study_in(folder)
    FIGURE.write_text(bars(by_measure(study), study["conditions"][0]["measures"][0]["inputs"]))
    PAGE.with_suffix(".csv").write_text(all_runs(folder))
    replace_generated(PAGE, "scatter36", lines_of(study))


if __name__ == "__main__":
    main()
