# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter-modal-mpi on one to four ranks against clatter-modal."""
import unittest

import h5py
import numpy as np
import ranks
import stages


class Modal(stages.PipelineTest):
    @staticmethod
    def commands():
        return [command for command in stages.PipelineTest.commands() if command[0] in ("mesh", "assembly", "modal")]

    def modes(self, count, *arguments):
        output = f"of_{count}.modes.h5"
        arguments = ["beam.fe.h5", *arguments, "-o", output]
        done = ranks.run("modal", count, *arguments, folder=self.folder) if count else \
            stages.run_stage("modal", *arguments, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.folder / output) as file:
            return file["frequency_hz"][()], file["shapes"][()].astype(float), done.stdout.splitlines()[-1]

    def assert_same(self, count, *arguments, rigid=0):
        hz, shapes, proof = self.modes(0, *arguments)
        found_hz, found_shapes, found_proof = self.modes(count, *arguments)
        self.assertEqual(proof, found_proof)  # with the inertia count
        self.assertEqual(len(hz), len(found_hz))
        np.testing.assert_array_equal(found_hz[:rigid], 0.0)
        self.assertLess(np.abs(found_hz[rigid:] / hz[rigid:] - 1.0).max(), 1e-9)
        # Residuals are 1e-8, so directions differ by that over the relative gap; files have single precision.
        self.assertLess(np.abs(found_shapes[rigid:] - shapes[rigid:]).max(), 1e-5 * np.abs(shapes).max())

    def test_any_number_of_ranks_gives_the_modes_of_one_process(self):
        for count in (1, 2, 3, 4):
            with self.subTest(ranks=count):
                self.assert_same(count, "--fmax-hz", "3000")

    def test_arpack_with_the_rows_of_its_vectors_spread(self):
        (self.folder / "arpack.modes.toml").write_text('count = 12\neigen_solver = "arpack"\n')
        for count in (1, 2, 3, 4):
            with self.subTest(ranks=count):
                self.assert_same(count, "-c", "arpack.modes.toml")

    def test_by_count_with_a_clamped_set(self):
        (self.folder / "clamped.modes.toml").write_text('count = 6\nfixed = ["tip"]\n')
        self.assert_same(3, "-c", "clamped.modes.toml")

    def test_a_free_part_has_six_modes_of_zero(self):
        self.edit("beam.fe.toml", '[[support]]\nsurface = "x_min"\n', "")
        done = stages.run_stage("assembly", *self.command("assembly"), folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same(2, "--fmax-hz", "2500", rigid=6)

    def test_an_unknown_set_is_refused_once(self):
        (self.folder / "wrong.modes.toml").write_text('count = 6\nfixed = ["nothing"]\n')
        done = ranks.run("modal", 3, "beam.fe.h5", "-c", "wrong.modes.toml", "-o", "wrong.modes.h5", folder=self.folder)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("error:"), 1, done.stderr)
        self.assertFalse((self.folder / "wrong.modes.h5").exists())


if __name__ == "__main__":
    unittest.main()
