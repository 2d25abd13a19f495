"""Runs the closed-form cases on gem's engines and on Box2D and rewrites validation/baseline: closed_form.csv and the
generated part of README.md. Nothing is judged here: a number that Box2D misses is shown, not failed."""
import argparse
import csv
import math
import os
import re
import subprocess
import sys

from pages import ROOT, program, replace_generated, rows_of_tests

FOLDER = ROOT / "validation" / "baseline"
SETTINGS = {
    "cpu coupled": "gem coupled",
    "cpu independent": "gem independent",
    "box2d_8_3 coupled": "Box2D 8/3",
    "box2d_200_50 coupled": "Box2D 200/50",
    "box2d_thin_skin coupled": "Box2D thin skin",
}


def case_number(case):
    return int(re.sub(r"\D", "", case))


def measured(build):
    """Rows of gem, of Box2D, and of the cases in which a push lasts."""
    tests, survey = program(build, "gem_verification_tests"), program(build, "gem_sustained_survey")
    # Tests fail where Box2D misses gem's tolerances: their rows are what is wanted.
    rows = rows_of_tests(tests, "*cpu*")[0] + rows_of_tests(tests, "*box2d*", GEM_BASELINES="1")[0]
    done = subprocess.run([survey], cwd=ROOT, env={**os.environ, "LC_ALL": "C", "GEM_BASELINES": "1"},
                          stdout=subprocess.PIPE, text=True, check=True)
    return rows + list(csv.reader(done.stdout.splitlines()))


def by_case(rows):
    """Worst error of each key and setting: {case: {key: (expected, unit, {setting: error})}}."""
    cases = {}
    for case, key, engine, resolution, expected, computed, error, _, unit, verdict in rows:
        setting = SETTINGS.get(f"{engine} {resolution}")
        if setting is None or verdict == "not offered" or not case.startswith("V"):
            continue
        errors = cases.setdefault(case, {}).setdefault(key, (float(expected), unit, {}))[2]
        errors[setting] = max(errors.get(setting, 0.0), float(error))
        if math.isnan(float(computed)):
            errors[setting] = math.inf
    # only what both programs can express
    for case, keys in list(cases.items()):
        cases[case] = {k: v for k, v in keys.items() if any(s.startswith("Box2D") for s in v[2])}
        if not cases[case]:
            del cases[case]
    return dict(sorted(cases.items(), key=lambda item: case_number(item[0])))


def shown(expected, error):
    """Relative where there is something to be relative to."""
    return "" if error is None else f"{error / abs(expected) if expected != 0.0 else error:.1e}"


def write_csv(cases):
    with open(FOLDER / "closed_form.csv", "w", newline="", encoding="ascii") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["case", "key", "closed_form", "unit"] + ["error_" + s.replace(" ", "_").replace("/", "_").lower()
                                                                for s in SETTINGS.values()])
        for case, keys in cases.items():
            for key, (expected, unit, errors) in keys.items():
                out.writerow([case, key, repr(expected), unit] + [errors.get(s, "") for s in SETTINGS.values()])


def table(cases):
    with open(FOLDER / "notes.txt", encoding="ascii") as file:
        notes = dict(tuple(part.strip() for part in line.split("|", 1)) for line in file if not line.startswith("#"))
    lines = ["| number | closed form | unit | " + " | ".join(SETTINGS.values()) + " |", "|---|---|---|" + "---|" * len(SETTINGS)]
    for case, keys in cases.items():
        if case not in notes:
            sys.exit(f"closed_form: case {case} has no line in notes.txt")
        for key, (expected, unit, errors) in keys.items():
            values = " | ".join(shown(expected, errors.get(s)) for s in SETTINGS.values())
            lines.append(f"| {key} | {expected:.9g} | {unit} | {values} |")
    lines += ["", "| case | why Box2D differs |", "|---|---|"]
    lines += [f"| {case} | {notes[case]} |" for case in cases]
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", nargs="?", default=ROOT / "build")
    cases = by_case(measured(parser.parse_args().build))
    if not any(s.startswith("Box2D") for keys in cases.values() for v in keys.values() for s in v[2]):
        sys.exit("closed_form: no Box2D rows (was Box2D built in?)")
    write_csv(cases)
    page = FOLDER / "README.md"
    replace_generated(page, "closed_form", ["", *table(cases), ""])
    print(f"closed_form: {sum(map(len, cases.values()))} numbers of {len(cases)} cases; {page.relative_to(ROOT)} is up to date")
