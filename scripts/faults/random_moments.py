"""Kills, power cuts and full disks, at random moments of a run."""
import itertools
import os
import pathlib
import random
import shutil
import subprocess
import tempfile
import time

from fault_runs import LARGE
from judge import h5py, judge, look


class RandomMoments:
    def kills(self):
        flush_s, longest_s = (0.2, 4.0) if self.short else (1.0, 4.0) if self.few else (4.0, 10.0)
        may_be_lost_s = flush_s + 1.5  # also the start of the process, and the time between two frames
        begins_file_s = may_be_lost_s + 1.0  # a run has a file after its first second

        def one(kill):
            after, checkpoint_s = kill
            path = self.path()
            start = time.time()
            run = subprocess.Popen([self.gem, "run", LARGE, "--until", "100000", "--engine", "cpu", "--threads", "1", "--quiet",
                                    "--flush-every", str(flush_s), "--checkpoint-every", str(checkpoint_s), "--out", path])
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
                if name == path and info is None and wall > begins_file_s:
                    fault = "no file"
                    break
                if name == path and info:
                    with h5py.File(path, "r", swmr=True) as file:
                        seen = file["stats/wall_time"][-1]
                    if wall - seen > may_be_lost_s:
                        fault = f"{wall - seen:.1f} s of data lost"
                        break
            fault = fault or self.cannot_go_on(path)
            for left in () if fault else pathlib.Path(self.folder).glob(pathlib.Path(path).name + "*"):
                left.unlink()
            return fault

        kills = self.count_of(200, 6, 100)
        # The longest is always there: only late kills show that a flush did not come. Every second run has frequent checkpoints, which are
        # then cut by the kill. They flush too, so the others have few.
        moments = [longest_s] + [random.uniform(0.05, longest_s) for _ in range(kills - 1)]
        self.each("kill -9 and a copy, at random moments", one, list(zip(moments, itertools.cycle((longest_s, flush_s)))))

    def cannot_go_on(self, path):
        """Why a killed run does not go on for a second of the simulation; None if it does, or was killed before its first checkpoint."""
        checkpoints = list(pathlib.Path(self.folder).glob(pathlib.Path(path).name + ".checkpoint-?"))
        if not checkpoints or not os.path.exists(path):
            return None
        with h5py.File(path, "r", swmr=True) as file:
            until = file["platform/time"][-1] + 1.0
        done = subprocess.run([self.gem, "run", "--continue", path, "--until", str(until), "--threads", "1", "--quiet"],
                              capture_output=True, text=True, timeout=120)
        return judge(self.gem, done.returncode, done.stderr, path) if done.returncode == 0 else f"--continue: {done.stderr.strip()[-300:]}"

    def power_cuts(self):
        """Copies of a growing file, whole or cut at a random length. A whole copy is readable from the first second on; a cut one is read
        or refused with a message, and what is read or mended has no false rows."""
        path = self.path()
        tries = self.count_of(300, 8)
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
                fill = ["dd", "if=/dev/zero", f"of={place}/other", "bs=4k"]
                if filled:
                    time.sleep(random.uniform(0.2, 4.0))
                    subprocess.run(fill, capture_output=True)
                try:
                    message = run.communicate(timeout=60)[1]
                except subprocess.TimeoutExpired:  # a slow machine has not filled the disk by itself
                    subprocess.run(fill, capture_output=True)
                    try:
                        message = run.communicate(timeout=60)[1]
                    except subprocess.TimeoutExpired:
                        run.kill()
                        return "does not end"
                return judge(self.gem, run.returncode, message, path)
            finally:
                subprocess.run(["umount", "-l", place], capture_output=True)

        disks = self.count_of(100, 4)
        items = [(random.randint(1000, 16000), n % 2 == 1) for n in range(disks)]
        self.each("full disk, every second one filled by another process", one, items)


def can_mount(folder):
    """Root in a container may lack the right."""
    place = f"{folder}/probe"
    os.mkdir(place)
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=100k", "none", place], capture_output=True).returncode == 0
    if mounted:
        subprocess.run(["umount", "-l", place], capture_output=True)
    os.rmdir(place)
    return mounted
