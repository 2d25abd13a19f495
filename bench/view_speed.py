"""Size and speed of the page of gem view, in Chromium without a GPU; a row for bench/results/view.csv on standard output.

usage: /usr/bin/python3 bench/view_speed.py GEM RUN.h5 >> bench/results/view.csv      (--head prints the names of the columns)
"""
import os
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scripts"))
import browser  # noqa: E402

COLUMNS = ("run", "floes", "frames", "page_MB", "pack_s", "first_picture_s", "all_read_s", "frames_per_s", "cpu_ms_per_frame",
           "processors", "load_average", "build")
PLAY_S = 6


def processor_seconds(group):
    """Processor time of all processes of a group."""
    ticks = 0
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{name}/stat", encoding="utf-8") as file:
                fields = file.read().rsplit(")", 1)[1].split()
        except OSError:
            continue
        if int(fields[2]) == group:
            ticks += int(fields[11]) + int(fields[12])
    return ticks / os.sysconf("SC_CLK_TCK")


def measured(gem, run):
    with tempfile.TemporaryDirectory() as folder, browser.Browser() as page:
        html = os.path.join(folder, "page.html")
        start = time.monotonic()
        subprocess.run([gem, "view", run, "--out", html], check=True, stdout=subprocess.DEVNULL)
        pack = time.monotonic() - start
        page.open("file://" + html)
        page.until("window.gemView && 1", 60)
        marks = dict(page.value("performance.getEntriesByType('mark').map(m => [m.name, m.startTime / 1000])"))
        page.value("gemView.player.speed = 200, gemView.player.seek(gemView.run.end / 3), gemView.player.play(true), 0")
        time.sleep(1)
        cpu, drawn, start = processor_seconds(page.process.pid), page.value("gemView.framesDrawn"), time.monotonic()
        time.sleep(PLAY_S)
        drawn = page.value("gemView.framesDrawn") - drawn
        seconds = time.monotonic() - start
        cpu = processor_seconds(page.process.pid) - cpu
        about = page.value("({name: gemView.run.description.name, floes: gemView.run.description.floes, "
                           "frames: gemView.run.frameCount})")
        version = subprocess.run([gem, "--version"], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
        return (about["name"], about["floes"], about["frames"], f"{os.path.getsize(html) / 1e6:.2f}", f"{pack:.2f}",
                f"{marks['first_picture']:.2f}", f"{marks['all_read']:.2f}", f"{drawn / seconds:.1f}",
                f"{1000 * cpu / drawn:.0f}", os.cpu_count(), f"{os.getloadavg()[0]:.1f}", '"' + version + '"')


print(",".join(map(str, COLUMNS if sys.argv[1] == "--head" else measured(*sys.argv[1:3]))))
