# SPDX-License-Identifier: GPL-3.0-or-later
"""The certificate of a reduced part: printed, omitted on request, verified by the full model, checked by readers."""
import hashlib
import json
import subprocess
import unittest

import h5py
import stages

CLATTER = stages.SOURCE / "tools/clatter"


class Certificate(stages.PipelineTest):
    def condense(self, *more):
        done = stages.run_stage("condense", *self.command("condense"), *more, "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.folder / "beam.rom.h5") as rom:
            return dict(rom["certificate"].attrs)

    def info(self):
        done = subprocess.run([CLATTER, "info", "beam.rom.h5"], cwd=self.folder, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def warnings(self, stage):
        done = stages.run_stage(stage, *self.command(stage), "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [line for line in done.stderr.splitlines() if "beam.rom.h5" in line]

    def test_info_says_what_was_proved_from_which_files_at_which_positions(self):
        text = self.info()
        self.assertIn("certified; no mode is missing", text)
        self.assertIn("errors estimated, not verified", text)
        for name in ("beam.fe.h5", "beam.rom.toml"):
            self.assertIn(f"{name}  sha256 {hashlib.sha256((self.folder / name).read_bytes()).hexdigest()[:12]}", text)
        self.assertIn("9 of 23 coordinates (SI: m kg s N rad)", text)
        self.assertRegex(text, r"tip +1-6  node: 3 displacements, 3 rotations about \(0.6, 0.02, 0.015\) m")
        with h5py.File(self.folder / "beam.rom.h5") as rom:
            names = set(rom["certificate"].attrs) - {"certified"}
        for name in names:  # each figure with a meaning, none under "more"
            self.assertRegex(text, rf"\n    {name} +\S+( Hz)?  \S+")
        self.assertNotIn("\n  more", text)

    def test_no_certificate_leaves_out_what_costs_and_readers_warn(self):
        full = self.condense()
        bare = self.condense("--no-certificate")
        self.assertEqual((full["certified"], bare["certified"]), (1.0, 0.0))
        self.assertEqual((full["count_proved"], bare["count_proved"]), (1.0, 0.0))
        self.assertEqual(set(full) - set(bare), {"rigid_modes", "first_elastic_hz", "max_frequency_hz", "condition_M_rr"})
        self.assertIn("NOT CERTIFIED", self.info())
        for stage in ("dynamics", "recover"):
            with self.subTest(stage=stage):
                lines = self.warnings(stage)
                self.assertEqual(len(lines), 1, lines)
                self.assertIn("not certified", lines[0])

    def test_errors_that_are_not_requested_are_not_estimated(self):
        with open(self.folder / "beam.rom.toml", "a") as toml:
            toml.write("frequency_error = 0.0\n")
        full = self.condense()
        bare = self.condense("--no-certificate")
        self.assertGreater(full["frequency_error_estimate"], 0.0)
        self.assertEqual(full["residual_modes"], 0.0)
        self.assertEqual({name for name in set(full) - set(bare) if name.startswith("frequency_error")},
                         {"frequency_error_estimate", "frequency_error_joined", "frequency_error_modes"})
        self.assertNotIn("errors estimated", self.info())

    def test_a_certified_part_gives_no_warning_and_one_without_certificate_does(self):
        self.assertEqual(self.warnings("dynamics"), [])
        with h5py.File(self.folder / "beam.rom.h5", "r+") as rom:
            del rom["certificate"]
        self.assertIn("no certificate", "".join(self.warnings("dynamics")))
        self.assertIn("NO CERTIFICATE", self.info())

    def test_verification_stores_what_the_comparison_with_the_full_model_finds(self):
        found = self.condense("--verify", "3000")
        done = stages.run_stage("modal", "compare", "beam.fe.h5", "beam.rom.h5", "--fmax-hz", "3000", "--json",
                                "--quiet", folder=self.folder)
        compared = json.loads(done.stdout)
        self.assertEqual(found["verified_to_hz"], 3000.0)
        self.assertEqual(found["verified_modes"], len(compared["modes"]))
        # Two runs of the same eigen-solver; the error is a difference of frequencies with residuals of 1e-9.
        self.assertAlmostEqual(found["verified_frequency_error"], compared["largest_error"], delta=1e-9)
        self.assertAlmostEqual(found["verified_mac"], compared["smallest_mac"], delta=1e-9)
        self.assertIn("verified by the full model", self.info())
        self.assertEqual(self.condense("--verify", "0")["verified_to_hz"], found["accurate_to_hz"])

    def test_a_request_asks_for_the_verification_and_the_command_line_comes_before_it(self):
        with open(self.folder / "beam.rom.toml", "a") as toml:
            toml.write("verify_hz = 2000\n")
        self.assertEqual(self.condense()["verified_to_hz"], 2000.0)
        self.assertEqual(self.condense("--verify", "3000")["verified_to_hz"], 3000.0)

    def test_a_meaningless_frequency_to_verify_is_refused(self):
        done = stages.run_stage("condense", *self.command("condense"), "--verify", "-5", folder=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--verify", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
