# SPDX-License-Identifier: MIT
from __future__ import annotations

import operator
import os
from functools import cached_property
from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _arrays, _native


class Tree:
    """The voxels of a cube of resolution^3 cells: an octree or a DAG in a device's memory, which does not change.

    Voxels are in Morton order: the same in every array, on every device. coords, colors and normals are copied from the
    device when the first of them is asked for; all who ask get the same arrays. Made by voxelize(), load() and
    compress()."""

    def __init__(self, native: _native.Tree) -> None:
        self._native = native

    def __len__(self) -> int:
        """N, the number of voxels."""
        return self._native.voxel_count

    def __repr__(self) -> str:
        return f"<zvo.Tree: {len(self)} voxels of {self.resolution}^3, {'a DAG' if self.is_dag else 'an octree'}>"

    @property
    def coords(self) -> npt.NDArray[np.int32]:
        """(N, 3) int32: the cells of the voxels, each number from 0 to resolution - 1."""
        return self._voxels[0]

    @property
    def colors(self) -> npt.NDArray[np.uint8] | None:
        """(N, 3) uint8: the mean colours of the voxels, sRGB. None without attributes."""
        return self._voxels[1]

    @property
    def normals(self) -> npt.NDArray[np.float32] | None:
        """(N, 3) float32: the mean normals, of length 1, or 0 where there is none, as inside. None without
        attributes."""
        return self._voxels[2]

    @property
    def points(self) -> npt.NDArray[np.float32]:
        """(N, 3) float32: the centres of the voxels, world units."""
        return (self.origin.astype(np.float64) + (self.coords + 0.5) * self.voxel_size).astype(np.float32)

    @property
    def resolution(self) -> int:
        """Voxels per edge of the grid."""
        return self._native.resolution

    @property
    def origin(self) -> npt.NDArray[np.float32]:
        """(3,) float32: the grid's lowest corner, world units."""
        return np.array(self._native.origin, np.float32)

    @property
    def voxel_size(self) -> float:
        """Edge of a voxel, world units. Cell c is the cube from origin + c * voxel_size on."""
        return self._native.voxel_size

    @property
    def is_dag(self) -> bool:
        """Whether equal parts of the tree are stored once."""
        return self._native.is_dag

    @property
    def bytes(self) -> int:
        """Bytes of device memory: nodes, and attributes."""
        return self._native.bytes

    def compress(self) -> Tree:
        """The DAG of the same voxels, in which equal parts of the octree are stored once. Raises ValueError for a DAG,
        ZvoError."""
        return Tree(self._native.compress())

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file of the kind that the path's extension tells, in place of any file that is there: .zvo, the tree
        itself; .vox; .nvdb; .glb; .ply, points; or .morton, codes alone. Raises ValueError, ZvoError; warns by
        ZvoWarning of what the kind of file does not hold."""
        self._native.save(os.fspath(path))

    def render(self, size: tuple[int, int] = (640, 480), *, camera: str = "auto", eye: _arrays.Input | None = None,
               target: _arrays.Input | None = None, fov: float = 45.0,
               integrator: Literal["primary", "path"] = "primary", samples: int | None = None,
               denoise: bool = False) -> npt.NDArray[np.uint8]:
        """A picture, (height, width, 4) uint8: sRGB, and 255 for alpha; rows from the top.

        size: width and height, pixels.
        camera: "auto", "close", "front", "back", "left", "right", "top" or "iso". Has no effect with eye and target.
        eye, target: (3,) world units: where the camera is, and what it looks at; y is up.
        fov: the vertical field of view, degrees.
        integrator: "primary": one ray to the sun and some over the hemisphere; "path": path tracing.
        samples: rays or paths of each pixel. None: 4 of rays, 64 of paths.
        denoise: whether the noise of paths is filtered.

        Raises ValueError, ZvoError."""
        width, height = map(operator.index, size)
        if not (1 <= width <= 16384 and 1 <= height <= 16384):
            raise ValueError(f"size: expected a width and a height from 1 to 16384, got {size}")
        if (eye is None) != (target is None):
            raise ValueError("eye and target: expected both or neither")
        view = []
        if eye is not None and target is not None:
            view = [*_point("eye", eye), *_point("target", target), fov]
        count = (64 if integrator == "path" else 4) if samples is None else operator.index(samples)
        if count < 1:
            raise ValueError(f"samples: expected 1 or more, got {count}")
        texels = self._native.render(width, height, camera, view, integrator, count, denoise)
        return texels.view(np.uint8).reshape(height, width, 4)

    @cached_property
    def _voxels(self) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.uint8] | None, npt.NDArray[np.float32] | None]:
        return self._native.voxels()


def _point(name: str, value: _arrays.Input) -> list[float]:
    point = _arrays.as_array(name, value)
    if point.shape != (3,):
        raise ValueError(f"{name}: expected three numbers, got an array of shape {point.shape}")
    return [float(number) for number in _arrays.elements(name, point, np.float32)]
