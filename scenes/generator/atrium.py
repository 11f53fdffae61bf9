# SPDX-License-Identifier: MIT
"""A courtyard of two storeys: arcades around an open court, stairs, a fountain, drapes, plants, lanterns."""

import math

from generator import atrium_building as building
from generator import atrium_interior as interior
from generator import foliage, textures
from generator import vector as vec
from generator.composer import Composer
from generator.glb import CLAMP_TO_EDGE, REPEAT
from generator.textures import rgb

CAMERAS = (  # name, eye, target, vertical field of view in degrees
    ("default", (-8.5, 3.4, 2.0), (4.0, 2.8, -1.3), 54.0),
    ("floor", (-7.4, 1.45, 0.7), (3.0, 3.5, -0.9), 60.0),
    ("gallery", (8.3, 6.6, 1.4), (-2.0, 2.5, -1.6), 60.0),
    ("roof", (-11.0, 19.0, 10.0), (0.0, 2.0, -0.6), 48.0),
)


def _textured_materials(composer):
    def add(name, picture, period=None, wrap=REPEAT, **settings):
        texture = composer.document.texture(name, picture, wrap)
        if settings.pop("glowing", False):
            settings["emission_texture"] = texture
        composer.material(name, texture=texture, period=period, **settings)

    t = textures
    add("court floor", t.court_floor(), roughness=0.35)
    add("marble", t.marble(), 1.3, roughness=0.5)
    add("limestone", t.ashlar(), 2.6)
    add("brick", t.brick(), 1.3)
    add("ochre", t.plaster(rgb("f1dfb8"), rgb("e6c998"), 71), 2.6)
    add("rose plaster", t.plaster(rgb("d08a68"), rgb("bc7052"), 72), 2.6)
    add("starry vault", t.starry_vault())
    add("terracotta tiles", t.gallery_floor(), 1.3)
    add("wood", t.wood(45, rgb("a3733f"), rgb("6b4525"), 6), 1.3)
    add("red cloth", t.drape(rgb("c02630"), rgb("86141f")), 1.3, double_sided=True)
    add("blue cloth", t.drape(rgb("2a4fa8"), rgb("182f70")), 1.3, double_sided=True)
    add("green cloth", t.drape(rgb("2f7d4a"), rgb("175030")), 1.3, double_sided=True)
    add("carpet", t.runner())
    leaf = {"wrap": CLAMP_TO_EDGE, "alpha_mode": "MASK", "alpha_cutoff": 0.4, "double_sided": True}
    add("orange leaves", foliage.leaf_cluster(77, rgb("274f22"), rgb("79a840"), rgb("b5d074"), 22, 0.25, 0.075), **leaf)
    add("ivy", foliage.ivy(), **leaf)
    add("fern", foliage.frond(), **leaf)
    add("bougainvillea", foliage.flowers(), **leaf)
    glass = {"alpha_mode": "BLEND", "double_sided": True, "roughness": 0.1}
    add("leaded glass", t.leaded_glass(), **glass)
    add("rose window", t.stained_glass(), wrap=CLAMP_TO_EDGE, glowing=True, emission=(1, 1, 1), strength=1.6, **glass)
    add("water", t.water(), 1.1, alpha_mode="BLEND", roughness=0.05)


def _plain_materials(composer):
    add = composer.material
    add("mosaic", (0.06, 0.30, 0.36))
    add("jet", (0.70, 0.88, 0.92, 0.55), alpha_mode="BLEND", roughness=0.05)
    add("blue glaze", (0.045, 0.13, 0.42), roughness=0.3)
    add("white glaze", (0.82, 0.80, 0.74), roughness=0.3)
    add("gold", (0.86, 0.60, 0.20), roughness=0.4, metallic=0.6, double_sided=True)
    add("iron", (0.07, 0.06, 0.055), roughness=0.6)
    add("bronze", (0.22, 0.13, 0.06), roughness=0.5, metallic=0.5)
    add("patina", roughness=0.4, metallic=0.3)  # coloured by its vertices, like the roof's tiles
    add("roof tile")
    add("terracotta", (0.50, 0.17, 0.085))
    add("earth", (0.09, 0.055, 0.035))
    add("bark", (0.20, 0.13, 0.08))
    add("orange", (0.90, 0.34, 0.03), roughness=0.5)
    add("lamp glass", (0.9, 0.75, 0.5), emission=(1.0, 0.56, 0.20), strength=6.0)


def build():
    composer = Composer("CC0 1.0: no rights reserved")
    _textured_materials(composer)
    _plain_materials(composer)
    sides = building.make_sides(composer)
    building.floors(composer)
    building.arcades(composer, sides)
    building.aisles(composer, sides)
    building.outer_walls(composer, sides)
    building.tiled_roof(composer, sides)
    flight = building.flight_of_stairs(composer)
    interior.fountain(composer)
    interior.drapes(composer, sides)
    interior.lanterns(composer, sides)
    interior.benches(composer)
    interior.potted_plants(composer)
    interior.creepers(composer, sides, flight)
    for name, eye, target, fov in CAMERAS:
        composer.document.camera(name, vec.columns(vec.look_at(eye, target)), math.radians(fov), 16 / 9)
    return composer.document
