# SPDX-License-Identifier: MIT
"""What is done with trees: rays, DAGs, files, pictures, threads."""

import os
import threading
import unittest

import numpy as np

import meshes
import oracle
import support
import zvo


class Rays(support.Case):
    def rays(self, tree, count):
        random = np.random.default_rng(11)
        edge = tree.resolution * tree.voxel_size
        starts = tree.origin + edge * (random.random((count, 3)) * 2 - 0.5)
        targets = tree.origin + edge * random.random((count, 3))
        return starts.astype(np.float32), (3 * (targets - starts)).astype(np.float32)

    def check(self, tree):
        starts, ways = self.rays(tree, 400)
        hits = zvo.trace(tree, starts, ways)
        rows, times, margins = oracle.first_hits(tree.coords, tree.origin, tree.voxel_size, starts, ways)
        is_clear = margins > 1e-5
        self.assertGreater(is_clear.sum(), 350)
        self.assertGreater((rows[is_clear] >= 0).sum(), 50)
        self.assertGreater((rows[is_clear] < 0).sum(), 50)
        self.expect_equal(hits.hit[is_clear], rows[is_clear] >= 0)
        found = is_clear & (rows >= 0)
        self.expect_equal(hits.voxel[found], tree.coords[rows[found]])
        self.expect_equal(hits.normal[found], tree.normals[rows[found]])
        self.expect_equal(hits.color[found], tree.colors[rows[found]])
        np.testing.assert_allclose(hits.t[found], times[found], atol=1e-5)
        self.expect_equal(hits.t[~hits.hit], np.inf)
        self.expect_equal(hits.voxel[~hits.hit], -1)
        self.expect_equal(hits.face[~hits.hit], -1)
        self.assertFalse(hits.undecided.any())

    def test_find_what_all_voxels_give(self):
        self.check(zvo.voxelize(*meshes.torus(), resolution=32))

    def test_find_the_same_in_a_dag(self):
        self.check(zvo.voxelize(*meshes.torus(), resolution=32).compress())

    def test_come_by_faces(self):
        tree = zvo.voxelize(*meshes.cube(), resolution=8)
        for axis in range(3):
            start, way = np.full((1, 3), 0.5), np.zeros((1, 3))
            start[0, axis], way[0, axis] = 3, -2
            hits = zvo.trace(tree, start, way)
            self.assertEqual((hits.face[0], hits.t[0]), (axis, 1.0))
        inside = zvo.trace(tree, [[0.01, 0.5, 0.5]], [[1, 0, 0]])
        self.assertEqual(inside.face[0], 3)
        self.assertLess(inside.t[0], 1e-30)

    def test_count_from_t_min_to_t_max(self):
        tree = zvo.voxelize(*meshes.cube(), resolution=8)
        ray = ([[0.5, 0.5, 3]], [[0, 0, -1]])
        self.assertFalse(zvo.trace(tree, *ray, t_max=1.9).hit[0])
        self.assertTrue(zvo.trace(tree, *ray, t_max=2.1).hit[0])
        self.expect_equal(zvo.trace(tree, *ray, t_min=2.5).voxel, [[4, 4, 0]])

    def test_may_be_none(self):
        hits = zvo.trace(zvo.voxelize(*meshes.cube(), resolution=8), np.zeros((0, 3)), np.zeros((0, 3)))
        self.assertEqual(hits.t.shape, (0,))
        self.assertEqual(hits.voxel.shape, (0, 3))

    def test_that_are_not_finite_find_nothing(self):
        tree = zvo.voxelize(*meshes.cube(), resolution=8)
        self.assertFalse(zvo.trace(tree, [[np.nan, 0.5, 0.5]], [[1, 0, 0]]).hit[0])


class Trees(support.Case):
    def test_dags_have_the_same_voxels(self):
        tree = zvo.voxelize(*meshes.torus(), resolution=256)
        dag = tree.compress()
        self.assertTrue(dag.is_dag)
        self.assertLess(dag.bytes, tree.bytes)
        for name in ("coords", "colors", "normals"):
            self.expect_equal(getattr(dag, name), getattr(tree, name))
        self.expect_equal(tree.render((64, 48)), dag.render((64, 48)))

    def test_filled_trees_become_dags(self):
        tree = zvo.voxelize(*meshes.sphere(), resolution=64, fill="solid")
        dag = tree.compress()
        self.assertTrue(dag.is_dag)
        for name in ("coords", "colors", "normals"):
            self.expect_equal(getattr(dag, name), getattr(tree, name))
        inside = zvo.voxelize(*meshes.sphere(), resolution=64, fill="solid", shell="none")
        self.assertLess(len(inside), len(tree))
        self.assertLessEqual(set(map(tuple, inside.coords)), set(map(tuple, tree.coords)))

    def test_files_are_those_of_the_command_line(self):
        path = support.SCENES / "knot.glb"
        tree = zvo.load(path, resolution=64)
        tree.save(self.folder / "knot.zvo")
        support.run_zvo("build", path, "-o", self.folder / "cli.zvo", "--resolution", 64, "--structure", "svo")
        self.assertEqual((self.folder / "knot.zvo").read_bytes(), (self.folder / "cli.zvo").read_bytes())
        for kind in ("ply", "vox", "morton", "glb", "nvdb"):
            tree.save(self.folder / f"knot.{kind}")
            support.run_zvo("convert", self.folder / "cli.zvo", "-o", self.folder / f"cli.{kind}")
            ours, theirs = (self.folder / f"{name}.{kind}" for name in ("knot", "cli"))
            self.assertEqual(ours.read_bytes(), theirs.read_bytes(), kind)

    def test_files_are_read_again(self):
        tree = zvo.load(support.SCENES / "knot.glb", resolution=64)
        tree.save(self.folder / "knot.zvo")
        again = zvo.load(self.folder / "knot.zvo")
        for name in ("coords", "colors", "normals", "origin", "voxel_size", "resolution", "bytes"):
            self.expect_equal(getattr(again, name), getattr(tree, name))
        tree.save(self.folder / "knot.vox")
        self.assertEqual(len(zvo.load(self.folder / "knot.vox")), len(tree))

    def test_packed_attributes_are_read(self):
        support.run_zvo("build", support.SCENES / "knot.glb", "-o", self.folder / "packed.zvo", "--resolution", 64,
                        "--attributes", "block", "--structure", "svo")
        packed = zvo.load(self.folder / "packed.zvo")
        whole = zvo.load(support.SCENES / "knot.glb", resolution=64)
        self.assertLess(packed.bytes, whole.bytes / 2)
        self.expect_equal(packed.coords, whole.coords)
        self.assertLess(np.abs(packed.colors.astype(int) - whole.colors).mean(), 5)
        hits = zvo.trace(packed, packed.points[:9], np.ones((9, 3)))
        self.expect_equal(hits.color, packed.colors[:9])

    def test_filled_trees_are_read_again(self):
        tree = zvo.voxelize(*meshes.sphere(), resolution=32, fill="solid")
        tree.save(self.folder / "ball.zvo")
        again = zvo.load(self.folder / "ball.zvo")
        self.expect_equal(again.coords, tree.coords)
        self.expect_equal(again.normals, tree.normals)

    def test_pictures_are_those_of_the_command_line(self):
        tree = zvo.load(support.SCENES / "cornell_box.glb", resolution=64)
        tree.save(self.folder / "box.zvo")
        for name, options, arguments in (
                ("auto", {}, []),
                ("eye", {"eye": [0.3, 1, 4], "target": [0, 1, 0], "fov": 30}, ["--camera", "0.3,1,4,0,1,0,30"]),
                ("path", {"integrator": "path", "samples": 2, "camera": "front"},
                 ["--integrator", "path", "--spp", 2, "--camera", "front"])):
            zvo.write_picture(self.folder / f"{name}.png", tree.render((64, 48), **options))
            support.run_zvo("render", self.folder / "box.zvo", "-o", self.folder / "cli.png", "--force", "--size",
                            "64x48", *arguments)
            self.assertEqual((self.folder / f"{name}.png").read_bytes(), (self.folder / "cli.png").read_bytes(), name)

    def test_pictures_show_the_voxels(self):
        picture = zvo.voxelize(*meshes.cube(), resolution=16).render((60, 40), eye=[0.5, 0.5, 8], target=[0.5, 0.5, 0])
        self.assertEqual((picture.shape, picture.dtype), ((40, 60, 4), np.uint8))
        sky = picture[0, 0]
        self.assertTrue((picture[20, 30] != sky).any())
        self.assertEqual(picture[..., 3].min(), 255)


class Threads(support.Case):
    def test_use_a_device_one_after_the_other(self):
        made = [(meshes.torus(8 + 4 * i), 32 << i % 3) for i in range(8)]
        wanted = [zvo.voxelize(*mesh, resolution=resolution).coords for mesh, resolution in made]
        faults = []

        def work(first):
            for i in range(first, first + 8):
                mesh, resolution = made[i % 8]
                tree = zvo.voxelize(*mesh, resolution=resolution)
                hits = zvo.trace(tree, tree.points[:5], np.ones((5, 3)))
                if not np.array_equal(tree.coords, wanted[i % 8]) or not hits.hit.all():
                    faults.append(i)
                del tree  # while others work

        threads = [threading.Thread(target=work, args=(2 * i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(faults, [])

    def test_run_while_a_device_works(self):
        ticks, done = [0], threading.Event()

        def count():
            while not done.wait(0.0005):
                ticks[0] += 1

        counter = threading.Thread(target=count)
        mesh = meshes.soup(20000, 9)
        counter.start()
        try:
            before = ticks[0]
            zvo.voxelize(*mesh, resolution=256)
            passed = ticks[0] - before
        finally:
            done.set()
            counter.join()
        self.assertGreater(passed, 10)

    @unittest.skipUnless(hasattr(os, "fork"), "takes fork")
    def test_forked_processes_are_told_to_spawn(self):
        tree = zvo.voxelize(*meshes.cube(), resolution=8)
        child = os.fork()
        if child == 0:
            try:
                zvo.voxelize(*meshes.cube(), resolution=8)
            except ValueError as error:
                del tree
                os._exit(7 if "spawn" in str(error) else 8)
            os._exit(9)
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 7)
        self.assertEqual(len(tree.coords), len(tree))


if __name__ == "__main__":
    unittest.main()
