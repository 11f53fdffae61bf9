# SPDX-License-Identifier: MIT
"""What comes in and goes out: kinds of arrays, and arguments that make no sense."""

import array
import inspect
import unittest

import numpy as np

import meshes
import support
import zvo


class Tensor:
    """What a library of tensors gives: DLPack, and nothing else."""

    def __init__(self, values, device=(1, 0)):
        self._values, self._device = values, device

    def __dlpack__(self, stream=None):
        return self._values.__dlpack__()

    def __dlpack_device__(self):
        return self._device


class Arrays(support.Case):
    def setUp(self):
        super().setUp()
        self.vertices, self.faces = meshes.sphere()
        self.wanted = zvo.voxelize(self.vertices, self.faces, resolution=32).coords

    def check(self, vertices, faces):
        self.expect_equal(zvo.voxelize(vertices, faces, resolution=32).coords, self.wanted)

    def test_lists(self):
        self.check(self.vertices.tolist(), self.faces.tolist())

    def test_doubles_and_signed_indices(self):
        self.check(self.vertices.astype(np.float64), self.faces.astype(np.int64))

    def test_buffers(self):
        buffer = memoryview(array.array("f", self.vertices.ravel())).cast("B").cast("f", self.vertices.shape)
        self.check(buffer, self.faces)

    def test_tensors_through_dlpack(self):
        self.check(Tensor(self.vertices), Tensor(self.faces.astype(np.int64)))

    def test_rows_that_do_not_stand_one_behind_the_other(self):
        self.check(np.asfortranarray(self.vertices), np.repeat(self.faces, 2, axis=0)[::2])

    def test_results_go_out_through_dlpack(self):
        tree = zvo.voxelize(self.vertices, self.faces, resolution=32)
        self.expect_equal(np.from_dlpack(Tensor(tree.coords)), self.wanted)
        self.assertIs(tree.coords, tree.coords)

    def test_inputs_stay_as_they_are(self):
        before = self.vertices.copy()
        zvo.voxelize(self.vertices, self.faces, normals=self.vertices, resolution=32)
        self.expect_equal(self.vertices, before)

    def test_types_and_shapes_of_results(self):
        tree = zvo.voxelize(self.vertices, self.faces, resolution=32)
        count = len(tree)
        for values, dtype, shape in ((tree.coords, np.int32, (count, 3)), (tree.colors, np.uint8, (count, 3)),
                                     (tree.normals, np.float32, (count, 3)), (tree.points, np.float32, (count, 3)),
                                     (tree.origin, np.float32, (3,))):
            self.assertEqual((values.dtype, values.shape), (np.dtype(dtype), shape))


class Errors(support.Case):
    def expect(self, pattern, **changes):
        vertices, faces = meshes.cube()
        arguments = {"vertices": vertices, "faces": faces, "resolution": 8} | changes
        with self.assertRaisesRegex(ValueError, pattern):
            zvo.voxelize(**arguments)

    def test_shapes(self):
        self.expect(r"vertices: expected an array of shape \(N, 3\), got \(8, 2\)", vertices=np.zeros((8, 2)))
        self.expect(r"vertices: expected an array of shape", vertices=np.zeros(24))
        self.expect(r"faces: expected an array of shape \(N, 3\)", faces=np.zeros((2, 4), int))
        self.expect(r"colors: expected an array of shape", colors=np.zeros((8, 2)))
        self.expect(r"colors: expected 8 rows, one for each of vertices, got 7", colors=np.zeros((7, 3)))
        self.expect(r"normals: expected 8 rows", normals=np.zeros((9, 3)))
        self.expect(r"uv: expected an array of shape \(N, 2\)", uv=np.zeros((8, 3)))
        self.expect(r"texture: expected an array of uint8", uv=np.zeros((8, 2)), texture=np.zeros((4, 4, 3)))
        self.expect(r"texture: goes with uv", texture=np.zeros((4, 4, 3), np.uint8))
        self.expect(r"bounds: expected 2 rows", bounds=np.zeros((3, 3)))

    def test_types(self):
        self.expect(r"vertices: expected numbers, got an array of complex128", vertices=np.zeros((8, 3), complex))
        self.expect(r"vertices: expected numbers", vertices=np.full((8, 3), "a"))
        self.expect(r"faces: expected whole numbers, got an array of float64", faces=np.zeros((2, 3)))
        self.expect(r"colors: expected uint8 or fractions, got an array of int64", colors=np.zeros((8, 3), int))

    def test_values(self):
        self.expect(r"faces: expected indices of 8 vertices, got some from 0 to 8", faces=[[0, 1, 8]])
        self.expect(r"faces: .* from -1 to 2", faces=[[-1, 1, 2]])
        self.expect(r"resolution: expected a power of two", resolution=100)
        self.expect(r"resolution: expected a power of two", resolution=1 << 18)
        self.expect(r"fill half: expected one of none, solid, parity, robust", fill="half")
        self.expect(r"coverage thick: expected one of", coverage="thick")
        self.expect(r"bounds: expected the low and the high corner", bounds=[[1, 1, 1], [0, 2, 2]])

    def test_numbers_that_are_not_whole(self):
        with self.assertRaisesRegex(TypeError, "cannot be interpreted as an integer"):
            zvo.voxelize(*meshes.cube(), resolution=8.0)
        tree = zvo.voxelize(*meshes.cube(), resolution=np.int64(8))
        with self.assertRaisesRegex(TypeError, "cannot be interpreted as an integer"):
            tree.render((8.5, 8))

    def test_tensors_on_devices(self):
        class Far(Tensor):
            def __dlpack__(self, stream=None):
                raise BufferError("the tensor is on another device")

        self.expect(r"vertices: cannot be read through DLPack .* on the CPU", vertices=Far(None, (2, 0)))

    def test_files(self):
        with self.assertRaises(zvo.ZvoError) as raised:
            zvo.load(self.folder / "gone.glb")
        self.assertEqual(raised.exception.code, "input")
        self.assertIn("gone.glb", str(raised.exception))
        tree = zvo.voxelize(*meshes.cube(), resolution=8)
        with self.assertRaises(zvo.ZvoError) as raised:
            tree.save(self.folder / "gone" / "cube.zvo")
        self.assertEqual(raised.exception.code, "output")
        with self.assertRaisesRegex(ValueError, "kind of file is not clear; its name ends in .ply"):
            tree.save(self.folder / "cube.stl")
        with self.assertRaisesRegex(ValueError, "pictures are files that end in"):
            zvo.write_picture(self.folder / "cube.txt", np.zeros((4, 4, 4), np.uint8))
        tree.save(self.folder / "cube.zvo")
        with self.assertRaisesRegex(ValueError, "holds voxels; resolution"):
            zvo.load(self.folder / "cube.zvo", resolution=64)
        with self.assertRaisesRegex(ValueError, "up u: expected one of x"):
            zvo.load(support.SCENES / "cube.glb", up="u")

    def test_devices(self):
        self.assertTrue(any(not device.reasons for device in zvo.devices()))
        with self.assertRaises(zvo.ZvoError) as raised:
            zvo.voxelize(*meshes.cube(), resolution=8, device="no such device")
        self.assertEqual(raised.exception.code, "device")
        self.assertIn("no such device", str(raised.exception))

    def test_trees(self):
        dag = zvo.voxelize(*meshes.sphere(), resolution=32).compress()
        with self.assertRaisesRegex(ValueError, "a DAG already"):
            dag.compress()
        with self.assertRaisesRegex(ValueError, "expected both or neither"):
            dag.render(eye=[0, 0, 3])
        with self.assertRaisesRegex(ValueError, "integrator light: expected one of primary, path"):
            dag.render(integrator="light")
        with self.assertRaisesRegex(ValueError, "sofa: there is no such camera"):
            dag.render(camera="sofa")
        with self.assertRaisesRegex(ValueError, "directions: expected 2 rows, one for each of origins, got 3"):
            zvo.trace(dag, np.zeros((2, 3)), np.zeros((3, 3)))


class Documentation(unittest.TestCase):
    def test_everything_public_says_what_it_is(self):
        for name in zvo.__all__:
            value = getattr(zvo, name)
            if not isinstance(value, str):
                self.assertTrue(inspect.getdoc(value), name)
        for name, value in vars(zvo.Tree).items():
            if not name.startswith("_"):
                self.assertTrue(inspect.getdoc(value), name)

    def test_the_version_is_that_of_the_headers(self):
        header = (support.SOURCES / "include/zvo/version.h").read_text()
        self.assertIn(f'"{zvo.__version__}"', header)


if __name__ == "__main__":
    unittest.main()
