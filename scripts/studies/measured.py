"""What scripts/measure.sh made: its tables, the conditions that it noted, and small tools for pages that are made from them."""
import csv
import math
import statistics
import textwrap

from pages import ROOT, table_of

ROWS = ROOT / "bench" / "results" / "speed_against_error"
FOLDER = ROOT / "validation" / "baseline"
FIGURES = FOLDER / "figures"


def read(name):
    """Rows of one table and those of other engines with the same header."""
    path = ROWS / name
    if not path.exists():
        return []
    with open(path, newline="", encoding="utf-8") as file:
        head = file.readline()
        rows = list(csv.DictReader(file, fieldnames=head.strip().split(",")))
    for other in sorted((ROWS / "other").glob("*.csv")):
        with open(other, newline="", encoding="utf-8") as file:
            if file.readline() == head:
                rows += csv.DictReader(file, fieldnames=head.strip().split(","))
    return rows


def grouped(rows, *keys):
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return groups


def median(rows, key):
    values = [float(row[key]) for row in rows if row[key] not in ("", "nan")]
    return statistics.median(values) if values else math.nan


def rms(values):
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else math.nan


def table(head, rows):
    """With numbers: to the right."""
    return table_of(head, rows, "---:") + [""]


def figure(name, text):
    return [f"![{text}](figures/{name}.svg)", "", f"*{text} Numbers: `bench/results/speed_against_error`.*", ""]


def conditions():
    """Text of conditions.txt, and its measurements: dicts with parts, begun, machine, load, program."""
    path = ROWS / "conditions.txt"
    lines = path.read_text(encoding="utf-8").rstrip().splitlines() if path.exists() else []
    runs = []
    for line in lines:
        word, _, rest = line.partition(" ")
        if word == "begun":
            when, _, parts = rest.partition(": ")
            runs.append({"begun": when, "parts": [part.split(":")[0] for part in parts.split()]})
        elif runs and word in ("machine", "load", "program", "note"):
            runs[-1].setdefault(word, rest.strip())
    return lines, runs


def commit_of(run):
    return (run.get("program", "") + " ? ? ?").split()[2]


# Changes of gem's results after commits whose rows are still shown; a commit that is not here has the results of today.
CONTACTS_CHANGED = ("Since then gem's contacts have changed: no point is left out of the iterations any more, contacts reach 1.5 time steps of "
                    "drift, and floes are numbered along the channel; runs of today have other bits, and these rows were not made again")
CHANGED_SINCE = {"1fcea2322717": CONTACTS_CHANGED,
                 "d3be220d2d4d": CONTACTS_CHANGED + ". The commit is that of the program which counted; the runs are of it or older"}

def since(commit):
    return CHANGED_SINCE.get(commit.removesuffix("-dirty"), "")


def wrapped(text):
    return textwrap.fill(text, 125, break_on_hyphens=False, break_long_words=False)


def provenance(part, rows=()):
    """By which commits, when and where a part was measured, as a paragraph; rows that state their commit choose among its runs."""
    commits = dict.fromkeys(row["commit"] for row in rows if row.get("commit"))
    runs = [run for run in conditions()[1] if part in run["parts"] and (not commits or commit_of(run) in commits)]
    texts = []
    for commit in commits or dict.fromkeys(commit_of(run) for run in runs):
        mine = [run for run in runs if commit_of(run) == commit]
        where = dict.fromkeys(f"{run['begun'][:10]} on {run.get('machine', '?')}, load {run.get('load', '?').replace(', quick 0', '')}"
                              + (f" ({run['note']})" if "note" in run else "") for run in mine)
        text = f"commit `{commit}`, " + ("; ".join(where) or "conditions not recorded")
        texts.append(text + (f". {since(commit)}" if since(commit) else ""))
    return wrapped("Measured by " + "; by ".join(texts) + ".") if texts else "Not measured."


def stamp(*parts, rows=()):
    """Commit and conditions of the measurements of these parts, for a figure; the newest first. With `rows` only those that made
    them."""
    texts, commits = [], {row["commit"] for row in rows}
    for run in reversed(conditions()[1]):
        if not set(parts) & set(run["parts"]) or (commits and commit_of(run) not in commits):
            continue
        text = f"commit {commit_of(run)}, {run['begun'][:10]}, {run.get('machine', '?')}, load {run.get('load', '?')}"
        if text.endswith("quick 1"):
            text = "REHEARSAL, numbers mean nothing: " + text
        texts.append(text.replace(", quick 0", "").replace(", quick 1", ""))
    return "; ".join(dict.fromkeys(texts)) or "conditions not recorded"
