#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A data set for training: many meshes become sparse voxels of one grid: dataset.py [COUNT [RESOLUTION]]

Each mesh is a lump, made anew; its sample has the cells, their normals, and which lump it is, as arrays that libraries
of tensors take without a copy (torch.from_numpy, jax.dlpack.from_dlpack). Prints how many meshes a second pass, of the
process and of the work on the device alone."""

import sys
import time

import numpy as np

import zvo


def lump(seed, rows=48):
    """A ball with waves: vertices (V, 3) in a cube from -1 to 1, faces (F, 3)."""
    random = np.random.default_rng(seed)
    polar, around = np.meshgrid(np.linspace(0, np.pi, rows + 1), np.linspace(0, 2 * np.pi, 2 * rows + 1), indexing="ij")
    waves = random.integers(1, 6, 3)
    radius = 0.7 + 0.2 * np.sin(waves[0] * polar) * np.cos(waves[1] * around + waves[2])
    vertices = radius[..., None] * np.stack([np.sin(polar) * np.cos(around), np.cos(polar),
                                             np.sin(polar) * np.sin(around)], -1)
    index = np.arange(vertices.shape[0] * vertices.shape[1]).reshape(vertices.shape[:2])
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    faces = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)])
    return vertices.reshape(-1, 3).astype(np.float32), faces.reshape(-1, 3).astype(np.uint32)


def samples(count, resolution):
    """For each mesh: cells (N, 3) int32, normals (N, 3) float32, label, and the seconds that zvo took."""
    for seed in range(count):
        vertices, faces = lump(seed)
        begin = time.perf_counter()
        tree = zvo.voxelize(vertices, faces, resolution=resolution, bounds=[[-1, -1, -1], [1, 1, 1]])
        coords, normals = tree.coords, tree.normals
        yield coords, normals, seed, time.perf_counter() - begin


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    resolution = int(sys.argv[2]) if len(sys.argv) > 2 else 64
    zvo.voxelize(*lump(0), resolution=resolution)  # makes the device's kernels
    begin, seconds, voxels = time.perf_counter(), 0.0, 0
    for coords, normals, _, of_zvo in samples(count, resolution):
        assert len(coords) == len(normals)
        seconds += of_zvo
        voxels += len(coords)
    passed = time.perf_counter() - begin
    print(f"{count} meshes of {len(lump(0)[1])} triangles at {resolution}^3, {voxels / count:.0f} voxels each: "
          f"{count / passed:.1f} meshes/s, {count / seconds:.1f} of zvo alone")


if __name__ == "__main__":
    main()
