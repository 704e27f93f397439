# SPDX-License-Identifier: GPL-3.0-or-later
"""--blas NAME|auto: selects the OpenBLAS kernel, whatever the environment says."""
import json
import os
import sys
import unittest

import stages

HELD = "OPENBLAS_CORETYPE forces OpenBLAS to kernel Prescott"
RUNS = "OpenBLAS runs its kernel "


class Blas(stages.PipelineTest):
    def setUp(self):
        super().setUp()
        if "avx2" not in open("/proc/cpuinfo").read():
            self.skipTest("this CPU has no kernel better than the oldest")

    def modal(self, *arguments, kernel="Prescott"):
        """The beam's modes with an OpenBLAS kernel set by the environment; returns the messages."""
        done = stages.run_stage("modal", "beam.fe.h5", "--count", 3, "-o", "again.modes.h5", *arguments,
                                folder=self.folder, env={**os.environ, "OPENBLAS_CORETYPE": kernel})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def kernel(self, *arguments, **options):
        """The kernel that ran, from the line that names it."""
        lines = [line for line in self.modal(*arguments, **options).stderr.splitlines() if line.startswith(RUNS)]
        self.assertEqual(len(lines), 1)
        return lines[0].removeprefix(RUNS)

    def test_an_older_kernel_by_the_environment_is_reported_in_one_line_with_the_remedy(self):
        lines = [line for line in self.modal().stderr.splitlines() if line.startswith(HELD)]
        self.assertEqual(len(lines), 1)
        self.assertIn("--blas auto", lines[0])

    def test_quiet_and_json_are_not_disturbed(self):
        done = self.modal("--quiet", "--json")
        self.assertEqual(done.stderr, "")
        self.assertEqual(json.loads(done.stdout)["modes"], 3)

    def test_auto_takes_a_better_kernel_than_the_environment(self):
        self.assertNotEqual(self.kernel("--blas", "auto"), "Prescott")
        self.assertNotIn(HELD, self.modal("--blas", "auto").stderr)

    def test_a_kernel_requested_by_name_runs_in_any_spelling(self):
        self.assertEqual(self.kernel("--blas=haswell"), "Haswell")
        self.assertEqual(self.kernel("--blas", "Prescott", kernel="Haswell"), "Prescott")

    def test_a_kernel_that_openblas_does_not_have_is_refused(self):
        for stage in ("modal", "condense"):
            self.assert_refused(stage, ["--blas", "Quick"] + self.command(stage), says=["--blas", "Quick", "auto"])

    def test_help_names_the_option(self):
        for stage in ("modal", "condense", "dynamics"):
            self.assertIn("--blas", stages.run_stage(stage, "--help", folder=self.folder).stdout)


if __name__ == "__main__":
    sys.exit(unittest.main())
