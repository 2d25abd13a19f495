"""Runs the closed-form cases and rewrites the generated part of validation/README.md: the claims with their status, then of
each case the number that uses most of its tolerance. Exit code 1: a check failed (the table says which)."""
import argparse
import math
import sys

from pages import ROOT, program, replace_generated, rows_of_tests, stated, table_of

PAGE = ROOT / "validation" / "README.md"
CASES = [f"V{number:02d}" for number in range(1, 200)] + [f"M{number}" for number in range(1, 100)]


def used(row):
    """Share of the tolerance that the error uses."""
    error, tolerance = float(row[6]), float(row[7])
    if error == 0.0:
        return 0.0
    return error / tolerance if tolerance > 0.0 else math.inf


def status(rows, bold_if_none="**not run**"):
    """'26 pass, 2 not offered' and the like."""
    checks = [row for row in rows if row[9] != "not offered"]
    faults = sum(row[9] != "pass" for row in checks)
    absent = len(rows) - len(checks)
    text = f"**{faults} of {len(checks)} fail**" if faults else f"{len(checks)} pass"
    if not checks:
        text = "none" if absent else bold_if_none
    return text + (f", {absent} not offered" if absent else "")


def claims_table(claims, rows_by_case):
    body = []
    for cases, claim, test, why in claims:
        rows = [row for case in cases.split() for row in rows_by_case.get(case, [])]
        body.append([cases, claim, f"`{test}`", why, status(rows)])
    return table_of(["cases", "claim", "test", "tolerance and why", "status"], body)


def cases_table(claimed, rows_by_case):
    body = []
    for case in (c for c in CASES if c in claimed):
        rows = rows_by_case.get(case, [])
        checks = [row for row in rows if row[9] != "not offered"]
        if checks:
            worst = max(checks, key=used)
            where = worst[2] if worst[3] == "-" else f"{worst[2]} {worst[3]}"
            body.append([case, worst[1], where, *worst[4:9], status(rows)])
        else:
            body.append([case] + [""] * 7 + [f"{len(rows)} not offered" if rows else "**not run**"])
    return table_of(["case", "number", "where", "expected", "computed", "error", "tolerance", "unit", "checks"], body)


def tables(claims, rows):
    claimed = {case for claim in claims for case in claim[0].split()}
    rows_by_case = {}
    for row in rows:
        if row[0] not in claimed:
            sys.exit(f"verification: case {row[0]} has no claim in claims.txt")
        rows_by_case.setdefault(row[0], []).append(row)
    return ["", "### Claims", "", *claims_table(claims, rows_by_case), "", "### Cases", "",
            "For each case: the number, over all engines and solvers, that comes closest to its tolerance; of equals the first.",
            "", *cases_table(claimed, rows_by_case)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", nargs="?", default=ROOT / "build")
    rows, log, failed = rows_of_tests(program(parser.parse_args().build, "gem_verification_tests"))
    claims = stated(ROOT / "validation" / "verification" / "claims.txt")
    replace_generated(PAGE, "verification", tables(claims, rows))
    if failed:
        sys.exit(f"{log}\nverification: some checks failed; {PAGE.relative_to(ROOT)} says which")
    print(f"verification: {len(rows)} rows pass or are not offered; {PAGE.relative_to(ROOT)} is up to date")
