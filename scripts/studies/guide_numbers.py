"""Runs the example of the user guide and writes its outputs and the sentences about them into the page.

usage: python3 scripts/studies guide_numbers GEM [--check] [--seeds]

--check   compares instead of writing; exit code 1 if a block differs
--seeds   also the sweep of six seeds in two channels (minutes); without it its blocks are left alone

A block of the page stands between <!-- made: NAME --> and <!-- end: NAME -->."""
import argparse
import difflib
import html
import pathlib
import re
import subprocess
import sys
import tempfile

from pages import ROOT

PAGE = ROOT / "gem" / "manual" / "user_guide.md"
CASES = ROOT / "cases"
# Lines that depend on the machine: they are not in the page.
OF_THE_MACHINE = ("wall time", "peak memory")
ANALYSED = ("verdict", "value", "x_offset_m", "x_deviation_m", "x_largest_m", "x_period_by_spectrum_s", "contact_fraction",
            "ice_force_x_mean_N", "ice_force_y_mean_N", "mooring_force_x_mean_N", "mooring_force_y_mean_N", "ice_force_window_largest_N",
            "mooring_force_largest_N")
OF_SEEDS = ("verdict", "mean", "most", "x_offset_m", "ice_force_x_mean_N", "ice_force_window_largest_N", "mooring_force_largest_N")


class Example:
    """The example's folder, where its commands run as the page writes them."""

    def __init__(self, gem, folder):
        self.gem, self.folder = pathlib.Path(gem).resolve(), folder

    def call(self, *words):
        done = subprocess.run([self.gem, *words], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              check=False)
        if done.returncode:
            sys.exit(f"gem {' '.join(words)}: exit code {done.returncode}\n{done.stderr}")
        return done.stderr, done.stdout


def shown(lines, names, indent="  "):
    """The first line, those that begin with one of `names`, and headings, with ... for what is left out."""
    kept, left_out = [], False
    for number, line in enumerate(lines):
        word = line.split()[0] if line.split() else ""
        if number == 0 or word in names or (line and not line.startswith(" ")):
            kept, left_out = kept + ([indent + "..."] if left_out else []) + [line], False
        else:
            left_out = True
    return kept


def code(*lines):
    return ["```", *lines, "```"]


def value_in(lines, name, column=1):
    return float(next(line for line in lines if line.split()[:1] == [name]).split()[column])


def force(newton):
    """Two digits, or whole units above 100, with the unit that fits."""
    size, unit = (newton / 1e6, "MN") if abs(newton) >= 1e6 else (newton / 1e3, "kN")
    return f"{size:.0f} {unit}" if abs(size) >= 100 else f"{float(f'{size:.2g}'):g} {unit}"


def check_block(example):
    lines = example.call("case", "check", "first.toml")[1].rstrip().splitlines()
    return code("$ gem case check first.toml", *(line for line in lines if not line.startswith("  case ")))


def run_block(example):
    said, result = example.call("run", "first.toml", "--engine", "cpu", "--threads", "2")
    lines = result.rstrip().splitlines() or said.rstrip().splitlines()
    ended = lines[next(k for k, line in enumerate(lines) if line.startswith("complete")):]
    return code("$ gem run first.toml", said.splitlines()[0], "...",
                *(line for line in ended if not line.strip().startswith(OF_THE_MACHINE)))


def analysis_blocks(example):
    lines = example.call("analyse", "first.h5")[1].rstrip().splitlines()
    last = next(k for k, line in enumerate(lines) if line.startswith("spells and gaps"))
    mean, mooring, window = (value_in(lines, name) for name in
                             ("ice_force_x_mean_N", "mooring_force_largest_N", "ice_force_window_largest_N"))
    offset, largest = value_in(lines, "x_offset_m"), value_in(lines, "x_largest_m")
    words = [f"So the ice pushes with {force(mean)} on the mean, the mooring holds against it, the barge stands "
             f"{100 * offset:.0f} cm off and swings up to {100 * largest:.0f} cm.",
             f"The largest mooring force is {force(mooring)}. The largest ice force averaged over 1 s is {force(window)}. "
             "Both are magnitudes in the plane."]
    return {"analyse": code("$ gem analyse first.h5", *shown(lines[:last], ANALYSED)), "loads": words}


def report_blocks(example):
    example.call("report", "first.h5", "--out", "first_report")
    page = (example.folder / "first_report" / "index.html").read_text(encoding="utf-8")
    table = page[page.index("Loads on the platform"):]
    cells = [tuple(html.unescape(re.sub("<[^>]*>", "", cell)) for cell in row) for row in
             re.findall(r"<tr><th[^>]*>(.*?)</th><td>(.*?)</td></tr>", table[:table.index("</table>")])]
    value = dict(cells)
    peak = value["force of one hit, largest"].split(" (")[0]
    lines = example.call("analyse", "first.h5")[1].splitlines()
    mooring, window = value_in(lines, "mooring_force_largest_N"), value_in(lines, "ice_force_window_largest_N")
    words = [f"So the answer to \"the largest load\" is: {force(mooring)} for the mooring lines together, {force(window)} for the "
             f"hull over 1 s,", f"{peak} for a few square metres of plate."]
    return {"report": ["| load | value |", "|---|---|", *(f"| {name} | {text} |" for name, text in cells)], "answer": words}


def sweep_block(example):
    """The first runs of the sweep, without their wall time."""
    listed = example.call("sweep", "list", "first_seeds.toml")[1].rstrip().splitlines()
    status = example.call("sweep", "status", "seeds")[1].rstrip().splitlines()
    begin, end = status[0].index("wall"), status[0].index("verdict")
    rows = [status[0], *(line[:begin] + "...".ljust(end - begin) + line[end:] for line in status[1:4])]
    said, done = example.call("sweep", "collect", "seeds", "--out", "seeds.nc.h5")
    return code("$ gem sweep list cases/first_seeds.toml", *listed[:3], "...", listed[-1],
                "$ gem sweep run cases/first_seeds.toml --out seeds", "$ gem sweep status seeds", *(row.rstrip() for row in rows), "...",
                status[-1], "$ gem sweep collect seeds --out seeds.nc.h5", (done or said).rstrip().splitlines()[-1])


def seeds_block(example):
    example.call("sweep", "run", "first_seeds.toml", "--out", "seeds", "--engine", "cpu")
    files = sorted(str(path.relative_to(example.folder)) for path in (example.folder / "seeds").glob("300_s*.h5"))
    lines = example.call("analyse", *files)[1].rstrip().splitlines()
    gumbel = lines[next(k for k, line in enumerate(lines) if line.startswith("largest of one exposure")):]
    name = "mooring_force_largest_N"
    words = [f"In 20 minutes of this ice the largest mooring force is most probably {force(value_in(gumbel, name))}. Nine of ten "
             f"such exposures stay below {force(value_in(gumbel, name, 2))}; the 95 % interval of that limit is "
             f"{force(value_in(gumbel, name, 3))} to {force(value_in(gumbel, name, 5))}. More seeds narrow it. Extremes need five "
             "runs of one length and one condition; other sets are refused."]
    last = next((k for k, line in enumerate(lines) if line.startswith("spells and gaps")), len(lines))
    return {"sweep": sweep_block(example), "seeds": code("$ gem analyse seeds/300_s*.h5", *shown(lines[:last], OF_SEEDS)), "exposure": words}


def blocks(example, seeds):
    made = {"check": check_block(example), "run": run_block(example)}
    made.update(analysis_blocks(example))
    made.update(report_blocks(example))
    if seeds:
        made.update(seeds_block(example))
    return made


def with_blocks(text, made):
    for name, lines in made.items():
        begin, end = f"<!-- made: {name} -->\n", f"<!-- end: {name} -->"
        if text.count(begin) != 1 or text.count(end) != 1:
            sys.exit(f"{PAGE.name}: the block '{name}' has no marks, or more than one pair")
        head, rest = text.split(begin, 1)
        text = head + begin + "\n".join(lines) + "\n" + end + rest.split(end, 1)[1]
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gem")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--seeds", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name in ("first.toml", "first_seeds.toml"):
            (folder / name).write_bytes((CASES / name).read_bytes())
        made = blocks(Example(options.gem, folder), options.seeds)
    before = PAGE.read_text(encoding="utf-8")
    after = with_blocks(before, made)
    if not options.check:
        PAGE.write_text(after, encoding="utf-8")
    elif before != after:
        sys.stdout.writelines(difflib.unified_diff(before.splitlines(True), after.splitlines(True), str(PAGE.name), "now"))
        sys.exit(f"{PAGE.name} is out of date (lines with + are new); write it anew: python3 scripts/studies guide_numbers GEM")


if __name__ == "__main__":
    main()
