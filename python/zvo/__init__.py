# SPDX-License-Identifier: MIT
"""Voxels of meshes and points, made and traced on Vulkan devices.

    tree = zvo.voxelize(vertices, faces, resolution=256)
    tree.coords                         # (N, 3) cells
    hits = zvo.trace(tree, origins, directions)
    zvo.write_picture("mesh.png", tree.render())

Arrays come in as anything that NumPy, the buffer protocol or DLPack (on the CPU) knows, and go out as NumPy's. Every
function that uses a device waits for it without Python's lock; of several threads, one uses a device at a time.
Arguments that make no sense are ValueError; all other failures are ZvoError."""

from ._devices import Device, devices
from ._errors import ZvoError, ZvoWarning
from ._native import version as __version__
from ._picture import write_picture
from ._trace import Hits, trace
from ._tree import Tree
from ._voxelize import load, voxelize

__all__ = ["Device", "Hits", "Tree", "ZvoError", "ZvoWarning", "__version__", "devices", "load", "trace", "voxelize",
           "write_picture"]
