# SPDX-License-Identifier: MIT
"""The flight of stairs from the court to the gallery.

It climbs along -x; x = 0 is the foot of the lowest riser, z = 0 the middle of the steps.
"""

from generator import vector as vec
from generator.plan import RAIL, UPPER_FLOOR
from generator.geometry import Mesh, bevelled_block, box, half_circle, lathe, sphere, wall

STEPS = 28
GOING = 0.27
RISE = UPPER_FLOOR / STEPS
HALF_TREAD = 1.0  # half width of the steps
CHEEK = 0.24  # thickness of the walls beside them
CARPET = 0.62  # half width of the runner
LENGTH = (STEPS - 1) * GOING
PASSAGE = (-LENGTH + 1.5, 1.0, 1.85)  # the arched passage below: x of its middle, half width, height of its spring


def slope_height(x):
    """Height of the line along the front edges of the steps at x, from 0 to -LENGTH."""
    return -x / GOING * RISE + RISE


def step():
    """One step, its front edge at x = 0 and its top at y = RISE: stone, carpet."""
    stone, carpet = Mesh(), Mesh()
    for target, a, b in ((stone, -HALF_TREAD, -CARPET), (carpet, -CARPET, CARPET), (stone, CARPET, HALF_TREAD)):
        target.append(box((-GOING - 0.02, RISE - 0.045, a), (0.025, RISE, b), skip="-x -z +z"))
        target.polygon([(0, 0, b), (0, 0, a), (0, RISE - 0.045, a), (0, RISE - 0.045, b)])
    # The runner's pattern follows its way over tread and riser.
    repeat = GOING + RISE
    carpet.uvs = [((z + CARPET) / (2 * CARPET), (0.025 - x + RISE - y) / repeat) for x, y, z in carpet.positions]
    return stone, carpet


def cheek():
    """The wall below one side of the stairs with an arched passage, its middle at z = 0: the wall, its coping."""
    center, radius, spring = PASSAGE
    end = -LENGTH - 0.02

    def top(x):
        return slope_height(x) + 0.12

    arch = half_circle(center, spring, radius, 20)
    left = [(end, 0.0, top(end)), (center - radius, 0.0, top(center - radius))]
    right = [(center + radius, 0.0, top(center + radius)), (0.12, 0.0, top(0.12))]
    over = [(x, y, top(x)) for x, y in arch]
    z = CHEEK / 2
    mesh = wall(left, z, -z).append(wall(over, z, -z)).append(wall(right, z, -z, "front back right"))
    bounds = [(x, top(x) - 0.02, top(x) + 0.08) for x in (end, 0.16)]
    return mesh, wall(bounds, z + 0.035, -z - 0.035, "front back upper lower right")


def passage():
    """The vault and the side walls of the passage below the stairs, and the stairs' underside towards the gallery."""
    center, radius, spring = PASSAGE
    z = HALF_TREAD + CHEEK
    arch = [(x, y, 9.0) for x, y in half_circle(center, spring, radius, 20)]
    mesh = wall(arch, z, -z, "lower")
    for side in (-1, 1):
        x = center + side * radius
        corners = [(x, 0, -z), (x, 0, z), (x, spring, z), (x, spring, -z)]
        mesh.polygon(corners if side > 0 else corners[::-1])
    end = -LENGTH - 0.02
    top = slope_height(end)
    return mesh.polygon([(end, 0, -z), (end, 0, z), (end, top, z), (end, top, -z)])


def handrail():
    """The rail over the balusters of one side."""
    bounds = [(x, slope_height(x) + RAIL - 0.02, slope_height(x) + RAIL + 0.09) for x in (-LENGTH + 0.05, 0.0)]
    return wall(bounds, 0.1, -0.1, "front back upper lower left right")


def newel():
    """The post at the foot of the stairs, with a stone ball."""
    mesh = bevelled_block(0.5, 0.16, 0.5, 0.03)
    mesh.append(box((-0.19, 0.14, -0.19), (0.19, 1.22, 0.19), skip="+y -y"))
    runs = [[(0.2, 0.0), (0.22, 0.03), (0.31, 0.09)], [(0.31, 0.09), (0.31, 0.16)],
            [(0.31, 0.16), (0.16, 0.22), (0, 0.22)]]
    cap = lathe(runs, 4, 45, 405)
    mesh.append(cap, vec.translation(0, 1.2, 0))
    mesh.append(lathe([[(0.13, 0), (0.08, 0.04), (0.07, 0.09), (0.1, 0.12)]], 20), vec.translation(0, 1.42, 0))
    return mesh.append(sphere(0.19, 24, 16), vec.translation(0, 1.7, 0))
