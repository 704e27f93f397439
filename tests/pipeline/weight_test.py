# SPDX-License-Identifier: GPL-3.0-or-later
"""Gravity on the clamped beam of the samples: its sag after it has settled, and a model without inertia forces."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import stages  # noqa: E402
from observed import expect_at_most  # noqa: E402

SCENE = """gravity_m_s2 = 9.81
[time]
end_s = 0.1
output_step_us = 1000.0
[[body]]
name = "beam"
rom = "beam.rom.h5"
"""


class Weight(stages.PipelineTest):
    def run_stage(self, stage, *arguments):
        done = stages.run_stage(stage, *arguments, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_hardB9_the_weight_of_a_clamped_beam_and_the_refusal_of_a_file_without_it(self):
        self.edit("beam.fe.toml", "ratio = 0.002", "ratio = 0.5")
        self.run_stage("assembly", "beam.mesh.h5", "-c", "beam.fe.toml", "-o", "beam.fe.h5")
        self.run_stage("condense", "beam.fe.h5", "-c", "beam.rom.toml", "-o", "beam.rom.h5")
        (self.folder / "weight.run.toml").write_text(SCENE)
        self.run_stage("dynamics", "weight.run.toml", "-o", "weight.run.h5")
        with h5py.File(self.folder / "weight.run.h5") as file:
            sag = -file["bodies/beam/q"][-1, 2]
        theory = 9.81 * 12 * 7850 * 0.6**4 / (8 * 210e9 * 0.03**2)  # w L^4 / (8 E I), I = b h^3 / 12
        # Shear adds 0.3 %; cells of 15 mm, two over the height, are about as much too stiff.
        expect_at_most(self, "error of the sag against beam theory", abs(sag / theory - 1.0), 0.01)

        with h5py.File(self.folder / "beam.rom.h5", "r+") as file:
            del file["inertia_force"]
        done = stages.run_stage("dynamics", "weight.run.toml", "-o", "old.run.h5", folder=self.folder)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("gravity_m_s2: ", done.stderr)
        self.assertIn("condense the part again", done.stderr)
        self.assertFalse((self.folder / "old.run.h5").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
