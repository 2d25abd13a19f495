"""Processor time of each thread of a program, from Linux: python3 scripts/faults/thread_times.py PROGRAM ARGUMENTS...

Prints one line: wall time, the time of the first thread, of the other threads in the order in which they began, and their sum [s].
The last tenth of a second of a thread may be missing.
"""

import os
import subprocess
import sys
import time


def times_of(process):
    """Nanoseconds of each thread that is there now, by its number."""
    found = {}
    folder = f"/proc/{process}/task"
    for thread in os.listdir(folder):
        try:
            with open(f"{folder}/{thread}/schedstat") as file:
                found[int(thread)] = int(file.read().split()[0])
        except (OSError, IndexError):
            continue  # the thread has ended
    return found


def main():
    begun = time.monotonic()
    program = subprocess.Popen(sys.argv[1:], stdout=subprocess.DEVNULL)
    times = {}
    while program.poll() is None:
        try:
            times.update(times_of(program.pid))
        except OSError:
            pass  # the program has ended
        time.sleep(0.05)
    wall = time.monotonic() - begun
    seconds = [1e-9 * times[thread] for thread in sorted(times)]
    print(f"wall {wall:.2f} threads", *(f"{value:.3f}" for value in seconds), f"sum {sum(seconds):.3f}")
    return program.returncode


sys.exit(main())
