"""Speed of whole runs, with what it costs in accuracy: runs cases with `gem run --json` and writes one CSV row per run.

usage: python3 scripts/studies real_time_factor PROGRAM OUTPUT.csv [--seconds S] [--threads 1,2] [--index 1,2,...]

The member of Table 1 of each --index runs for S seconds of simulated time at 0.25 m/s, and in proportion less at higher
speed; S = 0 runs it to its end. Repeated three times in turn; the row holds the median wall time and the spread.
"""
import argparse
import csv
import json
import os
import platform
import statistics
import subprocess
import tempfile

CASES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "cases", "table1.toml")
KEPT = ("engine", "time_s", "steps", "contacts", "maximum_overlap_m", "residual_momentum", "residual_energy",
        "peak_memory_bytes", "state_hash")


def processor():
    try:
        with open("/proc/cpuinfo", encoding="ascii") as info:
            return next(line.split(":", 1)[1].strip() for line in info if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor()


def run(program, index, threads, seconds, folder):
    out = os.path.join(folder, "run.h5")
    command = [program, "run", CASES, "--index", str(index), "--threads", str(threads), "--out", out, "--overwrite",
               "--json", "--quiet"]
    if seconds > 0:
        speed = (0.25, 0.5, 1.0)[(index - 1) % 3]
        command += ["--until", str(seconds * 0.25 / speed)]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("output")
    parser.add_argument("--seconds", type=float, default=900.0)
    parser.add_argument("--threads", default="1,2")
    parser.add_argument("--index", default="1,2,27")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    threads = [int(t) for t in options.threads.split(",")]
    indices = [int(i) for i in options.index.split(",")]
    version = subprocess.run([options.program, "--version"], check=True, capture_output=True, text=True).stdout
    commit = version.split()[2]  # gem VERSION COMMIT ...
    results = {}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.repeats):
            for index in indices:
                for count in threads:
                    results.setdefault((index, count), []).append(
                        run(options.program, index, count, options.seconds, folder))
    with open(options.output, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(("index", "threads", *KEPT, "median_wall_s", "fastest_wall_s", "slowest_wall_s",
                         "x_real_time", "processor", "commit"))
        for (index, count), runs in results.items():
            hashes = {r["state_hash"] for r in runs}
            assert len(hashes) == 1, f"run {index} gave {hashes}"
            walls = sorted(r["wall_time_s"] for r in runs)
            median = statistics.median(walls)
            row = (index, count, *(runs[0].get(key, "") for key in KEPT), median, walls[0], walls[-1],
                   runs[0]["time_s"] / median, processor(), commit)
            writer.writerow(row)
            print(*row)

