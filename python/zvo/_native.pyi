# SPDX-License-Identifier: MIT
"""The engine. Its arrays are C-contiguous and have exactly these types of elements."""

from typing import Optional

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float32]

version: str

class GridArguments:
    def __init__(self, *, depth: Optional[int], coverage: str, fill: str, shell: str, bounds: Optional[list[float]],
                 attributes: bool) -> None: ...

class Tree:
    @property
    def resolution(self) -> int: ...
    @property
    def origin(self) -> tuple[float, float, float]: ...
    @property
    def voxel_size(self) -> float: ...
    @property
    def voxel_count(self) -> int: ...
    @property
    def is_dag(self) -> bool: ...
    @property
    def bytes(self) -> int: ...
    def voxels(self) -> tuple[npt.NDArray[np.int32], Optional[npt.NDArray[np.uint8]], Optional[Floats]]:
        """Cells (N, 3), colours (N, 3), normals (N, 3): new arrays in each call."""
    def compress(self) -> Tree: ...
    def save(self, path: str) -> None: ...
    def render(self, width: int, height: int, camera: str, view: list[float], integrator: str, samples: int,
               denoise: bool) -> npt.NDArray[np.uint32]:
        """(height, width) texels. view: eye, target and field of view in degrees, or nothing."""

def devices() -> list[tuple[str, str, str, int, list[str]]]:
    """Name, type, driver, bytes of memory, and reasons for which the device cannot be used."""

def voxelize(device: str, positions: Floats, triangles: Optional[npt.NDArray[np.uint32]], normals: Optional[Floats],
             colors: Optional[Floats], uvs: Optional[Floats], texture: Optional[npt.NDArray[np.uint8]],
             grid: GridArguments) -> Tree:
    """(V, 3), (F, 3), (V, 3), linear (V, 4), (V, 2), (height, width, 4). Without triangles, vertices are points."""

def load(device: str, paths: list[str], up: str, scale: float, point_size: int, time: Optional[float],
         grid: GridArguments) -> Tree: ...

def trace(tree: Tree, origins: Floats, directions: Floats, t_min: float, t_max: float) -> tuple[
        npt.NDArray[np.uint8], Floats, npt.NDArray[np.int32], npt.NDArray[np.int8], Floats, npt.NDArray[np.uint8]]:
    """State (M,), t (M,), voxel (M, 3), face (M,), normal (M, 3), color (M, 3)."""

def write_picture(path: str, texels: npt.NDArray[np.uint32]) -> None:
    """(height, width) texels."""
