# SPDX-License-Identifier: MIT
"""The wooden ceiling of the atrium's gallery and the tiled roof, which slopes towards the court."""

import math
import random

from generator import vector as vec
from generator.geometry import Mesh, box, lathe
from generator.plan import AISLE, BAY, CEILING, EAVE, ROOF_DECK, ROOF_OVERHANG, ROOF_RISE, ROOF_RUN, ROOF_TOP


def coffers():
    """One bay of the wooden ceiling: planks, and beams that cross below them."""
    z0, z1, y = 0.0, -AISLE, CEILING
    planks = Mesh().polygon([(-BAY / 2, y, z1), (BAY / 2, y, z1), (BAY / 2, y, z0), (-BAY / 2, y, z0)])
    beams = Mesh()
    for i in range(4):
        x = -BAY / 2 + BAY * i / 4
        w = 0.09 if i == 0 else 0.06
        depth = 0.24 if i == 0 else 0.15
        beams.append(box((x - w, y - depth, z1), (x + w, y, z0), skip="+y -z +z"))
    for k in range(3):
        z = z0 + (z1 - z0) * (k + 0.75) / 3.5
        beams.append(box((-BAY / 2, y - 0.12, z - 0.05), (BAY / 2, y, z + 0.05), skip="+y -x +x"))
    rosette = lathe([[(0.13, 0), (0.12, -0.03), (0.06, -0.035), (0.05, -0.06), (0, -0.065)]], 8).flipped()
    rosettes = Mesh()
    for i in range(4):
        for k in range(2):
            x, z = -BAY / 2 + BAY * (i + 0.5) / 4, z0 + (z1 - z0) * (k + 1.25) / 3.5
            rosettes.append(rosette, vec.translation(x, y, z))
    return planks, beams, rosettes


TILE, TILES = 0.384, 9  # length of a cover tile, tiles from the eave to the top


def tile_row(count, seed):
    """A row of half-round cover tiles, the upper `count` ones of a slope: z = 0 at its top, down along +z."""
    source = random.Random(seed)
    mesh = Mesh()
    for i in range(count):
        z0, z1 = TILE * i - 0.02, TILE * (i + 1) + 0.03
        tone, warm = 0.82 + 0.3 * source.random(), source.random()
        color = (0.56 * tone, (0.20 + 0.06 * warm) * tone, (0.10 + 0.04 * warm) * tone)
        lift, r0, r1 = 0.012, 0.085, 0.105

        def point(u, v):
            a = math.pi * u
            r = r0 + (r1 - r0) * v
            # From +x over the top to -x, so that the outside is up.
            return ((r * math.cos(a), r * math.sin(a) * 0.95 + lift * v, z0 + (z1 - z0) * v),
                    (math.cos(a), math.sin(a), 0.0), (0.0, 0.0), color)

        mesh.grid(6, 1, point)
        arch = [(r1 * math.cos(math.pi * k / 6), r1 * math.sin(math.pi * k / 6) * 0.95 + lift, z1) for k in range(7)]
        mesh.polygon(arch, color=tuple(0.7 * c for c in color))  # closed with mortar
    return mesh


def roof_deck(half_x, half_z):
    """The four slopes below the tiles (upper side, lower side), from the eave rectangle outwards."""
    run = ROOF_RUN
    y0, y1 = EAVE + ROOF_DECK, ROOF_TOP
    upper, lower = Mesh(), Mesh()
    inner = [(half_x, half_z), (half_x, -half_z), (-half_x, -half_z), (-half_x, half_z)]
    for i in range(4):
        (ax, az), (bx, bz) = inner[i], inner[(i + 1) % 4]

        def out(x, z, y):
            return (x + math.copysign(run, x), y, z + math.copysign(run, z))

        corners = [(ax, y0, az), out(ax, az, y1), out(bx, bz, y1), (bx, y0, bz)]
        upper.polygon(corners)
        lower.polygon([(x, y - ROOF_DECK, z) for x, y, z in reversed(corners)])
        a, b = (ax, az), (bx, bz)
        upper.polygon([(b[0], y0 - ROOF_DECK, b[1]), (a[0], y0 - ROOF_DECK, a[1]), (a[0], y0, a[1]), (b[0], y0, b[1])])
    return upper, lower


def rafter():
    """The end of a rafter below the eave, pointing to +z."""
    slope = ROOF_RISE / ROOF_RUN
    mesh = box((-0.055, -0.12, 0.0), (0.055, 0.0, ROOF_OVERHANG + 0.06), skip="-z")
    mesh.positions = [(x, y - slope * z, z) for x, y, z in mesh.positions]
    return mesh
