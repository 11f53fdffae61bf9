# SPDX-License-Identifier: MIT
"""What the tests of the Python package share. $ZVO_PROGRAM names the command line, to compare with."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

SOURCES = pathlib.Path(__file__).resolve().parents[2]
SCENES = SOURCES / "scenes"


class Case(unittest.TestCase):
    """A test with a folder, self.folder, that is deleted after it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def expect_equal(self, left, right):
        np.testing.assert_array_equal(left, right)


def run_zvo(*arguments):
    """Runs the command line. A test that needs it is skipped where there is none."""
    if "ZVO_PROGRAM" not in os.environ:
        raise unittest.SkipTest("ZVO_PROGRAM names no program to compare with")
    result = subprocess.run([os.environ["ZVO_PROGRAM"], *map(str, arguments)], capture_output=True, text=True)
    if result.returncode != 0:
        raise AssertionError(f"zvo {arguments}: {result.stderr}")


def read_codes(path):
    """The cells of a file of Morton codes, (N, 3)."""
    codes = np.fromfile(path, "<u8")
    cells = np.zeros((len(codes), 3), np.int64)
    for bit in range(17):
        for axis in range(3):
            cells[:, axis] |= (codes >> np.uint64(3 * bit + axis) & np.uint64(1)).astype(np.int64) << bit
    return cells


def read_ply(path):
    """The rows of a binary PLY file of voxels, by name."""
    head, _, rest = pathlib.Path(path).read_bytes().partition(b"end_header\n")
    fields = [line.split() for line in head.decode().splitlines() if line.startswith("property")]
    return np.frombuffer(rest, [(name, {"float": "<f4", "uchar": "u1"}[kind]) for _, kind, name in fields])
