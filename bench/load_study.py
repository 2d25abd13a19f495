#!/usr/bin/env python3
"""Loads of run 1 by setting of the solver, over seeds: means, deviations, largest 0.2 s force, spectrum, crushing peaks.

Usage: load_study.py GEM FOLDER SEEDS [--speed U] SETTING...     runs what is not in FOLDER yet, and prints rows as CSV
U is another speed of the current [m/s]; the drift stays the same. A setting is iteration:iterations:tolerance:time_step,
e.g. splitting:192:1e-3:0.2. The last one is the reference.
Needs h5py and numpy.
"""
import os
import subprocess
import sys
import time

import h5py
import numpy

CASE = os.path.join(os.path.dirname(__file__), "..", "cases", "004_400_25.toml")
END_M, START_M, WINDOW_S = 300.0, 100.0, 0.2  # drift; before START_M little ice touches the barge
BAND_HZ, SEGMENT = (0.3, 1.0), 256
COLUMNS = ["mean_N", "sd_N", "largest_N", "largest_1s_N", "psd_N2_per_Hz", "peak_median_N", "peak_95_N", "hits", "wall_s"]


def run(gem, path, setting, seed, speed):
    """Runs one setting with one seed; the wall time stands beside the file [s]."""
    iteration, iterations, tolerance, step = setting.split(":")
    keys = {
        "contact.solver": "coupled", "numerics.iteration": iteration, "numerics.iterations_maximum": iterations,
        "numerics.residual_tolerance": tolerance, "numerics.time_step_s": step, "run.seed": seed,
        "current.velocity_m_per_s": f"[{speed},0.0]", "output.platform_interval_s": WINDOW_S,
        "output.floes_interval_s": START_M / speed,
    }
    words = [gem, "run", CASE, "--out", path + ".part", "--overwrite", "--until", str(END_M / speed), "--engine", "cpu",
             "--threads", "1", "--quiet"]
    for key, value in keys.items():
        words += ["--set", f"{key}={value}"]
    begin = time.monotonic()
    subprocess.run(words, check=True)
    with open(path + ".time", "w", encoding="ascii") as out:
        out.write(f"{time.monotonic() - begin:.1f}")
    os.rename(path + ".part", path)


def loads(path, speed):
    """The numbers of one run, in the order of COLUMNS."""
    with h5py.File(path) as f:
        times = f["platform/time"][:]
        force = f["platform/ice_impulse_x"][1:].astype(float) / WINDOW_S  # impulse since the last row
        peaks = f["events/force_peak"][:]
    force = force[times[1:] > START_M / speed]
    second = round(1.0 / WINDOW_S)
    hann = numpy.hanning(SEGMENT)
    segments = [force[i:i + SEGMENT] for i in range(0, len(force) - SEGMENT, SEGMENT // 2)]
    power = numpy.mean([abs(numpy.fft.rfft((s - s.mean()) * hann))**2 for s in segments], axis=0)
    frequency = numpy.fft.rfftfreq(SEGMENT, WINDOW_S)
    band = (frequency >= BAND_HZ[0]) & (frequency <= BAND_HZ[1])
    density = 2.0 * WINDOW_S / (hann**2).sum()
    with open(path + ".time", encoding="ascii") as text:
        wall = float(text.read())
    return [force.mean(), force.std(), force.max(), numpy.convolve(force, numpy.ones(second) / second, "valid").max(),
            density * power[band].mean(), numpy.median(peaks), numpy.percentile(peaks, 95), len(peaks), wall]


def main():
    gem, folder, seeds, settings, speed = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4:], 0.25
    if settings[0] == "--speed":
        speed, settings = float(settings[1]), settings[2:]
    rows = {}
    print("setting,seed," + ",".join(COLUMNS))
    for setting in settings:
        for seed in range(1, seeds + 1):
            path = os.path.join(folder, f"{setting.replace(':', '_')}_{seed}.h5")
            if not os.path.exists(path):
                run(gem, path, setting, seed, speed)
            rows[setting, seed] = loads(path, speed)
            print(f"{setting},{seed}," + ",".join(f"{x:.5g}" for x in rows[setting, seed]), flush=True)
    reference = numpy.array([rows[settings[-1], seed] for seed in range(1, seeds + 1)])
    for setting in settings[:-1]:
        one = numpy.array([rows[setting, seed] for seed in range(1, seeds + 1)])
        error = (one - reference).std(axis=0, ddof=1) / seeds**0.5 / reference.mean(axis=0)
        shares = one.mean(axis=0) / reference.mean(axis=0) - 1.0
        print(f"{setting}: " + ", ".join(f"{name} {100 * x:+.0f} +- {100 * e:.0f} %"
                                         for name, x, e in zip(COLUMNS, shares, error)), file=sys.stderr)


if __name__ == "__main__":
    main()
