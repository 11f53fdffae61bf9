# SPDX-License-Identifier: MIT
"""Furnishes the atrium: fountain, drapes, lanterns, benches, plants."""

import math

from generator import furnishings, plants, stairs
from generator import vector as vec
from generator.atrium_building import STAIR_FOOT
from generator.geometry import Mesh
from generator.plan import (BAY, BAYS, CEILING, CORNICE, HALF_X, HALF_Z, LOWER_HALF, LOWER_SPRING, RAIL, STEP,
                            UPPER_FLOOR, VAULT_MIDDLE, VAULT_RISE, bays, column_lines)

FOUNTAIN = (-2.6, 0.0, 0.0)
COLORS = ("red", "blue", "green")


def fountain(composer):
    define, place = composer.define, composer.place
    stone, mosaic, surface = furnishings.basin()
    pillar, bowl = furnishings.fountain_column()
    define("basin", (stone, "marble"), (mosaic, "mosaic"), (Mesh().append(surface).append(bowl), "water"))
    define("fountain pillar", (pillar, "marble"))
    define("jet", (furnishings.jet(), "jet"))
    define("a third of the knot", (furnishings.knot_third(140, 36), "patina"))
    parent = composer.group("fountain", FOUNTAIN)
    place("basin", parent=parent)
    place("fountain pillar", parent=parent)
    for k in range(8):
        place("jet", parent=parent, rotation=vec.quaternion("y", 45 * k + 22.5))
    # The axis of the knot's symmetry lies along the court.
    upright = vec.product(vec.translation(0, 2.42, 0), vec.rotation("z", 90), vec.rotation("y", 90))
    sculpture = composer.document.node("sculpture", parent=parent, matrix=vec.columns(upright))
    for k in range(3):
        place("a third of the knot", parent=sculpture, rotation=vec.quaternion("y", 120 * k))


def drapes(composer, sides):
    define, place = composer.define, composer.place
    curtain, band = furnishings.curtain(), furnishings.tie_band()
    cloth, hem = furnishings.banner()
    for color in COLORS:
        define(f"{color} curtain", (curtain, f"{color} cloth"), (band, "gold"))
        define(f"{color} banner", (cloth, f"{color} cloth"), (hem, "gold"))
    for side, shift, numbers in (("north", 0, (3, 1, -1, -3)), ("south", 1, (3, 1, -1, -3)), ("west", 0, (1, -1))):
        for n, i in enumerate(numbers):
            for sign in (-1, 1):
                place(f"{COLORS[(n + shift) % 3]} curtain", (i * BAY - sign, LOWER_SPRING + 0.04, 0), sides[side],
                      scale=[sign, 1, 1])
    for side, shift, numbers in (("north", 1, (2, 0, -2)), ("south", 2, (2, 0)), ("west", 1, (0,))):
        for n, i in enumerate(numbers):
            place(f"{COLORS[(n + shift) % 3]} banner", (i * BAY, UPPER_FLOOR + RAIL, 0), sides[side])


def lanterns(composer, sides):
    bronze, glass = furnishings.lantern()
    composer.define("lantern", (bronze, "bronze"), (glass, "lamp glass"))
    for side, parent in sides.items():
        for i in bays(side):
            if i % 2 == 0:
                composer.place("lantern", (i * BAY, LOWER_SPRING + VAULT_RISE - 0.03, VAULT_MIDDLE), parent)
            if i % 2 or BAYS[side] == 3:
                composer.place("lantern", (i * BAY, CEILING - 0.13, -1.3), parent)


def benches(composer):
    composer.define("bench", (furnishings.bench(), "marble"))
    for x in (3.9, -1.3):
        for sign in (-1, 1):
            composer.place("bench", (x, 0, sign * (HALF_Z - 0.85)))


def potted_plants(composer):
    define, place = composer.define, composer.place
    pot, earth = plants.pot(0.36, 0.58)
    define("pot", (pot, "terracotta"), (earth, "earth"))
    pot, earth = plants.pot(0.24, 0.36)
    define("small pot", (pot, "terracotta"), (earth, "earth"))
    leaves, wood, fruit = plants.citrus_tree(5)
    define("orange tree", (leaves, "orange leaves"), (wood, "bark"), (fruit, "orange"))
    define("fern", (plants.fern(9, 26, 0.85), "fern"))

    def tree(x, z, turn, size):
        node = composer.group("orange tree", (x, 0, z), rotation=vec.quaternion("y", turn), scale=[size] * 3)
        place("pot", parent=node)
        place("orange tree", (0, 0.52, 0), node)

    def fern(x, y, z, turn, size):
        node = composer.group("fern", (x, y, z), rotation=vec.quaternion("y", turn), scale=[size] * 3)
        place("small pot", parent=node)
        place("fern", (0, 0.33, 0), node)

    for sign in (-1, 1):
        for n, x in enumerate((6.5, 1.3, -3.9, -6.5)):
            tree(x, sign * (HALF_Z - 0.95), 80 * n + 40 * sign, 0.92 + 0.05 * (n % 3))
        fern(STAIR_FOOT - 0.75, 0, sign * 1.25, 50 * sign, 1.05)
        fern(0.95 - HALF_X, 0, sign * 2.6, 90 * sign, 1.2)
        fern(0.9 - HALF_X, 0, sign * 1.3, 20 * sign, 0.9)


def creepers(composer, sides, flight):
    define, place = composer.define, composer.place
    define("vine", (plants.column_creeper(21, 150, 0.22, 3.0, 1.6, 0.30), "ivy"))
    define("hanging ivy", (plants.hanging_mass(31, 170, 2.0, 1.5, 0.32), "ivy"))
    define("hanging bougainvillea", (plants.hanging_mass(41, 170, 1.9, 1.35, 0.34), "bougainvillea"))
    define("stair ivy", (_stair_ivy(), "ivy"))
    for side, line, turn in (("north", 6, 0), ("north", 2, -120), ("south", 5, -60), ("south", 1, -200)):
        place("vine", (column_lines(side)[line], STEP, 0), sides[side], vec.quaternion("y", turn))
    for side, i, name, sign in (
        ("north", 1, "ivy", -1), ("south", -1, "ivy", 1), ("south", -3, "ivy", -1), ("east", -1, "ivy", -1),
        ("north", -3, "bougainvillea", -1), ("north", 3, "bougainvillea", 1), ("south", 3, "bougainvillea", 1),
        ("east", 1, "bougainvillea", -1),
    ):
        place(f"hanging {name}", (i * BAY, UPPER_FLOOR, LOWER_HALF + CORNICE), sides[side], scale=[sign, 1, 1])
    for sign in (1, -1):
        place("stair ivy", parent=flight, scale=[1, 1, sign])


def _stair_ivy():
    """Ivy on one wall of the stairs, densest at the foot of the wall; the passage stays free."""
    z = stairs.HALF_TREAD + stairs.CHEEK
    middle, radius, spring = stairs.PASSAGE

    def place(source):
        while True:
            x = -stairs.LENGTH * source.random()
            y = (stairs.slope_height(x) + 0.15) * (1 - source.random() ** 0.7)
            free = math.hypot(x - middle, max(0.0, y - spring)) > radius + 0.12
            patch = math.sin(2.1 * x + 0.4) + math.sin(1.3 * y + 0.7 * x) > -0.25
            if free and patch:
                return (x, y, z), (0.0, 0.0, 1.0)

    return plants.creeper(51, 330, place, 0.30, floor=0.26)
