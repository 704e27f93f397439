# SPDX-License-Identifier: GPL-3.0-or-later
"""A factorisation, an eigen-solve or a count that fails leaves no file, neither the final nor a temporary one,
and does not change an older result (hard cases A4, C1, C2; H1)."""
import os
import signal
import subprocess
import unittest

import h5py
import numpy as np
import stages
from observed import observed


class Failing(stages.PipelineTest):
    """The beam with an invalid matrix, an impossible request or too little memory."""

    def setUp(self):
        super().setUp()
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()
        self.environment = {**os.environ, "TMPDIR": str(self.temporary)}

    def fails(self, stage, code, says=(), extra=()):
        """The stage ends with `code` and gives the reason; an older result stays, and no other file is left."""
        output = self.folder / self.command(stage)[-1]
        output.write_bytes(b"an older result")
        for older in (True, False):
            if not older:
                output.unlink()
            before = self.listing()
            done = stages.run_stage(stage, *self.command(stage), *extra, "--quiet", folder=self.folder, env=self.environment)
            self.assertEqual(done.returncode, code, done.stderr)
            *warnings, error = done.stderr.strip().splitlines()
            self.assertTrue(error.startswith(f"clatter-{stage}: error: "), error)
            self.assertTrue(all(line.startswith("warning: ") for line in warnings), done.stderr)
            for text in says:
                self.assertIn(text, error)
            self.assertEqual(self.listing(), before)
        self.show_refusal(error)
        output.write_bytes(b"an older result")

    def listing(self):
        """All files with the properties that must not change."""
        return {str(path.relative_to(self.folder)): stages.fingerprint(path)
                for path in self.folder.rglob("*") if path.is_file()}

    def edit_matrix(self, name, change):
        """Changes the values of a matrix of the beam: change(values, rows, columns) in place."""
        with h5py.File(self.folder / "beam.fe.h5", "r+") as model:
            group = model[name]
            values, rows, starts = group["data"][()], group["indices"][()], group["indptr"][()]
            change(values, rows, np.repeat(np.arange(len(starts) - 1), np.diff(starts)))
            group["data"][...] = values


def overweight(values, rows, columns):
    """Entries next to a positive diagonal so large that the matrix is indefinite."""
    values[(rows != columns) & (columns == 100)] *= 1e3


class HardA4EigenSolves(Failing):
    def test_a_mass_that_is_not_definite(self):
        self.edit_matrix("M", overweight)
        for stage in ("modal", "condense"):
            with self.subTest(stage=stage):
                self.fails(stage, 3, says=["modes:", "M is not positive semidefinite"])

    def test_a_frequency_that_more_than_half_of_all_modes_stay_below(self):
        for stage, config in (("modal", "beam.modes.toml"), ("condense", "beam.rom.toml")):
            with self.subTest(stage=stage):
                path = self.folder / config
                lines = [line for line in path.read_text().splitlines() if not line.startswith(("fmax_hz", "count"))]
                path.write_text("\n".join(["fmax_hz = 1e9", *lines]) + "\n")
                self.fails(stage, 2, says=["Hz"])


class HardC2Factorisations(Failing):
    def test_a_value_that_is_not_a_number(self):
        for name in "KM":
            def poison(values, rows, columns):
                values[len(values) // 2] = np.nan
            self.edit_matrix(name, poison)
            for stage in ("modal", "condense"):
                with self.subTest(matrix=name, stage=stage):
                    self.fails(stage, 2, says=["beam.fe.h5", name])

    def test_a_stiffness_that_is_not_definite(self):
        self.edit_matrix("K", overweight)
        for stage in ("modal", "condense"):
            with self.subTest(stage=stage):
                self.fails(stage, 3, says=["not positive definite", "node"])

    def test_an_unattached_node(self):
        def cut(values, rows, columns):
            at = (rows // 3 == 40) | (columns // 3 == 40)
            values[at] = np.where(rows[at] == columns[at], 1e9, 0.0)
            values[(rows == 121) & (columns == 120)] = 1e9  # x and y of node 40 are one motion
        self.edit_matrix("K", cut)
        self.fails("condense", 3, says=["node"])


class HardC4Memory(Failing):
    def test_a_limit_that_the_factor_does_not_fit(self):
        for stage in ("modal", "condense"):
            with self.subTest(stage=stage):
                self.fails(stage, 3, says=["MiB", " are left", "--memory-limit", f"mpirun -n 4 clatter-{stage}-mpi"],
                           extra=["--memory-limit", "0.02"])

    def test_no_advice_to_use_several_processes_where_they_would_refuse(self):
        config = self.folder / "beam.rom.toml"
        config.write_text(config.read_text() + '\neigen_solver = "amls"\n')
        done = stages.run_stage("condense", *self.command("condense"), "--memory-limit", "0.02", folder=self.folder)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn(" are left", done.stderr)
        self.assertNotIn("mpirun", done.stderr)

    def test_a_meaningless_limit(self):
        self.fails("modal", 2, says=["--memory-limit"], extra=["--memory-limit", "-1"])


class HardH1Interrupted(Failing):
    def test_a_signal_during_a_solve_leaves_no_file(self):
        for stage in ("modal", "condense"):
            arguments = self.command(stage)
            output = self.folder / arguments[-1]
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
                for older in (True, False):
                    with self.subTest(stage=stage, signal=number.name, older=older):
                        output.unlink(missing_ok=True)
                        if older:
                            output.write_bytes(b"an older result")
                        self.interrupt(stage, arguments, number)

    def interrupt(self, stage, arguments, number):
        before = self.listing()
        process = subprocess.Popen([stages.BIN / f"clatter-{stage}", *arguments], cwd=self.folder, text=True,
                                   env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        for line in process.stderr:
            if "read" in line and "DoF" in line:  # printed when the model is in memory: the solves come next
                break
        process.send_signal(number)
        process.stderr.read()
        process.stderr.close()
        self.assertEqual(process.wait(), -number)
        self.assertEqual(self.listing(), before)
        if not getattr(self, "shown", False):
            observed(f"clatter-{stage} ended by {number.name}: every file as before, none left over")
        self.shown = True


if __name__ == "__main__":
    unittest.main(verbosity=2)
