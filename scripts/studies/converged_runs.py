"""Numbers of the runs behind validation/paper/converged.md: one CSV of their summaries, and the statements as gem_paper judges them."""
import csv
import fnmatch
import math
import pathlib
import shutil
import subprocess
import tarfile

from pages import ROOT

RESULTS = ROOT / "bench" / "results" / "paper_splitting"
PAGE_RUNS = ROOT / "bench" / "results" / "paper"
RUNS = RESULTS / "runs.csv"

# Archives of each set. `page`: the runs of validation/paper/README.md; `gradient`: run 1 made again with its settings by the program of `converged`.
SETS = {"page": sorted(PAGE_RUNS.glob("seeds_*.tar.xz")), "gradient": [RESULTS / "gradient.tar.xz"], "converged": [RESULTS / "summaries.tar.xz"]}
CONDITIONS = ("*_400_*", "*_300_100")

NUMBERS = ("ice_mean_N", "x_offset_m", "x_deviation_m", "y_deviation_m", "orbit_largest_m", "mooring_peak_N", "x_period_by_spectrum_s",
           "maximum_overlap_m", "platform_touches", "ice_peak_sample_N", "ice_peak_window_N", "ice_peak_crushing_N", "real_time_factor")


def unpacked(name, folder, fits=lambda file: file.endswith(".h5")):
    """The summaries of a set whose names fit, in a folder of their own."""
    folder.mkdir()
    for archive in SETS[name]:
        with tarfile.open(archive) as tar:
            for member in tar.getmembers():
                file = pathlib.Path(member.name).name
                if member.isfile() and fits(file):
                    (folder / file).write_bytes(tar.extractfile(member).read())
    return folder


def setting(case, key):
    return next(line.split("=")[1].strip() for line in case.splitlines() if line.split("=")[0].strip() in key)


def rows_of(name, path):
    """One row for each run of a summary that the page compares."""
    import h5py
    with h5py.File(path) as file:
        column = {key: file[key][()] for key in NUMBERS + ("verdict_unfinished_steps",) if key in file}
        for i, run in enumerate(file["run"][()]):
            condition = run.decode().rsplit("_s", 1)[0]
            if not any(fnmatch.fnmatch(condition, pattern) for pattern in CONDITIONS):
                continue
            case = file["case_toml"][i].tobytes().decode()
            unfinished = column.get("verdict_unfinished_steps", [math.nan] * (i + 1))[i]
            yield {"set": name, "run": condition, "seed": int(file["seed"][i]), "state_hash": file["state_hash"][i].decode(),
                   "time_step_s": setting(case, ("time_step_s", "moment_s")),
                   "verdict": file["verdict"][i].decode() if "verdict" in file else "", "unfinished": f"{unfinished:.5g}",
                   **{key: f"{column[key][i]:.6g}" for key in NUMBERS}}


def collect(folder):
    """Writes RUNS from the summaries (needs h5py)."""
    rows = [row for name in SETS for path in unpacked(name, folder / name).glob("*.h5") for row in rows_of(name, path)]
    rows.sort(key=lambda row: (row["set"], row["run"], row["seed"]))
    with open(RUNS, "w", newline="", encoding="ascii") as file:
        out = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        out.writeheader()
        out.writerows(rows)


def stored():
    """Rows of RUNS by set and condition."""
    found = {}
    with open(RUNS, newline="", encoding="ascii") as file:
        for row in csv.DictReader(file):
            found.setdefault((row["set"], row["run"]), []).append(row)
    return found


def listed():
    """Verdict of each state hash of status.txt, as `gem sweep status` printed it."""
    lines = (RESULTS / "status.txt").read_text(encoding="ascii").splitlines()
    return {words[3]: words[-1] for words in map(str.split, lines) if len(words) > 4 and words[0].isdigit()}


def statements_in(path):
    """Row of each statement; the later ones with its name are of other modelling choices."""
    found = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["id"].startswith("P"):
                found.setdefault(row["id"], row)
    return found


def judged(gem_paper, runs, folder):
    """Rows of the statements by the runs of a folder alone: no rows of other programs lie beside the statements."""
    folder.mkdir()
    shutil.copy(ROOT / "validation" / "paper" / "paper.json", folder)
    subprocess.run([gem_paper, "judge", runs, "--out", folder / "page", "--statements", folder / "paper.json"], check=True,
                   stdout=subprocess.DEVNULL)
    return statements_in(folder / "page" / "rows.csv")
