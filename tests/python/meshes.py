# SPDX-License-Identifier: MIT
"""Meshes that tests make: (vertices (V, 3) float32, faces (F, 3) uint32)."""

import numpy as np


def cube(edge=1.0):
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float32) * np.float32(edge)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], np.uint32)


def sheet(rows, columns, place, wraps=(False, False)):
    """place(u, v), from 0 to 1 each: the positions of a sheet of so many quads, whose ends may be joined."""
    u, v = np.meshgrid(np.arange(rows + 1), np.arange(columns + 1), indexing="ij")
    index = (u % rows if wraps[0] else u) * (columns + 1) + (v % columns if wraps[1] else v)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    faces = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    return place(u.ravel() / rows, v.ravel() / columns).astype(np.float32), faces.astype(np.uint32)


def sphere(rows=24, radius=1.0):
    def place(u, v):
        polar, around = np.pi * u, 2 * np.pi * v
        return radius * np.stack([np.sin(polar) * np.cos(around), np.cos(polar), np.sin(polar) * np.sin(around)], -1)

    return sheet(rows, 2 * rows, place, (False, True))


def torus(rows=32, thin=0.3):
    def place(u, v):
        ring, tube = 2 * np.pi * u, 2 * np.pi * v
        out = 1 + thin * np.cos(tube)
        return np.stack([out * np.cos(ring), thin * np.sin(tube), out * np.sin(ring)], -1)

    return sheet(rows, rows, place, (True, True))


def waves(rows=40):
    return sheet(rows, rows, lambda u, v: np.stack([u, 0.2 * np.sin(9 * u) * np.cos(7 * v), v], -1))


def soup(count, seed, size=0.3):
    """Triangles anywhere in a cube, which have nothing to do with each other."""
    random = np.random.default_rng(seed)
    middles = random.random((count, 1, 3))
    corners = middles + size * (random.random((count, 3, 3)) - 0.5)
    return corners.reshape(-1, 3).astype(np.float32), np.arange(3 * count, dtype=np.uint32).reshape(-1, 3)


def slivers(count=40):
    """Long triangles, less than a voxel wide."""
    random = np.random.default_rng(7)
    start, end = random.random((count, 3)), random.random((count, 3))
    return (np.stack([start, end, end + 1e-3], 1).reshape(-1, 3).astype(np.float32),
            np.arange(3 * count, dtype=np.uint32).reshape(-1, 3))


def write_ply(path, vertices, faces, colors=None):
    """A binary PLY file, with colours of uint8 (V, 3)."""
    fields = [("x", "<f4"), ("y", "<f4"), ("z", "<f4")]
    names = {"<f4": "float", "u1": "uchar"}
    if colors is not None:
        fields += [("red", "u1"), ("green", "u1"), ("blue", "u1")]
    rows = np.zeros(len(vertices), fields)
    for axis, name in enumerate("xyz"):
        rows[name] = vertices[:, axis]
    if colors is not None:
        for channel, name in enumerate(("red", "green", "blue")):
            rows[name] = colors[:, channel]
    lists = np.zeros(len(faces), [("count", "u1"), ("indices", "<i4", 3)])
    lists["count"], lists["indices"] = 3, faces
    header = "".join(f"property {names[kind]} {name}\n" for name, kind in fields)
    with open(path, "wb") as file:
        file.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {len(rows)}\n{header}"
                    f"element face {len(lists)}\nproperty list uchar int vertex_indices\nend_header\n").encode())
        file.write(rows.tobytes() + lists.tobytes())
