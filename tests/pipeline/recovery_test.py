# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces of the mesh as panels of the field file, and recovered accelerations in an export."""
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402


class Recovery(stages.PipelineTest):
    def recover(self, text):
        """The field of the beam's run with other panels and frames."""
        (self.folder / "other.field.toml").write_text((self.folder / "step.field.toml").read_text() + text)
        done = stages.run_stage("recover", "step.run.h5", "-c", "other.field.toml", "-o", "other.field.h5", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / "other.field.h5"

    def test_surfaces_of_the_mesh_are_panels_with_their_area_and_normals(self):
        with h5py.File(self.folder / "beam.mesh.h5") as mesh, h5py.File(self.folder / "beam.rom.h5") as rom:
            self.assertEqual(sorted(rom["skin/faces"]), sorted(mesh["surfaces"]))
            self.assertEqual(len(rom["skin/faces/skin"]), len(rom["skin/triangles"]))
        path = self.recover('[[panel]]\nname = "end"\nsurfaces = ["x_max"]\n'
                            '[[panel]]\nname = "broad"\nsurfaces = ["z_min", "z_max"]\n')
        with h5py.File(path) as field:
            end, broad = field["panels/end"], field["panels/broad"]
            self.assertAlmostEqual(end.attrs["area_m2"], 0.04 * 0.03, places=12)
            self.assertAlmostEqual(broad.attrs["area_m2"], 2 * 0.6 * 0.04, places=12)
            normals = field["skin/face_normal"][()]
            self.assertLess(abs(normals[end["faces"][()]] - [1, 0, 0]).max(), 1e-12)
            self.assertLess(abs(abs(normals[broad["faces"][()]]) - [0, 0, 1]).max(), 1e-12)

    def test_a_surface_that_is_not_there_is_refused_with_those_that_are(self):
        (self.folder / "bad.field.toml").write_text('cycle = false\n[[panel]]\nname = "end"\nsurfaces = ["x_mx"]\n')
        self.assert_refused("recover", ["step.run.h5", "-c", "bad.field.toml", "-o", "step.field.h5"],
                            says=("panel 'end': no surface of the skin named x_mx", "x_max", "z_min"))

    def test_accelerations_are_the_derivative_of_velocities_and_are_exported(self):
        path = self.recover('quantities = ["velocity", "acceleration"]\n')
        with h5py.File(self.folder / "step.run.h5") as run, h5py.File(self.folder / "beam.rom.h5") as rom, h5py.File(path) as field:
            self.assertNotIn("frames/displacement", field)
            first = int(np.argmin(abs(run["output/time"][()] - field["frames/time"][3])))
            expected = rom["skin/T"][()] @ run["bodies/beam/a"][first]
            found = field["frames/acceleration/00003"][()].ravel()
            self.assertLess(abs(found - expected).max(), 1e-6 * abs(expected).max())
        done = subprocess.run([stages.SOURCE / "tools/clatter", "export", path, "-o", self.folder / "a.csv", "--frames",
                               "--quantity", "acceleration", "--at", "0.02"], text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("acceleration", (self.folder / "a.csv").read_text()[:4000])


if __name__ == "__main__":
    unittest.main(verbosity=2)
