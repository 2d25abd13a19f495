"""Calls of the system that fail, and little memory."""
import os
import pathlib
import subprocess

from fault_runs import LARGE, SMALL
from judge import judge


class FailingCalls:
    def failing(self, call, nth, stays=False, count=None):
        path = self.path()
        settings = {"GEM_FAIL_CALL": call, "GEM_FAIL_NTH": str(nth), "GEM_FAIL_FOLDER": self.folder}
        if stays:
            settings["GEM_FAIL_STAYS"] = "1"
        if count:
            settings["GEM_FAIL_COUNT"] = count
        done = subprocess.run([self.gem, "run", SMALL, "--until", "2" if self.short else "5", "--engine", "cpu", "--threads", "2",
                               "--checkpoint-every", "1e-9", "--quiet", "--out", path],
                              env={**os.environ, "LD_PRELOAD": self.library, **settings}, capture_output=True, text=True,
                              timeout=120)
        return done.returncode, done.stderr, path

    def count(self, call):
        counter = f"{self.folder}/count"
        code, message, path = self.failing(call, 0, count=counter)
        assert code == 0, message
        os.remove(path)
        return int(pathlib.Path(counter).read_text())

    def nth_calls(self):
        # a failed malloc inside HDF5 may end in SIGSEGV, so only the whole round has it
        calls_to_fail = ("pwrite", "write", "fsync", "open", "ftruncate", "fallocate", "rename")
        if not (self.few or self.short or self.tries):
            calls_to_fail += ("malloc",)
        for call in calls_to_fail:
            calls = self.count(call)
            if calls == 0:  # HDF5 writes with other calls than before, or the library counts none: nothing would be tried
                self.report(f"{call}: call n fails", [(call, "the run never makes this call")])
                continue
            most = self.count_of(3000 if call == "malloc" else calls, 20)
            stride = max(1, -(-calls // most))

            def one(nth, call=call, stays=False):
                try:
                    code, message, path = self.failing(call, nth, stays)
                except subprocess.TimeoutExpired:
                    return "hangs"
                fault = judge(self.gem, code, message, path)
                if os.path.exists(path):
                    os.remove(path)
                return fault

            items = list(range(1, calls + 1, stride))
            note = f", every {stride}." if stride > 1 else ""
            self.each(f"{call}: call n fails (n to {calls}{note})", one, items)
            if call in ("pwrite", "fsync"):
                self.each(f"{call}: calls from n on fail", lambda nth, one=one: one(nth, stays=True),
                          sorted({*items[:: 10 if self.short else 2], *range(max(1, calls - 4), calls + 1)}))  # the last calls close the file

    def memory(self):
        limits = range(20000, 400000, 380000 // self.count_of(38, 4))

        def one(limit):
            path = self.path()
            done = subprocess.run(["bash", "-c", 'ulimit -v "$0"; exec "$@"', str(limit), self.gem, "run", LARGE, "--until", "20",
                                   "--engine", "cpu", "--threads", "2", "--force", "--quiet", "--out", path],
                                  capture_output=True, text=True, timeout=120)
            # below about 40 MB the program's libraries cannot be loaded: the loader ends with 127
            if done.returncode == 127 and "shared" in done.stderr and not os.path.exists(path):
                return None
            return judge(self.gem, done.returncode, done.stderr, path)

        self.each("ulimit -v, 20 to 400 MB", one, list(limits))
