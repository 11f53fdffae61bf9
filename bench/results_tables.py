# SPDX-License-Identifier: MIT
"""The page and the table in Markdown that say what the reports of `zvo-bench baselines` have."""

import re
import textwrap

from results_plots import PLOTS, plots_of
from results_report import in_order, is_wall, median, number, spread_text, zvo_ms

COLUMNS = 100
SLOWER_MAX = 6  # rows that the summary names one by one

# The works of summaries, in their order, and those of the README.
SUMMARY = [("thesis", "voxelize"), ("thesis", "build, bottom-up"), ("Crassin, Green", "build, top-down"),
           ("thesis", "update"), ("thesis", "rays after the update"), ("slides", "voxelize and build"),
           ("slides", "voxelize and build, DAG"), ("slides", "rays, state saved"), ("hash table", "DAG"),
           ("DDA", "rays through a bit grid"), ("Embree", "rays, voxels, packets"),
           ("Embree", "rays, voxels, single")]
README_WORKS = [("thesis", "voxelize"), ("thesis", "build, bottom-up"), ("Crassin, Green", "build, top-down"),
                ("thesis", "update"), ("thesis", "rays after the update"), ("slides", "voxelize and build"),
                ("slides", "rays, state saved"), ("Embree", "rays, voxels, packets")]
# The thesis's scenes, and what the names of each have in common.
THESIS_SCENES = {"Buddha and Dragon": "buddha", "Sponza and Bunny": "sponza"}
THESIS_SOURCES = ("thesis", "Crassin, Green")


def table(names, rows, text_columns=1):
    """A table whose first columns are text and whose others are numbers; none without rows."""
    if not rows:
        return ""
    lines = [names, ["---"] * text_columns + ["---:"] * (len(names) - text_columns)] + rows
    return "".join("| " + " | ".join(str(cell).replace("|", "\\|") for cell in line) + " |\n" for line in lines) + "\n"


def prose(text):
    return textwrap.fill(" ".join(text.split()), COLUMNS, break_long_words=False, break_on_hyphens=False) + "\n\n"


def details(name, text):
    return f"<details><summary>{name}</summary>\n\n{text}</details>\n\n" if text else ""


def grid(resolution):
    return f"{resolution}³"


def megabytes(count):
    return f"{number(count / 1e6)} MB" if count else "-"


def ms_text(ms):
    """A published time, in all digits that it was published with."""
    return "-" if ms is None else f"{ms:,}"


def work_name(source, work):
    return f"{work} ({source})"


def published_text(report, row):
    """The published time of a row, with its hardware."""
    figure = report.published_of(row)
    ms = row.get("published_ms") or (figure or {}).get("ms")
    hardware = (figure or {}).get("hardware")
    return "-" if ms is None else f"{ms_text(ms)} ({hardware})" if hardware else ms_text(ms)


def summary_rows(report, works):
    """A row for each work: of a scene with a published time, or else of sponza, where there are such."""
    scenes = sorted(report.first_scenes, key=lambda scene: not scene.startswith("sponza"))
    rows = []
    for source, work in works:
        found = [row for scene in scenes for row in
                 report.select(scene=scene, resolution=report.resolution, source=source, work=work)]
        found.sort(key=lambda row: published_text(report, row) == "-")
        if found:
            rows.append((found[0], [median(row, "ratio") for row in found if median(row, "ratio") is not None]))
    return rows


def summary_table(report, works, has_range):
    lines = []
    rows = summary_rows(report, works)
    scenes = [row["scene"] for row, _ in rows]
    first = max(scenes, key=scenes.count) if rows else None
    for row, ratios in rows:
        name = work_name(row["source"], row["work"]) + (f", {row['scene']}" if row["scene"] != first else "")
        line = [name, published_text(report, row), number(median(row, "baseline_ms")), number(median(row, "zvo_ms")),
                number(median(row, "ratio"))]
        spread = f"{number(min(ratios))} to {number(max(ratios))}" if len(ratios) > 1 else "-"
        lines.append(line + [spread] if has_range else line)
    names = ["work", "published, ms (hardware)", "baseline here, ms", "zvo here, ms", "ratio"]
    return first, table(names + ["over scenes"] if has_range else names, lines)


def slower_text(report):
    """Where zvo takes longer."""
    rated = [row for row in report.rows if median(row, "ratio") is not None]
    slower = [row for row in rated if median(row, "ratio") < 1]
    if not rated:
        return ""
    text = f"zvo takes less time than the baseline in {len(rated) - len(slower)} of {len(rated)} rows. "
    works = in_order((row["source"], row["work"]) for row in slower)
    if slower and len(slower) <= SLOWER_MAX:
        text += "It takes more in " + "; ".join(
            f"{work_name(row['source'], row['work'])}, {row['scene']} at {grid(row['resolution'])} "
            f"({number(median(row, 'ratio'))})" for row in slower) + "."
    elif slower:
        text += "It takes more in rows of " + "; ".join(
            f"{work_name(source, work)}: "
            f"{sum((row['source'], row['work']) == (source, work) for row in slower)} of "
            f"{len([row for row in rated if (row['source'], row['work']) == (source, work)])}"
            for source, work in works) + "."
    return text


def head_text(report):
    head = report.head
    size = f"{report.pixels[0]} x {report.pixels[1]}"
    parts = [part for part in (report.device, report.driver) if part]
    if report.subgroup_size:
        parts.append(f"subgroups of {report.subgroup_size}")
    if report.made():
        parts.append(report.made())
    text = ", ".join(parts) + ". "
    if head.get("coverage"):
        text += f"{head['coverage'].capitalize()} coverage, "
        text += "all attributes; " if head.get("attributes") == "full" else "geometry alone; "
    if head.get("runs"):
        text += f"medians of {head['runs']} runs in turns; "
    return text + f"rays of pictures of {size} pixels."


def summary(report):
    scene, text = summary_table(report, SUMMARY, True)
    if not text:
        return prose(head_text(report))
    return prose(head_text(report)) + prose(
        f"Figures are of {scene} at {grid(report.resolution)}, or of the scene that a row names. A ratio is the "
        f"baseline's time by zvo's, of runs in turns: above 1, zvo takes less. The last column has the ratios of all "
        f"scenes at this resolution. {slower_text(report)}") + text


def thesis_cells(report, scene_part, source, work):
    """Published, baseline, zvo and ratio of a work on one of the thesis's scenes."""
    figures = [figure for figure in report.published if figure["source"] == source and figure["work"] == work
               and scene_part in figure["scene"].lower()]
    # The scene with its moving object goes before the scene alone.
    scenes = sorted((scene for scene in report.scenes if scene_part in scene), key=len, reverse=True)
    row = next((row for scene in scenes for row in
                report.select(scene=scene, resolution=report.resolution, source=source, work=work)), {})
    ms = row.get("published_ms") or next((figure["ms"] for figure in figures if figure.get("ms")), None)
    return [ms_text(ms), number(median(row, "baseline_ms")), number(median(row, "zvo_ms")),
            number(median(row, "ratio"))]


def thesis_section(report):
    works = in_order((item["source"], item["work"]) for item in report.published + report.rows
                     if item["source"] in THESIS_SOURCES)
    lines = []
    for source, work in works:
        cells = sum((thesis_cells(report, part, source, work) for part in THESIS_SCENES.values()), [])
        if any(cell != "-" for cell in cells):
            lines.append([work_name(source, work)] + cells)
    names = [f"{scene}: {what}" if what == "published" else what for scene in THESIS_SCENES
             for what in ("published", "baseline", "zvo", "ratio")]
    text = table(["ms"] + names, lines)
    if not text:
        return ""
    hardware = in_order(figure["hardware"] for figure in report.published
                        if figure["source"] in THESIS_SOURCES and figure.get("hardware"))
    return "### The thesis's tables 1 and 2\n" + prose(
        f"Its two scenes{', published of ' + ', '.join(hardware) if hardware else ''}; here at "
        f"{grid(report.resolution)}.") + text


def simple_name(scene):
    return re.sub(r"[^a-z0-9]+", "_", scene.lower())


def slides_section(report):
    lines = []
    for figure in (figure for figure in report.published if figure["source"] == "slides"):
        row = next((row for row in report.select(source="slides", work=figure["work"],
                                                 resolution=figure["resolution"])
                    if row["scene"] == simple_name(figure["scene"])), {})
        lines.append([figure["work"], figure["scene"], grid(figure["resolution"]), figure.get("hardware") or "-",
                      ms_text(figure.get("ms")), megabytes(figure.get("bytes")),
                      number(median(row, "baseline_ms")), number(median(row, "zvo_ms")),
                      number(median(row, "ratio"))])
    text = table(["work", "scene", "resolution", "hardware", "published, ms", "published, bytes", "baseline here, ms",
                  "zvo here, ms", "ratio"], lines, 4)
    rows = report.select(source="slides", resolution=report.resolution)
    scenes = [scene for scene in report.first_scenes if any(row["scene"] == scene for row in rows)]
    lines = []
    for work in in_order(row["work"] for row in rows):
        cells = []
        for scene in scenes:
            row = next((row for row in rows if (row["scene"], row["work"]) == (scene, work)), {})
            cells.append(f"{number(median(row, 'baseline_ms'))} / {number(median(row, 'zvo_ms'))} "
                         f"({number(median(row, 'ratio'))})" if row else "-")
        lines.append([work] + cells)
    here = table(["baseline / zvo, ms (ratio)"] + scenes, lines)
    if not text and not here:
        return ""
    return ("### The slides' figures\n" + (prose("As published, and what was measured here of scenes with the same names.") + text
                                           if text else "") +
            (prose(f"The same works at {grid(report.resolution)}.") + here if here else ""))


def all_rows_section(report):
    text = ""
    for scene in report.scenes:
        rows = report.select(scene=scene)
        lines = [[row["source"], row["work"], row.get("clock") or "device", grid(row["resolution"]),
                  f"{row['voxels']:,}" if row.get("voxels") else "-", ms_text(row.get("published_ms")),
                  spread_text(row.get("baseline_ms")), spread_text(row.get("zvo_ms")), spread_text(row.get("ratio"))]
                 for row in sorted(rows, key=lambda row: row["resolution"])]
        text += details(f"{scene}: {len(lines)} rows", table(
            ["source", "work", "clock", "resolution", "voxels", "published, ms", "baseline, ms", "zvo, ms", "ratio"],
            lines, 3))
    return "### All rows\n" + prose("Medians, minima and maxima.") + text if text else ""


def bytes_section(report):
    at = [size for size in report.sizes if size["resolution"] == report.resolution and size.get("voxels")]
    scenes = [scene for scene in report.first_scenes if any(size["scene"] == scene for size in at)]
    lines = []
    for form in in_order(size["form"] for size in at):
        found = {size["scene"]: size["bytes"] / size["voxels"] for size in at if size["form"] == form}
        lines.append([form] + [number(found.get(scene)) for scene in scenes])
    text = table([f"bytes a voxel at {grid(report.resolution)}"] + scenes, lines)
    every = table(["scene", "form", "resolution", "voxels", "nodes", "bytes"],
                  [[size["scene"], size["form"], grid(size["resolution"]), f"{size['voxels']:,}", f"{size['nodes']:,}",
                    f"{size['bytes']:,}"] for size in report.sizes], 2)
    if not every:
        return ""
    return "### Bytes\n" + prose("Geometry alone, without attributes.") + text + details("All resolutions", every)


def rays_section(report):
    columns = {scene: report.ray_rows(scene, report.resolution) for scene in report.first_scenes}
    columns = {scene: rows for scene, rows in columns.items() if rows}
    lines = []
    if columns:
        lines.append(["**zvo**"] + [number(report.mrays(zvo_ms(rows))) for rows in columns.values()])
    for source, work in report.works(sum(columns.values(), [])):
        found = [next((row for row in rows if (row["source"], row["work"]) == (source, work)), {})
                 for rows in columns.values()]
        name = work_name(source, work) + (", wall clock" if any(is_wall(row) for row in found) else "")
        lines.append([name] + [number(report.mrays(median(row, "baseline_ms"))) for row in found])
    text = table([f"Mrays/s at {grid(report.resolution)}"] + list(columns), lines)
    return "### Traversals\n" + prose(
        "Millions of primary rays a second; zvo's with their beam pass. Embree and the DDA run on the host and have "
        "the wall clock.") + text if text else ""


def update_section(report):
    rows = [row for row in report.rows if row.get("moving_voxels")]
    names = ["scene", "work", "resolution", "moving voxels", "baseline, ms", "zvo, ms", "ratio"]
    lines = [(row["resolution"], [row["scene"], row["work"], grid(row["resolution"]), f"{row['moving_voxels']:,}",
                                  number(median(row, "baseline_ms")), number(median(row, "zvo_ms")),
                                  number(median(row, "ratio"))]) for row in rows]
    text = table(names, [line for resolution, line in lines if resolution == report.resolution], 2)
    every = table(names, [line for resolution, line in lines if resolution != report.resolution], 2)
    if not text and not every:
        return ""
    return "### Update\n" + prose("The thesis's dynamic update of scenes with a moving object, and zvo's.") + text + \
        details("Other resolutions", every)


def orders_section(report):
    def lines_at(is_wanted):
        return [[row["scene"], row["order"], grid(row["resolution"]), spread_text(row.get("rays_ms")),
                 number(report.mrays(median(row, "rays_ms"))), spread_text(row.get("update_ms"))]
                for row in report.orders if is_wanted(row)]

    names = ["scene", "order", "resolution", "rays, ms", "Mrays/s", "update, ms"]
    text = table(names, lines_at(lambda row: row["resolution"] == report.resolution), 2)
    other = table(names, lines_at(lambda row: row["resolution"] != report.resolution), 2)
    if not text and not other:
        return ""
    return "### Order of nodes\n" + prose("The same octree with its nodes in other orders.") + text + \
        details("Other resolutions", other)


def plots_section(report):
    files = plots_of(report)
    text = "".join(f"![{about}]({report.folder}_{name}.svg)\n\n" for name, (_, about) in PLOTS.items()
                   if f"{report.folder}_{name}.svg" in files)
    return "### Plots\n" + text if text else ""


SECTIONS = [summary, thesis_section, slides_section, bytes_section, rays_section, update_section, orders_section,
            plots_section, all_rows_section]


def page_text(reports, reading):
    text = "# Baselines\n" + prose(
        "The algorithms of zvo's sources beside zvo's own, on the same device in turns: Y. Pan's thesis (2021), "
        "ushiostarfish's slides (2023), C. Crassin and S. Green (2012), a hash table for DAGs, a DDA through a grid "
        "of bits, and Embree. [architecture.md](../architecture.md#baselines) says how they were written. "
        "`bench/results-page` makes this page from the reports of `zvo-bench baselines` in `bench/results`; "
        "[Reading it](#reading-it) is written by hand.")
    for report in reports:
        text += f"## {report.folder}: {report.device}\n" + "".join(section(report) for section in SECTIONS)
    return text + "## Reading it\n" + reading.strip() + "\n"


def readme_text(reports, page):
    """The text between the marks of the README, of the first device that has results. page: where the others are."""
    for report in reports:
        scene, text = summary_table(report, README_WORKS, False)
        if text:
            lead = prose(f"{scene} at {grid(report.resolution)} on {report.device}"
                         f"{', ' + report.made() if report.made() else ''}; ratios are baseline / zvo. [All figures, "
                         f"and how to read them]({page}).")
            return f"\n{lead}{text}"
    return ""
