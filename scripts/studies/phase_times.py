"""Time of each stage of time steps on a GPU, from what Nsight Compute printed, as CSV: kernels one after the other.

usage: ncu --metrics gpu__time_duration.sum --csv -k regex:phase_of --launch-skip 64 -c 192 \\
         build/gem_cuda_speed cases profile 264 independent plug | python3 scripts/studies phase_times COMMIT DEVICE
"""
import csv
import re
import sys

# Stage in gem/engine/step/stages.h
STAGES = ["list", "candidates", "narrow_phase", "solo_events", "contact_events", "gather", "iterate", "settle", "books",
          "move", "open_call", "first_solo_events", "plan", "last_books", "close_call"]


def stage_of(kernel):
    if "phase_of_lists" in kernel:
        return "list (none was out of date)"
    return STAGES[int(re.search(r"<(?:\(.*?\))?(\d+)", kernel)[1])]


def main():
    commit, device = sys.argv[1:3]
    lines = [line for line in sys.stdin if line.startswith('"')]
    times = {}
    for row in csv.DictReader(lines):
        microseconds = float(row["Metric Value"].replace(",", "")) / 1e3
        times.setdefault((stage_of(row["Kernel Name"]), row["Grid Size"]), []).append(microseconds)
    print("commit,device,phase,blocks,launches,microseconds")
    for (stage, grid), some in times.items():
        blocks = re.search(r"\d+", grid)[0]
        print(f"{commit},{device},{stage},{blocks},{len(some)},{sum(some) / len(some):.2f}")

