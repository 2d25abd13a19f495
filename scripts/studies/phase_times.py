"""Time of each phase of time steps on a GPU, from what Nsight Compute printed, as CSV: kernels one after the other.

usage: ncu --metrics gpu__time_duration.sum --csv -k regex:phase_of --launch-skip 64 -c 192 \\
         build/gem_cuda_speed cases profile 264 independent plug | python3 scripts/studies phase_times COMMIT DEVICE
"""
import csv
import re
import sys

# DevicePhase in gem/engine/device/phases.h
PHASES = ["open", "begin", "plan", "list", "choose", "look", "resolve", "gather", "iterate", "settle", "bodies",
          "last_work", "close"]


def phase_of(kernel):
    if "phase_of_lists" in kernel:
        return "list (none was worn)"
    return PHASES[int(re.search(r"<(?:\(.*?\))?(\d+)", kernel)[1])]


def main():
    commit, device = sys.argv[1:3]
    lines = [line for line in sys.stdin if line.startswith('"')]
    times = {}
    for row in csv.DictReader(lines):
        microseconds = float(row["Metric Value"].replace(",", "")) / 1e3
        times.setdefault((phase_of(row["Kernel Name"]), row["Grid Size"]), []).append(microseconds)
    print("commit,device,phase,blocks,launches,microseconds")
    for (phase, grid), some in times.items():
        blocks = re.search(r"\d+", grid)[0]
        print(f"{commit},{device},{phase},{blocks},{len(some)},{sum(some) / len(some):.2f}")

