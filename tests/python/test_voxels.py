# SPDX-License-Identifier: MIT
"""Voxels of arrays and files: those of the command line, and of an oracle in NumPy."""

import subprocess
import sys
import unittest
import warnings

import numpy as np

import meshes
import oracle
import support
import zvo


class EqualTheCommandLine(support.Case):
    """Ten meshes: as arrays here, as files there."""

    def check(self, mesh, resolution, fill="none", coverage="thin"):
        random = np.random.default_rng(3)
        colors = random.integers(0, 256, mesh[0].shape, np.uint8)
        meshes.write_ply(self.folder / "mesh.ply", *mesh, colors)
        for kind in ("morton", "ply"):
            support.run_zvo("voxelize", self.folder / "mesh.ply", "-o", self.folder / f"voxels.{kind}", "--resolution",
                            resolution, "--fill", fill, "--coverage", coverage)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", zvo.ZvoWarning)
            tree = zvo.voxelize(*mesh, colors=colors, resolution=resolution, fill=fill, coverage=coverage)
        self.assertGreater(len(tree), 0)
        self.expect_equal(tree.coords, support.read_codes(self.folder / "voxels.morton"))
        rows = support.read_ply(self.folder / "voxels.ply")
        self.expect_equal(tree.points, np.stack([rows["x"], rows["y"], rows["z"]], 1))
        self.expect_equal(tree.normals, np.stack([rows["nx"], rows["ny"], rows["nz"]], 1))
        self.expect_equal(tree.colors, np.stack([rows["red"], rows["green"], rows["blue"]], 1))

    def test_cube(self):
        self.check(meshes.cube(), 64)

    def test_filled_sphere(self):
        self.check(meshes.sphere(), 64, fill="solid")

    def test_torus_by_parity(self):
        self.check(meshes.torus(), 128, fill="parity")

    def test_conservative_waves(self):
        self.check(meshes.waves(), 128, coverage="conservative")

    def test_open_waves_filled_robustly(self):
        self.check(meshes.waves(), 32, fill="robust")

    def test_soup(self):
        self.check(meshes.soup(500, 1), 64)

    def test_slivers(self):
        self.check(meshes.slivers(), 256)


class EqualTheCommandLineOnScenes(support.Case):
    def check(self, name, resolution):
        path = support.SCENES / name
        support.run_zvo("voxelize", path, "-o", self.folder / "voxels.morton", "--resolution", resolution)
        self.expect_equal(zvo.load(path, resolution=resolution).coords,
                          support.read_codes(self.folder / "voxels.morton"))

    def test_cube(self):
        self.check("cube.glb", 32)

    def test_cornell_box(self):
        self.check("cornell_box.glb", 128)

    def test_knot(self):
        self.check("knot.glb", 256)


class EqualTheOracle(support.Case):
    def check(self, mesh, coverage):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", zvo.ZvoWarning)
            tree = zvo.voxelize(*mesh, resolution=16, coverage=coverage)
        self.expect_equal(tree.coords, oracle.voxels(*mesh, 16, tree.origin, tree.voxel_size, coverage))

    def test_thin(self):
        for mesh in (meshes.cube(), meshes.sphere(8), meshes.soup(100, 2), meshes.soup(100, 3, 0.02)):
            self.check(mesh, "thin")

    def test_conservative(self):
        for mesh in (meshes.cube(), meshes.sphere(8), meshes.soup(100, 4), meshes.soup(100, 5, 0.02)):
            self.check(mesh, "conservative")


class Voxelize(support.Case):
    def test_points_have_the_voxels_that_they_lie_in(self):
        points = np.random.default_rng(5).random((1000, 3)).astype(np.float32)
        tree = zvo.voxelize(points, resolution=32)
        cells = np.clip(oracle.snapped(points, tree.origin, tree.voxel_size) // 256, 0, 31)
        mask = np.zeros((32, 32, 32), bool)
        mask[tuple(cells.T)] = True
        self.expect_equal(tree.coords, oracle.cells_of(mask))

    def test_no_faces_are_no_points(self):
        with self.assertWarnsRegex(zvo.ZvoWarning, "there are no voxels"):
            tree = zvo.voxelize(meshes.cube()[0], np.zeros((0, 3), np.uint32), resolution=8)
        self.assertEqual(tree.coords.shape, (0, 3))
        self.assertEqual(tree.colors.shape, (0, 3))

    def test_bounds_place_the_grid(self):
        tree = zvo.voxelize(*meshes.cube(), resolution=8, bounds=[[-1, -1, -1], [3, 1, 1]])
        self.expect_equal(tree.origin, [-1, -1, -1])
        self.assertEqual(tree.voxel_size, 0.5)
        self.expect_equal(tree.coords, oracle.voxels(*meshes.cube(), 8, tree.origin, 0.5, "thin"))

    def test_bytes_are_srgb_and_fractions_are_linear(self):
        vertices, faces = meshes.cube()
        wanted = np.array([200, 100, 3], np.uint8)
        linear = (((wanted / 255 + 0.055) / 1.055) ** 2.4)[None].repeat(8, 0)
        linear[:, 2] = 3 / 255 / 12.92
        for colors in (np.tile(wanted, (8, 1)), np.tile([*wanted, 0], (8, 1)).astype(np.uint8), linear):
            tree = zvo.voxelize(vertices, faces, colors=colors, resolution=16)
            self.expect_equal(tree.colors, np.tile(wanted, (len(tree), 1)))

    def test_textures_begin_at_their_top_row(self):
        vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float32)
        uv = np.array([[0, 1], [1, 1], [1, 0], [0, 0]], np.float32)
        texture = np.zeros((64, 64, 3), np.uint8)
        texture[:32] = [255, 0, 0]
        texture[32:] = [0, 0, 255]
        tree = zvo.voxelize(vertices, [[0, 1, 2], [0, 2, 3]], uv=uv, texture=texture, resolution=16)
        is_high = tree.coords[:, 1] >= 8
        is_far = np.abs(tree.coords[:, 1] - 7.5) > 1
        self.expect_equal(tree.colors[is_high & is_far], np.tile([255, 0, 0], ((is_high & is_far).sum(), 1)))
        self.expect_equal(tree.colors[~is_high & is_far], np.tile([0, 0, 255], ((~is_high & is_far).sum(), 1)))

    def test_normals_may_have_any_length(self):
        vertices, faces = meshes.sphere()
        tree = zvo.voxelize(vertices, faces, normals=7 * vertices, resolution=32)
        outward = tree.points / np.linalg.norm(tree.points, axis=1, keepdims=True)
        self.assertGreater((tree.normals * outward).sum(1).min(), 0.98)

    def test_solid_has_the_inside_without_normals(self):
        hollow = zvo.voxelize(*meshes.sphere(), resolution=64)
        solid = zvo.voxelize(*meshes.sphere(), resolution=64, fill="solid")
        volume = len(solid) * solid.voxel_size ** 3
        self.assertAlmostEqual(volume, 4 / 3 * np.pi, delta=0.25)
        on_surface = np.zeros((64, 64, 64), bool)
        on_surface[tuple(hollow.coords.T)] = True
        inside = ~on_surface[tuple(solid.coords.T)]
        self.assertEqual(inside.sum(), len(solid) - len(hollow))
        self.assertFalse(solid.normals[inside].any())

    def test_without_attributes(self):
        tree = zvo.voxelize(*meshes.cube(), resolution=16, attributes=False)
        self.assertIsNone(tree.colors)
        self.assertIsNone(tree.normals)
        self.expect_equal(tree.coords, zvo.voxelize(*meshes.cube(), resolution=16).coords)

    def test_what_is_left_out_is_warned_of(self):
        vertices, faces = meshes.cube()
        vertices[0, 0] = np.nan
        with self.assertWarnsRegex(zvo.ZvoWarning, r"nonfinite") as caught:
            zvo.voxelize(vertices, faces, resolution=16)
        self.assertEqual(caught.filename.rsplit("/", 1)[-1], "test_voxels.py")

    def test_nothing_is_told_but_by_warnings(self):
        code = "import zvo; zvo.voxelize([[0, 0, 0]], [[0, 0, 0]], resolution=8)"
        result = subprocess.run([sys.executable, "-W", "ignore", "-c", code], capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))


if __name__ == "__main__":
    unittest.main()
