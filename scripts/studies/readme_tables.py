"""Rewrites the tables of README.md and gem/manual/performance.md from the files under bench/results: no number is typed.

usage: python3 scripts/studies readme_tables

clean_root_run.txt, clean_root_test.txt   what scripts/run.sh and scripts/test.sh printed in a bare Debian 12 root
real_time_factor*.csv                     what scripts/studies real_time_factor wrote
cuda_*.csv                                what gem_cuda_speed printed
barriers_h200.csv                         what barriers cost with nothing between them; older than the rows of cuda_*.csv
scenes.csv                                what scripts/studies scene_bench wrote
speed_against_error/windows.csv           what scripts/studies measured (scripts/measure.sh)
"""
import csv
import glob
import math
import os
import re
import statistics

TOP = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
RESULTS = os.path.join(TOP, "bench", "results")
GPU_BATCHES = ("batch", "batch_recorded", "table1_recorded", "table1_twelfth_recorded", "growth")
NAMES = {1: "004_400_25", 2: "004_400_50", 27: "400_200_100"}


def phases(name):
    """(seconds, title) of each phase that a script listed at its end."""
    with open(os.path.join(RESULTS, name), encoding="utf-8") as file:
        text = file.read()
    return re.findall(r"^ +([\d.]+) s  (.+)$", text, re.MULTILINE)


def set_up_table():
    rows = ["| command | part | time, s |", "|---|---|---|"]
    for command, name in (("scripts/run.sh", "clean_root_run.txt"), ("scripts/test.sh", "clean_root_test.txt")):
        rows += [f"| `{command}` | {title} | {seconds} |" for seconds, title in phases(name)]
    return rows


def speed_table():
    rows = ["| run | threads | simulated, s | x real time | wall, s (fastest to slowest) | deepest overlap, mm | "
            "momentum, energy unexplained | memory, MB | state hash | processor | commit |", "|" + "---|" * 11]
    for path in sorted(glob.glob(os.path.join(RESULTS, "real_time_factor*.csv"))):
        with open(path, newline="", encoding="utf-8") as file:
            for r in csv.DictReader(file):
                rows.append(
                    f"| {NAMES.get(int(r['index']), r['index'])} | {r['threads']} | {float(r['time_s']):.0f} | "
                    f"{float(r['x_real_time']):.0f} | {float(r['median_wall_s']):.1f} "
                    f"({float(r['fastest_wall_s']):.1f} to {float(r['slowest_wall_s']):.1f}) | "
                    f"{1e3 * float(r['maximum_overlap_m']):.1f} | {float(r['residual_momentum']):.1e}, "
                    f"{float(r['residual_energy']):.1e} | {float(r['peak_memory_bytes']) / 1e6:.0f} | "
                    f"`{r['state_hash']}` | {r['processor']} | {r['commit'][:7]} |")
    return rows


def gpu_rows():
    """Of the layouts of one scene the fastest; of recorded batches and of growth the largest. The files hold the rest."""
    fastest, largest = {}, {}
    for path in sorted(glob.glob(os.path.join(RESULTS, "cuda_*.csv"))):
        with open(path, newline="", encoding="utf-8") as file:
            for r in csv.DictReader(file):
                key = r["resolution"], r["phase"]
                if r["measure"] != "moment":
                    kind = r["resolution"], r["measure"]
                    size = int(r["scenes"]) * (int(r["phase"].split()[0]) if r["measure"] == "growth" else 1)
                    if r["measure"] in GPU_BATCHES and size >= largest.get(kind, (0, None))[0]:
                        largest[kind] = size, r
                elif key not in fastest or float(r["microseconds_per_moment"]) < float(
                        fastest[key]["microseconds_per_moment"]):
                    fastest[key] = r
    return list(fastest.values()) + [row for _, row in largest.values()]


def barrier_costs():
    """Microseconds of one barrier by blocks and threads."""
    with open(os.path.join(RESULTS, "barriers_h200.csv"), newline="", encoding="utf-8") as file:
        return {(int(r["blocks"]), int(r["threads"])): float(r["microseconds"]) for r in csv.DictReader(file)}


def waiting(r, costs):
    """What the barriers of a time step of one scene cost with nothing between them [us]; empty for batches, whose blocks change."""
    if r["measure"] != "moment":
        return ""
    return f"{float(r['barriers']) * costs[int(r['blocks']), int(r['threads'])]:.1f}"


def gpu_table():
    rows = ["| contacts | what | scenes | route | blocks x threads | µs a time step | barriers alone, µs | "
            "x real time, all scenes | wall / device | state hash | device | commit |", "|" + "---|" * 12]
    costs = barrier_costs()
    for r in gpu_rows():
        what = r["phase"] if r["measure"] == "moment" else f"{r['measure'].replace('_', ', ')}, {r['phase']}"
        route = {"moments": "resident"}.get(r["launches"], r["launches"])
        rows.append(f"| {r['resolution']} | {what.replace('moments', 'time steps')} | {r['scenes']} | {route} | {r['blocks']} x {r['threads']} | "
                    f"{float(r['microseconds_per_moment']):.0f} | {waiting(r, costs)} | {float(r['x_real_time']):.0f} | "
                    f"{r['wall_over_device']} | `{r['state_hash']}` | {r['device']} | {r['commit'][:7]}{'-dirty' if 'dirty' in r['commit'] else ''} |")
    return rows


def scenes_table():
    """Moments without each feature against all of them, then over the number of floes."""
    with open(os.path.join(RESULTS, "scenes.csv"), newline="", encoding="utf-8") as file:
        scenes = list(csv.DictReader(file))
    everything = next(float(r["least_us"]) for r in scenes if r["scene"] == "feature/everything")
    rows = ["| time step | \u00b5s | of the whole | ns a floe | contacts | state hash |", "|" + "---|" * 6]
    for r in scenes:
        kind, name = r["scene"].split("/")
        share = f"{float(r['least_us']) / everything:.2f}" if kind == "feature" else ""
        per_floe = f"{float(r['ns_per_floe']):.0f}" if r["floes"] else ""
        title = name.replace("_", " ") if kind == "feature" else f"{name} floes"
        rows.append(f"| {title} | {float(r['least_us']):.0f} | {share} | {per_floe} | {float(r['contacts']):.0f} | "
                    f"`{r['state_hash']}` |")
    return rows


def root_of_mean_square(values):
    return math.sqrt(statistics.mean(value * value for value in values))


def window_row(regime, title, iteration, setting):
    """A setting of gem in the windows of one regime: speed beside the distance from a fine reference."""
    with open(os.path.join(RESULTS, "speed_against_error", "windows.csv"), newline="", encoding="utf-8") as file:
        windows = [r for r in csv.DictReader(file) if r["regime"] == regime and r["setting"] == setting]

    def of(name):
        return [float(r[name]) for r in windows]

    force = root_of_mean_square(a - b for a, b in zip(of("ice_force_x_N"), of("reference_ice_force_x_N")))
    return (f"| {title} | {iteration} | {1 / statistics.median(of('wall_s_per_s')):.3g} | "
            f"{1e3 * root_of_mean_square(of('all_rms_m')):.3g} | "
            f"{100 * force / root_of_mean_square(of('reference_ice_force_x_N')):.2g} | "
            f"{1e3 * max(of('overlap_maximum_m')):.2g} |")


def iterations_table():
    """Both iterations on a GPU: milliseconds of the device per simulated second of all scenes."""
    with open(os.path.join(RESULTS, "splitting", "cuda.csv"), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    cell = {(r["setting"], r["phase"], r["scenes"]): f"{float(r['ms_per_s']):.3g}" for r in rows}
    columns = [(phase, scenes) for phase in ("drift", "plug", "jam") for scenes in ("1", "4")]
    table = ["| iterations, time step | " + " | ".join(f"{phase}, {scenes} scene{'s' if scenes != '1' else ''}" for phase, scenes in columns) + " |",
             "|" + "---|" * 7]
    for setting in dict.fromkeys(r["setting"] for r in rows):
        table.append(f"| {setting} | " + " | ".join(cell[setting, phase, scenes] for phase, scenes in columns) + " |")
    return table + ["", f"{rows[0]['device']}, commit {rows[0]['commit'][:7]}{'-dirty' if 'dirty' in rows[0]['commit'] else ''}."]


def results_table():
    """Speed beside error."""
    rows = ["| ice | iteration, step | x real time | floes off, mm | force off, % | deepest overlap, mm |", "|" + "---|" * 6]
    for regime in ("drift", "plug", "jam"):
        for iteration, setting in (("splitting, 5 cm", "gem dt"), ("splitting, 10 cm", "gem 2dt"),
                                   ("splitting, 20 cm", "gem 4dt"), ("gradient, 5 cm", "gem gradient dt")):
            rows.append(window_row(regime, regime, iteration, f"{setting} 2 threads"))
    with open(os.path.join(RESULTS, "speed_against_error", "windows.csv"), newline="", encoding="utf-8") as file:
        commits = dict.fromkeys(row["commit"][:7] for row in csv.DictReader(file))
    return rows + ["", f"Two threads of a Xeon, commit {', '.join(commits)}."]


def rewrite(page, tables):
    path = os.path.join(TOP, page)
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for mark, rows in tables:
        begin, end = f"<!-- table: {mark} -->", "<!-- end of table -->"
        head, rest = text.split(begin, 1)
        text = head + begin + "\n" + "\n".join(rows) + "\n" + end + rest.split(end, 1)[1]
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def main():
    rewrite("README.md", [("results", results_table())])
    rewrite(os.path.join("gem", "manual", "performance.md"),
            [("set-up", set_up_table()), ("speed", speed_table()), ("gpu", gpu_table()), ("iterations", iterations_table()), ("scenes", scenes_table())])


if __name__ == "__main__":
    main()
