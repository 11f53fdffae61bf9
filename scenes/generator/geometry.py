# SPDX-License-Identifier: MIT
"""Triangle meshes and the shapes that buildings are made of.

Units are metres, y is up, triangles are counterclockwise when seen from outside. Texture coordinates are metres too,
unless a function says otherwise, so that one texture has one scale everywhere; Mesh.uvs_scaled brings them to the
size of the texture.
"""

import math

from generator import vector as vec


class Mesh:
    """A triangle list. The arrays are as long as positions; uvs and colors may be empty."""

    def __init__(self):
        self.positions, self.normals, self.uvs, self.colors = [], [], [], []
        self.triangles = []

    def vertex(self, position, normal, uv=(0.0, 0.0), color=None):
        self.positions.append(position)
        self.normals.append(normal)
        self.uvs.append(uv)
        if color is not None:
            self.colors.append(color)
        return len(self.positions) - 1

    def polygon(self, corners, uvs=None, color=None):
        """A flat convex polygon, counterclockwise; by default textured by its largest projection."""
        normal = (0.0, 0.0, 0.0)
        for i in range(1, len(corners) - 1):
            normal = vec.add(normal, vec.cross(vec.sub(corners[i], corners[0]), vec.sub(corners[i + 1], corners[0])))
        normal = vec.normalized(normal)
        uvs = uvs or [planar_uv(c, normal) for c in corners]
        first = [self.vertex(c, normal, uv, color) for c, uv in zip(corners, uvs)][0]
        self.triangles += [(first, first + i, first + i + 1) for i in range(1, len(corners) - 1)]
        return self

    def grid(self, columns, rows, point):
        """A surface of columns x rows cells, two triangles each.

        point(u, v), both 0 to 1: position, normal, uv and optionally a colour. The outside is where the direction of
        growing u turns counterclockwise into that of growing v.
        """
        first = len(self.positions)
        for j in range(rows + 1):
            for i in range(columns + 1):
                self.vertex(*point(i / columns, j / rows))
        for j in range(rows):
            for i in range(columns):
                a = first + j * (columns + 1) + i
                b, c, d = a + 1, a + columns + 2, a + columns + 1
                self.triangles += [(a, b, c), (a, c, d)]
        return self

    def append(self, other, transform=None):
        """Adds the other mesh, moved by the transform; a reflection keeps its outside outside."""
        first = len(self.positions)
        if transform is None:
            self.positions += other.positions
            self.normals += other.normals
            flip = False
        else:
            matrix = vec.cofactors(transform)
            rows = [row[:3] for row in transform]
            flip = vec.dot(rows[0], vec.cross(rows[1], rows[2])) < 0
            self.positions += [vec.transformed(transform, p) for p in other.positions]
            self.normals += [vec.normalized(tuple(vec.dot(row, n) for row in matrix)) for n in other.normals]
        self.uvs += other.uvs
        self.colors += other.colors
        self.triangles += [(a + first, c + first, b + first) if flip else (a + first, b + first, c + first)
                           for a, b, c in other.triangles]
        return self

    def moved(self, transform):
        return Mesh().append(self, transform)

    def flipped(self):
        """The same surface with its outside on the other side."""
        mesh = Mesh().append(self)
        mesh.normals = [vec.scaled(n, -1.0) for n in mesh.normals]
        mesh.triangles = [(a, c, b) for a, b, c in mesh.triangles]
        return mesh

    def uvs_scaled(self, period_u, period_v=None):
        """The same mesh with uvs in repeats of a texture of that size in metres."""
        mesh = Mesh().append(self)
        mesh.uvs = [(u / period_u, v / (period_v or period_u)) for u, v in self.uvs]
        return mesh

    def without_uvs(self):
        mesh = Mesh().append(self)
        mesh.uvs = []
        return mesh


def planar_uv(p, normal):
    """Texture coordinates from the axis that the normal is closest to; v runs downwards on walls."""
    x, y, z = (abs(c) for c in normal)
    if y >= x and y >= z:
        return (p[0], p[2])
    return (p[0] if z >= x else p[2], -p[1])


def box(low, high, skip=""):
    """A box without the faces named in skip, e.g. "-y +y"."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    faces = {
        "-x": [(x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)],
        "+x": [(x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)],
        "-y": [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)],
        "+y": [(x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)],
        "-z": [(x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)],
        "+z": [(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)],
    }
    mesh = Mesh()
    for name, corners in faces.items():
        if name not in skip.split():
            mesh.polygon(corners)
    return mesh


def bevelled_block(width, height, depth, bevel=0.02):
    """A block on y = 0, centred, with its upper edges cut; without a bottom."""
    w, d, h = width / 2, depth / 2, height - bevel
    mesh = box((-w, 0, -d), (w, h, d), skip="-y +y")
    iw, idp = w - bevel, d - bevel
    lower = [(-w, h, d), (w, h, d), (w, h, -d), (-w, h, -d)]
    upper = [(-iw, height, idp), (iw, height, idp), (iw, height, -idp), (-iw, height, -idp)]
    for i in range(4):
        j = (i + 1) % 4
        mesh.polygon([lower[i], lower[j], upper[j], upper[i]])
    return mesh.polygon(upper)


def run_normals(points):
    """Unit normals of a polyline in the plane, to the right of its direction, smooth along it."""
    normals = []
    for i in range(len(points)):
        dx = points[min(i + 1, len(points) - 1)][0] - points[max(i - 1, 0)][0]
        dy = points[min(i + 1, len(points) - 1)][1] - points[max(i - 1, 0)][1]
        length = math.hypot(dx, dy) or 1.0
        normals.append((dy / length, -dx / length))
    return normals


def arc(center, radius, start, end, segments, radius_y=None):
    """Points of an elliptic arc in the plane, angles in degrees."""
    angles = [math.radians(start + (end - start) * i / segments) for i in range(segments + 1)]
    return [(center[0] + radius * math.cos(a), center[1] + (radius_y or radius) * math.sin(a)) for a in angles]


def lathe(runs, segments, start=0.0, end=360.0):
    """Profiles turned about the y axis, in degrees from +z towards +x.

    runs: polylines of (radius, y), bottom to top for an outside that looks away from the axis. A run is shaded smoothly
    along itself, edges between runs are sharp. u is the way around at the run's largest radius, v runs downwards.
    """
    mesh = Mesh()
    for run in runs:
        normals = run_normals(run)
        radius = max(r for r, _ in run)
        way = [0.0]
        for (r0, y0), (r1, y1) in zip(run, run[1:]):
            way.append(way[-1] + math.hypot(r1 - r0, y1 - y0))
        count = len(run) - 1

        def point(u, v):
            i = round(v * count)
            a = math.radians(start + (end - start) * u)
            s, c = math.sin(a), math.cos(a)
            (r, y), (nr, ny) = run[i], normals[i]
            return (r * s, y, r * c), (nr * s, ny, nr * c), (radius * a, -way[i] - run[0][1])

        mesh.grid(segments, count, point)
    return mesh


def loop_sweep(runs, half_x, half_z, inward=False):
    """Profiles led around a rectangle, with mitred corners: cornices, kerbs.

    runs: polylines of (distance out of the rectangle, y), bottom to top; inward: the profile grows into the rectangle.
    """
    corners = [(1, 1), (1, -1), (-1, -1), (-1, 1)]  # counterclockwise from above
    sign = -1 if inward else 1
    mesh = Mesh()
    for run in runs:
        normals = run_normals(run)
        way = [0.0]
        for (r0, y0), (r1, y1) in zip(run, run[1:]):
            way.append(way[-1] + math.hypot(r1 - r0, y1 - y0))
        for side in range(4):
            a, b = corners[side], corners[(side + 1) % 4]
            if inward:
                a, b = b, a
            out = ((a[0] + b[0]) / 2 * sign, (a[1] + b[1]) / 2 * sign)
            first = len(mesh.positions)
            for i, ((r, y), (nr, ny)) in enumerate(zip(run, normals)):
                for sx, sz in (a, b):
                    p = (sx * (half_x + sign * r), y, sz * (half_z + sign * r))
                    along = p[0] if out[1] else p[2]
                    mesh.vertex(p, (out[0] * nr, ny, out[1] * nr), (along, -way[i] - run[0][1]))
            for i in range(len(run) - 1):
                k = first + 2 * i
                mesh.triangles += [(k, k + 1, k + 3), (k, k + 3, k + 2)]
    return mesh


def tube(points, radius, segments, closed=False, color=None):
    """A round tube along points; radius may be a function of the way (0 to 1). uv: metres around, metres along."""
    count = len(points)
    at = radius if callable(radius) else lambda t: radius
    tangents = []
    for i in range(count):
        before = points[i - 1] if i or closed else points[0]
        after = points[(i + 1) % count] if i + 1 < count or closed else points[-1]
        tangents.append(vec.normalized(vec.sub(after, before)))
    # Frames that turn as little as possible from point to point.
    normal = vec.normalized(vec.cross(tangents[0], (0.31, 0.87, 0.38) if abs(tangents[0][1]) < 0.9 else (1, 0, 0)))
    frames = []
    for t in tangents:
        normal = vec.normalized(vec.sub(normal, vec.scaled(t, vec.dot(normal, t))))
        frames.append((normal, vec.cross(t, normal)))
    way = [0.0]
    for a, b in zip(points, points[1:]):
        way.append(way[-1] + math.dist(a, b))

    def point(u, v):
        i = round(v * (count if closed else count - 1))
        (n, b), p = frames[i % count], points[i % count]
        a = 2 * math.pi * u
        out = vec.add(vec.scaled(n, math.cos(a)), vec.scaled(b, math.sin(a)))
        r = at(v)
        return vec.add(p, vec.scaled(out, r)), out, (r * a, way[i % count]), *((color,) if color else ())

    return Mesh().grid(segments, count if closed else count - 1, point)


def wall(bounds, front, back, faces="front back"):
    """A wall between two curves over x: bounds is a list of (x, lower, upper) from left to right.

    front, back: its z on the two sides; faces: any of front, back, lower, upper, left, right. The lower face is shaded
    smoothly (the inside of an arch).
    """
    mesh, faces = Mesh(), faces.split()
    for (x0, l0, u0), (x1, l1, u1) in zip(bounds, bounds[1:]):
        if "front" in faces:
            mesh.polygon([(x0, l0, front), (x1, l1, front), (x1, u1, front), (x0, u0, front)])
        if "back" in faces:
            mesh.polygon([(x1, l1, back), (x0, l0, back), (x0, u0, back), (x1, u1, back)])
        if "upper" in faces:
            mesh.polygon([(x0, u0, front), (x1, u1, front), (x1, u1, back), (x0, u0, back)])
    if "lower" in faces:
        run = [(x, lower) for x, lower, _ in bounds]
        normals = run_normals(run)
        count, way = len(run) - 1, [0.0]
        for p, q in zip(run, run[1:]):
            way.append(way[-1] + math.dist(p, q))

        def point(u, v):
            i = round(u * count)
            return (*run[i], back + (front - back) * v), (*normals[i], 0.0), (way[i], (front - back) * v)

        mesh.grid(count, 1, point)
    if "left" in faces:
        x, low, high = bounds[0]
        mesh.polygon([(x, low, back), (x, low, front), (x, high, front), (x, high, back)])
    if "right" in faces:
        x, low, high = bounds[-1]
        mesh.polygon([(x, low, front), (x, low, back), (x, high, back), (x, high, front)])
    return mesh


def half_circle(center_x, center_y, radius, segments, rise=None):
    """Points (x, y) of an arch from left to right; rise: height of an elliptic one."""
    angles = [math.pi * i / segments for i in range(segments + 1)]
    return [(center_x - radius * math.cos(a), center_y + (rise or radius) * math.sin(a)) for a in angles]


def moulded_arch(radius, runs, segments):
    """A moulding around a half circle that stands on y = 0 and looks to +z.

    runs: polylines of (radial distance from radius, z), from the inner edge outwards.
    """
    turned = [[(radius + r, z) for r, z in reversed(run)] for run in runs]
    # The lathe turns from -x over +z to +x about y; exchanging y and z stands the half circle up.
    return lathe(turned, segments, -90.0, 90.0).moved(((1, 0, 0, 0), (0, 0, 1, 0), (0, 1, 0, 0)))


def disc(radius, segments, y=0.0):
    """A flat disc that looks up; uv from -radius to radius."""
    corners = [(radius * math.sin(2 * math.pi * i / segments), y, radius * math.cos(2 * math.pi * i / segments))
               for i in range(segments)]
    return Mesh().polygon(corners)


def sphere(radius, segments, rings):
    run = [(radius * math.sin(math.pi * i / rings), -radius * math.cos(math.pi * i / rings)) for i in range(rings + 1)]
    mesh = lathe([run], segments)
    mesh.normals = [vec.normalized(p) for p in mesh.positions]
    return mesh


def sheet(columns, rows, place, uv, color=None):
    """A surface from positions alone: place(u, v) -> position, uv(u, v); normals by differences."""
    def point(u, v):
        e = 1e-3
        du = vec.sub(place(min(u + e, 1), v), place(max(u - e, 0), v))
        dv = vec.sub(place(u, min(v + e, 1)), place(u, max(v - e, 0)))
        return place(u, v), vec.normalized(vec.cross(du, dv)), uv(u, v), *((color(u, v),) if color else ())

    return Mesh().grid(columns, rows, point)
