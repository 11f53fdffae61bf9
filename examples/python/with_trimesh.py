#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Meshes of trimesh (https://trimesh.org): with_trimesh.py [MESH]

Voxelizes a mesh with the colours of its vertices, and makes a trimesh.voxel.VoxelGrid of the voxels. Says so and ends
where trimesh is not installed; Debian 12 has no package of it."""

import sys

import numpy as np

import zvo

try:
    import trimesh
except ImportError:
    trimesh = None


def voxelize(mesh, **options):
    """The tree of a trimesh.Trimesh. options: as of zvo.voxelize()."""
    if mesh.visual.kind == "vertex":
        options["colors"] = mesh.visual.vertex_colors
    elif mesh.visual.kind == "texture" and mesh.visual.uv is not None:
        image = getattr(mesh.visual.material, "image", None) or getattr(mesh.visual.material, "baseColorTexture", None)
        if image is not None:
            options["texture"] = np.asarray(image.convert("RGBA"))
            options["uv"] = mesh.visual.uv * [1, -1] + [0, 1]  # trimesh counts v from the bottom
    return zvo.voxelize(mesh.vertices, mesh.faces, normals=mesh.vertex_normals, **options)


def grid_of(tree):
    """The voxels as a trimesh.voxel.VoxelGrid, whose transform leads to the middles of cells."""
    transform = np.diag([tree.voxel_size] * 3 + [1.0])
    transform[:3, 3] = tree.origin + 0.5 * tree.voxel_size
    encoding = trimesh.voxel.encoding.SparseBinaryEncoding(tree.coords, shape=(tree.resolution,) * 3)
    return trimesh.voxel.VoxelGrid(encoding, transform=transform)


def main():
    if trimesh is None:
        print("trimesh is not installed: nothing to show")
        return
    mesh = trimesh.load(sys.argv[1], force="mesh") if len(sys.argv) > 1 else trimesh.creation.icosphere(4)
    tree = voxelize(mesh, resolution=64)
    grid = grid_of(tree)
    print(f"{len(mesh.faces)} triangles: {tree!r}; trimesh counts {grid.filled_count}")
    assert np.allclose(np.sort(grid.points, 0), np.sort(tree.points, 0), atol=1e-4)


if __name__ == "__main__":
    main()
