# SPDX-License-Identifier: MIT
"""Three-dimensional vectors as tuples, affine transforms as three rows of four numbers."""

import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scaled(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(a):
    """a at unit length; up for a vector of no length."""
    length = math.sqrt(dot(a, a))
    return scaled(a, 1 / length) if length > 1e-12 else (0.0, 1.0, 0.0)


def mixed(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def translation(x, y, z):
    return ((1, 0, 0, x), (0, 1, 0, y), (0, 0, 1, z))


def scaling(x, y, z):
    return ((x, 0, 0, 0), (0, y, 0, 0), (0, 0, z, 0))


def rotation(axis, degrees):
    """A rotation about the axis "x", "y" or "z", counterclockwise when it points at the viewer."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return {
        "x": ((1, 0, 0, 0), (0, c, -s, 0), (0, s, c, 0)),
        "y": ((c, 0, s, 0), (0, 1, 0, 0), (-s, 0, c, 0)),
        "z": ((c, -s, 0, 0), (s, c, 0, 0), (0, 0, 1, 0)),
    }[axis]


def product(*transforms):
    """The transform that applies the last one first."""
    result = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0))
    for t in transforms:
        result = tuple(
            tuple(sum(row[k] * t[k][j] for k in range(3)) + (row[3] if j == 3 else 0) for j in range(4))
            for row in result)
    return result


def transformed(t, p):
    return tuple(row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3] for row in t)


def cofactors(t):
    """The 3x3 matrix that transforms normals (its sign follows a reflection, so that normals stay outside)."""
    r = [row[:3] for row in t]
    matrix = [cross(r[1], r[2]), cross(r[2], r[0]), cross(r[0], r[1])]
    return [scaled(row, -1) for row in matrix] if dot(r[0], matrix[0]) < 0 else matrix


def columns(t):
    """The 16 numbers of a glTF node matrix."""
    return [t[i][j] if i < 3 else float(j == 3) for j in range(4) for i in range(4)]


def quaternion(axis, degrees):
    """The rotation of a glTF node: x, y, z, w."""
    c, s = math.cos(math.radians(degrees) / 2), math.sin(math.radians(degrees) / 2)
    return [s * (axis == k) for k in "xyz"] + [c]


def look_at(eye, target):
    """Camera to world: at eye, looking along -z at target, y up."""
    back = normalized(sub(eye, target))
    right = normalized(cross((0, 1, 0), back))
    up = cross(back, right)
    return tuple((right[i], up[i], back[i], eye[i]) for i in range(3))
