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


def _candidates(lattice, faces, resolution):
    """Rows (face, cell) of all cells that the faces' boxes touch: corners (M, 3, 3) and cells (M, 3)."""
    corners = lattice[faces]
    low = np.clip((corners.min(1) - 1) // 256, 0, resolution - 1)
    size = np.clip(corners.max(1) // 256, 0, resolution - 1) - low + 1
    counts = size.prod(1)
    row = np.repeat(np.arange(len(faces)), counts)
    number = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    x, rest = np.divmod(number, size[row, 1] * size[row, 2])
    return corners[row], low[row] + np.stack([x, *np.divmod(rest, size[row, 2])], 1)


def _thin(corners, cells, resolution):
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    rows = np.arange(len(cells))
    w = np.argmax(np.abs(normal), 1)  # of equal ones the first
    centers = 256 * cells + 128
    covered = normal.any(1) & ((256 * cells <= corners.max(1)) & (corners.min(1) <= 256 * (cells + 1))).all(1)
    # The plane's height in the column, times |n_w|.
    along = np.abs(normal[rows, w])
    to_center = centers - corners[:, 0]
    to_center[rows, w] = 0
    height = along * corners[rows, 0, w] - np.sign(normal[rows, w]) * (normal * to_center).sum(1)
    bottom = along * 256 * cells[rows, w]
    inside = (bottom <= height) & (height < bottom + along * 256)
    is_level = (normal != 0).sum(1) == 1
    is_top = is_level & (corners[rows, 0, w] == 256 * resolution)
    covered &= np.where(is_top, cells[rows, w] == resolution - 1, inside)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        s = np.where(normal[:, 3 - a - b] < 0, -1, 1)
        is_segment = normal[:, 3 - a - b] == 0
        for i in range(3):
            e = corners[:, (i + 1) % 3] - corners[:, i]
            from_start = centers - corners[:, i]
            distance = e[:, a] * from_start[:, b] - e[:, b] * from_start[:, a]
            reach = 128 * np.maximum(np.abs(e[:, a]), np.abs(e[:, b]))
            covered &= (s * distance + reach >= 0) & (~is_segment | (reach - distance >= 0))
    return covered


def _conservative(corners, cells, _resolution, grown=0):
    """No axis separates the triangle from the box: those of the box, the normal, and products of edges with them.
    grown: lattice units by which boxes are larger on all sides."""
    half = 128 + grown
    middles = (256 * cells + 128)[:, None]
    edges = [corners[:, (i + 1) % 3] - corners[:, i] for i in range(3)]
    units = np.eye(3, dtype=np.int64)
    covered = np.ones(len(cells), bool)
    for axis in [*np.broadcast_to(units[:, None], (3, *cells.shape)), np.cross(edges[0], edges[1]),
                 *[np.cross(edge, unit) for edge in edges for unit in units]]:
        places = ((corners - middles) * axis[:, None]).sum(2)
        reach = half * np.abs(axis).sum(1)
        covered &= (-reach <= places.max(1)) & (places.min(1) <= reach)
    return covered


def occupied(vertices, faces, resolution, origin, voxel_size, coverage, **options):
    """The cells of a mesh as a mask [x, y, z]."""
    lattice = snapped(vertices, origin, voxel_size)
    mask = np.zeros((resolution,) * 3, bool)
    rule = _thin if coverage == "thin" else _conservative
    for first in range(0, len(faces), 4096):
        corners, cells = _candidates(lattice, np.asarray(faces)[first:first + 4096], resolution)
        mask[tuple(cells[rule(corners, cells, resolution, **options)].T)] = True
    return mask


def voxels(*arguments):
    """The cells of a mesh in Morton order; arguments as of occupied()."""
    return cells_of(occupied(*arguments))


def first_hits(coords, origin, voxel_size, origins, directions):
    """For each ray, by every voxel, in double precision: the row in coords of the voxel that it enters first, or -1;
    when; and how clear that is, the least difference of times that decides about it."""
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
