"""Line and point charts as SVG files by gnuplot: one style for all measured figures."""
import math
import subprocess
import textwrap

COLOURS = {"gem": "#0b5394", "independent": "#6fa8dc", "Box2D": "#c55a11", "thin": "#e6a23c", "other": "#6a329f",
           "dropped": "#38761d", "reference": "#444444", "cuda": "#a61c00",
           "gem2": "#073763", "iterations": "#3d85c6", "independent2": "#45818e", "Box2D moment": "#783f04",
           "thin moment": "#bf9000", "tolerance": "#76a5af", "gradient": "#a64d79", "gradient iterations": "#741b47"}


FAMILIES = {"gem": "gem", "gradient": "gem gradient", "independent": "gem independent", "Box2D": "Box2D", "thin": "Box2D, thin skin", "other": "other",
            "dropped": "gem, an option dropped", "reference": "reference", "cuda": "gem on CUDA"}


def family_of(setting):
    """Key of a setting's family by its label: what figures tell apart."""
    if setting.startswith(("reference", "fine")):
        return "reference"
    if "CUDA" in setting:
        return "cuda"
    if setting.startswith("Box2D"):
        return "thin" if "thin skin" in setting or "slop" in setting else "Box2D"
    if "without" in setting or "locked" in setting:
        return "dropped"
    for family in ("independent", "gradient"):
        if family in setting:
            return family
    return "gem" if setting.startswith("gem") else "other"


def colour_of(setting):
    return COLOURS[family_of(setting)]


def quoted(text):
    return '"' + text.replace('"', "'") + '"'


class Panel:
    """One plot of a figure: curves are (label or None, colour, style, points), marks are vertical lines."""

    def __init__(self, title, x, y, log="xy"):
        self.title, self.x, self.y, self.log = title, x, y, log
        self.curves, self.marks, self.texts, self.extra = [], [], [], []
        self.key = "outside right top"

    def curve(self, label, colour, points, style="linespoints pt 7 ps 0.5 lw 1.5"):
        points = [p for p in points if all(v == v for v in p) and not ("y" in self.log and p[1] <= 0.0)
                  and not ("x" in self.log and p[0] <= 0.0)]
        if points:
            self.curves.append((label, colour, style, points))

    def mark(self, x, label):
        self.marks.append((x, label))

    def text(self, x, y, label, colour):
        """A label left of and below its point, where a Pareto front leaves room; left out where it would lie on another."""
        self.texts.append((x, y, label, colour))

    def x_range(self):
        """Logarithms of the ends of a logarithmic x axis that holds all points and marks, with room for labels on the left."""
        points = [point[0] for curve in self.curves for point in curve[3]]
        low, high = math.log10(min(points)), math.log10(max(points + [1.3 * x for x, _ in self.marks]))
        return (low - 0.25 * (high - low), high + 0.02 * (high - low)) if self.texts else (math.floor(low), math.ceil(high))

    def texts_with_room(self):
        points = [point[1] for curve in self.curves for point in curve[3]]
        height = math.log10(max(points) / min(points)) or 1.0
        width = self.x_range()[1] - self.x_range()[0]
        placed = []
        for x, y, label, colour in self.texts:
            room = 0.012 * len(label) * width
            if all(abs(math.log10(y / v)) > 0.06 * height or abs(math.log10(x / u)) > room for u, v in placed):
                placed.append((x, y))
                yield x, y, label, colour

    def script(self):
        gap = "\\n " if self.key.startswith("below") else ""  # between the axis and the key
        lines = ["reset", f"set title {quoted(self.title)} noenhanced font ',13'", f"set xlabel {quoted(self.x + gap)}",
                 f"set ylabel {quoted(self.y)}", "set grid lc rgb '#dddddd'", f"set key {self.key} samplen 3 spacing 1.1 noenhanced",
                 "set border 3", "set tics nomirror"]
        lines += [f"set logscale {axis}\nset format {axis} '10^{{%L}}'" for axis in self.log]
        lines += self.extra
        if "x" in self.log and self.curves:
            lines.append("set xrange [{:.6g}:{:.6g}]".format(*(10.0 ** end for end in self.x_range())))
        for x, label in self.marks:
            lines.append(f"set arrow from first {x:g}, graph 0 to first {x:g}, graph 1 nohead dt 2 lc rgb '#888888'")
            lines.append(f"set label {quoted(label)} at first {x:g}, graph 1 center offset 0,0.5 font ',8' noenhanced "
                         "tc rgb '#666666'")
        for x, y, label, colour in self.texts_with_room() if self.texts else ():
            lines.append(f"set label {quoted(label)} at first {x:g}, first {y:g} right offset -0.7,-0.4 font ',9' noenhanced "
                         f"tc rgb '{colour}'")
        parts, seen = [], {}
        for k, (label, colour, style, points) in enumerate(self.curves):
            if colour and label and " dt " not in style:  # curves of one family are told apart by their dashes
                seen[colour] = seen.get(colour, 0) + 1
                style += f" dt {seen[colour]}"
            lines.append(f"$d{k} << END")
            lines += [" ".join(f"{v:.9g}" for v in point) for point in points]
            lines.append("END")
            title = f"title {quoted(label)}" if label else "notitle"
            paint = f"lc rgb '{colour}' " if colour else ""
            parts.append(f"$d{k} with {style} {paint}{title}")
        return "\n".join(lines + ["plot " + ", \\\n  ".join(parts)]) if parts else ""


def write_figure(path, panels, columns=1, width=900, height=420, stamp=""):
    """One SVG with the panels that hold anything, row by row, and a line above them: by what and under which conditions it was
    measured. Returns whether there was any."""
    drawn = [script for script in (panel.script() for panel in panels) if script]
    if not drawn:
        return False
    rows = -(-len(drawn) // columns)
    above = "\\n".join(textwrap.wrap(stamp, width * columns // 6)).replace('"', "'")
    title = f' title "{above}" font \',9\' noenhanced' if stamp else ""
    head = (f"set terminal svg size {width * columns},{height * rows} font 'Helvetica,11' background '#ffffff' dynamic\n"
            f"set output {quoted(str(path))}\nset multiplot layout {rows},{columns}{title}\n")
    subprocess.run(["gnuplot"], input=head + "\n".join(drawn) + "\nunset multiplot\n", text=True, check=True)
    return True
