# SPDX-License-Identifier: MIT
"""A cube with edges of one metre around the origin: what scene files put things on."""

import math

from generator import vector as vec
from generator.geometry import box
from generator.glb import Document


def build():
    document = Document("CC0 1.0: no rights reserved")
    material = document.material("stone", (0.42, 0.40, 0.37), roughness=0.9)
    mesh = box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)).without_uvs()
    document.node("cube", mesh=document.mesh("cube", (mesh, material)))
    document.camera("default", vec.columns(vec.look_at((1.5, 1.3, 2.2), (0.0, 0.0, 0.0))), math.radians(36), 16 / 9)
    return document
