# SPDX-License-Identifier: MIT
"""Names for the materials and meshes of a document, so that a mesh is built once and placed often."""

from generator.glb import Document


class Composer:
    def __init__(self, copyright_notice):
        self.document = Document(copyright_notice)
        self._materials = {}  # name -> (index, period, is it textured)
        self._meshes = {}

    def material(self, name, color=(1, 1, 1, 1), period=None, **settings):
        """A material for define. period: metres of one repeat of its texture; None: uvs are its texture coordinates."""
        index = self.document.material(name, color, **settings)
        self._materials[name] = (index, period, settings.get("texture") is not None)

    def define(self, name, *parts):
        """A mesh for place. parts: pairs of a geometry.Mesh and a material's name; uvs become those of the texture."""
        primitives = []
        for geometry, material_name in parts:
            material, period, textured = self._materials[material_name]
            if not geometry.triangles:
                continue
            if not textured:
                geometry = geometry.without_uvs()
            elif period is not None:
                geometry = geometry.uvs_scaled(period)
            primitives.append((geometry, material))
        self._meshes[name] = self.document.mesh(name, *primitives)

    def place(self, mesh, at=(0, 0, 0), parent=None, rotation=None, scale=None):
        """A node with a defined mesh. rotation: a quaternion."""
        return self.group(None, at, parent, mesh=self._meshes[mesh], rotation=rotation, scale=scale)

    def group(self, name, at=(0, 0, 0), parent=None, **transform):
        """A node, to be the parent of others."""
        return self.document.node(name, parent=parent, translation=list(at) if any(at) else None, **transform)
