"""Writes the generated part of validation/paper/scatter.md, scatter.csv beside it and its figures from the folder of a sweep with
draws of the paper's runs (cases/scatter.toml).

usage: python3 scripts/studies scatter GEM FOLDER
"""
import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from pages import ROOT, replace_generated, table_of

PAGE = ROOT / "validation" / "paper" / "scatter.md"
MEASURES = {"ice_force_x_mean_N": "mean ice force along x", "ice_force_window_largest_N": "largest ice force over 1 s",
            "ice_sample_largest_N": "largest ice force over 0.2 s", "mooring_force_largest_N": "largest mooring force"}


def share(estimate):
    if estimate is None:
        return "-"
    value, low, high = (f"{100.0 * estimate[end]:.0f}" for end in ("value", "low", "high"))
    return f"{value} ({low} to {high})"


def force(estimate):
    value, low, high = (f"{1e-3 * estimate[end]:.4g}" for end in ("value", "low", "high"))
    return f"{value} ({low} to {high})"


def part(entry, *keys):
    for key in keys:
        entry = entry and entry[key]
    return entry


def loads(measures):
    return table_of(["load [kN]", "mean", "standard deviation", "90 % quantile", "smallest", "largest"],
                    [[MEASURES[m["measure"]], force(m["mean"]), force(m["deviation"]), force(m["p90"]),
                      f"{1e-3 * m['smallest']:.4g}", f"{1e-3 * m['largest']:.4g}"] for m in measures])


def shares(measures):
    """A row for each input; in each cell the share by a monotone trend, for the field that between its repeats."""
    rows = [[entry["input"]] + [share(part(m["inputs"][k], "total") if entry["key"] == "run.seed"
                                      else part(m["inputs"][k], "monotone", "share")) for m in measures]
            for k, entry in enumerate(measures[0]["inputs"])]
    rows.append(["all trends together"] + [f"{100.0 * max(m['monotone_explained'] or 0.0, 0.0):.0f}" for m in measures])
    return table_of(["input, share [%]"] + [MEASURES[m["measure"]] for m in measures], rows)


def first_order(measures):
    rows = [[entry["input"]] + [share(m["inputs"][k]["first_order"]) for m in measures]
            for k, entry in enumerate(measures[0]["inputs"]) if entry["key"] != "run.seed"]
    return table_of(["input, first-order index [%]"] + [MEASURES[m["measure"]] for m in measures], rows)


def lines_of(study, figures):
    inputs = study["conditions"][0]["measures"][0]["inputs"]
    lines = [f"{study['runs']} of {study['listed']} runs were made. The inputs, drawn independently in a Latin hypercube:", ""]
    lines += table_of(["input", "key", "distribution"], [[i["input"], f"`{i['key']}`", i["law"]] for i in inputs])
    for number, condition in enumerate(study["conditions"], 1):
        measures = condition["measures"]
        lines += ["", f"## {condition['condition']}: {measures[0]['draws']} draws, {measures[0]['runs']} runs", ""]
        lines += loads(measures) + ["", "Shares by monotone trends (ranks); of the field, the variance between runs of one draw:", ""]
        lines += shares(measures)
        if measures[0]["inputs"][0]["first_order"]:
            lines += ["", "The same without an assumption about form, from neighbours in the order of an input. Below 0 is chance:", ""]
            lines += first_order(measures)
        lines += ["", f"![Shares of {condition['condition']}]({figures[number - 1]})"]
    return lines


def main():
    parser = argparse.ArgumentParser(prog="studies scatter", description=__doc__.split("\n\n")[0])
    parser.add_argument("gem", help="the program")
    parser.add_argument("folder", help="folder of the sweep")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        page = Path(scratch) / "page"
        done = subprocess.run([arguments.gem, "sweep", "sensitivity", arguments.folder, "--json", "--partial", "--out", page],
                              stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            sys.exit(done.returncode)
        study = json.loads(done.stdout)
        figures = []
        for number, _ in enumerate(study["conditions"], 1):
            figures.append(f"figures/scatter_{number}.svg")
            shutil.copyfile(page / "figures" / f"shares_{number}.svg", PAGE.parent / figures[-1])
        shutil.copyfile(page / "runs.csv", PAGE.with_suffix(".csv"))
        replace_generated(PAGE, "scatter", lines_of(study, figures))


if __name__ == "__main__":
    main()
