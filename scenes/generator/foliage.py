# SPDX-License-Identifier: MIT
"""The textures of leaves and flowers: opaque where a leaf is, alpha 0 elsewhere."""

import math
import random

from generator.noise import fractal_noise
from generator.textures import mix, painted, rgb


def _leaf(dx, dy, length, width):
    """1 inside a pointed leaf from (0, 0) along +y, and the distance from its midrib in parts of its half width."""
    t = dy / length
    if not 0 < t < 1:
        return None
    half = width * math.sin(math.pi * t ** 0.75) ** 0.9
    return abs(dx) / half if abs(dx) < half else None


def _foliage(size, leaves, palette, seed, vein=0.12):
    """Leaves painted one over the other: (x, y, angle, length, width, tone); alpha 1 inside, 0 outside."""
    cloud = fractal_noise(size, 8, 3, seed)
    base = palette[0]

    def painter(u, v, k):
        color, alpha = base, 0.0
        for x, y, angle, length, width, tone in leaves:
            dx, dy = u - x, v - y
            if abs(dx) > length or abs(dy) > length:
                continue
            c, s = math.cos(angle), math.sin(angle)
            rib = _leaf(dx * c - dy * s, dx * s + dy * c, length, width)
            if rib is not None:
                color = mix(palette[0], palette[1], tone + 0.35 * (cloud[k] - 0.5) - 0.18 * rib)
                if rib < vein:
                    color = mix(color, palette[2], 0.5)
                alpha = 1.0
        return (*color, alpha)

    return painted(size, painter, 32)


def leaf_cluster(seed, dark, light, rib, count, length, width):
    """A round spray of leaves that grows from the middle of the picture."""
    source = random.Random(seed)
    leaves = []
    for i in range(count):
        around = 2 * math.pi * (i * 0.381966 + 0.03 * source.random())
        out = 0.24 * math.sqrt((i + 0.5) / count)
        reach = length * (0.8 + 0.35 * source.random())
        x, y = 0.5 + out * math.sin(around), 0.5 + out * math.cos(around)
        leaves.append((x, y, around + 0.5 * (source.random() - 0.5),
                       min(reach, 0.49 - out), width * (0.85 + 0.3 * source.random()), 0.2 + 0.6 * source.random()))
    leaves.reverse()  # the inner ones on top
    return _foliage(128, leaves, [dark, light, rib], seed)


def ivy():
    """Ivy leaves, three-lobed, scattered so that the picture is about two thirds full."""
    source = random.Random(73)
    leaves = []
    for i in range(26):
        x, y = 0.14 + 0.72 * source.random(), 0.10 + 0.68 * source.random()
        tone, turn, size = 0.15 + 0.75 * source.random(), 0.9 * (source.random() - 0.5), 0.15 + 0.06 * source.random()
        leaves += [(x, y, turn + 1.0, size * 0.8, size * 0.25, tone), (x, y, turn - 1.0, size * 0.8, size * 0.25, tone),
                   (x, y, turn, size, size * 0.32, tone + 0.08)]
    return _foliage(128, leaves, [rgb("24471f"), rgb("6f9b3c"), rgb("a9c070")], 73)


def frond():
    """One arching palm or fern leaf: the stem along v in the middle, leaflets to both sides, the tip at the top."""
    leaves = []
    for i in range(15):
        t = i / 14
        y = 0.94 - 0.80 * t
        reach = 0.47 * math.sin(math.pi * (0.22 + 0.68 * t)) ** 0.8
        for side in (-1, 1):
            leaves.append((0.5, y, math.pi + side * (1.15 - 0.6 * t), reach, 0.042, 0.3 + 0.35 * t + 0.1 * (i % 2)))
    leaves.append((0.5, 0.99, math.pi, 0.97, 0.022, 0.9))
    return _foliage(128, leaves, [rgb("2a5a2c"), rgb("7fae4c"), rgb("c2d48a")], 79)


def flowers():
    """Bougainvillea: magenta bracts among few leaves."""
    source = random.Random(83)
    leaves = []
    for i in range(10):
        around = 2 * math.pi * i * 0.381966
        leaves.append((0.5 + 0.2 * math.sin(around), 0.5 + 0.2 * math.cos(around), around, 0.24, 0.075, -0.9))
    for i in range(17):
        x, y, turn = 0.2 + 0.6 * source.random(), 0.2 + 0.6 * source.random(), 6.28 * source.random()
        tone = 0.3 + 0.6 * source.random()
        leaves += [(x, y, turn + 2.09 * j, 0.13, 0.058, tone) for j in range(3)]
    cloud = fractal_noise(128, 8, 3, 84)
    bract = [rgb("b01f6d"), rgb("ea5fa6"), rgb("f6c1dc")]
    green = [rgb("2c5426"), rgb("5f9040")]

    def painter(u, v, k):
        color, alpha = green[0], 0.0
        for x, y, angle, length, width, tone in leaves:
            dx, dy = u - x, v - y
            if abs(dx) > length or abs(dy) > length:
                continue
            c, s = math.cos(angle), math.sin(angle)
            rib = _leaf(dx * c - dy * s, dx * s + dy * c, length, width)
            if rib is not None:
                alpha = 1.0
                color = mix(*green, cloud[k]) if tone < 0 else mix(bract[0], bract[1], tone + 0.3 * (cloud[k] - 0.5))
                if tone > 0 and rib < 0.15:
                    color = mix(color, bract[2], 0.4)
        return (*color, alpha)

    return painted(128, painter, 32)
