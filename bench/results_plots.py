# SPDX-License-Identifier: MIT
"""Plots of the reports of `zvo-bench baselines`, drawn by gnuplot: scripts with their data, and SVG files of them."""

import hashlib
import html
import math
import re
import shutil
import subprocess
from dataclasses import dataclass, field

from results_report import in_order, is_wall, median, number, zvo_ms

WIDTH = 1000
HEAD, FOOT_LINE = 58, 20  # above all panels, and for each line of the legend below them
LEFT, RIGHT, ABOVE, BELOW = 62, 14, 24, 54  # around a panel
PANEL_HEIGHT = 170
PANELS_MAX = 3  # in a row
BAR_HEIGHT = 17
BAR_NAMES = 252  # for the names of bars, left of the first panel
TICKS_MIN = 3
LEGEND_COLUMN = 240

# By the first word of a source or form; colours that color-blind people tell apart (M. Okabe and K. Ito, 2008).
COLORS = {"zvo": "#0072b2", "thesis": "#d55e00", "crassin": "#cc79a7", "slides": "#009e73", "embree": "#666666",
          "dda": "#8a6d00", "hash": "#e69f00"}
OTHER_COLOR = "#333333"
# gnuplot's numbers; one less is the same mark, hollow.
MARKS = {"zvo": 7, "thesis": 5, "crassin": 9, "slides": 11, "embree": 13, "dda": 15, "hash": 13}
SCENE_MARKS = [7, 5, 9, 11, 13, 15, 6, 4, 8, 10]
# What rows of panels have; the words that a source implies are left out of the names of lines.
ENDS = ["voxelize", "build", "voxelize and build", "DAG"]
IMPLIED = {"bottom-up", "top-down"}
UPDATE_ENDS = ["update: voxelize", "update: merge", "update"]


@dataclass
class Line:
    name: str
    points: list
    is_dashed: bool = False
    mark: int = 0  # 0: of the name's first word

    def word(self):
        return first_word(self.name)

    def style(self):
        word = self.word()
        mark = self.mark or MARKS.get(word, 7) - self.is_dashed
        width = 2.4 if word == "zvo" else 1.6
        dash = "(7,4)" if self.is_dashed else "1"
        return f"lw {width} dt {dash} pt {mark} ps 0.7 lc rgb '{COLORS.get(word, OTHER_COLOR)}'"


@dataclass
class Panel:
    title: str
    lines: list
    x_name: str = ""
    y_name: str = ""
    x_ticks: list = field(default_factory=list)


def first_word(name):
    return re.split(r"[\W_]+", name.lower())[0]


def quoted(text):
    return "'" + text.replace("'", "''") + "'"


def log_range(values):
    """The ends of a logarithmic axis, and its marks: powers of ten, with 2 and 5 between them if they are few."""
    low, high = min(values), max(values)
    low, high = low / 1.25, high * 1.25
    marks = []
    for steps in ([1], [1, 2, 5], [1, 1.5, 2, 3, 5, 7]):
        marks = [step * 10.0 ** power for power in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
                 for step in steps if low <= step * 10.0 ** power <= high]
        if len(marks) >= TICKS_MIN:
            break
    return low, high, marks


def ticks(values):
    return "(" + ", ".join(f"{quoted(axis_number(value))} {value:g}" for value in values) + ")"


def axis_number(value):
    if value >= 1e6:
        return f"{value / 1e6:g} M"
    return f"{value:,.0f}" if value >= 1 and value == int(value) else f"{value:g}"


def page_head(title, caption, width, height):
    return [f"set term svg noenhanced size {width},{height} font 'sans-serif,12' background '#ffffff'",
            "set multiplot",
            f"set label 1 {quoted(title)} at screen {12 / width:.5f},{1 - 22 / height:.5f} left font 'sans-serif,16'",
            f"set label 2 {quoted(caption)} at screen {12 / width:.5f},{1 - 41 / height:.5f} left tc rgb '#444444'",
            "set tics nomirror scale 0.5", "set grid lt 1 lw 0.5 lc rgb '#dddddd'",
            "set border 3 lw 0.8 lc rgb '#555555'", "unset key"]


def place(width, height, left, right, top, bottom):
    return (f"set lmargin at screen {left / width:.5f}; set rmargin at screen {right / width:.5f}; "
            f"set tmargin at screen {1 - top / height:.5f}; set bmargin at screen {1 - bottom / height:.5f}")


def line_plot(title, caption, rows, legend):
    """A gnuplot script of panels in rows. The panels of a row share their y axis. legend: lines without points."""
    columns = max(len(row) for row in rows)
    per_line = WIDTH // LEGEND_COLUMN
    named = [line for line in legend if line.points]
    legend = named + [None] * (-len(named) % per_line) + [line for line in legend if not line.points]
    foot = 14 + FOOT_LINE * math.ceil(len(legend) / per_line)
    height = HEAD + len(rows) * (ABOVE + PANEL_HEIGHT + BELOW) + foot
    script = page_head(title, caption, WIDTH, height)
    cell = (WIDTH - 8) / columns
    blocks = 0
    for row_number, row in enumerate(rows):
        top = HEAD + row_number * (ABOVE + PANEL_HEIGHT + BELOW) + ABOVE
        y_low, y_high, y_marks = log_range([y for panel in row for line in panel.lines for _, y in line.points])
        for column, panel in enumerate(row):
            left = column * cell + LEFT
            script.append(place(WIDTH, height, left, column * cell + cell - RIGHT, top, top + PANEL_HEIGHT))
            xs = [x for line in panel.lines for x, _ in line.points]
            x_low, x_high, x_marks = log_range(xs)
            plots = []
            for line in panel.lines:
                script += [f"$d{blocks} << E"] + [f"{x:g} {y:.6g}" for x, y in line.points] + ["E"]
                plots.append(f"$d{blocks} using 1:2 with linespoints {line.style()} notitle")
                blocks += 1
            script += [f"set title {quoted(panel.title)} offset 0,-0.7", "set logscale xy",
                       f"set xrange [{x_low:g}:{x_high:g}]", f"set yrange [{y_low:g}:{y_high:g}]",
                       f"set xtics {ticks(panel.x_ticks or x_marks)}", f"set ytics {ticks(y_marks)}",
                       f"set xlabel {quoted(panel.x_name)} offset 0,0.4",
                       f"set label 3 {quoted(panel.y_name if column == 0 else '')} at screen {14 / WIDTH:.5f},"
                       f"{1 - (top + PANEL_HEIGHT / 2) / height:.5f} center rotate",
                       "plot " + ", ".join(plots), "unset label"]
    # The legend is a plot of nothing, as gnuplot draws samples of lines in keys alone.
    script += ["unset border; unset tics; unset grid; unset title; unset xlabel; unset logscale",
               "set xrange [0:1]; set yrange [0:1]"]
    for number_of, line in enumerate(legend):
        if line is None:
            continue
        x = 40 + (number_of % per_line) * LEGEND_COLUMN
        y = foot - 14 - FOOT_LINE * (number_of // per_line)
        script += [place(WIDTH, height, 0, WIDTH, 0, height),
                   f"set key at screen {x / WIDTH:.5f},{y / height:.5f} left center Left reverse samplen 3 width 0",
                   f"plot NaN with {'linespoints' if line.points else 'points'} {line.style()} "
                   f"title {quoted(line.name)}"]
    return "\n".join(script + ["unset multiplot"]) + "\n"


def bar_plot(title, caption, panels, names, x_name):
    """A gnuplot script of bars that lie, panels side by side. panels: (title, {name: (value, colour)})."""
    height = HEAD + ABOVE + BAR_HEIGHT * len(names) + BELOW
    script = page_head(title, caption, WIDTH, height)
    cell = (WIDTH - BAR_NAMES - 8) / len(panels)
    most = max(value for _, bars in panels for value, _ in bars.values())
    script += ["set style fill solid 1.0 noborder", "set grid noy", "set ytics scale 0",
               f"set yrange [{len(names) - 0.4:g}:-0.6]", f"set xlabel {quoted(x_name)} offset 0,0.4"]
    for column, (panel_title, bars) in enumerate(panels):
        left = BAR_NAMES + column * cell
        script.append(place(WIDTH, height, left + 6, left + cell - 12, HEAD + ABOVE, height - BELOW))
        data = [f"{value:.6g} {names.index(name)} {color} {number(value).replace(',', '')}"
                for name, (value, color) in bars.items()]
        labels = ", ".join(f"{quoted(name)} {place_of}" for place_of, name in enumerate(names))
        script += [f"$d{column} << E"] + data + ["E"]
        script += [f"set title {quoted(panel_title)} offset 0,-0.7", f"set xrange [0:{most * 1.22:g}]",
                   f"set ytics ({labels})" if column == 0 else "unset ytics",
                   f"set xtics {step_of(most):g}",
                   f"plot $d{column} using (0):2:(0):1:($2-0.36):($2+0.36):3 with boxxyerror lc rgb variable, "
                   f"$d{column} using 1:2:4 with labels left offset 0.4,0 font 'sans-serif,10'", "unset label"]
    return "\n".join(script + ["unset multiplot"]) + "\n"


def step_of(most):
    """The distance of marks on an axis from 0 to most: about four of them."""
    power = 10.0 ** math.floor(math.log10(most / 4))
    return next(step * power for step in (1, 2, 2.5, 5, 10) if step * power >= most / 4 * 0.999)


# What is drawn of a report.

def line_of(row):
    """The end of a row's work, and the name of its line, less the words that the source implies."""
    end, *variant = row["work"].split(", ")
    words = [word for word in variant if word not in IMPLIED]
    return end, ", ".join([row["source"]] + words)


def zvo_line_of(row):
    return "zvo, DAG" if row["work"].endswith(", DAG") else "zvo"


def builder_lines(report, scene, end, x_of, mark=0):
    """The lines of a scene: zvo's first, then a line for each source and variant. x_of: where a row stands."""
    points = {}
    for row in report.select(scene=scene):
        if line_of(row)[0] == end and median(row, "baseline_ms") and median(row, "zvo_ms"):
            points.setdefault(zvo_line_of(row), {}).setdefault(x_of(row), []).append(row)
            points.setdefault(line_of(row)[1], {}).setdefault(x_of(row), []).append(row)
    lines = []
    for name in sorted(points, key=lambda name: not name.startswith("zvo")):
        values = [(x, zvo_ms(rows) if name.startswith("zvo") else median(rows[0], "baseline_ms"))
                  for x, rows in sorted(points[name].items()) if x]
        if values:
            lines.append(Line(name, values, "," in name and not name.startswith("Crassin"), mark))
    return lines


def legend_of(rows, marks=None):
    """Each name once, those of a source together; with marks, the scenes as well."""
    lines = {}
    for row in rows:
        for panel in row:
            for line in panel.lines:
                lines.setdefault(line.name, Line(line.name, [(0, 0)], line.is_dashed, -1 if marks else 0))
    words = list(COLORS)
    named = sorted(lines.values(), key=lambda line: words.index(line.word()) if line.word() in words else len(words))
    return named + [Line(scene, [], mark=mark) for scene, mark in (marks or {}).items()]


def plot_time(report, caption):
    scenes = [scene for scene in report.first_scenes
              if not any(row.get("moving_voxels") for row in report.select(scene=scene))] or report.first_scenes
    rows = []
    for end in ENDS:
        panels = [Panel(f"{scene}: {end}", builder_lines(report, scene, end, lambda row: row["resolution"]),
                        "voxels along an edge of the grid", "ms", report.resolutions) for scene in scenes[:PANELS_MAX]]
        rows.append([panel for panel in panels if panel.lines])
    rows = [row for row in rows if row]
    return line_plot("Time over resolution", caption, rows, legend_of(rows)) if rows else None


def plot_voxels(report, caption):
    return plot_over(report, caption, "Time over voxels, scene by scene", ENDS, "voxels", "voxels of the scene")


def plot_update(report, caption):
    return plot_over(report, caption, "Update of moving objects over their voxels", UPDATE_ENDS, "moving_voxels",
                     "voxels that move")


def plot_over(report, caption, title, ends, key, x_name):
    """A panel for each end, with the lines of all scenes."""
    marks = dict(zip(report.scenes, SCENE_MARKS * len(report.scenes)))
    panels, shown = [], set()
    for end in ends:
        lines = []
        for scene, mark in marks.items():
            more = builder_lines(report, scene, end, lambda row: row.get(key), mark)
            shown |= {scene} if more else set()
            lines += more
        if lines:
            panels.append(Panel(end, lines, x_name, "ms"))
    if not panels:
        return None
    per_row = 2 if len(panels) == 4 else 3
    rows = [panels[first:first + per_row] for first in range(0, len(panels), per_row)]
    return line_plot(title, caption, rows,
                     legend_of(rows, {scene: mark for scene, mark in marks.items() if scene in shown}))


def plot_bytes(report, caption):
    panels = []
    for scene in report.first_scenes[:PANELS_MAX]:
        forms = {}
        for size in report.sizes:
            if size["scene"] == scene and size.get("voxels") and size.get("bytes"):
                forms.setdefault(size["form"], {})[size["resolution"]] = size["bytes"] / size["voxels"]
        lines = [Line(form, sorted(points.items()), "DAG" in form) for form, points in forms.items()]
        if lines:
            panels.append(Panel(scene, lines, "voxels along an edge of the grid", "bytes a voxel", report.resolutions))
    if not panels:
        return None
    return line_plot("Geometry of octrees and DAGs, bytes a voxel over resolution", caption, [panels],
                     legend_of([panels]))


def bar_name(row):
    """The name of a traversal: its source and what its work says beyond rays."""
    more = re.sub(r"^rays(, | )?", "", row["work"])
    return f"{row['source']}: {more}" if more else row["source"]


def plot_rays(report, caption):
    panels = []
    for scene in report.first_scenes:
        rows = [row for row in report.ray_rows(scene, report.resolution) if median(row, "baseline_ms")]
        bars = {}
        if zvo_ms(rows):
            bars["zvo"] = (report.mrays(zvo_ms(rows)), color_number("zvo"))
        for row in rows:
            name = bar_name(row) + (", wall clock" if is_wall(row) else "")
            bars.setdefault(name, (report.mrays(median(row, "baseline_ms")), color_number(row["source"])))
        if bars:
            panels.append((scene, bars))
    if not panels:
        return None
    # Scenes with few traversals have their tables alone.
    enough = max(len(bars) for _, bars in panels) / 2
    panels = [(scene, bars) for scene, bars in panels if len(bars) >= enough][:PANELS_MAX]
    names = [name for _, bars in panels for name in bars]
    names = sorted(in_order(names), key=lambda name: not name.startswith("zvo"))
    return bar_plot(f"Rays of a picture at {report.resolution}³ voxels",
                    f"{caption}, {report.pixels[0]} x {report.pixels[1]} pixels", panels, names, "Mrays/s")


def color_number(source):
    return int(COLORS.get(first_word(source), OTHER_COLOR)[1:], 16)


# The ends of files' names, what draws the plot, and what it shows.
PLOTS = {
    "time": (plot_time, "Time over resolution, a line for each builder"),
    "voxels": (plot_voxels, "Time over voxels, a line for each builder and scene"),
    "bytes": (plot_bytes, "Bytes a voxel over resolution, a line for each form of tree"),
    "rays": (plot_rays, "Millions of rays a second, by traversal"),
    "update": (plot_update, "Time of an update over moving voxels"),
}


def plots_of(report):
    """The scripts of a report's plots by the names of their files, in the order of PLOTS."""
    caption = ", ".join(part for part in (report.device, report.made()) if part)
    scripts = {}
    for name, (draw, _) in PLOTS.items():
        script = draw(report, caption)
        if script:
            scripts[f"{report.folder}_{name}.svg"] = script
    return scripts


def mark_of(script):
    """The comment of an SVG file that says what it was made from."""
    return f"<!-- bench/results-page: sha256 of data and plot {hashlib.sha256(script.encode()).hexdigest()} -->"


def find_gnuplot():
    """Ends the program if gnuplot is not there."""
    program = shutil.which("gnuplot")
    if not program:
        raise SystemExit("results-page: gnuplot is missing; install the Debian package gnuplot-nox")
    return program


def shorten(svg):
    """Leaves out groups without content, and attributes that the picture as a whole can have."""
    svg = re.sub(r' stroke-linecap="butt"| stroke-linejoin="miter"|<tspan font-family="sans-serif" >|</tspan>', "", svg)
    count = 1
    while count:
        svg, count = re.subn(r"<g [^>]*>\s*</g>", "", svg)
    svg = re.sub(r'<g (transform=[^>]*)>\s*<text>(.*?)</text>\s*</g>', r"<text \1>\2</text>", svg)
    svg = re.sub(r"<text [^>]*></text>", "", svg)
    svg = re.sub(r'<g id="gnuplot_plot_[^>]*><title>[^<]*</title>', "<g>", svg)
    svg = re.sub(r"rgb\(\s*(\d+),\s*(\d+),\s*(\d+)\)",
                 lambda color: "#" + "".join(f"{int(part):02x}" for part in color.groups()), svg)
    shared = ['fill="none" color="black" stroke="currentColor"', 'font-family="sans-serif" font-size="12.00"']
    for attributes in shared:
        svg = svg.replace(" " + attributes, "")
    svg = svg.replace('<g id="gnuplot_canvas">', f"<g {' '.join(shared)}>")
    svg = re.sub(r"(\b\d+\.\d)\d(?=[ ,)\"'])", r"\1", svg)  # tenths of a pixel
    svg = svg.replace(' class="gridline"', "")
    svg = re.sub(r'<g( stroke-width="[^"]*")>\s*<path([^>]*/>)\s*</g>', r"<path\1\2", svg)
    svg = svg.replace(' fill="#ffffff"/>', ' fill="#ffffff" stroke="none"/>', 1)  # the background
    return "\n".join(line.strip() for line in svg.splitlines() if line.strip())


def draw(script):
    """The SVG of a script."""
    result = subprocess.run([find_gnuplot(), "-"], input=script, capture_output=True, encoding="utf-8")
    if result.returncode != 0 or "</svg>" not in result.stdout:
        raise SystemExit(f"results-page: gnuplot: {(result.stderr.strip().splitlines() or ['no picture'])[-1]}")
    title = re.search(r"set label 1 '((?:[^']|'')*)'", script).group(1).replace("''", "'")
    head = f"{mark_of(script)}\n<title>{html.escape(title)}</title>"
    svg = re.sub(r"<title>Gnuplot</title>\s*<desc>.*?</desc>", lambda _: head, result.stdout, count=1, flags=re.S)
    return shorten(svg) + "\n"
