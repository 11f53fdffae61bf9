# SPDX-License-Identifier: MIT
"""The Cornell box, from the measurements that the Cornell University Program of Computer Graphics publishes, in metres.

https://www.graphics.cornell.edu/online/box/data.html. The camera looks along +z, so x runs to the left in the picture.
The reflectances and the light are the usual RGB versions of the published spectra.
"""

import math

from generator import vector as vec
from generator.geometry import Mesh
from generator.glb import Document

# The published corners in millimetres. Quadrilaterals, counterclockwise from where they are seen.
WHITE_WALLS = [
    [(552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2)],  # floor
    [(556, 548.8, 0), (556, 548.8, 559.2), (0, 548.8, 559.2), (0, 548.8, 0)],  # ceiling
    [(549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2)],  # back wall
]
GREEN_WALL = [[(0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2)]]
RED_WALL = [[(552.8, 0, 0), (549.6, 0, 559.2), (556, 548.8, 559.2), (556, 548.8, 0)]]
LIGHT_HEIGHT = 548.3  # published at the ceiling's height; half a millimetre lower, so that it is seen
LIGHT = [[(343, LIGHT_HEIGHT, 227), (343, LIGHT_HEIGHT, 332), (213, LIGHT_HEIGHT, 332), (213, LIGHT_HEIGHT, 227)]]
SHORT_BLOCK = [
    [(130, 165, 65), (82, 165, 225), (240, 165, 272), (290, 165, 114)],
    [(290, 0, 114), (290, 165, 114), (240, 165, 272), (240, 0, 272)],
    [(130, 0, 65), (130, 165, 65), (290, 165, 114), (290, 0, 114)],
    [(82, 0, 225), (82, 165, 225), (130, 165, 65), (130, 0, 65)],
    [(240, 0, 272), (240, 165, 272), (82, 165, 225), (82, 0, 225)],
]
TALL_BLOCK = [
    [(423, 330, 247), (265, 330, 296), (314, 330, 456), (472, 330, 406)],
    [(423, 0, 247), (423, 330, 247), (472, 330, 406), (472, 0, 406)],
    [(472, 0, 406), (472, 330, 406), (314, 330, 456), (314, 0, 456)],
    [(314, 0, 456), (314, 330, 456), (265, 330, 296), (265, 0, 296)],
    [(265, 0, 296), (265, 330, 296), (423, 330, 247), (423, 0, 247)],
]
EYE = (278, 273, -800)
FOCAL_LENGTH, FILM = 35, 25  # the same unit; the film is square


def _metres(point):
    return tuple(c / 1000 for c in point)


def build():
    document = Document("CC0 1.0: no rights reserved; measurements: Cornell University Program of Computer Graphics")
    white = document.material("white", (0.725, 0.71, 0.68), roughness=1.0)
    green = document.material("green", (0.14, 0.45, 0.091), roughness=1.0)
    red = document.material("red", (0.63, 0.065, 0.05), roughness=1.0)
    radiance = {"emission": (1.0, 12 / 17, 4 / 17), "strength": 17.0}
    light = document.material("light", (0.78, 0.78, 0.78), roughness=1.0, **radiance)
    for name, quads, material in (
        ("white walls", WHITE_WALLS, white), ("green wall", GREEN_WALL, green), ("red wall", RED_WALL, red),
        ("short block", SHORT_BLOCK, white), ("tall block", TALL_BLOCK, white), ("light", LIGHT, light),
    ):
        mesh = Mesh()
        for quad in quads:
            mesh.polygon([_metres(p) for p in quad])
        document.node(name, mesh=document.mesh(name, (mesh.without_uvs(), material)))
    eye = _metres(EYE)
    forward = vec.add(eye, (0, 0, 1))
    fov = 2 * math.atan(FILM / 2 / FOCAL_LENGTH)
    document.camera("default", vec.columns(vec.look_at(eye, forward)), fov, 1.0, near=0.01, far=10.0)
    return document
