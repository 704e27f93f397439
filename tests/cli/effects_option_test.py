# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter-dynamics --effects`: what a scene simulates and what it costs, without a run."""
import json
import unittest

import stages


class EffectsOption(stages.PipelineTest):
    def effects(self, *more):
        before = {path: path.stat().st_mtime_ns for path in self.folder.iterdir()}
        done = stages.run_stage("dynamics", "--effects", "step.run.toml", *more, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({path: path.stat().st_mtime_ns for path in self.folder.iterdir()}, before)  # nothing is written
        return done

    def test_a_finished_run_of_the_scene_gives_the_seconds(self):
        printed = json.loads(self.effects("--json").stdout)
        self.assertIn("step.run.h5", printed["source"])
        run = stages.run_stage("dynamics", "step.run.toml", "-o", "again.run.h5", "--json", folder=self.folder)
        self.assertEqual(printed["steps"], json.loads(run.stdout)["steps"])

    def test_another_scene_is_probed_and_the_old_run_is_named(self):
        self.edit("step.run.toml", "largest_step_us = 50.0", "largest_step_us = 40.0")
        done = self.effects("--json")
        self.assertIn("step.run.h5: not of this scene", done.stderr)
        printed = json.loads(done.stdout)
        self.assertIn("a probe of", printed["source"])
        self.assertGreater(printed["steps"], 10)
        rows = {row["name"]: row for row in printed["effects"]}
        self.assertEqual(rows["gravity"]["state"], "off")
        self.assertEqual(rows["gravity"]["seconds"], None)
        self.assertGreater(rows["elastic beam"]["unknowns"], 6)

    def test_the_list_has_equation_needs_and_switch_in_120_columns(self):
        lines = self.effects().stdout.splitlines()
        self.assertLessEqual(max(map(len, lines)), 120)
        for text in ("off gravity: ", "    equation: f = -phi^T M r g", "    needs: nothing; switch: gravity_m_s2 > 0"):
            self.assertTrue(any(line.startswith(text) for line in lines), text)


if __name__ == "__main__":
    unittest.main(verbosity=2)
