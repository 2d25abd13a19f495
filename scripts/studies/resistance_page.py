"""Writes the generated part of validation/resistance.md, resistance.csv beside it and its figure from the folder of
cases/pack_ice_resistance.toml: resistance in pack ice over concentration, speed and thickness, beside published trends.

usage: python3 scripts/studies resistance FOLDER       or, as a test: python3 scripts/studies resistance --check GEM
"""
import argparse
import csv
import math
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

from chart import Panel, write_figure
from pages import ROOT, replace_generated, table_of

CASE = ROOT / "cases" / "pack_ice_resistance.toml"
PAGE = ROOT / "validation" / "resistance.md"
BEGIN, END = 150.0, 600.0  # of the path [m]: the whole ship is in the ice
BEAM, LENGTH, ICE, GRAVITY = 22.0, 110.0, 900.0, 9.81
STUDENT = {2: 12.706, 3: 4.303, 4: 3.182, 5: 2.776}  # 97.5 % quantile by the number of values


def colbourne(k, b, n):
    """R = C_p rho B h V^2 C^n / 2 with C_p = k Fr^b and Fr = V / sqrt(g h C)."""
    return lambda c, v, h: 0.5 * k * (v / math.sqrt(GRAVITY * h * c)) ** b * ICE * BEAM * h * v * v * c ** n


def huang(c, v, h):
    return 0.2 * ICE * BEAM * h * v * v * c ** 1.5 / (v / math.sqrt(GRAVITY * LENGTH))


def zuev(c, v, h):
    froude = v / math.sqrt(GRAVITY * h)
    return ICE * GRAVITY * BEAM * h * h * (0.13 * BEAM / h + 1.3 * froude + 0.5 * froude ** 2) * (2.0 - c) * c ** 2


# Label, resistance [N] by concentration, speed [m/s] and thickness [m], colour. Sources: the page.
PUBLISHED = [("slender hull (Colbourne's form)", colbourne(4.4, -0.8267, 2.0), "#c55a11"),
             ("blunt hull (Colbourne's form)", colbourne(16.1, -1.7937, 3.0), "#783f04"),
             ("Huang et al.", huang, "#6a329f"), ("Zuev", zuev, "#38761d")]
AXES = ("concentration", "speed", "thickness")


def measured(path):
    """Mean force of the ice against the course [N]: the ship goes along -x."""
    import h5py
    with h5py.File(path) as file:
        platform = file["platform"]
        way = -platform["x"][()]
        return float(platform["ice_force_x"][()][(way > BEGIN) & (way <= END)].mean())


def conditions(name):
    """Concentration, speed and thickness of a run by its name, and its seed."""
    c, v, h, seed = re.fullmatch(r"c(\d)_v([\d.]+)_h([\d.]+)_s(\d+)", name).groups()
    return 0.1 * int(c), float(v), float(h), int(seed)


def rows_of(folder):
    paths = sorted(folder.glob("c*_s*.h5"))
    if not paths:
        sys.exit(f"no runs in {folder} run: gem sweep run {CASE.relative_to(ROOT)} -o {folder}")
    return [(*conditions(path.stem), measured(path)) for path in paths]


def series(rows, axis, others):
    """Resistances by seed over one of the conditions, the other two fixed: {seed: [(value, R)]}."""
    out = {}
    for row in rows:
        if all(abs(row[k] - value) < 1e-9 for k, value in others.items()):
            out.setdefault(row[3], []).append((row[axis], row[4]))
    return {seed: sorted(points) for seed, points in out.items()}


def slope(points):
    """Exponent of a power law by least squares of the logarithms."""
    x, y = [math.log(p[0]) for p in points], [math.log(p[1]) for p in points]
    mx, my = statistics.mean(x), statistics.mean(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def coefficient(c, v, h, force, power=2.0):
    """C_p of Colbourne's form and its Froude number."""
    return v / math.sqrt(GRAVITY * h * c), force / (0.5 * ICE * BEAM * h * v * v * c ** power)


def interval(values):
    """Mean and half width of its 95 % interval."""
    return statistics.mean(values), STUDENT[len(values)] * statistics.stdev(values) / math.sqrt(len(values))


def exponent(rows, axis, others):
    """Of the ice fields: each gives an exponent."""
    return interval([slope(points) for points in series(rows, axis, others).values()])


def froude_exponent(rows):
    """Exponent b of C_p = k Fr^b, fitted to all runs of an ice field together with n."""
    import numpy
    powers = []
    for seed in sorted({row[3] for row in rows}):
        mine = [row for row in rows if row[3] == seed]
        terms = [(1.0, math.log(coefficient(c, v, h, force)[0]), math.log(c)) for c, v, h, _, force in mine]
        known = [math.log(coefficient(c, v, h, force, 0.0)[1]) for c, v, h, _, force in mine]
        powers.append(float(numpy.linalg.lstsq(numpy.array(terms), numpy.array(known), rcond=None)[0][1]))
    return interval(powers)


def published_exponent(law, axis, others, values):
    def at(value):
        state = {axis: value, **others}
        return law(state[0], state[1], state[2])
    return slope([(value, at(value)) for value in values])


TRENDS = [("concentration, 3/10 to 8/10", 0, {1: 2.0, 2: 0.7}), ("speed at 5/10", 1, {0: 0.5, 2: 0.7}),
          ("speed at 8/10", 1, {0: 0.8, 2: 0.7}), ("thickness at 5/10", 2, {0: 0.5, 1: 2.0}),
          ("thickness at 8/10", 2, {0: 0.8, 1: 2.0})]


def values_of(rows, axis, others):
    return [point[0] for point in next(iter(series(rows, axis, others).values()))]


def exponent_table(rows):
    lines = []
    for label, axis, others in TRENDS:
        value, half = exponent(rows, axis, others)
        law = [f"{published_exponent(one, axis, others, values_of(rows, axis, others)):.2f}" for _, one, _ in PUBLISHED]
        lines.append([label, f"{value:.2f} ± {half:.2f}", *law])
    lines.append(["pack-ice Froude number, all runs", "{:.2f} ± {:.2f}".format(*froude_exponent(rows)), "-0.83", "-1.79", "-", "-"])
    return table_of(["exponent of", "gem, 95 % interval", *(label for label, _, _ in PUBLISHED)], lines)


def grouped(rows):
    groups = {}
    for c, v, h, _, force in rows:
        groups.setdefault((c, v, h), []).append(force)
    return sorted(groups.items())


def resistance_table(rows):
    lines = []
    for (c, v, h), forces in grouped(rows):
        mean, half = interval(forces)
        lines.append([f"{10 * c:.0f}/10", f"{v:g}", f"{h:g}", f"{1e-3 * mean:.0f} ± {1e-3 * half:.0f}",
                      *(f"{1e-3 * law(c, v, h):.0f}" for _, law, _ in PUBLISHED)])
    return table_of(["concentration", "speed m/s", "thickness m", "gem kN", *(f"{label} kN" for label, _, _ in PUBLISHED)], lines)


def set_axes(panel, values, key):
    """Logarithmic, with the values as marks of the x axis."""
    panel.extra = ["unset format x", "unset format y", f"set xtics ({', '.join(f'{value:g}' for value in values)})"]
    panel.x_range = lambda: (math.log10(0.9 * values[0]), math.log10(1.1 * values[-1]))
    panel.key = key


def panels(rows):
    out = []
    for axis, others, title, x in ((0, {1: 2.0, 2: 0.7}, "Concentration (2 m/s, 0.7 m)", "concentration [-]"),
                                   (1, {0: 0.5, 2: 0.7}, "Speed (5/10, 0.7 m)", "speed [m/s]"),
                                   (2, {0: 0.5, 1: 2.0}, "Thickness (5/10, 2 m/s)", "thickness [m]")):
        panel = Panel(title, x, "resistance [kN]")
        points = [(p[0], 1e-3 * p[1]) for seed in series(rows, axis, others).values() for p in seed]
        panel.curve("gem, each run", "#0b5394", points, "points pt 7 ps 0.5")
        values = values_of(rows, axis, others)
        for label, law, colour in PUBLISHED:
            grid = [values[0] * (values[-1] / values[0]) ** (k / 40) for k in range(41)]
            state = [{axis: value, **others} for value in grid]
            panel.curve(label, colour, [(s[axis], 1e-3 * law(s[0], s[1], s[2])) for s in state], "lines lw 1.5")
        set_axes(panel, values, "left top" if axis == 2 else "right bottom")
        out.append(panel)
    panel = Panel("Coefficient of Colbourne's form, n = 2", "pack-ice Froude number V / sqrt(g h C)", "2 R / (rho B h V^2 C^2)")
    panel.curve("gem, each run", "#0b5394", [coefficient(c, v, h, force) for c, v, h, _, force in rows], "points pt 7 ps 0.5")
    panel.curve("slender hull: 4.4 Fr^-0.83", "#c55a11", [(0.25 * 2.0 ** k, 4.4 * (0.25 * 2.0 ** k) ** -0.8267) for k in range(4)],
                "lines lw 1.5")
    set_axes(panel, [0.25, 0.5, 1.0, 2.0], "right top")
    return [*out, panel]


def write_page(rows):
    with open(PAGE.with_suffix(".csv"), "w", newline="", encoding="ascii") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["concentration", "speed_m_per_s", "thickness_m", "seed", "resistance_N"])
        out.writerows([f"{c:.1f}", f"{v:g}", f"{h:g}", seed, f"{force:.1f}"] for c, v, h, seed, force in rows)
    write_figure(PAGE.with_suffix(".svg"), panels(rows), 2, 560, 420)
    replace_generated(PAGE, "resistance", [*exponent_table(rows), "", "![Resistance over concentration, speed and thickness beside published trends](resistance.svg)",
                                           "", *resistance_table(rows)])


# The test: one exponent each from two runs with one ice field. Its scatter over the five fields of the page is up to 0.5
# in concentration, 0.3 in speed and 0.2 in thickness.
CHECKED = [("concentration", 0, "c3_v2.0_h0.7_s1", "c5_v2.0_h0.7_s1", 0.5, 2.5), ("speed", 1, "c5_v1.0_h0.7_s1", "c5_v2.0_h0.7_s1", 1.7, 2.3),
           ("thickness", 2, "c5_v2.0_h0.35_s1", "c5_v2.0_h0.7_s1", 0.8, 1.4)]


def check(gem):
    try:
        import h5py  # noqa: F401
    except ImportError:
        print("skipped: no h5py (package python3-h5py)")
        sys.exit(77)
    listed = subprocess.run([gem, "sweep", "list", CASE], check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    number = {line.split()[1]: line.split()[0] for line in listed.stdout.splitlines()[1:]}
    names = sorted({name for one in CHECKED for name in one[2:4]})
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([gem, "sweep", "run", CASE, "--out", folder, "--engine", "cpu", "--quiet", "--index",
                        ",".join(number[name] for name in names)], check=True)
        force = {name: measured(pathlib.Path(folder) / f"{name}.h5") for name in names}
    failed = False
    for label, axis, low, high, least, most in CHECKED:
        value = slope([(conditions(name)[axis], force[name]) for name in (low, high)])
        failed = failed or not least < value < most
        print(f"exponent of {label}: {value:.2f}, wanted {least} to {most}")
    sys.exit(1 if failed else 0)


def main():
    parser = argparse.ArgumentParser(prog="studies resistance", description=__doc__.split("\n\n")[0])
    parser.add_argument("folder", nargs="?", type=pathlib.Path, help="of gem sweep run cases/pack_ice_resistance.toml")
    parser.add_argument("--check", metavar="GEM", help="make four of the runs and compare their exponents with bounds")
    arguments = parser.parse_args()
    if arguments.check:
        check(arguments.check)
    if not arguments.folder:
        parser.error("FOLDER or --check GEM is needed")
    write_page(rows_of(arguments.folder))


if __name__ == "__main__":
    main()
