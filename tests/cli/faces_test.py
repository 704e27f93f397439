# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter-mesh faces, its picture, and CAD files without a description."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np
import stages

TUBE = """name = "tube"
kind = "cylinder"
[cylinder]
radius = 53.5
inner_radius = 46.5
length = 100
[mesh]
element_size_mm = 20
"""


class OfATube(unittest.TestCase):
    """A STEP file of a tube, drawn once, in a fresh folder."""

    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        with tempfile.TemporaryDirectory(prefix="clatter-faces-") as folder:
            (pathlib.Path(folder) / "tube.mesh.toml").write_text(TUBE)
            done = stages.run_stage("mesh", "tube.mesh.toml", "-o", "drawn.mesh.h5", "--write-step", "tube.step", folder=folder)
            if done.returncode:
                raise RuntimeError(done.stderr)
            cls.step = (pathlib.Path(folder) / "tube.step").read_bytes()

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="clatter-faces-")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "tube.step").write_bytes(self.step)

    def mesh(self, *arguments, code=0):
        done = stages.run_stage("mesh", *arguments, folder=self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def arrays(self, name):
        """All datasets of nodes, cells, surfaces and sets of a mesh file."""
        found = {}

        def keep(path, item):
            if isinstance(item, h5py.Dataset) and path.partition("/")[0] in ("nodes", "cells", "surfaces", "node_sets"):
                found[path] = item[()]

        with h5py.File(self.folder / name) as file:
            file.visititems(keep)
        return found


class Faces(OfATube):
    def test_the_table_and_the_json_say_what_each_face_is(self):
        done = self.mesh("faces", "tube.step")
        head, *rows = done.stdout.splitlines()
        self.assertRegex(head, r"face +kind +radius \[mm\] +axis or normal +position \[mm\] +area \[mm2\]")
        self.assertEqual(len(rows), 4)
        self.assertIn("tube.step: written in mm", done.stderr)
        done = self.mesh("faces", "tube.step", "--json")
        self.assertEqual(len(done.stdout.splitlines()), 1)
        self.assertIn("position [mm]", done.stderr)  # the table is still there to read
        faces = json.loads(done.stdout)["faces"]
        kinds = sorted((face["kind"], face["concave"], round(face["radius"], 6)) for face in faces
                       if face["kind"] == "cylinder")
        self.assertEqual(kinds, [("cylinder", False, 53.5), ("cylinder", True, 46.5)])
        for face in faces:
            wanted = {53.5: 2 * np.pi * 53.5 * 100, 46.5: 2 * np.pi * 46.5 * 100}.get(
                round(face["radius"], 6), np.pi * (53.5**2 - 46.5**2))
            self.assertAlmostEqual(face["area"] / wanted, 1, delta=1e-8)  # nine digits are printed
            if face["kind"] == "plane":  # outward: up at the top, down at the bottom
                self.assertEqual(face["direction"], [0, 0, 1 if face["place"][2] > 50 else -1])

    def test_the_filters_of_a_face_select_that_face(self):
        faces = json.loads(self.mesh("faces", "tube.step", "--json", "--quiet").stdout)["faces"]
        tables = "".join(f"[surface.face_{face['number']}]\n{face['toml']}\n" for face in faces)
        (self.folder / "named.mesh.toml").write_text(
            f'name = "t"\nkind = "cad"\n[cad]\nsource = "tube.step"\n{tables}')
        named = json.loads(self.mesh("faces", "named.mesh.toml", "--json", "--quiet").stdout)["faces"]
        for face in named:
            self.assertEqual(face["surfaces"], [f"face_{face['number']}"])

    def test_a_surface_that_selects_nothing_is_reported_and_the_faces_are_listed(self):
        (self.folder / "t.mesh.toml").write_text(
            TUBE + "[surface.bore]\ncylinder = { radius = 46, point = [0, 0, 0], axis = [0, 0, 1] }\n")
        done = self.mesh("faces", "t.mesh.toml")
        self.assertIn("nearest: face ", done.stderr)
        self.assertIn("cylinder of radius 46.5 mm, radius 0.5 mm more", done.stderr)
        self.assertEqual(len(done.stdout.splitlines()), 5)

    def test_a_length_unit_is_kept_and_that_of_the_file_is_reported(self):
        (self.folder / "inch.mesh.toml").write_text(TUBE.replace('kind', 'length_unit = "in"\nkind', 1)
                                                    .replace("53.5", "2").replace("46.5", "1").replace("100", "3"))
        self.mesh("inch.mesh.toml", "-o", "inch.mesh.h5", "--write-step", "inch.step")
        faces = json.loads(self.mesh("faces", "inch.step", "--json", "--quiet").stdout)["faces"]
        self.assertEqual(sorted({round(face["radius"], 6) for face in faces}), [0, 25.4, 50.8])
        done = self.mesh("faces", "inch.mesh.toml")
        self.assertIn("radius [in]", done.stdout)

    def test_a_mesh_has_no_faces_to_list(self):
        (self.folder / "x.inp").write_text("*NODE\n1, 0, 0, 0\n")
        self.assertIn("expected CAD", self.mesh("faces", "x.inp", code=2).stderr)

    def test_they_are_drawn(self):
        def plot(*arguments):
            return subprocess.run([sys.executable, stages.SOURCE / "tools/clatter", "plot", "faces", *arguments],
                                  cwd=self.folder, text=True, capture_output=True,
                                  env={**os.environ, "CLATTER_BIN": str(stages.BIN)})
        done = plot("tube.step", "-o", "b.png")  # through clatter-mesh faces
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "b.png").read_bytes()[:4], b"\x89PNG")
        self.assertGreater((self.folder / "b.png").stat().st_size, 20000)
        done = plot("none.step", "-o", "c.png")
        self.assertEqual(done.returncode, 2)
        self.assertIn("none.step: file not found", done.stderr)

    def test_lone_pixels_take_the_face_around_them(self):
        from clatter_tools.plots import faces
        ids = np.zeros((12, 9), int)
        ids[2:9, 2:7] = 7
        complete, light = ids.copy(), np.where(ids > 0, 0.5, 0.0)
        ids[5, 4], ids[0, 7] = 0, 9
        found, bright = faces.without_specks(ids, np.where(ids == 7, 0.5, 0.0))
        np.testing.assert_array_equal(found, complete)
        np.testing.assert_array_equal(bright, light)

    def test_each_face_has_its_number_where_it_is_seen(self):
        self.mesh("faces", "tube.step", "-o", "tube.faces.h5")
        from clatter.artefact import open_artefact
        from clatter_tools.plots import faces
        file = open_artefact(self.folder / "tube.faces.h5", "faces")
        triangles = file["triangles"][()]
        kinds = dict.fromkeys(file["number"][()], "plane")
        views = [faces.seen(*faces.cut(file["nodes"][()], triangles, file["triangle_face"][()], along), kinds, a, e)[1]
                 for a, e, along in faces.VIEWS]
        labels = faces.place_labels(views)
        self.assertEqual(sorted(number for found in labels for number in found), sorted(file["number"][()]))
        for ids, found in zip(views, labels):
            for number, (row, column) in found.items():
                self.assertEqual(ids[row, column], number)


class BareCad(OfATube):
    def test_a_cad_file_alone_is_meshed_and_its_description_makes_the_same_mesh(self):
        (self.folder / "out").mkdir()
        self.mesh("tube.step", "-o", "out/part.mesh.h5", "--element-size-mm", 20)
        self.assertIn('source = "../tube.step"', (self.folder / "out/part.mesh.toml").read_text())
        self.mesh("out/part.mesh.toml", "-o", "again.mesh.h5")
        first, second = self.arrays("out/part.mesh.h5"), self.arrays("again.mesh.h5")
        self.assertEqual(first.keys(), second.keys())
        for name, values in first.items():
            np.testing.assert_array_equal(values, second[name], name)

    def test_an_element_size_is_taken_and_a_description_that_is_there_stays(self):
        (self.folder / "part.mesh.toml").write_text("precious")
        done = self.mesh("tube.step", "-o", "part.mesh.h5", "--element-size-mm", 15)
        self.assertEqual((self.folder / "part.mesh.toml").read_text(), "precious")
        self.assertIn("part.mesh.toml: exists and is left as it is", done.stderr)
        coarse = len(self.arrays("part.mesh.h5")["nodes"])
        self.mesh("tube.step", "-o", "fine.mesh.h5", "--element-size-mm", 10)
        self.assertGreater(len(self.arrays("fine.mesh.h5")["nodes"]), 1.5 * coarse)
        self.assertIn("element_size_mm = 10\n", (self.folder / "fine.mesh.toml").read_text())
        # The option overrides the description.
        self.mesh("fine.mesh.toml", "-o", "over.mesh.h5", "--element-size-mm", 15)
        self.assertEqual(len(self.arrays("over.mesh.h5")["nodes"]), coarse)

    def test_a_cad_file_without_a_solid_leaves_nothing(self):
        (self.folder / "bad.step").write_text("ISO-10303-21;\n")
        self.assertIn("bad.step", self.mesh("bad.step", "-o", "bad.mesh.h5", code=2).stderr)
        self.assertFalse((self.folder / "bad.mesh.h5").exists())
        self.assertFalse((self.folder / "bad.mesh.toml").exists())


class LongDefaultSize(OfATube):
    def test_without_an_element_size_the_volume_gives_one(self):
        done = self.mesh("tube.step", "-o", "part.mesh.h5")
        self.assertIn("element size 4 mm", done.stderr)
        self.assertIn("element_size_mm = 4\n", (self.folder / "part.mesh.toml").read_text())
        # About 30 000 cells: Gmsh's cells are up to half again as many as V / V_regular.
        self.assertTrue(20000 < len(self.arrays("part.mesh.h5")["cells/0/nodes"]) < 60000)


if __name__ == "__main__":
    unittest.main(verbosity=2)
