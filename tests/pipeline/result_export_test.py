# SPDX-License-Identifier: GPL-3.0-or-later
"""Mode shapes and static results as VTK reads them."""
import json
import pathlib
import sys
import unittest
import xml.etree.ElementTree as ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402
from vtk_test import arrays, grid_of, vtk  # noqa: E402

@unittest.skipIf(vtk is None, "VTK (package python3-vtk9) is not installed")
class ResultExport(stages.PipelineTest):
    @staticmethod
    def commands():
        return stages.PipelineTest.commands()[:4]

    def modal(self, *arguments, code=0):
        done = stages.run_stage("modal", *arguments, folder=self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def check_modes(self, grid, modes, cells):
        self.assertEqual(grid.GetNumberOfCells(), cells)
        shapes, hz = modes["shapes"][()], modes["frequency_hz"][()]
        found = {name: values for name, values in arrays(grid.GetPointData()).items() if name.startswith("mode ")}
        self.assertEqual(len(found), len(hz))
        for number, (name, values) in enumerate(sorted(found.items())):
            self.assertEqual(name.split()[:2], ["mode", f"{number + 1:0{len(str(len(hz)))}}"])
            self.assertAlmostEqual(float(name.split()[2]), hz[number], delta=1e-5 * max(1, hz[number]))
            np.testing.assert_array_equal(values, shapes[number].astype(float))

    def test_shapes_of_a_run_and_of_its_file_are_the_same(self):
        self.modal("beam.fe.h5", "--count", 9, "-o", "b.modes.h5", "--export", "run.vtu")
        self.modal("export", "b.modes.h5", "fe.vtu", "--cells", "beam.fe.h5")
        self.modal("export", "b.modes.h5", "mesh.vtu", "--cells", "beam.mesh.h5")
        self.modal("export", "b.modes.h5", "skin.vtu")
        self.assertEqual((self.folder / "run.vtu").read_bytes(), (self.folder / "fe.vtu").read_bytes())
        with h5py.File(self.folder / "b.modes.h5") as modes, h5py.File(self.folder / "beam.mesh.h5") as mesh:
            cells = sum(len(block["nodes"]) for block in mesh["cells"].values())
            skin = sum(len(faces) for faces in mesh["surfaces/skin"].values())
            for name, count in {"run.vtu": cells, "mesh.vtu": cells, "skin.vtu": skin}.items():
                with self.subTest(name):
                    self.check_modes(grid_of(self.folder / name), modes, count)

    def test_shapes_of_a_reduced_part_are_drawn_on_its_skin(self):
        self.modal("beam.rom.h5", "--count", 8, "-o", "r.modes.h5", "--export", "r.vtu")
        with h5py.File(self.folder / "r.modes.h5") as modes:
            self.check_modes(grid_of(self.folder / "r.vtu"), modes,
                             sum(len(faces) for faces in modes["surfaces/skin"].values()))

    def test_a_series_has_a_file_a_mode(self):
        self.modal("beam.fe.h5", "--count", 8, "-o", "b.modes.h5", "--export", "s.pvd")
        sets = ElementTree.parse(self.folder / "s.pvd").getroot().findall("Collection/DataSet")
        self.assertEqual([entry.get("timestep") for entry in sets], [str(i + 1) for i in range(8)])
        with h5py.File(self.folder / "b.modes.h5") as modes:
            for entry, shape in zip(sets, modes["shapes"][()]):
                points = arrays(grid_of(self.folder / entry.get("file")).GetPointData())
                np.testing.assert_array_equal(points["displacement"], shape.astype(float))

    def test_statics_have_displacement_and_stress(self):
        self.modal("statics", "beam.fe.h5", "--case", "tip_force", "-o", "h.static.h5", "--export", "h.vtu")
        points = arrays(grid_of(self.folder / "h.vtu").GetPointData())
        with h5py.File(self.folder / "h.static.h5") as file:
            case = file["cases/tip_force"]
            region = next(iter(case["stress"]))
            nodes = file[f"stress_nodes/{region}"][()]
            np.testing.assert_array_equal(points["tip_force displacement"], case["displacement"][()])
            np.testing.assert_array_equal(points["tip_force stress"][nodes], case[f"stress/{region}"][()])
            np.testing.assert_array_equal(points["tip_force von Mises"][nodes], case[f"von_mises/{region}"][()])
            stress = points["tip_force stress"][nodes]  # xx yy zz xy yz zx
            xx, yy, zz, xy, yz, zx = stress.T
            np.testing.assert_allclose(points["tip_force von Mises"][nodes], np.sqrt(
                ((xx - yy)**2 + (yy - zz)**2 + (zz - xx)**2) / 2 + 3 * (xy**2 + yz**2 + zx**2)), rtol=1e-9)

    def test_wrong_exports_are_refused_before_the_work(self):
        self.assertIn(".vtu or .pvd", self.modal("beam.fe.h5", "-o", "n.modes.h5", "--export", "n.stl", code=2).stderr)
        self.assertFalse((self.folder / "n.modes.h5").exists())
        stages.run_stage("mesh", "beam.mesh.toml", "-o", "other.mesh.h5", "--element-size-mm", 30, folder=self.folder)
        self.modal("beam.fe.h5", "--count", 4, "-o", "b.modes.h5")
        done = self.modal("export", "b.modes.h5", "n.vtu", "--cells", "other.mesh.h5", code=2)
        self.assertIn("its nodes are not those of", done.stderr)
        self.assertIn("found clatter/fe/2, expected results", self.modal("export", "beam.fe.h5", "n.vtu", code=2).stderr)
        self.assertFalse((self.folder / "n.vtu").exists())

    def test_results_are_on_stdout_and_progress_on_stderr(self):
        done = self.modal("beam.fe.h5", "--count", 8, "-o", "b.modes.h5")
        self.assertEqual(sum(" Hz  residual" in line for line in done.stdout.splitlines()), 8)
        self.assertNotIn(" Hz  residual", done.stderr)
        self.assertIn("read ", done.stderr)
        quiet = self.modal("beam.fe.h5", "--count", 8, "-o", "b.modes.h5", "--quiet")
        self.assertEqual(quiet.stdout, done.stdout)
        self.assertEqual(quiet.stderr, "")
        both = self.modal("beam.fe.h5", "--count", 8, "-o", "b.modes.h5", "--json")
        self.assertEqual(len(both.stdout.splitlines()), 1)
        self.assertEqual(len(json.loads(both.stdout)["frequency_hz"]), 8)
        self.assertIn(" Hz  residual", both.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
