# SPDX-License-Identifier: MIT
"""What stands and hangs in the atrium: drapes, lanterns, the fountain with its sculpture."""

import math

from generator import vector as vec
from generator.geometry import Mesh, arc, bevelled_block, box, disc, lathe, sheet, tube


# Cloth: single sheets. Texture coordinates in metres of cloth.

def curtain():
    """The left half of a pair of curtains, gathered at the left: x from 0 to 1, y from 0 (the rod) down to -2.85."""
    height, tie = 2.85, 0.56

    def width(v):
        if v < tie:
            t = v / tie
            return 1.0 - 0.80 * t ** 2.2
        t = (v - tie) / (1 - tie)
        return 0.20 + 0.22 * math.sin(t * math.pi / 2)

    def place(u, v):
        w = width(v)
        depth = 0.03 + 0.03 * (1 - w)
        if v > tie - 0.04:
            depth *= min(1.0, 0.35 + 6 * abs(v - tie))
        fold = math.sin(2 * math.pi * (5 * u + 0.06 * math.sin(9 * v))) + 0.3 * math.sin(2 * math.pi * 3 * u + 4 * v)
        sag = 0.10 * u * (1 - w) * (1 if v < tie else 0.6)
        hem = 0.03 * math.sin(2 * math.pi * 5 * u + 1.3) * (v > 0.999)
        return (w * u, -height * v - sag - hem, depth * fold)

    return sheet(42, 24, place, lambda u, v: (1.8 * u, height * v)).flipped()


def tie_band():
    """The cord around a gathered curtain."""
    ring = [(0.11 + 0.125 * math.cos(a), -0.56 * 2.85 - 0.03 * math.cos(a), 0.10 * math.sin(a))
            for a in (2 * math.pi * i / 16 for i in range(16))]
    band = tube(ring, 0.028, 6, closed=True)
    tassel = lathe([[(0.045, -0.26), (0.04, -0.1), (0.02, -0.06)], [(0.032, -0.07), (0.032, -0.03), (0.0, -0.01)]], 8)
    return band.append(tassel, vec.translation(0.2, -0.56 * 2.85 - 0.02, 0.09))


def banner(width=1.3, drop=1.75):
    """Cloth over a balustrade's rail that hangs down in front of the cornice: the cloth, its gold hem.

    y = 0 is the top of the rail, z = 0 the rail's middle, +z the court.
    """
    path = [(-0.45, -0.17), (-0.2, -0.165), (0.015, -0.15), (0.03, 0.0), (0.012, 0.155), (-0.1, 0.20), (-0.45, 0.30),
            (-0.88, 0.45), (-1.05, 0.475), (-1.3, 0.47), (-0.88 - drop, 0.44)]
    way = [0.0]
    for (y0, z0), (y1, z1) in zip(path, path[1:]):
        way.append(way[-1] + math.hypot(y1 - y0, z1 - z0))
    total = way[-1]

    def along(s):
        """The path at s metres, rounded at its points."""
        def at(x):
            x = min(max(x, 0.0), total)
            i = max(k for k in range(len(way) - 1) if way[k] <= x)
            t = (x - way[i]) / (way[i + 1] - way[i])
            return tuple(a + (b - a) * t for a, b in zip(path[i], path[i + 1]))

        near = [at(s + d) for d in (-0.05, -0.025, 0.0, 0.025, 0.05)]
        return sum(p[0] for p in near) / 5, sum(p[1] for p in near) / 5

    def place_from(start, end):
        def place(u, v):
            s = start + (end - start) * v
            y, z = along(s)
            free = min(1.0, max(0.0, (s - 1.35) / 1.2))
            fold = free * 0.055 * math.sin(2 * math.pi * 3.5 * u + 0.5 * math.sin(3 * s))
            fold += 0.006 * math.sin(2 * math.pi * 7 * u)
            squeeze = 1 - 0.07 * free
            point = -0.24 * (1 - abs(2 * u - 1)) * max(0.0, (s - total + 0.5) / 0.5)
            return ((u - 0.5) * width * squeeze, y + point, z + fold + 0.06 * free)
        return place

    hem = total - 0.14
    cloth = sheet(32, 40, place_from(0.0, hem), lambda u, v: (u * width, v * hem)).flipped()
    gold = sheet(32, 2, place_from(hem, total), lambda u, v: (u, v)).flipped()
    return cloth, gold


# Lanterns

def lantern():
    """A hexagonal lantern below its chain; y = 0 is the hook: bronze, glowing glass."""
    chain = 0.62
    bronze = Mesh()
    bronze.append(tube([(0, 0, 0), (0, -chain, 0)], 0.014, 6))
    cap = [[(0.17, 0.0), (0.175, 0.03)], [(0.175, 0.03), (0.11, 0.10), (0.045, 0.14), (0.03, 0.17)],
           arc((0.0, 0.2), 0.035, -60, 90, 5)]
    bronze.append(lathe(cap, 6), vec.translation(0, -chain - 0.23, 0))
    foot = [[(0.0, -0.1), (0.025, -0.09), (0.03, -0.06), (0.09, -0.03)],
            [(0.09, -0.03), (0.13, -0.02), (0.13, 0.0), (0.0, 0.0)]]
    bronze.append(lathe(foot, 6), vec.translation(0, -chain - 0.6, 0))
    for i in range(6):
        a = 2 * math.pi * i / 6
        bronze.append(tube([(0.125 * math.sin(a), -chain - 0.6, 0.125 * math.cos(a)),
                            (0.168 * math.sin(a), -chain - 0.23, 0.168 * math.cos(a))], 0.012, 4))
    glass = Mesh()
    low, high = (0.115, -chain - 0.6), (0.155, -chain - 0.23)
    for i in range(6):
        a, b = 2 * math.pi * i / 6, 2 * math.pi * (i + 1) / 6
        corners = ((low, a), (low, b), (high, b), (high, a))
        glass.polygon([(r * math.sin(t), y, r * math.cos(t)) for (r, y), t in corners])
    return bronze, glass


# The fountain

def basin():
    """A round basin with a moulded rim and a plinth: stone, the mosaic inside, the water's surface."""
    outside = [
        [(1.72, 0.0), (1.72, 0.10)], [(1.72, 0.10), (1.62, 0.12)],
        [(1.5, 0.12), (1.47, 0.16), (1.44, 0.24), (1.46, 0.34), (1.53, 0.42)],
        [(1.53, 0.42), *arc((1.53, 0.47), 0.055, -60, 80, 6)], [(1.54, 0.525), (1.30, 0.525)],
        [(1.30, 0.525), (1.27, 0.50)],
    ]
    stone = lathe(outside, 64)
    stone.append(lathe([[(1.62, 0.12), (1.5, 0.12)]], 64))
    mosaic = lathe([[(1.27, 0.50), (1.26, 0.08)], [(1.26, 0.08), (0.0, 0.08)]], 64)
    return stone, mosaic, disc(1.262, 64, 0.42)


def fountain_column():
    """The pillar in the basin and the bowl on it: stone, the water in the bowl."""
    runs = [
        [(0.34, 0.05), (0.34, 0.46)], [(0.34, 0.46), (0.30, 0.50), (0.22, 0.53)],
        [(0.22, 0.53), (0.17, 0.62), (0.14, 0.78), (0.135, 0.92), (0.16, 1.05)], arc((0.15, 1.08), 0.04, -80, 80, 6),
        [(0.14, 1.12), (0.26, 1.17), (0.50, 1.25), (0.68, 1.36), (0.76, 1.46)], arc((0.76, 1.485), 0.035, -80, 110, 6),
        [(0.745, 1.515), (0.62, 1.40), (0.40, 1.33), (0.16, 1.31)],
        [(0.16, 1.31), (0.15, 1.42), (0.11, 1.60), (0.10, 1.72)], [(0.10, 1.72), (0.17, 1.78), (0.19, 1.82)],
        [(0.19, 1.82), (0.19, 1.87)], [(0.19, 1.87), (0.0, 1.87)],
    ]
    return lathe(runs, 40), disc(0.72, 40, 1.47)


def jet():
    """One arc of water from the upper bowl into the basin, towards +z."""
    points = [(0, 1.5 + 1.0 * t - 2.06 * t * t, 0.74 + 0.36 * t) for t in (i / 12 for i in range(13))]
    return tube(points, lambda t: 0.018 + 0.014 * t, 6)


def knot_third(along, around):
    """A third of a trefoil knot about the y axis, finely divided; colours from bronze to verdigris.

    Three of them, turned by 120 degrees each, close.
    """
    def center(t):  # t: 0 to 1 is once around the whole curve, which goes twice about the axis
        a = 2 * math.pi * t
        r = 0.34 + 0.15 * math.cos(3 * a)
        return (r * math.sin(2 * a), 0.20 * math.sin(3 * a), r * math.cos(2 * a))

    def point(u, v):
        t = v / 3
        e = 1e-4
        tangent = vec.normalized(vec.sub(center(t + e), center(t - e)))
        # A frame that the knot's symmetry carries into itself: from the axis outwards.
        p = center(t)
        out = vec.normalized((p[0], 0.0, p[2]))
        side = vec.normalized(vec.cross(tangent, out))
        normal = vec.cross(side, tangent)
        a = 2 * math.pi * (u + v)
        n = vec.add(vec.scaled(normal, math.cos(a)), vec.scaled(side, math.sin(a)))
        ridge = 0.5 + 0.5 * math.cos(3 * a - 2 * math.pi * 6 * v)
        color = vec.mixed((0.55, 0.29, 0.09), (0.09, 0.36, 0.29), 0.65 * (1 - ridge) ** 2)
        return vec.add(p, vec.scaled(n, 0.082 + 0.018 * ridge)), n, (0.0, 0.0), color

    return Mesh().grid(around, along, point)


def bench():
    """A stone bench along x."""
    mesh = bevelled_block(1.6, 0.09, 0.46, 0.02).append(box((-0.8, 0, -0.23), (0.8, 0.05, 0.23), skip="+y +x -x +z -z"))
    mesh = mesh.moved(vec.translation(0, 0.40, 0))
    for x in (-0.58, 0.58):
        mesh.append(box((x - 0.11, 0, -0.17), (x + 0.11, 0.41, 0.17), skip="-y +y"))
    return mesh


def urn():
    """A stone vase for a niche or a balustrade."""
    runs = [[(0.13, 0.0), (0.13, 0.04)], [(0.13, 0.04), (0.06, 0.07), (0.05, 0.10), (0.07, 0.12)],
            [(0.07, 0.12), (0.16, 0.2), (0.2, 0.3), (0.18, 0.4), (0.11, 0.48), (0.1, 0.52)],
            [(0.1, 0.52), (0.17, 0.56), (0.17, 0.58)], [(0.17, 0.58), (0.12, 0.56), (0.0, 0.52)]]
    return lathe(runs, 24)
