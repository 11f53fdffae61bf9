# SPDX-License-Identifier: MIT
"""Puts up the atrium's building: floors, arcades, outer walls, roof, stairs."""

import math

from generator import architecture, roof, stairs
from generator import vector as vec
from generator.furnishings import urn
from generator.geometry import Mesh, box, loop_sweep, tube
from generator.plan import (AISLE, BAY, BAYS, CORNICE, EAVE, HALF_X, HALF_Z, KERB, LOWER_HALF, LOWER_RADIUS,
                            LOWER_SPRING, ROOF_OVERHANG, ROOF_RISE, ROOF_RUN, ROOF_TOP, STEP, UPPER_FLOOR, UPPER_HALF,
                            UPPER_RADIUS, UPPER_SPRING, VAULT_HALF, VAULT_MIDDLE, VAULT_RISE, WALL, WALL_TOP, WALL_X,
                            WALL_Z, bays, column_lines)

STAIR_FOOT = HALF_X - LOWER_HALF - CORNICE - stairs.LENGTH  # x where the stairs begin; they climb along +x
WINDOW_SILL, WINDOW_SPRING, WINDOW_HALF = 6.05, 7.35, 0.5
ROSE_CENTER, ROSE_RADIUS = 7.25, 1.0


def make_sides(composer):
    """The frames of the four sides: x along the arcade, z = 0 on the column line, +z towards the court."""
    return {
        "north": composer.group("north side", (0, 0, -HALF_Z)),
        "south": composer.group("south side", (0, 0, HALF_Z), scale=[1, 1, -1]),
        "west": composer.group("west side", (-HALF_X, 0, 0), rotation=vec.quaternion("y", 90)),
        "east": composer.group("east side", (HALF_X, 0, 0), rotation=vec.quaternion("y", -90)),
    }


def _ring(inner_x, inner_z, y):
    """A level floor between a rectangle and the outer walls."""
    mesh = Mesh()
    for x0, z0, x1, z1 in ((-WALL_X, -WALL_Z, WALL_X, -inner_z), (-WALL_X, inner_z, WALL_X, WALL_Z),
                           (-WALL_X, -inner_z, -inner_x, inner_z), (inner_x, -inner_z, WALL_X, inner_z)):
        mesh.append(box((x0, 0, z0), (x1, y, z1), skip="-x +x -y -z +z"))
    return mesh


def floors(composer):
    """The court is two triangles, 17 m long; its texture has one repeat for each bay."""
    x, z = HALF_X - KERB + 0.05, HALF_Z - KERB + 0.05
    court = Mesh().polygon([(-x, 0, z), (x, 0, z), (x, 0, -z), (-x, 0, -z)])
    court.uvs = [(p[0] / BAY + 0.5, p[2] / BAY + 0.5) for p in court.positions]
    composer.define("court floor", (court, "court floor"))
    kerb = [[(2 * KERB, 0), (2 * KERB, STEP - 0.02)], [(2 * KERB, STEP - 0.02), (2 * KERB - 0.02, STEP), (0, STEP)]]
    composer.define("kerb", (loop_sweep(kerb, HALF_X + KERB, HALF_Z + KERB, inward=True), "marble"))
    composer.define("aisle floor", (_ring(HALF_X + KERB, HALF_Z + KERB, STEP), "terracotta tiles"))
    composer.define("gallery floor", (_ring(HALF_X - LOWER_HALF, HALF_Z - LOWER_HALF, UPPER_FLOOR), "terracotta tiles"))
    for name in ("court floor", "kerb", "aisle floor", "gallery floor"):
        composer.place(name)


def arcades(composer, sides):
    define, place = composer.define, composer.place
    panel = architecture.arcade_panel
    define("lower arch", (panel(LOWER_SPRING, LOWER_RADIUS, UPPER_FLOOR - 0.2, LOWER_HALF), "limestone"))
    define("upper arch", (panel(UPPER_SPRING, UPPER_RADIUS, EAVE + 0.06, UPPER_HALF), "ochre"))
    define("lower archivolt", (architecture.archivolt(LOWER_SPRING, LOWER_RADIUS, LOWER_HALF), "marble"))
    define("upper archivolt", (architecture.archivolt(UPPER_SPRING, UPPER_RADIUS, UPPER_HALF), "marble"))
    define("lower column", (architecture.lower_column(), "marble"))
    define("upper column", (architecture.upper_column(), "marble"))
    define("pedestal", (architecture.pedestal(), "marble"))
    define("baluster", (architecture.baluster(), "marble"))
    define("rails", (architecture.rails(-BAY / 2 + 0.19, BAY / 2 - 0.19), "marble"))
    define("tie rod", (tube([(-LOWER_RADIUS, 0, 0), (LOWER_RADIUS, 0, 0)], 0.024, 6), "iron"))
    dish, rim, rosette = architecture.roundel()
    define("roundel", (dish, "blue glaze"), (rim, "white glaze"), (rosette, "gold"))

    for side, parent in sides.items():
        for i in bays(side):
            bay = composer.group(f"{side} bay {i}", (i * BAY, 0, 0), parent)
            for part in ("lower arch", "lower archivolt", "upper arch", "upper archivolt"):
                place(part, parent=bay)
            place("tie rod", (0, LOWER_SPRING + 0.06, 0), bay)
            if (side, i) != ("east", 0):  # where the stairs arrive
                place("rails", (0, UPPER_FLOOR, 0), bay)
                for k in range(-4, 5):
                    place("baluster", (k * 0.235, UPPER_FLOOR + 0.12, 0), bay)
        lines = column_lines(side)
        for i, x in enumerate(lines):
            corner = x in (lines[0], lines[-1])
            if not corner:
                place("roundel", (x, 4.17, LOWER_HALF), parent)
            if not corner or side in ("north", "south"):
                turn = vec.quaternion("y", 90 * (i % 4))  # the marble's veins do not repeat from column to column
                place("lower column", (x, 0, 0), parent, turn)
                place("upper column", (x, 0, 0), parent, turn)
                place("pedestal", (x, UPPER_FLOOR, 0), parent)

    lower = architecture.cornice(HALF_X - LOWER_HALF, HALF_Z - LOWER_HALF, 4.50, UPPER_FLOOR, CORNICE)
    upper = architecture.cornice(HALF_X - UPPER_HALF, HALF_Z - UPPER_HALF, 8.80, 9.16, 0.13)
    define("string course", (lower, "marble"))
    define("cornice", (upper, "marble"))
    place("string course")
    place("cornice")


def aisles(composer, sides):
    """The vaults on their ribs below, the coffered ceiling above."""
    define, place = composer.define, composer.place
    define("vault", (architecture.cross_vault(), "starry vault"))
    define("rib", (architecture.rib(0.15), "limestone"))
    define("corner rib", (architecture.rib(0.2), "limestone"))
    define("pilaster", (architecture.pilaster(), "marble"))
    planks, beams, rosettes = roof.coffers()
    define("coffers", (planks, "wood"), (beams, "wood"), (rosettes, "gold"))
    across = vec.quaternion("y", 90)
    for side, parent in sides.items():
        numbers = list(bays(side))
        for i in numbers:
            place("vault", (i * BAY, LOWER_SPRING, VAULT_MIDDLE), parent, scale=[BAY / 2, VAULT_RISE, VAULT_HALF])
        lines = column_lines(side)
        for x in lines:
            place("corner rib" if x in (lines[0], lines[-1]) else "rib", (x, 0, VAULT_MIDDLE), parent, across)
            place("pilaster", (x, 0, -AISLE), parent)
        if side in ("north", "south"):  # these have the corners
            for sign in (-1, 1):
                place("vault", (sign * (HALF_X - VAULT_MIDDLE), LOWER_SPRING, VAULT_MIDDLE), parent,
                      scale=[VAULT_HALF, VAULT_RISE, VAULT_HALF])
            numbers = [numbers[0] - 1, *numbers, numbers[-1] + 1]
        for i in numbers:
            place("coffers", (i * BAY, 0, 0), parent)


def _define_wall(composer, name, low, high, inner, outer, hole=None):
    face, back, cheeks = architecture.wall_panel(low, high, hole)
    composer.define(name, (face, inner), (back, outer), (cheeks, "limestone"))


def outer_walls(composer, sides):
    define, place = composer.define, composer.place
    _define_wall(composer, "lower wall", 0.0, UPPER_FLOOR, "rose plaster", "limestone")
    _define_wall(composer, "upper wall", UPPER_FLOOR, WALL_TOP, "ochre", "brick")
    _define_wall(composer, "window wall", UPPER_FLOOR, WALL_TOP, "ochre", "brick",
                 ("arch", WINDOW_HALF, WINDOW_SILL, WINDOW_SPRING))
    _define_wall(composer, "rose window wall", UPPER_FLOOR, WALL_TOP, "ochre", "brick",
                 ("round", ROSE_RADIUS, ROSE_CENTER))
    frame, pane = architecture.arched_window()
    pane.uvs = [(x / (2 * WINDOW_HALF) + 0.5, 1 - y / 1.8) for x, y, _ in pane.positions]
    define("window", (frame, "marble"), (pane, "leaded glass"))
    frame, pane = architecture.rose_window(ROSE_RADIUS)
    define("rose window", (frame, "marble"), (pane, "rose window"))
    frame, leaves, iron = architecture.door()
    define("door", (frame, "marble"), (leaves, "wood"), (iron, "iron"))
    frame, back = architecture.niche()
    define("niche", (frame, "marble"), (back, "ochre"))
    define("urn", (urn(), "marble"))
    define("dado", (architecture.dado(), "marble"))
    define("dado beside a door", (architecture.dado(0.7), "marble"))
    define("quoin", (box((-0.2, 0, -0.2), (0.2, WALL_TOP, 0.2), skip="-y +y"), "limestone"))

    for side, parent in sides.items():
        reach = BAYS[side] // 2 + 1
        for i in range(-reach, reach + 1):
            x, corner, rose = i * BAY, abs(i) == reach, (side, i) == ("east", 0)
            place("lower wall", (x, 0, 0), parent)
            door = not corner and i % 2 == 0 and not rose
            place("dado beside a door" if door else "dado", (x, 0, -AISLE), parent)
            if door:
                place("door", (x, 0, -AISLE), parent)
            elif not corner:
                place("niche", (x, 0, -AISLE), parent)
                place("urn", (x, 1.02, -AISLE + 0.22), parent, scale=[1.25, 1.35, 0.62])
            if rose:
                place("rose window wall", (x, 0, 0), parent)
                place("rose window", (x, ROSE_CENTER, -AISLE), parent)
            elif not corner and i % 2:
                place("window wall", (x, 0, 0), parent)
                place("window", (x, WINDOW_SILL, -AISLE), parent)
            else:
                place("upper wall", (x, 0, 0), parent)
                if not corner:
                    place("door", (x, UPPER_FLOOR - STEP, -AISLE), parent)
    for sx in (-1, 1):
        for sz in (-1, 1):
            place("quoin", (sx * (WALL_X + 0.15), 0, sz * (WALL_Z + 0.15)), scale=[sx, 1, sz])


def tiled_roof(composer, sides):
    define, place = composer.define, composer.place
    eave_x, eave_z = HALF_X - ROOF_OVERHANG, HALF_Z - ROOF_OVERHANG
    upper, lower = roof.roof_deck(eave_x, eave_z)
    define("roof deck", (upper, "terracotta"), (lower, "wood"))
    place("roof deck")
    valley = tube([(eave_x, EAVE + 0.04, eave_z), (eave_x + ROOF_RUN, ROOF_TOP - 0.02, eave_z + ROOF_RUN)], 0.1, 8)
    define("valley", (valley, "terracotta"))
    for sx in (-1, 1):
        for sz in (-1, 1):
            place("valley", scale=[sx, 1, sz])
    coping = [[(0.0, WALL_TOP - 0.05), (0.09, WALL_TOP), (0.09, ROOF_TOP + 0.08)],
              [(0.09, ROOF_TOP + 0.08), (-0.02, ROOF_TOP + 0.17), (-0.26, ROOF_TOP + 0.15)],
              [(-0.26, ROOF_TOP + 0.15), (-0.26, ROOF_TOP - 0.2)]]
    define("coping", (loop_sweep(coping, WALL_X + WALL, WALL_Z + WALL), "limestone"))
    place("coping")

    define("rafter", (roof.rafter(), "wood"))
    for count in range(1, roof.TILES + 1):
        define(f"{count} tiles", (roof.tile_row(count, count), "roof tile"))
    define("other tiles", (roof.tile_row(roof.TILES, 10), "roof tile"))
    length = math.hypot(ROOF_RUN, ROOF_RISE)
    pitch = vec.quaternion("x", math.degrees(math.atan2(ROOF_RISE, ROOF_RUN)))
    for side, parent in sides.items():
        eave, outer = (eave_x, WALL_X + WALL) if side in ("north", "south") else (eave_z, WALL_Z + WALL)
        for k, x in enumerate(_spread(outer, 0.26)):
            free = length * (1 - max(0.0, abs(x) - eave) / ROOF_RUN)  # down to the valley
            count = min(roof.TILES, round(free / roof.TILE + 0.1))
            if count:
                name = "other tiles" if count == roof.TILES and k * 7 % 5 % 2 else f"{count} tiles"
                place(name, (x, ROOF_TOP, -AISLE - WALL), parent, pitch)
        for x in _spread(eave, 0.52):
            place("rafter", (x, EAVE + ROOF_RISE / ROOF_RUN * ROOF_OVERHANG, 0), parent)


def _spread(half, spacing):
    """Places from -half to half, that far apart, as many as fit."""
    count = int(2 * half / spacing + 1e-6)
    return [(k - (count - 1) / 2) * spacing for k in range(count)]


def flight_of_stairs(composer):
    """Returns the group of the flight, in the frame of generator.stairs."""
    define, place = composer.define, composer.place
    stone, carpet = stairs.step()
    define("step", (stone, "marble"), (carpet, "carpet"))
    side, coping = stairs.cheek()
    define("stair wall", (side, "limestone"), (coping, "marble"))
    define("stair rail", (stairs.handrail(), "marble"))
    define("newel", (stairs.newel(), "marble"))
    define("passage", (stairs.passage(), "limestone"))
    flight = composer.group("stairs", (STAIR_FOOT, 0, 0), rotation=vec.quaternion("y", 180))
    for k in range(stairs.STEPS - 1):  # the gallery is the last one
        place("step", (-k * stairs.GOING, k * stairs.RISE, 0), flight)
    for name, sign in (("north", 1), ("south", -1)):
        z = sign * (stairs.HALF_TREAD + stairs.CHEEK / 2)
        half = composer.group(f"stairs {name}", (0, 0, z), flight, scale=[1, 1, sign])
        place("stair wall", parent=half)
        place("stair rail", parent=half)
        for k in range(1, stairs.STEPS - 1):
            x = -(k - 0.5) * stairs.GOING
            place("baluster", (x, stairs.slope_height(x) + 0.155, 0), half, scale=[1, 1.15, 1])
        place("newel", (0.2, 0, 0), half)
    place("passage", parent=flight)
    return flight
