#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A tutorial, cell by cell, for editors that know "# %%" and for reading: tutorial.py"""

# %% A mesh: corners, and triangles that name them.
import pathlib
import tempfile

import numpy as np

import zvo

print("zvo", zvo.__version__, "on", [device.name for device in zvo.devices() if not device.reasons])
vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], np.float32)
faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.uint32)

# %% Voxels: the cells of a cube of 64^3 that the surface passes through.
tree = zvo.voxelize(vertices, faces, resolution=64)
print(tree, "from", tree.origin, "on, each", tree.voxel_size, "wide")

# %% Arrays: cells, world positions of their centres, normals.
print(tree.coords.shape, tree.points[0], tree.normals[0])

# %% What a network eats: a dense grid, [x, y, z].
dense = np.zeros([tree.resolution] * 3, bool)
dense[tuple(tree.coords.T)] = True
print("occupied:", dense.mean())

# %% The inside as well. A tetrahedron has a sixth of the cube's volume.
solid = zvo.voxelize(vertices, faces, resolution=64, fill="solid")
print("volume:", len(solid) * solid.voxel_size**3, "of", 1 / 6)

# %% Rays: from above down, a depth map.
steps = (np.arange(64) + 0.5) / 64
x, z = np.meshgrid(steps, steps, indexing="ij")
origins = np.stack([x, np.full_like(x, 2.0), z], -1).reshape(-1, 3)
hits = zvo.trace(tree, origins, np.tile([0, -1, 0], (len(origins), 1)))
depth = hits.t.reshape(64, 64)
print("hit:", hits.hit.mean(), "nearest:", depth.min())

# %% A DAG stores equal parts once.
dag = tree.compress()
print(tree.bytes, "bytes become", dag.bytes)

# %% Files, and a picture.
with tempfile.TemporaryDirectory() as folder:
    dag.save(pathlib.Path(folder, "tetrahedron.zvo"))
    again = zvo.load(pathlib.Path(folder, "tetrahedron.zvo"))
    assert np.array_equal(again.coords, tree.coords)
    zvo.write_picture(pathlib.Path(folder, "tetrahedron.png"), again.render((320, 240)))
print("done")
