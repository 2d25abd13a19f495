"""Kills runs at random instants, lets them go on, and compares them with a run that was never killed. Exit code 1: a difference.

usage: /usr/bin/python3 scripts/check_continue.py GEM CASE.toml [--kills N] [--sweep] [--seconds S] [--seed N] [-- OPTIONS OF GEM RUN]

Every run is killed (SIGKILL) at random instants until one process reaches the end. Some processes that go on are killed
too, and each one has another number of threads. A run that was killed before its first checkpoint begins again.
"""
import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import time

try:
    import h5py
    import numpy
except ImportError:
    h5py = None

WALL_CLOCK = ("wall_time", "sim_rate")  # datasets that tell of the machine
SAME = ("gem_state_hash", "gem_status", "gem_verdict", "gem_case_sha256")


def call(arguments):
    return subprocess.run(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)


def info(gem, path):
    return json.loads(call([gem, "info", path, "--json"]).stdout)


def difference(gem, whole, other):
    """The first difference of two run files, or None."""
    if h5py is None:
        a, b = info(gem, whole), info(gem, other)
        names = ("gem_state_hash", "gem_status", "frames", "platform_samples", "events", "verdict")
        return next((name for name in names if a[name] != b[name]), None)
    with h5py.File(whole, "r") as a, h5py.File(other, "r") as b:
        for name in SAME:
            if a.attrs[name] != b.attrs[name]:
                return f"{name}: {a.attrs[name]} and {b.attrs[name]}"
        for group in ("shape", "boundary", "floes", "platform", "events", "stats"):
            for name in a[group]:
                if name in WALL_CLOCK:
                    continue
                one, two = a[group][name][...], b[group][name][...]
                if one.shape != two.shape or one.tobytes() != two.tobytes():
                    return f"{group}/{name}: {one.shape} and {two.shape}"
    return None


class Killer:
    """Makes one run or one sweep with kills, and counts."""

    def __init__(self, gem, start, go_on, wall, chance):
        self.gem, self.start, self.go_on, self.wall, self.chance = gem, start, go_on, wall, chance
        self.kills = self.continued = self.begun_again = 0

    def run_for(self, arguments, seconds):
        """Runs the program; kills it after some time. Returns its exit code; None: it was killed."""
        with subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            try:
                _, errors = process.communicate(timeout=seconds)
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                self.kills += 1
                return None
        if process.returncode not in (0, 4):
            raise AssertionError(f"{' '.join(arguments)}: exit code {process.returncode}: {errors}")
        if process.returncode == 4 and "no checkpoint" not in errors and "no such file" not in errors:
            raise AssertionError(f"{' '.join(arguments)}: {errors}")
        return process.returncode

    def go(self, most_kills):
        """Makes the run to its end; kills it at most so many times."""
        arguments, left = self.start(), most_kills
        while True:
            instant = self.chance.uniform(0.02, self.wall) if left > 0 else None
            code = self.run_for(arguments, instant)
            if code == 0:
                return
            left -= code is None
            if code == 4:
                self.begun_again += 1
                arguments = self.start()
            else:
                self.continued += 1
                arguments = self.go_on()


def single(gem, case, options, chosen, folder, chance):
    threads = lambda: ["--threads", str(chance.choice((1, 2, 3)))] if "--engine" not in options else []
    whole, parts = f"{folder}/whole.h5", f"{folder}/parts.h5"
    begun = time.monotonic()
    subprocess.run([gem, "run", case, "-q", "--out", whole, "--checkpoint-every", "0", *options], check=True)
    wall = time.monotonic() - begun
    every = ["-q", "--checkpoint-every", "0.1"]
    kept = [word for k, word in enumerate(options) if "--engine" in (word, *options[k - 1:k])]
    killer = Killer(gem, lambda: [gem, "run", case, "--out", parts, "--overwrite", *every, *threads(), *options],
                    lambda: [gem, "run", "--continue", parts, *every, *threads(), *kept], wall, chance)
    while killer.kills < chosen.kills:
        killer.go(min(3, chosen.kills - killer.kills))
        found = difference(gem, whole, parts)
        if found:
            raise AssertionError(f"after {killer.kills} kills: {found}")
        assert not list(pathlib.Path(folder).glob("*checkpoint*")), "checkpoints are left behind"
    print(f"run of {wall:.1f} s: {killer.kills} kills, {killer.continued} times continued, {killer.begun_again} times begun "
          "again; same bits in state and rows")


def sweep(gem, path, options, chosen, folder, chance):
    whole, parts = f"{folder}/whole", f"{folder}/parts"
    begun = time.monotonic()
    subprocess.run([gem, "sweep", "run", path, "-q", "--out", whole, *options], check=True)
    wall = time.monotonic() - begun
    again = lambda: [gem, "sweep", "run", path, "-q", "--out", parts, "--checkpoint-every", "0.1", *options]
    killer = Killer(gem, again, again, wall, chance)
    continued = 0
    while killer.kills < chosen.kills:
        killer.go(min(5, chosen.kills - killer.kills))
        for file in sorted(pathlib.Path(whole).glob("*.h5")):
            found = difference(gem, str(file), f"{parts}/{file.name}")
            if found:
                raise AssertionError(f"after {killer.kills} kills: {file.name}: {found}")
            continued += info(gem, f"{parts}/{file.name}")["history"].count("\n")
        for file in pathlib.Path(parts).iterdir():
            file.unlink()
    print(f"sweep of {wall:.1f} s: {killer.kills} kills, {continued} times a run was continued; same bits in every run")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("gem")
    parser.add_argument("case")
    parser.add_argument("--kills", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--sweep", action="store_true")
    own, options = sys.argv[1:], []
    if "--" in own:
        own, options = own[:own.index("--")], own[own.index("--") + 1:]
    chosen = parser.parse_args(own)
    chance = random.Random(chosen.seed)
    with tempfile.TemporaryDirectory() as folder:
        (sweep if chosen.sweep else single)(chosen.gem, chosen.case, options, chosen, folder, chance)


if __name__ == "__main__":
    main()
