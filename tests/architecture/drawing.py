# SPDX-License-Identifier: MIT
"""Draws rooms in rows, each above all that it includes, with the arrows that do not follow from others.

After K. Sugiyama, S. Tagawa and M. Toda, Methods for Visual Understanding of Hierarchical System Structures, 1981: rows
by the longest way down, a bend in every row that an arrow passes, rows ordered by the means of their neighbors."""

import functools
import html

BOX_HEIGHT, ROW_HEIGHT, GAP, BEND_WIDTH, MARGIN = 26, 66, 16, 10, 12
CHARACTER_WIDTH = 7.3
SWEEPS = 24
# Fill and frame by the first part of a room's name.
COLORS = {"include": ("#f3e6fa", "#8e4fae"), "shaders": ("#fdf0d5", "#b7791f"), "vk": ("#e3e8ee", "#52606d"),
          "core": ("#dcebfb", "#2b6cb0"), "io": ("#ddf3e4", "#2f855a"), "runtime": ("#d8f1f1", "#2c7a7b"),
          "baseline": ("#f0e9dc", "#7b6a4d"), "api": ("#f3e6fa", "#8e4fae"), "apps": ("#fbe3e0", "#c0392b"),
          "python": ("#fff6bf", "#8a6d00")}


def reduce_arrows(known):
    """Room -> what it includes, without what a room that it includes leads to as well."""
    @functools.cache
    def reached(room):
        return frozenset().union(*({target} | reached(target) for target in known[room]))

    return {room: [target for target in targets
                   if not any(target in reached(other) for other in targets if other != target)]
            for room, targets in known.items()}


class Layout:
    """Where the boxes are, and through which points the arrows go. A knot is (room,), or (from, to, row) for a bend."""

    def __init__(self, known):
        arrows = reduce_arrows(known)
        row_of = {}
        for room in known:  # in the order of the file: what a room includes has its row
            row_of[room] = 1 + max((row_of[target] for target in known[room]), default=-1)
        self.rows = [[(room,) for room in known if row_of[room] == row] for row in range(max(row_of.values()) + 1)]
        self.ways = []
        for room, targets in arrows.items():
            for target in targets:
                bends = [(room, target, row) for row in range(row_of[room] - 1, row_of[target], -1)]
                for bend in bends:
                    self.rows[bend[2]].append(bend)
                self.ways.append([(room,)] + bends + [(target,)])
        self.below, self.above = {}, {}
        for way in self.ways:
            for upper, lower in zip(way, way[1:]):
                self.below.setdefault(upper, []).append(lower)
                self.above.setdefault(lower, []).append(upper)
        self._order_rows()
        self._place()

    def _order_rows(self):
        best, best_crossings = None, None
        for sweep in range(SWEEPS):
            is_upward = sweep % 2 == 0
            neighbors = self.below if is_upward else self.above
            rows = self.rows if is_upward else self.rows[::-1]
            for fixed, row in zip(rows, rows[1:]):
                place = {knot: index for index, knot in enumerate(fixed)}
                own = {knot: index * len(fixed) / len(row) for index, knot in enumerate(row)}
                row.sort(key=lambda knot: mean([place[other] for other in neighbors.get(knot, [])], own[knot]))
            crossings = sum(self._crossings(row) for row in range(1, len(self.rows)))
            if best is None or crossings < best_crossings:
                best, best_crossings = [list(row) for row in self.rows], crossings
        self.rows = best

    def _crossings(self, row):
        place = {knot: index for index, knot in enumerate(self.rows[row - 1])}
        ends = [place[lower] for upper in self.rows[row] for lower in sorted(self.below.get(upper, []), key=place.get)]
        return sum(left > right for index, left in enumerate(ends) for right in ends[index + 1:])

    def _place(self):
        self.x = {}
        for row in self.rows:
            left = 0
            for knot in row:
                self.x[knot] = left + width_of(knot) / 2
                left += width_of(knot) + GAP
        for sweep in range(8 * SWEEPS):
            rows = self.rows if sweep % 2 == 0 else self.rows[::-1]
            for row in rows:
                wanted = []
                for knot in row:
                    others = self.below.get(knot, []) + self.above.get(knot, [])
                    wanted.append(mean([self.x[other] for other in others], self.x[knot]))
                for knot, x in zip(row, spread(wanted, [width_of(knot) for knot in row])):
                    self.x[knot] = x
        left = min(x - width_of(knot) / 2 for knot, x in self.x.items())
        self.x = {knot: round(x - left + MARGIN) for knot, x in self.x.items()}
        self.y = {knot: MARGIN + ROW_HEIGHT * (len(self.rows) - 1 - row) + BOX_HEIGHT // 2
                  for row, knots in enumerate(self.rows) for knot in knots}
        self.width = max(x + width_of(knot) // 2 for knot, x in self.x.items()) + MARGIN
        self.height = 2 * MARGIN + ROW_HEIGHT * (len(self.rows) - 1) + BOX_HEIGHT


def mean(values, otherwise):
    return sum(values) / len(values) if values else otherwise


def width_of(knot):
    return round(len(knot[0]) * CHARACTER_WIDTH) + 18 if len(knot) == 1 else BEND_WIDTH


def spread(wanted, widths):
    """The places nearest to the wanted ones, by squares, at which neighbors keep their order and the gap: blocks of
    neighbors that touch stand at the mean of what their members want (pool adjacent violators)."""
    offsets = [0.0]
    for left, right in zip(widths, widths[1:]):
        offsets.append(offsets[-1] + (left + right) / 2 + GAP)
    blocks = []  # [sum, count]
    for want, offset in zip(wanted, offsets):
        blocks.append([want - offset, 1])
        while len(blocks) > 1 and blocks[-2][0] / blocks[-2][1] > blocks[-1][0] / blocks[-1][1]:
            total, count = blocks.pop()
            blocks[-1][0] += total
            blocks[-1][1] += count
    places = [total / count for total, count in blocks for _ in range(count)]
    return [place + offset for place, offset in zip(places, offsets)]


def draw(allowed):
    """The picture as SVG: the same bytes for the same arrows."""
    known = {room: [name for name in names if not name.startswith("<")] for room, names in allowed.items()}
    layout = Layout(known)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {layout.width} {layout.height}" '
             f'width="{layout.width}" height="{layout.height}" font-family="sans-serif" font-size="13">',
             '<title>The rooms of zvo: each includes only what stands below it</title>',
             '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" '
             'orient="auto"><path d="M0 0 8 4 0 8z" fill="#4a5568"/></marker></defs>',
             '<rect width="100%" height="100%" fill="#ffffff"/>']
    for way in layout.ways:
        points = [(layout.x[knot], layout.y[knot]) for knot in way]
        path, (last_x, last_y) = f"M{points[0][0]} {points[0][1] + BOX_HEIGHT // 2}", points[0]
        last_y += BOX_HEIGHT // 2
        for x, y in points[1:]:
            y -= BOX_HEIGHT // 2
            middle = (last_y + y) // 2
            path += f"C{last_x} {middle} {x} {middle} {x} {y}"
            if (x, y + BOX_HEIGHT // 2) != points[-1]:
                path += f"V{y + BOX_HEIGHT}"
            last_x, last_y = x, y + BOX_HEIGHT
        color = COLORS[way[0][0].split("/")[0]][1]
        lines.append(f'<path d="{path}" fill="none" stroke="{color}" stroke-opacity="0.75" marker-end="url(#tip)"/>')
    for room in known:
        fill, frame = COLORS[room.split("/")[0]]
        x, y, width = layout.x[(room,)], layout.y[(room,)], width_of((room,))
        lines.append(f'<rect x="{x - width // 2}" y="{y - BOX_HEIGHT // 2}" width="{width}" height="{BOX_HEIGHT}" '
                     f'rx="4" fill="{fill}" stroke="{frame}"/>')
        lines.append(f'<text x="{x}" y="{y + 5}" text-anchor="middle" fill="#1a202c">{html.escape(room)}</text>')
    return "\n".join(lines) + "\n</svg>\n"
