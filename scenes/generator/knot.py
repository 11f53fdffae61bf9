# SPDX-License-Identifier: MIT
"""A (3, 5) torus knot: one closed surface without a seam, fluted, its colour running around it."""

import math

from generator import vector as vec
from generator.geometry import Mesh
from generator.glb import Document

AROUND_AXIS, AROUND_TUBE = 3, 5
ALONG, ACROSS = 750, 40  # divisions: 2 * ALONG * ACROSS triangles


def _center(t):
    a = 2 * math.pi * t
    r = 1.0 + 0.42 * math.cos(AROUND_TUBE * a)
    return (r * math.cos(AROUND_AXIS * a), 0.46 * math.sin(AROUND_TUBE * a), r * math.sin(AROUND_AXIS * a))


def _frame(t):
    """Point, and two directions across the curve that return to themselves after one way around it."""
    e = 1e-4
    p = _center(t)
    tangent = vec.normalized(vec.sub(_center(t + e), _center(t - e)))
    side = vec.normalized(vec.cross(tangent, (p[0], 0.0, p[2])))
    return p, vec.cross(side, tangent), side


def _surface(u, v):
    p, normal, side = _frame(v)
    a = 2 * math.pi * (u + 2 * v)
    flute = math.cos(6 * (a - 2 * math.pi * v))
    n = vec.add(vec.scaled(normal, math.cos(a)), vec.scaled(side, math.sin(a)))
    return vec.add(p, vec.scaled(n, 0.148 + 0.010 * flute))


def _color(u, v):
    """Linear: four hues that follow each other along the knot, darker in the flutes."""
    hues = ((0.72, 0.12, 0.06), (0.80, 0.48, 0.07), (0.05, 0.36, 0.33), (0.10, 0.12, 0.48))
    at = v * len(hues)
    i, t = int(at) % len(hues), at % 1
    color = vec.mixed(hues[i], hues[(i + 1) % len(hues)], t * t * (3 - 2 * t))
    flute = 0.5 + 0.5 * math.cos(6 * (2 * math.pi * (u + 2 * v) - 2 * math.pi * v))
    return vec.scaled(color, 0.62 + 0.38 * flute)


def build():
    mesh, e = Mesh(), 1e-4
    for j in range(ALONG):
        for i in range(ACROSS):
            u, v = i / ACROSS, j / ALONG
            du = vec.sub(_surface(u + e, v), _surface(u - e, v))
            dv = vec.sub(_surface(u, v + e / 10), _surface(u, v - e / 10))
            mesh.vertex(_surface(u, v), vec.normalized(vec.cross(du, dv)), color=_color(u, v))
    for j in range(ALONG):
        for i in range(ACROSS):
            a, b = j * ACROSS + i, j * ACROSS + (i + 1) % ACROSS
            c, d = ((k + ACROSS) % (ALONG * ACROSS) for k in (b, a))
            mesh.triangles += [(a, b, c), (a, c, d)]
    document = Document("CC0 1.0: no rights reserved")
    material = document.material("glaze", roughness=0.4)
    document.node("knot", mesh=document.mesh("knot", (mesh.without_uvs(), material)))
    document.camera("default", vec.columns(vec.look_at((1.9, 2.6, 3.2), (0.0, -0.08, 0.0))), math.radians(36), 16 / 9)
    return document
