"""Makes runs fail and counts what is left: tried, survived, lost.

usage: python3 scripts/faults/faults.py GEM LIBRARY [--few | --short] [--tries N] [--only NAMES] [--seed N]

Without an option the whole round, which takes hours. --short: two minutes, for continuous integration: every call of a short run, several
processes, kills. --few: seconds, a few of each fault, as a test. --tries: how often each fault is tried; of the n-th calls every so manyth.
LIBRARY is gem_fail_nth (CMake builds it with the tests).

A run survives if it ends with exit code 0 and a complete file, or with exit code 4 or 7, a message, and no file or a file that `gem info`
reads, without rows of zeros. A killed run survives if it holds all but what came since its last flush (--flush-every and 1.5 s of wall time;
no file in its first seconds) and can go on from its checkpoint, if it had one. Exit code 1: something was lost; 77: no module h5py would check the rows.
"""
import argparse
import os
import random
import shutil
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
    length = parser.add_mutually_exclusive_group()
    length.add_argument("--few", action="store_true")
    length.add_argument("--short", action="store_true")
    parser.add_argument("--tries", type=int, default=0)
    parser.add_argument("--only", default="")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if h5py is None:
        print("skipped: no h5py (package python3-h5py)")
        sys.exit(77)
    random.seed(options.seed)
    # waiting for a disk is most of the time; the short round needs little room, so it stays in memory if there is some
    in_memory = options.short and os.path.isdir("/dev/shm") and shutil.disk_usage("/dev/shm").free > 1e9
    with tempfile.TemporaryDirectory(dir="/dev/shm" if in_memory else None) as folder:
        faults = Faults(options.gem, options.library, folder, options)
        for name in ("two_writers", "sweeps", "memory", "nth_calls", "disks", "power_cuts", "kills"):
            if options.short and not options.only and name in ("memory", "disks", "power_cuts"):
                continue
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
