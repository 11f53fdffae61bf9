#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A scan becomes evenly spread points: scan_to_points.py [SCAN.ply [OUT.ply [RESOLUTION]]]

Each voxel of the scan becomes a point at its centre, with the mean colour and normal of what lies in it. So parts that
were scanned twice, or from near by, weigh no more than others. Without a scan it makes one of a ball."""

import pathlib
import sys
import tempfile

import numpy as np

import zvo


def write_scan(path, count=200000):
    """A PLY file of points on a ball, half of which lie on an eighth of it, with noise."""
    random = np.random.default_rng(1)
    way = random.normal(size=(count, 3))
    way[: count // 2] = np.abs(way[: count // 2])
    points = way / np.linalg.norm(way, axis=1, keepdims=True) + 0.002 * random.normal(size=(count, 3))
    rows = np.zeros(count, [("place", "<f4", 3), ("color", "u1", 3)])
    rows["place"], rows["color"] = points, 127.5 * (1 + np.clip(points, -1, 1))
    with open(path, "wb") as file:
        file.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {count}\n"
                    + "".join(f"property float {axis}\n" for axis in "xyz")
                    + "".join(f"property uchar {channel}\n" for channel in ("red", "green", "blue"))
                    + "end_header\n").encode() + rows.tobytes())


def main():
    with tempfile.TemporaryDirectory() as folder:
        scan = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(folder, "scan.ply")
        if len(sys.argv) == 1:
            write_scan(scan)
        out = sys.argv[2] if len(sys.argv) > 2 else "points.ply"
        tree = zvo.load(scan, resolution=int(sys.argv[3]) if len(sys.argv) > 3 else 128)
    low, high = tree.points.min(0), tree.points.max(0)
    print(f"{len(tree)} points, one every {tree.voxel_size:.4g} units, from {low} to {high}")
    tree.save(out)
    print("wrote", out)


if __name__ == "__main__":
    main()
