"""Runs the hard cases and rewrites the generated part of validation/hard/README.md: each bound, and what every engine and
resolution came to. Exit code 1: a bound is missed that is not stated as missed (the table says which)."""
import argparse
import csv
import re
import sys

from pages import ROOT, program, replace_generated, rows_of_tests, stated, table_of

FOLDER = ROOT / "validation" / "hard"
NOT_LONG = "-*/Long*:Long*"


def order(key):
    """H2 stands before H10."""
    letter, number, rest = re.match(r"(.)\D*(\d+)(.*)", key).groups()
    return letter, int(number), rest


def cell_of(row, bound, reasons, notes):
    """A missed bound is bold; a miss that is stated beforehand is slanted, with the number of its reason in `notes`."""
    text = f"{float(row[5]):.3g}" + ("" if row[7] == bound else f" (bound {row[7]})")
    if row[9] == "FAIL":
        return f"**{text}**"
    if row[9] == "missed":
        number = notes.setdefault(reasons.get((row[3], row[1]), ""), len(notes) + 1)
        return f"*{text}* ({number})"
    return text


def table(known_misses, rows):
    reasons = {tuple(name.split()[:2]): why for name, why in known_misses}
    settings, keys, cells, notes = {}, {}, {}, {}
    for row in rows:
        setting = row[2] if row[3] == "-" else f"{row[2]} {row[3]}"
        settings[setting] = True
        expected, bound, unit = keys.setdefault(row[1], (row[4], row[7], row[8]))
        cells[row[1], setting] = cell_of(row, bound, reasons, notes)
    count = {verdict: sum(row[9] == verdict for row in rows) for verdict in ("pass", "FAIL", "missed")}
    body = [[key, *keys[key]] + [cells.get((key, setting), "") for setting in settings] for key in sorted(keys, key=order)]
    return ["", f"{count['pass']} numbers within their bounds, {count['FAIL']} beyond, {count['missed']} stated as missed.", "",
            *table_of(["number", "expected", "bound", "unit", *settings], body), "",
            *(f"{number}. {why}" for why, number in notes.items())]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", nargs="?", default=ROOT / "build")
    parser.add_argument("--filter", help="cases as --gtest_filter names them: the table is printed and the page left alone. "
                        "Without it the long ones are taken from validation/hard/long.csv (GEM_TABLE=FILE gem_hard_tests "
                        "--gtest_filter='*Long*', the day of jam with GEM_ENGINE=cuda)")
    parser.add_argument("--rows", metavar="FILE.csv", help="takes the rows that scripts/measure_all.sh made instead of running the tests")
    options = parser.parse_args()
    if options.rows:
        with open(options.rows, newline="", encoding="ascii") as file:
            rows, log = list(csv.reader(file)), ""
        failed = any(row[9] == "FAIL" for row in rows)
    else:
        rows, log, failed = rows_of_tests(program(options.build, "gem_hard_tests"), options.filter or NOT_LONG)
    with open(FOLDER / "long.csv", newline="", encoding="ascii") as file:
        lines = table(stated(FOLDER / "known_misses.txt"), rows + list(csv.reader(file)))
    page = FOLDER / "README.md"
    if options.filter:
        print("\n".join(lines))
        sys.exit(failed)
    replace_generated(page, "hard", lines)
    if failed:
        told = sorted({line for line in log.splitlines() if re.match(r"\[  FAILED  \]|[A-Z]\d+\.", line)})
        sys.exit("\n".join(told) + f"\nhard cases: some bounds are missed; {page.relative_to(ROOT)} says which")
    print(f"hard cases: {len(rows)} rows within their bounds or stated as missed; {page.relative_to(ROOT)} is up to date")
