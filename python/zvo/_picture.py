# SPDX-License-Identifier: MIT
from __future__ import annotations

import os

import numpy as np

from . import _arrays, _native


def write_picture(path: str | os.PathLike[str], picture: _arrays.Input) -> None:
    """Writes a picture as PNG, JPEG or WebP, as the path's extension tells, in place of any file that is there.

    picture: (height, width, 3 or 4) uint8 in sRGB, rows from the top, as Tree.render() makes them. Raises ValueError,
    ZvoError."""
    pixels = _arrays.picture("picture", picture)
    _native.write_picture(os.fspath(path), pixels.view(np.uint32)[..., 0])
