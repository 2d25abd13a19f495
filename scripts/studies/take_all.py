"""Takes what scripts/measure_all.sh made elsewhere: its tables become those of the pages, and the pages are made again.

usage: python3 scripts/studies take all.tar.gz
"""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile

import speed_against_error
from pages import ROOT


def study(*words):
    subprocess.run([sys.executable, ROOT / "scripts" / "studies", *words], check=False)


def take_scatter(packed):
    with tempfile.TemporaryDirectory() as folder, tarfile.open(packed) as tar:
        tar.extractall(folder)
        study("scatter36", folder)


def main():
    parser = argparse.ArgumentParser(prog="studies take", description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("archive", help="all.tar.gz of scripts/measure_all.sh")
    with tempfile.TemporaryDirectory() as folder, tarfile.open(parser.parse_args().archive) as tar:
        tar.extractall(folder)
        results = pathlib.Path(folder) / "results"
        print((results / "left.txt").read_text() or "all parts are finished", end="\n")
        speed_against_error.keep(results)
        if (results / "real_time_factor.csv").exists():
            shutil.copy(results / "real_time_factor.csv", ROOT / "bench" / "results")
        if (results / "hard_rows.csv").exists():
            study("hard", "--rows", str(results / "hard_rows.csv"))
        if (results / "scatter36.tar.xz").exists():
            take_scatter(results / "scatter36.tar.xz")
    study("speed_against_error")
    study("readme_tables")
