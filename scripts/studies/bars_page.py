"""The bars of validation/baseline/speed_against_error.md: gem at Box2D's own error and at Box2D's own speed, out of windows.csv."""
import math
import random
import re
import textwrap

from measured import grouped, median, read, rms, table

KINDS = (("places", "places [m]"), ("force", "ice force, relative"))
JUDGED = ("Box2D 8/3 dt", "Box2D thin skin 8/3 dt")
FASTER, MORE_EXACT = 3.0, 10.0


def error_of(rows, kind):
    if kind == "places":
        return rms([float(r["all_rms_m"]) for r in rows])
    scale = rms([float(r["reference_ice_force_x_N"]) for r in rows])
    error = rms([float(r["ice_force_x_N"]) - float(r["reference_ice_force_x_N"]) for r in rows])
    return error / scale if scale > 0.0 else math.nan


def points_of(group, kind):
    """Setting -> (cost, error) over the windows in `group`."""
    return {setting: (median(rows, "wall_s_per_s"), error_of(rows, kind))
            for (setting,), rows in grouped(group, "setting").items() if not setting.startswith("reference")}


# Settings of gem with all options of the scene: all of them, those of the default iteration, and those that change its time step
# and threads alone.
STEP = r"(dt/\d|\d?dt)"
ALL = rf"gem( independent| gradient)? {STEP}( tolerance \de-\d| \d+ iterations)?( 2 threads)?"
SPLITTING = rf"gem {STEP}( tolerance \de-\d| \d+ iterations)?( 2 threads)?"
DEFAULT = rf"gem {STEP}( 2 threads)?"


def ratios(points, judged, allowed=ALL):
    """(speed at Box2D's error, error at Box2D's speed) of gem's settings that match `allowed`, as factors; NaN: none is there."""
    cost, error = points[judged]
    mine = [p for s, p in points.items() if re.fullmatch(allowed, s)]
    as_exact = [c for c, e in mine if e <= error]
    as_fast = [e for c, e in mine if c <= cost]
    return (cost / min(as_exact) if as_exact else math.nan,
            error / min(as_fast) if as_fast and min(as_fast) > 0.0 else math.nan)


def factor(value):
    return "none" if math.isnan(value) else f"{value:.3g}"


def met(value, low, bar):
    """By the value itself; whether the windows' scatter could undo it is said too."""
    if not value >= bar:
        return "missed"
    return "met" if math.isnan(low) or low >= bar else "met, not for all draws"


def with_interval(group, kind, judged):
    """Both ratios with 90 % intervals from windows drawn again, each with its verdict."""
    draw = random.Random(1)
    windows = [rows for _, rows in sorted(grouped(group, "window", "start_s").items())]
    again = []
    for _ in range(200 if len(windows) > 2 else 0):
        rows = [row for window in draw.choices(windows, k=len(windows)) for row in window]
        again.append(ratios(points_of(rows, kind), judged))
    cells = []
    for k, value in enumerate(ratios(points_of(group, kind), judged)):
        drawn = sorted(r[k] for r in again if not math.isnan(r[k]))
        text, low = factor(value), math.nan
        if not math.isnan(value) and len(drawn) >= 20:
            low = drawn[len(drawn) // 20]
            text += f" ({low:.3g} to {drawn[-1 - len(drawn) // 20]:.3g})"
        cells.append((text, met(value, low, (FASTER, MORE_EXACT)[k])))
    return cells


def usual_settings(regimes):
    body = []
    for regime, group in regimes:
        for kind, _ in KINDS:
            points = points_of(group, kind)
            for judged in JUDGED:
                if judged not in points or math.isnan(points[judged][1]):
                    continue
                faster, exact = with_interval(group, kind, judged)
                body.append([f"{regime}, {kind}", judged, *faster, *exact])
    return table(["regime, error of", "Box2D's setting", "times faster", "bar", "times more exact", "bar"], body)


def counts_of_rows(regimes):
    """In how many rows gem is faster at Box2D's own error, with all of its settings and with fewer."""
    lines = []
    for name, allowed in (("any setting of gem", ALL), ("`splitting` alone", SPLITTING),
                          ("the default's tolerance and iterations, any time step", DEFAULT)):
        factors = [ratios(points, s, allowed)[0] for _, group in regimes for kind, _ in KINDS for points in [points_of(group, kind)]
                   for s in points if s.startswith("Box2D") and not math.isnan(points[s][1])]
        lines += textwrap.wrap(f"- In all, with {name}: faster in {sum(f > 1.0 for f in factors)} of {len(factors)} rows, {FASTER:g} times "
                               f"faster in {sum(f >= FASTER for f in factors)}.", 125, subsequent_indent="  ")
    return lines


def all_settings(regimes):
    """Every setting of Box2D, and for each regime against how many of them gem meets the bars and which is the hardest."""
    body, lines = [], []
    for regime, group in regimes:
        points = {kind: points_of(group, kind) for kind, _ in KINDS}
        rivals = [s for s in points["places"] if s.startswith("Box2D")]
        found = {kind: {s: ratios(points[kind], s) for s in rivals} for kind, _ in KINDS}
        for kind, _ in KINDS:
            if all(math.isnan(error) for _, error in points[kind].values()):
                lines.append(f"- {regime}, {kind}: nothing pressed on the platform in these windows.")
                continue
            words = []
            for k, (what, bar) in enumerate((("faster", FASTER), ("more exact", MORE_EXACT))):
                values = {s: r[k] for s, r in found[kind].items()}
                hardest = min(values, key=lambda s: values[s] if values[s] == values[s] else -1.0)
                count = sum(v >= bar for v in values.values())
                least = "none" if math.isnan(values[hardest]) else f"{values[hardest]:.3g} times"
                words.append(f"{bar:g} times {what} against {count} of {len(values)} settings (hardest: {hardest}, {least})")
            lines += textwrap.wrap(f"- {regime}, {kind}: " + "; ".join(words) + ".", 125, subsequent_indent="  ")
        for s in rivals:
            cost, error = points["places"][s]
            force = points["force"][s][1]
            body.append([regime, s, f"{1e3 * cost:.3g}", f"{1e3 * error:.3g}", "" if math.isnan(force) else f"{100 * force:.3g}"]
                        + [factor(value) for kind, _ in KINDS for value in found[kind][s]])
    lines += counts_of_rows(regimes)
    return lines + [""] + table(["regime", "Box2D's setting", "wall, ms/s", "places [mm]", "force [%]", "faster (places)",
                                 "more exact (places)", "faster (force)", "more exact (force)"], body)


def bars():
    regimes = [(regime, group) for (regime,), group in grouped(read("windows.csv"), "regime").items()]
    if not regimes:
        return ["## gem at Box2D's own error and speed", "", "Not measured.", ""]
    counts = ", ".join(f"{regime} {len({(r['window'], r['start_s']) for r in group})} of {float(group[0]['window_s']):g} s"
                       for regime, group in regimes)
    return ["## gem at Box2D's own error and speed", "",
            f"Bars: at Box2D's own error {FASTER:g} times faster, at Box2D's own speed {MORE_EXACT:g} times more exact. From the windows of",
            "part B, which says where they were measured. Faster: Box2D's time over that of gem's cheapest setting whose error is no",
            "larger. More exact: Box2D's error over the least error of gem's settings that take no more time; \"none\": gem has no such",
            "setting, and the bar is missed. Settings that drop an option are left out; nothing is interpolated. The cheapest is chosen in the",
            "same windows, so chance favours gem a little; single windows decide some rows. Box2D has one thread,",
            "gem one or two, whichever serves it. In brackets: 90 % of draws of the windows, if there are three or more. Floes that gem left",
            "touching begin inside Box2D's usual skin, which pushes them apart: windows count that as its error. The reference is gem's own",
            "at a sixteenth of the time step.", "", f"Windows: {counts}.", ""
            ] + usual_settings(regimes) + ["Against every setting of Box2D:", ""] + all_settings(regimes)
