"""Makes runs fail and counts what is left: tried, survived, lost.

usage: python3 scripts/faults/faults.py GEM LIBRARY [--short] [--only NAME] [--seed N]

LIBRARY is gem_fail_nth (CMake builds it with the tests). A run survives if it ends with exit code 0 and a complete file, or with exit
code 4 or 7, a message, and no file or a file that `gem info` reads, without rows of zeros. A killed run survives if its file is absent
or holds all but the last 5 s of wall time. Exit code 1: something was lost; 77: no module h5py would check the rows.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

try:
    import h5py
except ImportError:
    h5py = None

ROOT = pathlib.Path(__file__).resolve().parents[2]
SMALL = ROOT / "cases/analytic/V10_floe_on_moored_platform.toml"
LARGE = ROOT / "cases/004_400_25.toml"
SWEEP = ROOT / "cases/small_sweep.toml"
FLUSH_S = 5.0


def rows_fault(path):
    """What is wrong with the rows, read without gem, or None."""
    with h5py.File(path, "r", swmr=True) as file:
        for group in ("floes", "platform", "stats"):
            times = file[group]["time"][...]
            if (times[1:] <= times[:-1]).any():
                return f"{group}/time does not increase"
        frames = min(len(file["floes/time"]), len(file["floes/vx"]), len(file["floes/active"]))
        if len(file["shape/vertex_count"]) and frames and not file["floes/active"][:frames].any(axis=1).all():
            return "a frame of zeros"
        steps = file["stats/steps"][...]
        if (steps[1:] <= steps[:-1]).any():
            return "stats/steps does not increase"
    return None


def look(gem, path):
    """(description of the file or None, fault or None)"""
    if not os.path.exists(path):
        return None, None
    done = subprocess.run([gem, "info", path, "--json"], capture_output=True, text=True, timeout=60)
    if done.returncode != 0:
        return None, f"gem info: {done.stderr.strip()[:200]}"
    info = json.loads(done.stdout)
    try:
        fault = rows_fault(path)
    except (OSError, KeyError, RuntimeError) as error:
        fault = f"h5py: {error}"
    if fault is None and info["frames"] == 0:
        fault = "no frame"
    return info, fault


ended = ("complete", "stopped:until")  # as asked


def judge(gem, code, message, path):
    """None, or why the run is lost."""
    info, fault = look(gem, path)
    if fault:
        return fault
    if code == 0:
        return None if info and info["gem_status"] in ended else f"exit 0 but {info and info['gem_status']}"
    if code not in (4, 7):
        return f"exit {code} {message.strip()[-200:]}"
    if "gem: " not in message and "error" not in message:
        return f"exit {code} without a message"
    if info and info["gem_status"] in ended:
        return "exit %d but complete" % code
    return None


class Faults:
    def __init__(self, gem, library, folder, short):
        self.gem, self.library, self.folder, self.short = gem, library, folder, short
        self.table = []
        self.number = 0

    def path(self):
        self.number += 1
        return f"{self.folder}/run_{self.number}.h5"

    def report(self, what, faults):
        lost = [(what_of, fault) for what_of, fault in faults if fault]
        self.table.append((what, len(faults), len(faults) - len(lost), len(lost)))
        print(f"{what}: {len(faults)} tried, {len(lost)} lost", flush=True)
        for what_of, fault in lost[:20]:
            print(f"  {what_of}: {fault}", flush=True)

    def each(self, what, action, items):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            self.report(what, list(zip(items, pool.map(action, items))))

    # the n-th call fails

    def failing(self, call, nth, stays=False, count=None):
        path = self.path()
        settings = {"GEM_FAIL_CALL": call, "GEM_FAIL_NTH": str(nth), "GEM_FAIL_FOLDER": self.folder}
        if stays:
            settings["GEM_FAIL_STAYS"] = "1"
        if count:
            settings["GEM_FAIL_COUNT"] = count
        done = subprocess.run([self.gem, "run", SMALL, "--until", "5", "--engine", "cpu", "--threads", "2", "--quiet", "--out", path],
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
        # a failed malloc inside HDF5 may end in SIGSEGV, so the short round leaves it out
        calls_to_fail = ("pwrite", "write", "fsync", "open", "ftruncate") + (() if self.short else ("malloc",))
        for call in calls_to_fail:
            calls = self.count(call)
            most = 3000 if call == "malloc" else 20 if self.short else calls
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
                          sorted({*items[::2], *range(max(1, calls - 4), calls + 1)}))  # the last calls close the file

    # little memory

    def memory(self):
        limits = range(20000, 400000, 100000 if self.short else 10000)

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

    # kills and copies

    def kills(self):
        def one(after):
            path = self.path()
            start = time.time()
            run = subprocess.Popen([self.gem, "run", LARGE, "--until", "100000", "--engine", "cpu", "--threads", "1", "--quiet", "--out",
                                    path])
            time.sleep(after * 0.7)
            copy = path + ".copy.h5"
            if os.path.exists(path):
                shutil.copyfile(path, copy)
            time.sleep(after * 0.3)
            run.kill()
            run.wait()
            wall = time.time() - start
            for draft in pathlib.Path(self.folder).glob(f".{pathlib.Path(path).name}*"):
                draft.unlink()
            fault = None
            for name in (path, copy):
                info, fault = look(self.gem, name)
                if fault:
                    fault = f"{name}: {fault}"
                    break
                if name == path and info is None and wall > FLUSH_S:
                    fault = "no file"
                    break
                if name == path and info:
                    with h5py.File(path, "r", swmr=True) as file:
                        seen = file["stats/wall_time"][-1]
                    # one more second: the start of the process, and the time between two frames
                    if wall - seen > FLUSH_S + 1.5:
                        fault = f"{wall - seen:.1f} s of data lost"
                        break
            for name in (path, copy):
                if not fault and os.path.exists(name):
                    os.remove(name)
            return fault

        kills = 6 if self.short else 200
        self.each("kill -9 and a copy, at random moments", one, [random.uniform(0.05, 4.0 if self.short else 10.0) for _ in range(kills)])

    # power cuts

    def power_cuts(self):
        """Copies of a growing file, whole or cut at a random length. A whole copy is readable from the first second on; a cut one is read
        or refused with a message, and what is read or mended has no false rows."""
        path = self.path()
        tries = 8 if self.short else 300
        run = subprocess.Popen([self.gem, "run", LARGE, "--until", "1000000", "--engine", "cpu", "--threads", "1", "--force", "--quiet",
                                "--out", path])
        counts = {"read": 0, "mended": 0, "refused": 0}

        def answered(command):
            done = subprocess.run(command, capture_output=True, text=True, timeout=60)
            if done.returncode not in (0, 4) or (done.returncode == 4 and "gem: " not in done.stderr):
                return None, f"{command[1]}: exit {done.returncode} {done.stderr.strip()[-200:]}"
            return done.returncode == 0, None

        def cut(copy):
            os.truncate(copy, random.randint(0, os.path.getsize(copy)))
            read, fault = answered([self.gem, "info", copy, "--json"])
            mended = f"{copy}.mended.h5"
            done, fault_of_repair = answered([self.gem, "repair", copy, "--out", mended]) if not fault else (None, None)
            counts["mended" if os.path.exists(mended) else "read" if read else "refused"] += 1
            if os.path.exists(mended):
                found = look(self.gem, mended)[1]
                fault_of_repair = fault_of_repair or (None if found == "no frame" else found)  # cut before the first one
                os.remove(mended)
            return fault or fault_of_repair

        def one(turn):
            time.sleep(random.uniform(0.0, 0.2))
            copy = f"{path}.copy{turn}.h5"
            shutil.copyfile(path, copy)
            fault = look(self.gem, copy)[1]
            fault = fault or cut(copy)
            os.remove(copy)
            return fault

        try:
            while not os.path.exists(path):
                time.sleep(0.05)
            self.report("power cut: copies at random moments, then cut at a random length", [(turn, one(turn)) for turn in range(tries)])
            print("  of the cut copies: " + ", ".join(f"{count} {what}" for what, count in counts.items()), flush=True)
        finally:
            run.kill()
            run.wait()

    # disks

    def disks(self):
        def one(item):
            size, filled = item
            place = tempfile.mkdtemp(dir=self.folder)
            if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "none", place], capture_output=True).returncode != 0:
                return "no right to mount a disk"
            try:
                path = f"{place}/run.h5"
                run = subprocess.Popen([self.gem, "run", LARGE, "--until", "100000", "--engine", "cpu", "--threads", "1", "--force", "--quiet",
                                        "--out", path], stderr=subprocess.PIPE, text=True)
                if filled:
                    time.sleep(random.uniform(0.2, 4.0))
                    subprocess.run(["dd", "if=/dev/zero", f"of={place}/other", "bs=4k"], capture_output=True)
                try:
                    message = run.communicate(timeout=100)[1]
                except subprocess.TimeoutExpired:
                    run.kill()
                    return "does not end"
                return judge(self.gem, run.returncode, message, path)
            finally:
                subprocess.run(["umount", "-l", place], capture_output=True)

        disks = 4 if self.short else 100
        items = [(random.randint(1000, 16000), n % 2 == 1) for n in range(disks)]
        self.each("full disk, every second one filled by another process", one, items)

    # several processes

    def two_writers(self):
        def one(_):
            path = self.path()
            command = [self.gem, "run", SMALL, "--until", "5", "--quiet", "--overwrite", "--out", path]
            runs = [subprocess.Popen(command, stderr=subprocess.PIPE, text=True) for _ in range(2)]
            ends = [(run.communicate()[1], run.returncode) for run in runs]
            for message, code in ends:
                if code not in (0, 4):
                    return f"exit {code}: {message}"
            if all(code != 0 for _, code in ends):
                return "both refused"
            return judge(self.gem, 0, "", path)

        self.each("two writers on one file", one, list(range(4 if self.short else 40)))

    def sweeps(self):
        def hashes(folder):
            return {path.name: look(self.gem, str(path)) for path in pathlib.Path(folder).glob("*.h5")}

        command = [self.gem, "sweep", "run", SWEEP, "--quiet", "--threads", "1", "--out"]
        alone = f"{self.folder}/alone"
        subprocess.run([*command, alone], check=True, capture_output=True)
        wanted = {name: info["gem_state_hash"] for name, (info, _) in hashes(alone).items()}

        def one(n):
            folder = f"{self.folder}/sweep_{n}"
            runs = [subprocess.Popen([*command, folder], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True) for _ in
                    range(3)]
            for run in runs[:2]:
                time.sleep(random.uniform(0.0, 0.3))
                os.killpg(run.pid, signal.SIGKILL)
            for run in runs:
                run.wait()
            done = subprocess.run([*command, folder], capture_output=True, text=True)
            if done.returncode != 0:
                return f"exit {done.returncode}: {done.stderr[-200:]}"
            for name, (info, fault) in hashes(folder).items():
                if fault:
                    return f"{name}: {fault}"
                if wanted[name] != info["gem_state_hash"]:
                    return f"{name}: another hash"
            return None if len(hashes(folder)) == len(wanted) else "runs are missing"

        self.report("sweep by three processes, two killed", [(n, one(n)) for n in range(2 if self.short else 20)])


def can_mount(folder):
    """Root in a container may lack the right."""
    place = f"{folder}/probe"
    os.mkdir(place)
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=100k", "none", place], capture_output=True).returncode == 0
    if mounted:
        subprocess.run(["umount", "-l", place], capture_output=True)
    os.rmdir(place)
    return mounted


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("gem")
    parser.add_argument("library")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if h5py is None:
        print("skipped: no h5py (package python3-h5py)")
        sys.exit(77)
    random.seed(options.seed)
    with tempfile.TemporaryDirectory() as folder:
        faults = Faults(options.gem, options.library, folder, options.short)
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
