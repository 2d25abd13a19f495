"""What all faults share: the cases, the paths of their runs, the table of what was tried and lost."""
import concurrent.futures
import itertools
import os
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
SMALL = ROOT / "cases/analytic/V10_floe_on_moored_platform.toml"
LARGE = ROOT / "cases/004_400_25.toml"
SWEEP = ROOT / "cases/small_sweep.toml"


class FaultRuns:
    def __init__(self, gem, library, folder, options):
        self.gem, self.library, self.folder = gem, library, folder
        self.few, self.short, self.tries = options.few, options.short, options.tries
        self.table = []
        self.numbers = itertools.count(1)  # threads share it

    def count_of(self, usual, few, short=None):
        """How often a fault is tried: in the whole round, as a test, in continuous integration."""
        return self.tries or (few if self.few else (short or usual) if self.short else usual)

    def path(self):
        return f"{self.folder}/run_{next(self.numbers)}.h5"

    def report(self, what, faults):
        lost = [(what_of, fault) for what_of, fault in faults if fault]
        self.table.append((what, len(faults), len(faults) - len(lost), len(lost)))
        print(f"{what}: {len(faults)} tried, {len(lost)} lost", flush=True)
        for what_of, fault in lost[:20]:
            print(f"  {what_of}: {fault}", flush=True)

    def each(self, what, action, items):
        with concurrent.futures.ThreadPoolExecutor(max(2, os.cpu_count())) as pool:
            self.report(what, list(zip(items, pool.map(action, items))))
