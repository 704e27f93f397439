# SPDX-License-Identifier: GPL-3.0-or-later
"""A run whose step size falls below its floor: exit code 3, the reason in one line, the results so far in a file of their own."""
import unittest

import h5py
import stages


class FailedRun(stages.PipelineTest):
    def test_the_results_before_the_failure_are_kept_and_the_requested_name_is_not_taken(self):
        scene = (stages.SOURCE / "samples/beam/step.run.toml").read_text()
        self.assertIn("largest_step_us = 50.0", scene)
        # A force of 100 N rises within a step that may not shrink; the tolerance is beyond its reach.
        scene = scene.replace("largest_step_us = 50.0", "largest_step_us = 50.0\nsmallest_step_us = 40.0")
        (self.folder / "step.run.toml").write_text(scene + "\n[accuracy]\ntolerance = 1e-8\n")
        done = stages.run_stage("dynamics", "step.run.toml", "-o", "stiff.run.h5", "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r"^clatter-dynamics: error: .*step.*; the results up to there are in stiff\.run\.failed\.h5\n$")
        self.assertFalse((self.folder / "stiff.run.h5").exists())
        with h5py.File(self.folder / "stiff.run.failed.h5") as run:
            self.assertEqual(run.attrs["complete"], 0)
            self.assertEqual(run["bodies/beam/q"].shape[0], run["output/time"].shape[0])


if __name__ == "__main__":
    unittest.main(verbosity=2)
