# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter-dynamics --effects`: what a scene simulates and what it costs, without a run."""
import json
import os
import re
import subprocess
import unittest

import stages
from pseudo_terminal import open_terminal


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

    def test_a_run_on_a_terminal_counts_the_effects_that_are_off_and_one_in_a_file_lists_them(self):
        def run(stdout, stderr):
            return subprocess.run([stages.BIN / "clatter-dynamics", "step.run.toml", "-o", "again.run.h5"], cwd=self.folder,
                                  stdout=stdout, stderr=stderr, check=True, timeout=300)
        listed = run(subprocess.PIPE, subprocess.PIPE)
        names = {row["name"]: row["state"] for row in json.loads(self.effects("--json").stdout)["effects"]}
        off = [name for name, state in names.items() if state == "off"]
        self.assertGreater(len(off), 1)
        ours, theirs = open_terminal()
        seen = run(theirs, subprocess.PIPE)
        os.close(theirs)
        with open(ours, "rb", buffering=0) as terminal:
            text = ""
            while "energy residue" not in text:  # the last line, after which a read of a closed terminal fails
                text += terminal.read(65536).decode().replace("\r", "")
        self.assertIn(f"  {len(off)} effects off (--effects lists them)", text)
        for name in off:
            self.assertRegex(listed.stdout.decode(), rf"\n  {re.escape(name)} +off ")
            self.assertRegex(seen.stderr.decode(), rf"\n  {re.escape(name)} +off ")  # of which a file gets all
            self.assertNotRegex(text, rf"\n  {re.escape(name)} +off ")
        for name in names.keys() - set(off):
            self.assertRegex(text, rf"\n  {re.escape(name)} +on ")


if __name__ == "__main__":
    unittest.main(verbosity=2)
