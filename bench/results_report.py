# SPDX-License-Identifier: MIT
"""Reads the reports of `zvo-bench baselines --json`, zvo.bench_baselines/1. Arrays and values may be absent."""

import json
import statistics

SCHEMA = "zvo.bench_baselines/1"
FILE = "bench_baselines.json"
RESOLUTION = 512  # of summaries, where it was measured


def spread_text(value):
    """A median with its extremes, all that a cell of a long table says."""
    if not value:
        return "-"
    return f"{number(value['median'])} ({number(value['min'])} to {number(value['max'])})"


def number(value):
    """Three digits, and all digits before the point."""
    if value is None:
        return "-"
    if value == 0:
        return "0"
    digits = 0 if abs(value) >= 99.95 else 1 if abs(value) >= 9.995 else 2 if abs(value) >= 0.1 else 4
    return f"{value:,.{digits}f}"


def median(row, key):
    value = row.get(key)
    return value["median"] if value else None


def in_order(values):
    return list(dict.fromkeys(values))


class Report:
    """What was measured on one device."""

    def __init__(self, folder, document):
        self.folder = folder
        self.head = document
        self.published = document.get("published") or []
        self.rows = document.get("rows") or []
        self.sizes = document.get("sizes") or []
        self.orders = document.get("orders") or []
        device = document.get("device") or {}
        self.device = device.get("name", folder)
        self.driver = device.get("driver", "")
        self.subgroup_size = device.get("subgroup_size")
        self.pixels = tuple(document.get("size") or (1280, 720))
        self.resolutions = sorted({row["resolution"] for row in self.rows + self.sizes})
        self.resolution = RESOLUTION if RESOLUTION in self.resolutions else max(self.resolutions, default=RESOLUTION)
        self.scenes = in_order(row["scene"] for row in self.rows + self.sizes)
        # Scenes of summaries: sponza first.
        self.first_scenes = sorted(self.scenes, key=lambda scene: scene != "sponza")

    def made(self):
        """When and of what it was measured, for captions: instruction set, date and commit."""
        parts = [self.head.get("instruction_set"), self.head.get("date")]
        if self.head.get("commit"):
            parts.append(f"commit {self.head['commit']}")
        return ", ".join(part for part in parts if part)

    def select(self, **wanted):
        return [row for row in self.rows if all(row.get(key) == value for key, value in wanted.items())]

    def find(self, **wanted):
        return next(iter(self.select(**wanted)), None)

    def works(self, rows=None):
        """The works in the order of the report, as (source, work)."""
        return in_order((row["source"], row["work"]) for row in (self.rows if rows is None else rows))

    def mrays(self, ms):
        """Rays of a picture, in millions a second."""
        return self.pixels[0] * self.pixels[1] / ms / 1000 if ms else None

    def ray_rows(self, scene, resolution):
        return [row for row in self.select(scene=scene, resolution=resolution) if row["work"].startswith("rays")]

    def published_of(self, row):
        """The published figure for a row: of its scene, resolution, source and work."""
        keys = ("scene", "resolution", "source", "work")
        return next((figure for figure in self.published if all(figure[key] == row[key] for key in keys)), None)


def zvo_ms(rows):
    """zvo's time for an end that several works have: the median of what was measured beside each of them."""
    values = [median(row, "zvo_ms") for row in rows if row.get("zvo_ms")]
    return statistics.median(values) if values else None


def is_wall(row):
    return row.get("clock") == "wall"


def load_reports(root):
    """The reports of bench/results, by the names of their folders. Ends the program if one cannot be read."""
    reports = []
    for path in sorted((root / "bench" / "results").glob(f"*/{FILE}")):
        try:
            document = json.loads(path.read_text(encoding="utf-8"))
        except ValueError as error:
            raise SystemExit(f"results-page: {path.relative_to(root)}: {error}")
        if document.get("schema") != SCHEMA:
            raise SystemExit(f"results-page: {path.relative_to(root)} has the schema {document.get('schema')}, "
                             f"not {SCHEMA}")
        reports.append(Report(path.parent.name, document))
    return reports
