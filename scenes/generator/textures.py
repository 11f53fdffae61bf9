# SPDX-License-Identifier: MIT
"""The painted textures. Each function returns a PNG file; colours are sRGB, 0 to 1.

A painter says the colour of a pixel at (u, v), both 0 to 1 from the top left corner.
"""

import math
import random

from generator import png
from generator.noise import fractal_noise


def rgb(code):
    """The colour of a hexadecimal code such as "d8c49a"."""
    return tuple(int(code[i:i + 2], 16) / 255 for i in (0, 2, 4))


def mix(a, b, t):
    t = min(max(t, 0.0), 1.0)
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def shade(color, factor):
    return tuple(c * factor for c in color)


def smoothstep(low, high, x):
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def painted(size, painter, colors=64):
    """A square picture; painter(u, v, k) with k the pixel's place in a size * size list."""
    pixels = [painter((x + 0.5) / size, (y + 0.5) / size, y * size + x) for y in range(size) for x in range(size)]
    return png.encode(size, size, pixels, colors)


def marble_veins(size, cells, seed):
    """0 to 1, 1 on thin winding veins."""
    broad, fine = fractal_noise(size, cells, 5, seed), fractal_noise(size, cells * 2, 4, seed + 1)
    return [max(0.0, 1 - 26 * abs(b - 0.5)) * 0.7 + max(0.0, 1 - 34 * abs(f - 0.52)) * 0.4 for b, f in zip(broad, fine)]


def court_floor():
    """Inlaid marble, one square of 2.6 m: a frame, a diamond, a round shield with an eight-pointed star."""
    size = 512
    veins, cloud = marble_veins(size, 4, 11), fractal_noise(size, 6, 5, 13)
    cream, rose, green, dark, gold = (rgb(c) for c in ("e6d8bb", "c27a5c", "48694f", "3b3a3d", "d3a453"))

    def painter(u, v, k):
        x, y = abs(u - 0.5), abs(v - 0.5)
        edge, diamond, radius = 0.5 - max(x, y), x + y, math.hypot(x, y)
        angle = math.atan2(v - 0.5, u - 0.5)
        petal = abs((angle / (math.pi / 4)) % 1 - 0.5) * 2
        if edge < 0.045:
            color = dark if min(x, y) > 0.5 - 0.045 else green
        elif edge < 0.06:
            color = cream
        elif diamond > 0.44:
            color = gold if 0.115 < diamond - 0.44 < 0.15 else (rose if diamond > 0.59 else cream)
        elif diamond > 0.40:
            color = dark
        elif radius > 0.265:
            color = rose
        elif radius > 0.235:
            color = cream
        elif radius > 0.215:
            color = dark
        elif radius < 0.045:
            color = gold
        else:
            color = green if radius < 0.065 + 0.13 * petal else cream
        tone = 0.88 + 0.26 * cloud[k]
        vein = rgb("9a8468") if color is cream or color is gold else rgb("e8dcc4")
        return mix(shade(color, tone), vein, 0.45 * veins[k])

    return painted(size, painter, 96)


def marble():
    """Warm white marble with grey-gold veins, for columns and steps, 1.3 m."""
    veins, cloud = marble_veins(256, 3, 21), fractal_noise(256, 3, 5, 23)

    def painter(u, v, k):
        base = mix(rgb("d9cbb0"), rgb("f3ebda"), 0.15 + 1.1 * cloud[k])
        return mix(base, rgb("a68d6c"), 0.5 * veins[k])

    return painted(256, painter, 32)


def bricks(size, columns, rows, colors, mortar, joint, seed, spread, grain=0.3, palette=48):
    """Staggered blocks; joint: half its width in parts of a block's height; spread: how much tones differ."""
    source = random.Random(seed)
    tones = [[(source.choice(colors), 1 + spread * (source.random() - 0.5)) for _ in range(columns)]
             for _ in range(rows)]
    cloud = fractal_noise(size, 8, 4, seed)
    aspect = rows / columns  # block width over block height

    def painter(u, v, k):
        row = int(v * rows)
        across = u * columns + (row % 2) * 0.5
        column = int(across) % columns
        fx, fy = across % 1, v * rows - row
        gap = min(min(fx, 1 - fx) * aspect, min(fy, 1 - fy))
        color, tone = tones[row][column]
        tone *= 1 - grain / 2 + grain * cloud[k]
        return mix(mortar, shade(color, tone), smoothstep(joint * 0.6, joint * 1.5, gap))

    return painted(size, painter, palette)


def ashlar():
    """Limestone blocks, 2.6 m: eight courses."""
    colors = [rgb("e3cfa5"), rgb("ddc496"), rgb("e9d8b4"), rgb("d8bd90")]
    return bricks(256, 4, 8, colors, rgb("b79d75"), 0.035, 31, 0.10)


def brick():
    """Old brick, 1.3 m: sixteen courses."""
    colors = [rgb("b5694a"), rgb("a85a3f"), rgb("c47d58"), rgb("b87550"), rgb("9d5640")]
    return bricks(256, 5, 16, colors, rgb("c9b08e"), 0.085, 37, 0.22)


def plaster(top, bottom, seed):
    """Limewash with stains, 2.6 m."""
    cloud, fine = fractal_noise(256, 3, 6, seed), fractal_noise(256, 24, 3, seed + 1)

    def painter(u, v, k):
        t = cloud[k] * 1.6 - 0.3
        return shade(mix(top, bottom, t), 0.95 + 0.1 * fine[k])

    return painted(256, painter, 24)


def starry_vault():
    """Lapis blue with gilded stars, one bay."""
    size = 256
    cloud = fractal_noise(size, 4, 5, 41)
    stars = [(0.25, 0.25, 1.0), (0.75, 0.75, 1.0), (0.75, 0.25, 0.62), (0.25, 0.75, 0.62), (0.5, 0.5, 0.62),
             (0.0, 0.5, 0.62), (0.5, 0.0, 0.62), (0.0, 0.0, 0.62)]

    def painter(u, v, k):
        color = mix(rgb("3a5ea8"), rgb("5f8fd0"), cloud[k] * 1.5 - 0.25)
        for x, y, s in stars:
            dx, dy = (u - x + 0.5) % 1 - 0.5, (v - y + 0.5) % 1 - 0.5
            r = math.hypot(dx, dy)
            if r < 0.075 * s:
                point = abs((math.atan2(dy, dx) / (math.pi / 4) + 0.5) % 1 - 0.5) * 2  # 0 on a ray
                if r < s * (0.075 - 0.05 * point):
                    color = rgb("f0c65a")
        return color

    return painted(size, painter, 32)


def gallery_floor():
    """Octagons of terracotta with small green squares between them, 1.3 m: four by four."""
    size = 256
    cloud = fractal_noise(size, 8, 4, 43)
    tones = [random.Random(440 + i).random() for i in range(16)]

    def painter(u, v, k):
        x, y = abs(u * 4 % 1 - 0.5), abs(v * 4 % 1 - 0.5)
        tone = 0.85 + 0.12 * tones[int(u * 4) * 4 + int(v * 4)] + 0.2 * cloud[k]
        if x + y > 0.74:
            color = rgb("4f7361") if x + y > 0.77 else rgb("d9c7a4")
        else:
            color = rgb("c08058") if max(x, y) < 0.478 else rgb("d9c7a4")
        return shade(color, tone)

    return painted(size, painter, 48)


def wood(seed, light, dark, planks):
    """Planks that run along v."""
    size = 256
    grain = fractal_noise(size, 16, 4, seed)
    slow = fractal_noise(size, 2, 3, seed + 1)
    tones = [random.Random(seed * 100 + i).random() for i in range(planks)]

    def painter(u, v, k):
        plank = int(u * planks)
        fx = u * planks - plank
        # The grain is read along a stretched line, so that it runs with the plank.
        g = grain[(int(v * size / 16) * size + int(u * size)) % (size * size)]
        t = 0.25 + 0.55 * g + 0.5 * (slow[k] - 0.5) + 0.35 * (tones[plank] - 0.5)
        return shade(mix(dark, light, t), 0.45 if min(fx, 1 - fx) < 0.03 else 1.0)

    return painted(size, painter, 32)


def drape(cloth, deep):
    """Heavy cloth with gold: u across, v along, one repeat of 1.3 m."""
    size = 256
    weave = fractal_noise(size, 64, 2, 51)
    gold, pale = rgb("e2b24a"), rgb("f3d27c")

    def flower(dx, dy, s):
        """Distance-like value of a five-lobed palmette, below 0 inside."""
        r, a = math.hypot(dx, dy) / s, math.atan2(dx, -dy)
        return r - (0.62 + 0.38 * abs(math.cos(2.5 * a))) * (1 - 0.25 * (dy > 0))

    def painter(u, v, k):
        color = mix(deep, cloth, 0.35 + 0.65 * weave[k])
        for cx, cy in ((0.25, 0.25), (0.75, 0.75)):
            dx, dy = (u - cx + 0.5) % 1 - 0.5, (v - cy + 0.5) % 1 - 0.5
            f = flower(dx, dy, 0.135)
            lozenge = abs(dx) / 0.25 + abs(dy) / 0.25
            if f < 0:
                color = gold if f > -0.34 else (deep if f > -0.5 else pale)
            elif 0.93 < lozenge < 1.0:
                color = gold
        return shade(color, 0.9 + 0.2 * weave[k])

    return painted(size, painter, 32)


def runner():
    """The carpet on the stairs: u across its whole width, v along one repeat."""
    size = 128
    weave = fractal_noise(size, 32, 2, 61)
    red, deep, gold, blue = rgb("a3242b"), rgb("71141f"), rgb("dcae52"), rgb("27407a")

    def painter(u, v, k):
        x, y = abs(u - 0.5), abs(v - 0.5)
        if x > 0.46 or 0.32 < x < 0.36:
            color = gold
        elif x > 0.36:
            color = blue
        else:
            lozenge = x / 0.15 + y / 0.38
            color = gold if 0.68 < lozenge < 1.0 else (deep if lozenge < 0.68 or x > 0.27 else red)
        return shade(color, 0.88 + 0.24 * weave[k])

    return painted(size, painter, 32)


def stained_glass():
    """A round window, (u, v) = (0.5, 0.5) in its middle: petals of coloured glass between bars of lead."""
    size = 256
    source = random.Random(91)
    cloud = fractal_noise(size, 8, 4, 91)
    ruby, azure, amber, leaf, violet = (rgb(c) for c in ("c81f2d", "1f57c4", "f2b53a", "2f9a54", "7a3fae"))
    wobble = [source.random() for _ in range(64)]

    def painter(u, v, k):
        x, y = u - 0.5, v - 0.5
        r, a = 2 * math.hypot(x, y), math.atan2(y, x) / (2 * math.pi) % 1
        lead = 0.0
        if r < 0.16:
            color, lead = amber, 0.13 < r
        elif r < 0.56:
            p = a * 12 % 1
            i = int(a * 12)
            petal = abs(p - 0.5) * 2
            rim = 0.50 - 0.10 * petal * petal
            color = (azure if i % 2 else ruby) if r < rim else amber
            lead = min(p, 1 - p) * r * 0.52 < 0.012 or abs(r - rim) < 0.016 or r > 0.535
            if r < 0.26 and not lead:
                color = leaf if i % 2 else amber
            lead = lead or abs(r - 0.26) < 0.012
        else:
            p = a * 24 % 1
            i = int(a * 24)
            d = math.hypot((p - 0.5) * r * 0.262, (r - 0.76) * 0.9)
            color = (ruby, amber, leaf, violet)[i % 4] if d < 0.075 else azure
            lead = min(p, 1 - p) * r * 0.262 < 0.012 or abs(d - 0.075) < 0.011 or r > 0.96
            if r > 0.90 and not lead:
                color = amber if i % 2 else ruby
            lead = lead or abs(r - 0.90) < 0.012
        if lead:
            return (0.13, 0.12, 0.12, 1.0)
        tone = 0.75 + 0.3 * cloud[k] + 0.15 * wobble[(i if r >= 0.16 else 0) % 64]
        return (*shade(color, tone), 0.72)

    return painted(size, painter, 64)


def leaded_glass():
    """Small panes of pale green glass in lead, one repeat of four by six panes."""
    size = 128
    tones = [random.Random(970 + i).random() for i in range(24)]

    def painter(u, v, k):
        p, q = u * 4 % 1, v * 6 % 1
        if min(p, 1 - p) < 0.055 or min(q, 1 - q) < 0.055:
            return (0.16, 0.15, 0.14, 1.0)
        tone = tones[int(u * 4) * 6 + int(v * 6)]
        return (*mix(rgb("8fc6b0"), rgb("d6e3b4"), tone), 0.30 + 0.15 * tone)

    return painted(size, painter, 16)


def water():
    """Ripples, seen from above, one repeat; alpha lets part of the basin show."""
    size = 128
    ripple = fractal_noise(size, 6, 3, 101)

    def painter(u, v, k):
        crest = smoothstep(0.06, 0.0, abs(ripple[k] - 0.5))
        return (*mix(rgb("1f7f8c"), rgb("a8e0de"), 0.15 + 0.6 * crest), 0.78)

    return painted(size, painter, 24)
