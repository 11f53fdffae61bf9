# SPDX-License-Identifier: MIT
"""Plants from cards with cut-out leaves: one mesh for each material; uvs are texture coordinates."""

import math
import random

from generator import vector as vec
from generator.geometry import Mesh, arc, lathe, sphere, tube


def _card(mesh, center, normal, up, size, shading):
    """A square card of the given size whose picture's top points along up; shading: the normal of its vertices."""
    normal = vec.normalized(normal)
    right = vec.normalized(vec.cross(up, normal))
    up = vec.cross(normal, right)
    half = size / 2
    corners = [vec.add(center, vec.add(vec.scaled(right, x * half), vec.scaled(up, y * half)))
               for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    first = [mesh.vertex(c, shading, uv) for c, uv in zip(corners, ((0, 1), (1, 1), (1, 0), (0, 0)))][0]
    mesh.triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]


def _direction(source):
    """A random unit vector."""
    y = 2 * source.random() - 1
    a = 2 * math.pi * source.random()
    r = math.sqrt(1 - y * y)
    return (r * math.sin(a), y, r * math.cos(a))


def pot(radius, height):
    """A terracotta pot with a rolled rim, and the earth in it."""
    r, h = radius, height
    runs = [
        [(0.66 * r, 0.0), (0.78 * r, 0.3 * h), (0.9 * r, 0.7 * h), (0.93 * r, 0.8 * h)],
        [(0.93 * r, 0.8 * h), *arc((0.95 * r, 0.9 * h), 0.1 * h, -80, 100, 8), (0.84 * r, 0.99 * h)],
        [(0.84 * r, 0.99 * h), (0.82 * r, 0.86 * h)],
    ]
    return lathe(runs, 28), lathe([[(0.83 * r, 0.88 * h), (0.4 * r, 0.92 * h), (0.0, 0.93 * h)]], 16)


def citrus_tree(seed):
    """A round orange tree for a large pot, the earth at y = 0: leaves, wood, fruit."""
    source = random.Random(seed)
    leaves, wood, fruit = Mesh(), Mesh(), Mesh()
    center, radius = (0.0, 1.32, 0.0), 0.56
    stem = [(0, -0.05, 0), (0.02, 0.35, 0.015), (-0.015, 0.7, 0.0), (0, 1.15, 0)]
    wood.append(tube(stem, lambda t: 0.045 - 0.015 * t, 8))
    for i in range(5):
        a = 2 * math.pi * i / 5
        wood.append(tube([(0, 0.72 + 0.05 * i, 0), (0.2 * math.sin(a), 1.05, 0.2 * math.cos(a)),
                          (0.32 * math.sin(a), 1.35, 0.32 * math.cos(a))], 0.017, 5))
    for i in range(230):
        d = _direction(source)
        reach = radius * (0.45 + 0.55 * source.random() ** 0.45)
        p = vec.add(center, (d[0] * reach, d[1] * reach * 0.92, d[2] * reach))
        tilt = vec.normalized(vec.add(d, vec.scaled(_direction(source), 0.55)))
        shading = vec.normalized(vec.add(d, (0, 0.35, 0)))
        _card(leaves, p, tilt, _direction(source), 0.22 + 0.10 * source.random(), shading)
    ball = sphere(0.048, 8, 5)
    for i in range(26):
        d = _direction(source)
        d = vec.normalized((d[0], d[1] * 0.8 - 0.1, d[2]))
        fruit.append(ball, vec.translation(*vec.add(center, vec.scaled(d, radius * 0.99))))
    return leaves, wood, fruit


def fern(seed, fronds, length):
    """A fountain of arching fronds, the earth at y = 0."""
    source = random.Random(seed)
    mesh = Mesh()
    for i in range(fronds):
        turn = 2 * math.pi * (i * 0.381966 + 0.05 * source.random())
        steep = 0.35 + 0.75 * (i / fronds)
        reach = length * (0.8 + 0.3 * source.random())
        width = 0.42 * reach
        s, c = math.sin(turn), math.cos(turn)

        def point(u, v):
            # v = 0 at the tip, so that the picture stands upright.
            t = 1 - v
            bend = steep + (1.5 + 0.4 * steep) * t * t * 0.9 - 0.3
            out = reach * (0.05 + 0.95 * t) * math.sin(max(0.12, bend)) * 0.85
            y = reach * (0.95 * t * math.cos(steep * 0.75) - 0.62 * steep * t * t)
            side = (u - 0.5) * width
            return (out * s + side * c, y - 0.10 * abs(2 * u - 1) * width, out * c - side * s)

        def shaded(u, v):
            p = point(u, v)
            return p, vec.normalized((0.5 * s, 0.85, 0.5 * c)), (0.02 + 0.96 * u, v)

        mesh.grid(2, 7, shaded)
    return mesh


def creeper(seed, count, place, size, floor=-1e9):
    """Leaves on a surface: place(random source) -> position, outward normal; no leaf's middle lies below floor."""
    source = random.Random(seed)
    mesh = Mesh()
    for _ in range(count):
        p, n = place(source)
        tilt = vec.normalized(vec.add(n, vec.scaled(_direction(source), 0.45)))
        up = vec.add((0.0, 1.0, 0.0), vec.scaled(_direction(source), 0.35))
        lifted = vec.add(p, vec.scaled(n, 0.03 + 0.05 * source.random()))
        lifted = (lifted[0], max(lifted[1], floor), lifted[2])
        shading = vec.normalized(vec.add(n, (0, 0.3, 0)))
        _card(mesh, lifted, tilt, up, size * (0.75 + 0.5 * source.random()), shading)
    return mesh


def hanging_mass(seed, count, width, drop, size):
    """A creeper that spills over an edge at y = 0 and hangs in front of it: x along the edge, +z away from the wall."""
    source = random.Random(seed)
    strands = [(width * (k / 11 - 0.5) + 0.1 * (source.random() - 0.5), drop * (0.35 + 0.65 * source.random()))
               for k in range(12)]

    def place(random_source):
        x, length = random_source.choice(strands)
        t = random_source.random() ** 1.25
        x += 0.2 * (random_source.random() - 0.5) * (1 - 0.5 * t)
        y = 0.10 - length * t
        z = 0.10 + 0.16 * math.sin(math.pi * min(1.0, t + 0.2)) + 0.1 * random_source.random() * (1 - t)
        return (x, y, z), vec.normalized((0.25 * (random_source.random() - 0.5), 0.25, 1.0))

    return creeper(seed + 1, count, place, size)


def column_creeper(seed, count, radius, height, turns, size):
    """A creeper that winds up a column of the given radius."""
    def place(source):
        t = source.random() ** 1.3
        a = 2 * math.pi * (turns * t) + 1.5 * (source.random() - 0.5) * (1.2 - t)
        n = (math.sin(a), 0.0, math.cos(a))
        return (n[0] * radius, 0.05 + height * t, n[2] * radius), n

    return creeper(seed, count, place, size, floor=0.95 * size)
