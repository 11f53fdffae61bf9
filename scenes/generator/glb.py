# SPDX-License-Identifier: MIT
"""A glTF 2.0 document, written as one binary file (.glb).

Khronos Group, glTF 2.0 Specification, 2021: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
"""

import json
import struct

from generator import png

FLOAT, UINT8, UINT16, UINT32 = 5126, 5121, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
REPEAT, CLAMP_TO_EDGE = 10497, 33071
MAGIC, JSON_CHUNK, BIN_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942


def _snapped(values, digits):
    """Values with so many decimals, in single precision: equal vertices become equal bytes however they came about."""
    return struct.unpack(f"<{len(values)}f", struct.pack(f"<{len(values)}f", *(round(v, digits) + 0.0 for v in values)))


def _tidy(value):
    """Floats in the JSON part with seven decimals, whole ones as integers; entries that are None left out."""
    if isinstance(value, float):
        value = round(value, 7)
        return int(value) if value == int(value) else value
    if isinstance(value, dict):
        return {k: _tidy(v) for k, v in value.items() if v is not None}
    if isinstance(value, (list, tuple)):
        return [_tidy(v) for v in value]
    return value


class Document:
    def __init__(self, copyright_notice):
        self._json = {
            "asset": {"version": "2.0", "generator": "zvo scenes/generate", "copyright": copyright_notice},
            "scene": 0,
            "scenes": [{"nodes": []}],
        }
        self._buffer = bytearray()
        self._images = []  # (name, PNG file): they follow the geometry in the buffer
        self._triangle_counts = []  # of each mesh
        self._extensions = set()

    def _append(self, kind, entry):
        entries = self._json.setdefault(kind, [])
        entries.append(_tidy(entry))
        return len(entries) - 1

    def _view(self, data, target=None):
        self._buffer += b"\0" * (-len(self._buffer) % 4)
        offset = len(self._buffer)
        self._buffer += data
        entry = {"buffer": 0, "byteOffset": offset, "byteLength": len(data), "target": target}
        return self._append("bufferViews", entry)

    def texture(self, name, png_file, wrap=REPEAT):
        """The index of a new texture."""
        self._images.append((name, png_file))
        samplers = self._json.setdefault("samplers", [])
        sampler = {"magFilter": 9729, "minFilter": 9987, "wrapS": wrap, "wrapT": wrap}
        if sampler not in samplers:
            samplers.append(sampler)
        entry = {"name": name, "source": len(self._images) - 1, "sampler": samplers.index(sampler)}
        return self._append("textures", entry)

    def material(self, name, color=(1, 1, 1, 1), texture=None, roughness=0.9, metallic=0.0, emission=None, strength=1.0,
                 emission_texture=None, alpha_mode=None, alpha_cutoff=None, double_sided=False):
        """The index of a new material. color: linear, with alpha or without; emission: linear, at most 1 each."""
        color = (*color, 1.0)[:4]
        entry = {
            "name": name,
            "pbrMetallicRoughness": {
                "baseColorFactor": color if color != (1, 1, 1, 1) else None,
                "baseColorTexture": {"index": texture} if texture is not None else None,
                "metallicFactor": metallic,
                "roughnessFactor": roughness,
            },
            "emissiveFactor": emission,
            "emissiveTexture": {"index": emission_texture} if emission_texture is not None else None,
            "alphaMode": alpha_mode,
            "alphaCutoff": alpha_cutoff,
            "doubleSided": True if double_sided else None,
        }
        if strength != 1.0:
            self._extensions.add("KHR_materials_emissive_strength")
            entry["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}
        return self._append("materials", entry)

    def mesh(self, name, *parts):
        """The index of a new mesh. parts: pairs of a geometry.Mesh and a material index."""
        self._triangle_counts.append(0)
        return self._append("meshes", {"name": name, "primitives": [self._primitive(g, m) for g, m in parts]})

    def _primitive(self, geometry, material):
        # Weld the vertices that are equal in every attribute; drop the triangles that have no area.
        vertices, index_of, remap = [], {}, []
        for i, position in enumerate(geometry.positions):
            color = (*geometry.colors[i], 1.0)[:4] if geometry.colors else ()
            vertex = (
                _snapped(position, 5),
                _snapped(geometry.normals[i], 4),
                _snapped(geometry.uvs[i], 4) if geometry.uvs else None,
                tuple(round(255 * min(max(c, 0.0), 1.0)) for c in color),
            )
            if vertex not in index_of:
                index_of[vertex] = len(vertices)
                vertices.append(vertex)
            remap.append(index_of[vertex])
        triangles, used = [], {}
        for triangle in geometry.triangles:
            corners = [remap[i] for i in triangle]
            if len({vertices[i][0] for i in corners}) == 3:
                triangles.append([used.setdefault(i, len(used)) for i in corners])
        vertices = [vertices[i] for i in used]
        assert triangles
        self._triangle_counts[-1] += len(triangles)

        def floats(kind, column):
            data = [v[column] for v in vertices]
            view = self._view(b"".join(struct.pack(f"<{len(row)}f", *row) for row in data), ARRAY_BUFFER)
            accessor = self._accessor(view, FLOAT, len(data), f"VEC{len(data[0])}")
            if kind == "POSITION":
                # Exactly the smallest and largest of the stored values, so they are not tidied.
                entry = self._json["accessors"][accessor]
                entry["min"], entry["max"] = [min(c) for c in zip(*data)], [max(c) for c in zip(*data)]
            return accessor

        attributes = {"POSITION": floats("POSITION", 0), "NORMAL": floats("NORMAL", 1)}
        if geometry.uvs:
            attributes["TEXCOORD_0"] = floats("TEXCOORD_0", 2)
        if geometry.colors:
            view = self._view(b"".join(bytes(v[3]) for v in vertices), ARRAY_BUFFER)
            attributes["COLOR_0"] = self._accessor(view, UINT8, len(vertices), "VEC4", normalized=True)

        kind, code = (UINT16, "H") if len(vertices) < 65535 else (UINT32, "I")
        flat = [i for t in triangles for i in t]
        indices = self._accessor(
            self._view(struct.pack(f"<{len(flat)}{code}", *flat), ELEMENT_ARRAY_BUFFER), kind, len(flat), "SCALAR")
        return {"attributes": attributes, "indices": indices, "material": material}

    def _accessor(self, view, component, count, kind, **more):
        entry = {"bufferView": view, "componentType": component, "count": count, "type": kind, **more}
        return self._append("accessors", entry)

    def node(self, name=None, parent=None, mesh=None, camera=None, translation=None, rotation=None, scale=None,
             matrix=None):
        """The index of a new node, a child of parent or at the root. rotation: quaternion x, y, z, w."""
        index = self._append("nodes", {
            "name": name, "mesh": mesh, "camera": camera, "translation": translation, "rotation": rotation,
            "scale": scale, "matrix": matrix,
        })
        nodes = self._json["nodes"]
        siblings = self._json["scenes"][0]["nodes"] if parent is None else nodes[parent].setdefault("children", [])
        siblings.append(index)
        return index

    def camera(self, name, matrix, vertical_fov, aspect=None, near=0.05, far=200.0):
        """A perspective camera at matrix (camera to world, 16 numbers by columns), field of view in radians."""
        perspective = {"yfov": vertical_fov, "aspectRatio": aspect, "znear": near, "zfar": far}
        index = self._append("cameras", {"name": name, "type": "perspective", "perspective": perspective})
        return self.node(name, camera=index, matrix=matrix)

    def unique_triangle_count(self):
        return sum(self._triangle_counts)

    def triangle_count(self):
        """Triangles with instances counted each time."""
        return sum(self._triangle_counts[n["mesh"]] for n in self._json["nodes"] if "mesh" in n)

    def to_bytes(self):
        """The file. Adds the images, so it is called once, at the end."""
        for name, png_file in self._images:
            self._append("images", {"name": name, "bufferView": self._view(png_file), "mimeType": "image/png"})
        self._images = []
        if self._extensions:
            self._json["extensionsUsed"] = sorted(self._extensions)
        self._buffer += b"\0" * (-len(self._buffer) % 4)
        self._json["buffers"] = [{"byteLength": len(self._buffer)}]
        text = json.dumps(self._json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        return b"".join([
            struct.pack("<III", MAGIC, 2, 12 + 8 + len(text) + 8 + len(self._buffer)),
            struct.pack("<II", len(text), JSON_CHUNK), text,
            struct.pack("<II", len(self._buffer), BIN_CHUNK), bytes(self._buffer),
        ])


def canonical(data):
    """What a .glb file says, free of how its images are packed."""
    length, = struct.unpack_from("<I", data, 12)
    content = json.loads(data[20:20 + length])
    buffer = data[28 + length:]
    views = []
    for view in content["bufferViews"]:
        body = buffer[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
        views.append(png.unpacked(body) if body.startswith(png.SIGNATURE) else body)
    del content["bufferViews"], content["buffers"]
    return content, views
