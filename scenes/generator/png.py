# SPDX-License-Identifier: MIT
"""PNG files with a palette (and its alpha values), which is enough for painted textures and packs well."""

import struct
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"


def _chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _median_cut(counts, size):
    """A palette of at most size colours, and for each colour in counts (colour -> pixels) its index in the palette."""
    boxes = [sorted(counts)]
    while len(boxes) < size:
        # Split the box with the largest spread, weighted by the square root of its pixels, at its weighted median.
        best, best_score = None, 0.0
        for index, box in enumerate(boxes):
            if len(box) < 2:
                continue
            spread = max(max(c[k] for c in box) - min(c[k] for c in box) for k in range(4))
            score = spread * sum(counts[c] for c in box) ** 0.5
            if score > best_score:
                best, best_score = index, score
        if best is None:
            break
        box = boxes.pop(best)
        axis = max(range(4), key=lambda k: max(c[k] for c in box) - min(c[k] for c in box))
        box.sort(key=lambda c: (c[axis], c))
        half, seen, cut = sum(counts[c] for c in box) / 2, 0, 0
        while cut < len(box) - 1 and (cut == 0 or seen + counts[box[cut]] <= half):
            seen += counts[box[cut]]
            cut += 1
        boxes += [box[:cut], box[cut:]]
    palette, index_of = [], {}
    for box in boxes:
        total = sum(counts[c] for c in box)
        palette.append(tuple(round(sum(c[k] * counts[c] for c in box) / total) for k in range(4)))
    # Entries with alpha below 255 first, so that the alpha table is short.
    order = sorted(range(len(boxes)), key=lambda i: (palette[i][3] == 255, palette[i]))
    for new, old in enumerate(order):
        for color in boxes[old]:
            index_of[color] = new
    return [palette[i] for i in order], index_of


def encode(width, height, pixels, colors=64):
    """A PNG file of a picture with at most `colors` colours (2 to 256).

    pixels: width * height colours (r, g, b) or (r, g, b, a), 0 to 1, sRGB encoded, alpha straight, rows from the top.
    """
    def quantized(color):
        # Steps of 4 of 255: finer ones are lost in the palette anyway.
        rgba = color if len(color) == 4 else (*color, 1.0)
        return tuple(min(255, round(min(max(c, 0.0), 1.0) * 63.75) * 4) for c in rgba)

    cells = [quantized(p) for p in pixels]
    assert len(cells) == width * height
    counts = {}
    for cell in cells:
        counts[cell] = counts.get(cell, 0) + 1
    palette, index_of = _median_cut(counts, colors)
    indices = [index_of[c] for c in cells]

    bits = 8 if len(palette) > 16 else 4 if len(palette) > 4 else 2
    per_byte = 8 // bits
    rows = bytearray()
    for y in range(height):
        rows.append(0)  # no filter
        row = indices[y * width:(y + 1) * width]
        row += [0] * (-width % per_byte)
        for x in range(0, len(row), per_byte):
            value = 0
            for index in row[x:x + per_byte]:
                value = value << bits | index
            rows.append(value)

    alphas = bytes(c[3] for c in palette if c[3] < 255)
    return b"".join([
        SIGNATURE,
        _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, 3, 0, 0, 0)),
        _chunk(b"PLTE", b"".join(bytes(c[:3]) for c in palette)),
        _chunk(b"tRNS", alphas) if alphas else b"",
        _chunk(b"IDAT", zlib.compress(bytes(rows), 9)),
        _chunk(b"IEND", b""),
    ])


def unpacked(data):
    """A PNG file's chunks with the pixel data uncompressed: equal for equal pictures, whichever zlib wrote them."""
    chunks, offset = [], len(SIGNATURE)
    while offset < len(data):
        length, kind = struct.unpack_from(">I4s", data, offset)
        body = data[offset + 8:offset + 8 + length]
        chunks.append((kind, zlib.decompress(body) if kind == b"IDAT" else body))
        offset += length + 12
    return chunks
