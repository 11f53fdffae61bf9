# SPDX-License-Identifier: MIT
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from . import _arrays, _native
from ._tree import Tree

_FOUND, _UNDECIDED = 1, 2


@dataclass(frozen=True)
class Hits:
    """What M rays have found, a row for each."""

    hit: npt.NDArray[np.bool_]
    """(M,) bool: whether the ray enters a voxel, or begins in one."""
    t: npt.NDArray[np.float32]
    """(M,) float32: where it enters the first voxel, in lengths of its direction; infinity where there is none. Of a
    ray that begins inside it is t_min, or the least number above 0."""
    voxel: npt.NDArray[np.int32]
    """(M, 3) int32: the voxel's cell; -1 where there is none."""
    face: npt.NDArray[np.int8]
    """(M,) int8: the axis of the face by which the ray comes, 0 to 2; 3: it begins inside; -1 where there is none."""
    normal: npt.NDArray[np.float32]
    """(M, 3) float32: the voxel's normal, of length 1, or 0 where there is none."""
    color: npt.NDArray[np.uint8]
    """(M, 3) uint8: the voxel's colour, sRGB; 0 where there is none."""
    undecided: npt.NDArray[np.bool_]
    """(M,) bool: rays that were given up, because the way through the tree took too long; of deep grids alone."""


def trace(tree: Tree, origins: _arrays.Input, directions: _arrays.Input, *, t_min: float = 0.0,
          t_max: float = float("inf")) -> Hits:
    """Traces rays through a tree, exactly: the first voxel is that of a walk through all cells.

    origins: (M, 3) numbers, world units.
    directions: (M, 3) numbers, of any length but 0, which is the unit of t.
    t_min, t_max: the part of the rays that counts.

    Rays with numbers that are not finite find nothing. Raises ValueError, ZvoError."""
    starts = _arrays.rows("origins", origins, 3)
    ways = _arrays.rows("directions", directions, 3, np.float32, len(starts), "origins")
    state, t, voxel, face, normal, color = _native.trace(tree._native, starts, ways, t_min, t_max)
    return Hits(state == _FOUND, t, voxel, face, normal, color, state == _UNDECIDED)
