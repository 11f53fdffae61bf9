# SPDX-License-Identifier: MIT
"""docs/voxelization.md and docs/queries.md once more, in NumPy: slow, short, and without zvo. Small grids and finite
triangles inside of them only."""

import numpy as np


def snapped(vertices, origin, voxel_size):
    """Vertices on the lattice of 1/256 voxel, by single precision."""
    scale = np.float32(256.0 / np.float64(np.float32(voxel_size)))
    return np.rint((np.asarray(vertices, np.float32) - origin) * scale).astype(np.int64)


def cells_of(mask):
    """The cells of a mask [x, y, z] in Morton order."""
    cells = np.argwhere(mask)
    codes = np.zeros(len(cells), np.int64)
    for bit in range(int(np.ceil(np.log2(max(mask.shape))))):
        for axis in range(3):
            codes |= (cells[:, axis] >> bit & 1) << (3 * bit + axis)
    return cells[np.argsort(codes)]


def _cells_around(corners, resolution):
    """The cells that a triangle's box touches, [x, y, z] -> cell."""
    low = np.clip((corners.min(0) - 1) // 256, 0, resolution - 1)
    high = np.clip(corners.max(0) // 256, 0, resolution - 1)
    return np.stack(np.meshgrid(*[np.arange(a, b + 1) for a, b in zip(low, high)], indexing="ij"), -1).astype(np.int64)


def _touches_ranges(corners, cells):
    low, high = corners.min(0), corners.max(0)
    return ((256 * cells <= high) & (low <= 256 * (cells + 1))).all(-1)


def _thin(corners, cells, resolution):
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    if not normal.any():
        return np.zeros(cells.shape[:3], bool)
    w = int(np.argmax(np.abs(normal)))  # of equal ones the first
    u, v = (w + 1) % 3, (w + 2) % 3
    centers = 256 * cells + 128
    covered = _touches_ranges(corners, cells)
    # The plane's height in the column, times |n_w|.
    sign = 1 if normal[w] > 0 else -1
    rise = sign * (normal[u] * (centers[..., u] - corners[0][u]) + normal[v] * (centers[..., v] - corners[0][v]))
    height = abs(normal[w]) * corners[0][w] - rise
    bottom = abs(normal[w]) * 256 * cells[..., w]
    inside = (bottom <= height) & (height < bottom + abs(normal[w]) * 256)
    if normal[u] == 0 and normal[v] == 0 and corners[0][w] == 256 * resolution:
        inside = cells[..., w] == resolution - 1
    covered &= inside
    for a, b in ((0, 1), (1, 2), (2, 0)):
        c = 3 - a - b
        for i in range(3):
            edges = [(corners[i], corners[(i + 1) % 3])]
            if normal[c] == 0:
                edges.append(edges[0][::-1])
            for start, end in edges:
                e = end - start
                s = -1 if normal[c] < 0 else 1
                distance = s * (-e[b] * (centers[..., a] - start[a]) + e[a] * (centers[..., b] - start[b]))
                covered &= distance + 128 * max(abs(e[a]), abs(e[b])) >= 0
    return covered


def _conservative(corners, cells, _resolution, grown=0):
    """No axis separates the triangle from the box: those of the box, the normal, and products of edges with them. grown:
    lattice units by which boxes are larger on all sides."""
    half = 128 + grown
    covered = (np.abs(256 * cells + 128 - np.clip(256 * cells + 128, corners.min(0), corners.max(0))) <= half).all(-1)
    edges = [corners[(i + 1) % 3] - corners[i] for i in range(3)]
    units = np.eye(3, dtype=np.int64)
    for axis in [np.cross(edges[0], edges[1])] + [np.cross(edge, unit) for edge in edges for unit in units]:
        of_triangle = corners @ axis
        middle = (256 * cells + 128) @ axis
        reach = half * np.abs(axis).sum()
        covered &= (middle - reach <= of_triangle.max()) & (of_triangle.min() <= middle + reach)
    return covered


def occupied(vertices, faces, resolution, origin, voxel_size, coverage, **options):
    """The cells of a mesh as a mask [x, y, z]."""
    lattice = snapped(vertices, origin, voxel_size)
    mask = np.zeros((resolution,) * 3, bool)
    rule = _thin if coverage == "thin" else _conservative
    for face in np.asarray(faces):
        cells = _cells_around(lattice[face], resolution)
        x, y, z = cells[0, 0, 0]
        part = mask[x:x + cells.shape[0], y:y + cells.shape[1], z:z + cells.shape[2]]
        part |= rule(lattice[face], cells, resolution, **options)
    return mask


def voxels(*arguments):
    """The cells of a mesh in Morton order; arguments as of occupied()."""
    return cells_of(occupied(*arguments))


def first_hits(coords, origin, voxel_size, origins, directions):
    """For each ray, by every voxel, in double precision: the row in coords of the voxel that it enters first, or -1, when,
    and how clear that is: the least difference of times that decides about it."""
    low = origin.astype(np.float64) + coords * voxel_size
    rows, times, margins = [], [], []
    with np.errstate(divide="ignore", invalid="ignore"):
        for start, way in zip(origins.astype(np.float64), directions.astype(np.float64)):
            near, far = (low - start) / way, (low + voxel_size - start) / way
            enter = np.minimum(near, far).max(1)
            leave = np.maximum(near, far).min(1)
            enter = np.maximum(enter, 0.0)
            length = leave - enter
            hit = length > 0
            order = np.sort(enter[hit])
            rows.append(int(np.flatnonzero(hit)[np.argmin(enter[hit])]) if hit.any() else -1)
            times.append(order[0] if len(order) else np.inf)
            margins.append(min(np.abs(length).min(initial=np.inf), order[1] - order[0] if len(order) > 1 else np.inf))
    return np.array(rows), np.array(times), np.array(margins)
