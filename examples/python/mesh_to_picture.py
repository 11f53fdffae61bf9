#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A mesh becomes voxels, and voxels a picture: mesh_to_picture.py [OUT.png]

Makes a torus in NumPy, voxelizes it with a colour for each vertex, and prints what the tree has."""

import sys

import numpy as np

import zvo


def torus(rows=96, thin=0.35):
    """Vertices (V, 3), faces (F, 3), and a colour of each vertex, uint8 (V, 3)."""
    ring, tube = np.meshgrid(*[np.linspace(0, 2 * np.pi, rows, endpoint=False)] * 2, indexing="ij")
    out = 1 + thin * np.cos(tube)
    vertices = np.stack([out * np.cos(ring), thin * np.sin(tube), out * np.sin(ring)], -1).reshape(-1, 3)
    index = np.arange(rows * rows).reshape(rows, rows)
    right, down = np.roll(index, -1, 0), np.roll(index, -1, 1)
    both = np.roll(right, -1, 1)
    faces = np.concatenate([np.stack([index, right, both], -1), np.stack([index, both, down], -1)]).reshape(-1, 3)
    colors = np.stack([128 + 127 * np.cos(ring), 128 + 127 * np.sin(3 * tube), 128 + 127 * np.sin(ring)], -1)
    return vertices, faces, colors.reshape(-1, 3).astype(np.uint8)


def main():
    path = sys.argv[1] if len(sys.argv) > 1 else "torus.png"
    vertices, faces, colors = torus()
    tree = zvo.voxelize(vertices, faces, colors=colors, resolution=256)
    print(f"{len(faces)} triangles: {tree!r}, {tree.bytes / len(tree):.1f} bytes a voxel")
    print("first voxels:", *zip(tree.coords[:3].tolist(), tree.colors[:3].tolist()))
    zvo.write_picture(path, tree.render((640, 480), eye=[1.2, 2.2, 3.0], target=[0, 0, 0], fov=35))
    print("wrote", path)


if __name__ == "__main__":
    main()
