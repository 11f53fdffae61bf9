# SPDX-License-Identifier: MIT
"""The parts of the atrium's building: columns, arcades, balustrades, vaults, walls. Texture coordinates in metres."""

import math

from generator import vector as vec
from generator.geometry import (Mesh, arc, bevelled_block, box, disc, half_circle, lathe, loop_sweep, moulded_arch,
                                sheet, sphere, wall)
from generator.plan import (AISLE, BAY, LOWER_RADIUS, LOWER_SPRING, RAIL, STEP, UPPER_FLOOR, UPPER_SPRING, VAULT_HALF,
                            VAULT_RISE, WALL)

COLUMN_SEGMENTS = 24


# Columns

def _acanthus(radius, y, height, flare, width):
    """One leaf at +z that leaves the bell of a capital at its tip."""
    def place(u, v):
        half = width * (1 - 0.75 * v ** 3) / 2
        x = (u - 0.5) * 2 * half
        z = radius + 0.012 + flare * v ** 3 + 0.02 * (1 - (2 * u - 1) ** 2) - 0.02 * abs(2 * u - 1)
        return (x, y + height * (v - 0.28 * max(0.0, v - 0.7) / 0.3 * (v > 0.7)), z)

    return sheet(2, 6, place, lambda u, v: (u * width, -v * height))


def capital(bottom, top, radius, half):
    """A bell with two rows of leaves and four corner scrolls below a square slab of the given half width."""
    slab = 0.09
    height = top - bottom - slab
    r = radius
    bell = [(r, bottom + 0.05), (r * 1.02, bottom + 0.05 + height * 0.4), (r * 1.12, bottom + height * 0.75),
            (half * 0.98, top - slab)]
    ring = arc((r, bottom + 0.025), 0.03, -90, 90, 4)
    mesh = lathe([ring, bell], COLUMN_SEGMENTS)
    for row, count in ((0, 8), (1, 8)):
        leaf = _acanthus(r, bottom + 0.05, height * (0.48 + 0.36 * row), 0.055 + 0.035 * row, 2.5 * r / count * 2.1)
        for i in range(count):
            mesh.append(leaf, vec.rotation("y", 360 / count * (i + 0.5 * row)))
    scroll = sphere(0.2 * half, 8, 6)
    for i in range(4):
        turn = vec.rotation("y", 45 + 90 * i)
        place = vec.translation(0, top - slab - 0.16 * half, half * 1.12)
        mesh.append(scroll, vec.product(turn, place, vec.scaling(0.8, 1.1, 0.9)))
    slab_block = bevelled_block(2 * half, slab, 2 * half, 0.015)
    mesh.append(slab_block, vec.translation(0, top - slab, 0))
    mesh.append(box((-half, top - slab, -half), (half, top, half), skip="+x -x +y +z -z"))
    return mesh


def column(bottom, top, radius, half_plinth, half_abacus, capital_height):
    """A round column with base, swelling shaft and capital, from bottom to top."""
    plinth = 0.11
    y = bottom + plinth
    mesh = bevelled_block(2 * half_plinth, plinth, 2 * half_plinth, 0.012).moved(vec.translation(0, bottom, 0))
    r = radius
    base = [
        arc((r * 1.22, y + 0.045), 0.045, -90, 90, 5),
        [(r * 1.2, y + 0.09), (r * 1.13, y + 0.105), (r * 1.1, y + 0.12), (r * 1.14, y + 0.14)],
        arc((r * 1.1, y + 0.165), 0.027, -90, 90, 4),
    ]
    low, high = y + 0.19, top - capital_height
    shaft = []
    for i in range(10):
        t = (i / 9) ** 1.5
        swell = 1 - 0.16 * t ** 1.8
        foot = 0.10 * max(0.0, 1 - 14 * t)
        shaft.append((r * (swell + foot), low + (high - low) * t))
    mesh.append(lathe([*base, shaft], COLUMN_SEGMENTS))
    return mesh.append(capital(high, top, r * 0.84, half_abacus))


def lower_column():
    return column(STEP, LOWER_SPRING, 0.205, 0.28, 0.27, 0.46)


def upper_column():
    return column(UPPER_FLOOR + RAIL + 0.06, UPPER_SPRING, 0.15, 0.2, 0.235, 0.34)


def pedestal():
    """Under an upper column, as high as the balustrade."""
    mesh = bevelled_block(0.48, 0.12, 0.48, 0.02)
    mesh.append(box((-0.19, 0.1, -0.19), (0.19, RAIL - 0.06, 0.19), skip="+y -y"))
    panel = box((-0.12, 0.2, 0.0), (0.12, RAIL - 0.16, 0.205), skip="-z -y -x +x +y")
    rim = Mesh()
    for side in range(4):
        rim.append(panel, vec.rotation("y", 90 * side))
    mesh.append(rim)
    top = bevelled_block(0.46, 0.12, 0.46, 0.02)
    top.append(box((-0.23, 0, -0.23), (0.23, 0.1, 0.23), skip="+y +x -x +z -z"))
    return mesh.append(top, vec.translation(0, RAIL - 0.06, 0))


# Arcades

def arcade_panel(spring, radius, top, half):
    """The wall of a bay over its arch, both faces and the inside of the arch."""
    arch = [(x, y, top) for x, y in half_circle(0, spring, radius, 24)]
    mesh = wall([(-BAY / 2, spring, top), *arch, (BAY / 2, spring, top)], half, -half)
    return mesh.append(wall(arch, half, -half, "lower"))


def archivolt(spring, radius, half):
    """The moulding around an arch on its court side, with a keystone."""
    z = half
    runs = [
        [(-0.012, z - 0.05), (-0.012, z + 0.035)],
        [(-0.012, z + 0.035), (0.075, z + 0.035)],
        [(0.075, z + 0.035), (0.08, z + 0.055), (0.10, z + 0.062), (0.12, z + 0.055), (0.13, z + 0.07)],
        [(0.13, z + 0.07), (0.17, z + 0.07)],
        [(0.17, z + 0.07), (0.17, z)],
    ]
    mesh = moulded_arch(radius, runs, 24).moved(vec.translation(0, spring, 0))
    low, high = spring + radius - 0.06, spring + radius + 0.26
    f = z + 0.11
    face = [(-0.085, low, f - 0.03), (0.085, low, f - 0.03), (0.13, high, f), (-0.13, high, f)]
    rear = [(x, y, -z if y == low else z - 0.01) for x, y, _ in face]
    mesh.polygon(face)
    for i in range(4):
        j = (i + 1) % 4
        mesh.polygon([face[j], face[i], rear[i], rear[j]])
    return mesh


def rib(half_width):
    """A cross arch of the aisle that carries the vaults, from the column to the outer wall: x along the arch."""
    bounds = []
    for x, y in half_circle(0, LOWER_SPRING, LOWER_RADIUS, 20, 1.12):
        bounds.append((x, y, LOWER_SPRING + (VAULT_RISE + 0.02) * math.sqrt(max(0.0, 1 - (x / VAULT_HALF) ** 2))))
    ends = [(side * VAULT_HALF, LOWER_SPRING, LOWER_SPRING + 0.01) for side in (-1, 1)]
    mesh = wall([ends[0], *bounds, ends[1]], half_width, -half_width)
    return mesh.append(wall(bounds, half_width, -half_width, "lower"))


def cross_vault(cells=12):
    """A groin vault over the square from -1 to 1, rising from 0 at the corners to 1, seen from below. uv: 0 to 1."""
    half = Mesh()

    def quarter(u, v):
        # The web between the two diagonals that looks to +z: |x| <= z. Its height follows the barrel along z.
        z = v
        x = (2 * u - 1) * z
        y = math.sqrt(max(0.0, 1 - x * x))
        return (x, y, z), vec.normalized((-x, -max(y, 0.05), 0.0)), ((x + 1) / 2, (z + 1) / 2)

    half.grid(cells, cells // 2, quarter)
    mesh = Mesh()
    for side in range(4):
        piece = half.moved(vec.rotation("y", 90 * side))
        piece.uvs = [((p[0] + 1) / 2, (p[2] + 1) / 2) for p in piece.positions]
        mesh.append(piece)
    return mesh


def pilaster():
    """On the inner face of the outer wall where a rib ends."""
    mesh = box((-0.16, STEP, 0), (0.16, LOWER_SPRING - 0.2, 0.1), skip="-z -y +y")
    mesh.append(bevelled_block(0.44, 0.3, 0.30, 0.03), vec.translation(0, STEP, 0))
    mesh.append(bevelled_block(0.36, 0.06, 0.22, 0.02), vec.translation(0, LOWER_SPRING - 0.26, 0))
    cap = lathe([[(0.2, 0), (0.22, 0.05), (0.29, 0.14)], [(0.29, 0.14), (0.29, 0.2), (0.0, 0.2)]], 4, 45, 405)
    mesh.append(cap, vec.product(vec.translation(0, LOWER_SPRING - 0.2, 0), vec.scaling(1, 1, 0.72)))
    return mesh


def cornice(half_x, half_z, bottom, top, depth, inward=True):
    """A moulded string course around the court."""
    h = top - bottom
    runs = [
        [(0.0, bottom), (0.035, bottom + 0.01), (0.035, bottom + 0.16 * h)],
        [(0.035, bottom + 0.16 * h), (0.3 * depth, bottom + 0.22 * h), (0.5 * depth, bottom + 0.42 * h),
         (0.62 * depth, bottom + 0.5 * h)],
        [(0.62 * depth, bottom + 0.5 * h), (0.62 * depth, bottom + 0.58 * h)],
        [(0.62 * depth, bottom + 0.58 * h), (depth, bottom + 0.62 * h)],
        [(depth, bottom + 0.62 * h), (depth, top - 0.02)],
        [(depth, top - 0.02), (depth - 0.02, top), (0.0, top)],
    ]
    return loop_sweep(runs, half_x, half_z, inward)


def baluster():
    """A turned baluster, 0 to RAIL - 0.24 high."""
    h = RAIL - 0.24
    mesh = box((-0.065, 0, -0.065), (0.065, 0.05, 0.065), skip="-y")
    mesh.append(box((-0.065, h - 0.05, -0.065), (0.065, h, 0.065), skip="+y"))
    profile = [(0.055, 0.05), (0.054, 0.075), (0.035, 0.105), (0.05, 0.16), (0.068, 0.205), (0.072, 0.24),
               (0.064, 0.29), (0.045, 0.37), (0.031, 0.48), (0.052, 0.53), (0.052, 0.555), (0.036, 0.575),
               (0.05, h - 0.05)]
    return mesh.append(lathe([profile], 10))


def rails(left, right):
    """The foot and the handrail of a balustrade between two pedestals."""
    mesh = box((left, 0, -0.11), (right, 0.12, 0.11), skip="-y -x +x")
    runs = [(-0.1, RAIL - 0.12), (-0.14, RAIL - 0.07), (-0.14, RAIL - 0.03), (-0.1, RAIL)]
    outline = [*[(-z, y) for z, y in runs], *reversed(runs)]  # counterclockwise seen from +x, from the front foot on
    for (z0, y0), (z1, y1) in zip(outline, [*outline[1:], outline[0]]):
        mesh.polygon([(left, y0, z0), (right, y0, z0), (right, y1, z1), (left, y1, z1)])
    return mesh


def roundel():
    """A glazed shield for the space between two arches, looking to +z: the dish, the rim, the rosette."""
    turn = vec.rotation("x", 90)
    dish = lathe([[(0.25, 0.0), (0.24, 0.055)], [(0.24, 0.055), (0.15, 0.075), (0.0, 0.085)]], 24).moved(turn)
    rim = lathe([arc((0.27, 0.045), 0.05, -90, 210, 7)], 24).moved(turn)
    rosette = lathe([[(0.055, 0.07), (0.045, 0.125), (0.0, 0.135)]], 12)
    petal = sphere(0.05, 6, 4)
    for i in range(8):
        place = vec.product(vec.rotation("y", 45 * i), vec.translation(0, 0.085, 0.125))
        rosette.append(petal, vec.product(place, vec.scaling(0.5, 0.7, 1.5)))
    return dish, rim, rosette.moved(turn)


# Outer walls

def wall_panel(low, high, hole=None):
    """One bay of the outer wall: inner face, outer face and the cheeks of its opening.

    hole: None, ("arch", half width, sill, spring) or ("round", radius, centre y).
    """
    inner, outer = -AISLE, -AISLE - WALL
    half = BAY / 2
    plain = [(-half, low, high), (half, low, high)]
    if hole is None:
        return wall(plain, inner, outer, "front"), wall(plain, inner, outer, "back"), Mesh()
    if hole[0] == "arch":
        _, w, sill, spring = hole
        top = half_circle(0, spring, w, 16)
        bottom = [(x, sill) for x, _ in top]
    else:
        _, w, center = hole
        top = half_circle(0, center, w, 32)
        bottom = [(x, 2 * center - y) for x, y in top]
    faces = {}
    for face in ("front", "back"):
        mesh = Mesh()
        for x0, x1 in ((-half, -w), (w, half)):
            mesh.append(wall([(x0, low, high), (x1, low, high)], inner, outer, face))
        mesh.append(wall([(x, y, high) for x, y in top], inner, outer, face))
        mesh.append(wall([(x, low, y) for x, y in bottom], inner, outer, face))
        faces[face] = mesh
    cheeks = wall([(x, y, high) for x, y in top], inner, outer, "lower")
    if hole[0] == "arch":
        cheeks.append(box((-w, sill, outer), (w, spring, inner), skip="+z -z +y").flipped())
    else:
        cheeks.append(wall([(x, y, high) for x, y in top], inner, outer, "lower"), vec.product(
            vec.translation(0, 2 * center, 0), vec.scaling(1, -1, 1)))
    return faces["front"], faces["back"], cheeks


def arched_window():
    """A frame for an arched opening of half width 0.5 (sill at 0, spring at 1.3), and the pane; z = 0 on the wall."""
    runs = [[(-0.03, -0.12), (-0.03, 0.05)], [(-0.03, 0.05), (0.1, 0.05)], [(0.1, 0.05), (0.1, 0)]]
    frame = moulded_arch(0.5, runs, 16).moved(vec.translation(0, 1.3, 0))
    for side in (-1, 1):
        a, b = sorted((side * 0.47, side * 0.6))
        frame.append(box((a, 0, -0.12), (b, 1.3, 0.05), skip="-z +y"))
    frame.append(box((-0.68, -0.1, -0.12), (0.68, 0.0, 0.12), skip="-z"))
    pane = wall([(x, 0.0, y) for x, y in half_circle(0, 1.3, 0.5, 16)], -0.12, -0.12, "front")
    return frame, pane


def door():
    """A double door in an arched frame on the wall's inner face: stone frame, wooden leaves, iron bands."""
    runs = [[(0, 0), (0, 0.14)], [(0, 0.14), (0.16, 0.14)], [(0.16, 0.14), (0.2, 0.1), (0.22, 0)]]
    frame = moulded_arch(0.62, runs, 20).moved(vec.translation(0, 2.1, 0))
    for side in (-1, 1):
        a, b = sorted((side * 0.62, side * 0.78))
        frame.append(box((a, STEP, 0), (b, 2.1, 0.14), skip="-z -y +y"))
    leaves = wall([(x, STEP, y) for x, y in half_circle(0, 2.1, 0.62, 20)], 0.07, 0.0, "front")
    iron = Mesh()
    for y in (0.5, 1.2, 1.9):
        for side in (-1, 1):
            a, b = sorted((side * 0.05, side * 0.58))
            iron.append(box((a, y, 0.07), (b, y + 0.06, 0.095), skip="-z"))
    for x in (-0.1, 0.1):
        iron.append(sphere(0.05, 10, 8), vec.translation(x, 1.55, 0.12))
    return frame, leaves, iron


def niche():
    """A shallow arched niche with a frame and a shelf: the stone, the painted back."""
    frame = moulded_arch(0.55, [[(0, 0), (0, 0.16)], [(0, 0.16), (0.12, 0.16)], [(0.12, 0.16), (0.14, 0)]], 20)
    frame = frame.moved(vec.translation(0, 2.0, 0))
    for side in (-1, 1):
        a, b = sorted((side * 0.55, side * 0.67))
        frame.append(box((a, 1.0, 0), (b, 2.0, 0.16), skip="-z -y +y"))
    frame.append(bevelled_block(1.56, 0.14, 0.62, 0.03), vec.translation(0, 0.88, 0))
    frame.append(box((-0.78, 0.88, 0), (0.78, 0.9, 0.31), skip="-z +y +z +x -x"))
    return frame, wall([(x, 1.0, y) for x, y in half_circle(0, 2.0, 0.55, 20)], 0.07, 0.0, "front")


def rose_window(radius):
    """A moulded ring in a round opening, looking to +z, and the pane in it with uvs over its whole picture."""
    turn = vec.rotation("x", 90)
    frame = lathe([[(radius + 0.16, 0.0), (radius + 0.14, 0.06)], arc((radius + 0.07, 0.06), 0.07, 0, 180, 8),
                   [(radius, 0.06), (radius - 0.03, 0.0), (radius - 0.03, -0.2)]], 48).moved(turn)
    pane = disc(radius, 48).moved(vec.product(vec.translation(0, 0, -0.14), turn))
    pane.uvs = [(0.5 + x / (2 * radius), 0.5 - y / (2 * radius)) for x, y, _ in pane.positions]
    return frame, pane


def dado(gap=0.0):
    """The marble skirting of a bay's wall on the ground floor; gap: half width of the door in it."""
    mesh = Mesh()
    for a, b in ((-BAY / 2, -gap), (gap, BAY / 2)):
        mesh.append(box((a, STEP, 0), (b, 0.88, 0.06), skip="-z -y -x +x"))
    return mesh
