# SPDX-License-Identifier: MIT
from __future__ import annotations

import operator
import os
from collections.abc import Sequence
from typing import Literal, Union

import numpy as np

from . import _arrays, _native
from ._devices import name_of
from ._tree import Tree

Fill = Literal["none", "solid", "parity", "robust"]
Shell = Literal["surface", "none"]
Coverage = Literal["thin", "conservative"]
Path = Union[str, "os.PathLike[str]"]


def voxelize(vertices: _arrays.Input, faces: _arrays.Input | None = None, *, colors: _arrays.Input | None = None,
             normals: _arrays.Input | None = None, uv: _arrays.Input | None = None,
             texture: _arrays.Input | None = None, resolution: int = 512, fill: Fill = "none",
             shell: Shell = "surface", coverage: Coverage = "thin", bounds: _arrays.Input | None = None, attributes: bool = True,
             device: str | int | None = None) -> Tree:
    """Voxelizes triangles, or points.

    vertices: (V, 3) numbers, world units; y is up in pictures. Rows that are not finite are left out, with a warning.
    faces: (F, 3) indices of vertices. None: each vertex is a point, which has the voxel that it lies in.
    colors: (V, 3) or (V, 4) of each vertex, uint8 in sRGB or fractions that are linear. Alpha has no effect.
    normals: (V, 3) of each vertex, of any length. None: those of the faces.
    uv: (V, 2) texture coordinates, with v = 0 at the texture's top row, and repeated outside of 0 to 1.
    texture: (height, width, 3 or 4) uint8 in sRGB, rows from the top. It multiplies the colours.
    resolution: voxels per edge of the grid, a power of two from 2 to 131,072.
    fill: whether voxels inside are there, too, and how the inside is decided: docs/voxelization.md, "Filling".
    shell: with fill "solid" or "parity": "surface": the voxels of the surface are there, too; "none": only those whose
        centres are inside.
    coverage: "thin": voxels by a rule that leaves no hole across faces; "conservative": all that are touched.
    bounds: (2, 3) corners of a box: the grid is the cube from its low corner on, as long as its longest edge. None:
        the smallest cube around the vertices that faces use.
    attributes: False: no colours and normals, which takes less time and memory.
    device: index or part of a name in devices(), or "cpu". None: the best one.

    The arrays must not change during the call, and are not needed after it. Arrays of float32, and of uint32 for faces,
    are read as they are; others are converted, in a copy. Raises ValueError, ZvoError; warns by ZvoWarning."""
    positions = _arrays.rows("vertices", vertices, 3)
    count = len(positions)
    triangles = None if faces is None else _arrays.indices("faces", faces, count)

    def of_vertices(name: str, value: _arrays.Input | None, columns: int) -> _arrays.AnyArray | None:
        return None if value is None else _arrays.rows(name, value, columns, np.float32, count, "vertices")

    if texture is not None and uv is None:
        raise ValueError("texture: goes with uv")
    linear = None if colors is None else _arrays.linear_colors("colors", colors, count, "vertices")
    return Tree(_native.voxelize(name_of(device), positions, triangles, of_vertices("normals", normals, 3), linear,
                                 of_vertices("uv", uv, 2),
                                 None if texture is None else _arrays.picture("texture", texture),
                                 _grid(resolution, fill, shell, coverage, bounds, attributes)))


def load(path: Path | Sequence[Path], *, resolution: int | None = None, fill: Fill = "none",
         shell: Shell = "surface", coverage: Coverage = "thin", bounds: _arrays.Input | None = None, attributes: bool = True, up: str = "y",
         scale: float = 1.0, point_size: int = 1, time: float | None = None, device: str | int | None = None) -> Tree:
    """Reads a file: the voxels of .zvo and .vox, or a mesh, points or a scene, which is voxelized (docs/input.md).

    path: of a file, or of several that make one scene.
    resolution: None: that of the scene file, or else 512.
    up: the axis of the files that becomes y: "x", "y", "z", "-x", "-y" or "-z".
    scale: world units of a unit of the files, above 0.
    point_size: edge of the cube of voxels that a point becomes, from 1 to 16.
    time: seconds in a scene that moves. None: meshes at rest.
    The other options are those of voxelize(). Raises ValueError, ZvoError; warns by ZvoWarning."""
    paths = [path] if isinstance(path, (str, os.PathLike)) else list(path)
    if not paths:
        raise ValueError("path: expected at least one")
    if not (0 < scale < float("inf")):
        raise ValueError(f"scale: expected a number above 0, got {scale}")
    edge = operator.index(point_size)
    if not 1 <= edge <= 16:
        raise ValueError(f"point_size: expected a whole number from 1 to 16, got {edge}")
    if time is not None and not (0 <= time < float("inf")):
        raise ValueError(f"time: expected seconds from 0 on, got {time}")
    return Tree(_native.load(name_of(device), [os.fspath(one) for one in paths], up, scale, edge, time,
                             _grid(resolution, fill, shell, coverage, bounds, attributes)))


def _grid(resolution: int | None, fill: str, shell: str, coverage: str, bounds: _arrays.Input | None,
          attributes: bool) -> _native.GridArguments:
    edge = None if resolution is None else operator.index(resolution)
    if edge is not None and (not 2 <= edge <= 1 << 17 or edge & (edge - 1) != 0):
        raise ValueError(f"resolution: expected a power of two from 2 to 131072, got {edge}")
    corners = None if bounds is None else _arrays.rows("bounds", bounds, 3, np.float32, 2, "the corners")
    if corners is not None and not (np.isfinite(corners).all() and (corners[0] <= corners[1]).all()
                                    and (corners[0] < corners[1]).any()):
        raise ValueError("bounds: expected the low and the high corner of a box")
    return _native.GridArguments(depth=None if edge is None else edge.bit_length() - 1, coverage=coverage, fill=fill, shell=shell,
                                 bounds=None if corners is None else corners.ravel().tolist(), attributes=attributes)
