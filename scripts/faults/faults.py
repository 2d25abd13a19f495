"""Makes runs fail and counts what is left: tried, survived, lost.

usage: python3 scripts/faults/faults.py GEM LIBRARY [--short] [--tries N] [--only NAMES] [--seed N]

--tries: how often each fault is tried; of the n-th calls every so manyth. LIBRARY is gem_fail_nth (CMake builds it with the tests).

A run survives if it ends with exit code 0 and a complete file, or with exit code 4 or 7, a message, and no file or a file that `gem info`
reads, without rows of zeros. A killed run survives if its file is absent or holds all but the last 5 s of wall time. Exit code 1:
something was lost; 77: no module h5py would check the rows.
"""
import argparse
import random
import sys
import tempfile

from failing_calls import FailingCalls
from fault_runs import FaultRuns
from judge import h5py
from random_moments import RandomMoments, can_mount
from several_processes import SeveralProcesses


class Faults(FailingCalls, RandomMoments, SeveralProcesses, FaultRuns):
    """All of them."""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("gem")
    parser.add_argument("library")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--tries", type=int, default=0)
    parser.add_argument("--only", default="")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if h5py is None:
        print("skipped: no h5py (package python3-h5py)")
        sys.exit(77)
    random.seed(options.seed)
    with tempfile.TemporaryDirectory() as folder:
        faults = Faults(options.gem, options.library, folder, options)
        for name in ("two_writers", "sweeps", "memory", "nth_calls", "disks", "power_cuts", "kills"):
            if name == "disks" and not can_mount(folder):
                print("disks: skipped, no right to mount a small disk")
            elif not options.only or name in options.only.split(","):
                getattr(faults, name)()
        print("\n| fault | tried | survived | lost |\n|---|---:|---:|---:|")
        for row in faults.table:
            print("| %s | %d | %d | %d |" % row)
        sys.exit(any(row[3] for row in faults.table))


if __name__ == "__main__":
    main()
