# SPDX-License-Identifier: MIT
"""Random pictures that repeat without a seam."""

import random


def value_noise(size, cells_x, cells_y, seed):
    """size * size values from 0 to 1: a random lattice of cells_x by cells_y, smoothly interpolated."""
    source = random.Random(seed)
    lattice = [[source.random() for _ in range(cells_x)] for _ in range(cells_y)]

    def steps(cells):
        for i in range(size):
            at = (i + 0.5) * cells / size
            k = int(at)
            t = at - k
            yield k % cells, (k + 1) % cells, t * t * (3 - 2 * t)

    columns = list(steps(cells_x))
    rows = [[row[a] + (row[b] - row[a]) * t for a, b, t in columns] for row in lattice]
    result = []
    for a, b, t in steps(cells_y):
        result += [p + (q - p) * t for p, q in zip(rows[a], rows[b])]
    return result


def fractal_noise(size, cells, octaves, seed, stretch=1):
    """size * size values around 0.5: octaves of value noise; stretch: how many times finer along y."""
    total, weight = [0.0] * (size * size), 1.0
    for octave in range(octaves):
        layer = value_noise(size, cells << octave, (cells * stretch) << octave, seed * 16 + octave)
        total = [s + weight * v for s, v in zip(total, layer)]
        weight *= 0.5
    norm = 2 - 2 * weight
    return [s / norm for s in total]
