# SPDX-License-Identifier: MIT
"""The measures of the atrium, in metres.

The court is a rectangle of 7 by 3 square bays; an aisle one bay deep runs around it, a gallery above the aisle. What
belongs to a bay stands in the bay's frame: x along the arcade from -BAY / 2 to BAY / 2, z = 0 on the column line, +z towards the
court, the inner face of the outer wall at z = -AISLE.
"""

BAY = 2.6
BAYS = {"north": 7, "south": 7, "west": 3, "east": 3}  # of the arcade on each side
HALF_X, HALF_Z = BAYS["north"] * BAY / 2, BAYS["west"] * BAY / 2  # the column lines
AISLE = 2.6  # from the column line to the outer wall
WALL = 0.3  # thickness of the outer wall
WALL_X, WALL_Z = HALF_X + AISLE, HALF_Z + AISLE  # its inner faces

STEP = 0.16  # the aisles stand one step above the court
KERB = 0.45  # and reach so far into it
LOWER_SPRING, UPPER_FLOOR, UPPER_SPRING, EAVE = 3.2, 4.95, 7.5, 9.35
LOWER_RADIUS, UPPER_RADIUS = 1.05, 1.09  # of the arches
LOWER_HALF, UPPER_HALF = 0.2, 0.16  # half thickness of the arcade walls
VAULT_MIDDLE, VAULT_HALF, VAULT_RISE = -1.4, 1.2, 1.25  # across the aisle, behind the arcade wall
CORNICE = 0.22  # how far the string course below the gallery stands out
RAIL = 0.88  # height of a balustrade
CEILING = 8.95  # of the gallery

ROOF_OVERHANG, ROOF_DECK, ROOF_TOP = 0.36, 0.06, 10.65
ROOF_RUN, ROOF_RISE = AISLE + WALL + ROOF_OVERHANG, ROOF_TOP - EAVE - ROOF_DECK  # from the eave to the outer edge
WALL_TOP = 10.4


def bays(side):
    """The numbers of a side's bays, 0 in the middle."""
    reach = BAYS[side] // 2
    return range(-reach, reach + 1)


def column_lines(side):
    """x of a side's columns; the first and the last one stand in the corners."""
    return [(i - BAYS[side] / 2) * BAY for i in range(BAYS[side] + 1)]
