# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter-condense predict and clatter predict: counts of a factorisation before it is made."""
import json
import os
import re
import subprocess
import unittest

import h5py
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg
import stages


class Command(stages.PipelineTest):
    @staticmethod
    def commands():
        return [command for command in stages.PipelineTest.commands() if command[0] in ("mesh", "assembly", "condense")]

    def predict(self, *arguments):
        done = stages.run_stage("condense", "predict", "beam.fe.h5", *arguments, "--json", "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)


class Predict(Command):
    def test_the_ranks_do_what_one_process_does(self):
        one = self.predict("-c", "beam.rom.toml", "--ranks", "1")
        for ranks in (2, 7):
            several = self.predict("-c", "beam.rom.toml", "--ranks", str(ranks))
            for name, total in (("rank_flops", "factor_flops"), ("rank_entries", "factor_entries")):
                self.assertEqual(len(several[name]), ranks)
                self.assertAlmostEqual(sum(several[name]) / one[total], 1.0, delta=1e-12)
            self.assertGreater(sum(several["rank_sent_gib"]), 0.0)
        self.assertEqual(sum(one["rank_sent_gib"]), 0.0)

    def test_entries_are_those_of_superlu_without_a_boundary(self):
        said = self.predict()
        with h5py.File(self.folder / "beam.fe.h5") as file:
            K = file["K"]
            lower = sp.csc_matrix((K["data"][()], K["indices"][()], K["indptr"][()]), shape=tuple(K.attrs["shape"]))
        self.assertEqual(said["dofs"], lower.shape[0])
        full = (lower + sp.tril(lower, -1).T).tocsc()
        # In any order of SuperLU's for a symmetric pattern: L has about as many entries.
        lu = scipy.sparse.linalg.splu(full, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        self.assertAlmostEqual(said["factor_entries"] / lu.L.nnz, 1.0, delta=0.35)

    def test_the_given_rate_is_used(self):
        slow, fast = (self.predict("--gflops", rate) for rate in ("2", "20"))
        self.assertAlmostEqual(slow["factor_seconds"] / fast["factor_seconds"], 10.0, delta=1e-9)
        self.assertAlmostEqual(slow["factor_seconds"], max(slow["rank_flops"]) / 2e9, delta=1e-12)

    def test_wrong_requests_are_refused_in_one_line(self):
        (self.folder / "wrong.rom.toml").write_text('boundary = ["nothing"]\nmethod = "guyan"\n')
        for arguments, code, words in ((["beam.fe.h5", "--ranks", "0"], 2, "--ranks: found 0, expected 1 to 65536"),
                                       (["beam.fe.h5", "--gflops", "-1"], 2, "--gflops: found -1"),
                                       (["beam.fe.h5", "--gflops", "nan"], 2, "--gflops: found nan"),
                                       (["beam.fe.h5", "-c", "wrong.rom.toml"], 2, "nothing"),
                                       (["beam.mesh.h5"], 2, "schema"), (["none.fe.h5"], 2, "no such file")):
            with self.subTest(words):
                done = stages.run_stage("condense", "predict", *arguments, folder=self.folder)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertEqual(done.stderr.count("error:"), 1, done.stderr)
                self.assertIn(words, done.stderr)

    def test_clatter_predict_says_the_same(self):
        command = ["/usr/bin/python3", str(stages.SOURCE / "tools/clatter"), "predict", "beam.fe.h5", "-c", "beam.rom.toml", "--ranks", "4"]
        environment = {**os.environ, "PATH": f"{stages.BIN}:{os.environ['PATH']}"}
        done = subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"L has [0-9.e+]+ entries")
        self.assertRegex(done.stdout, r"memory of each of 4 ranks: [0-9.]+ \wiB at most")
        refused = subprocess.run([*command, "--gflops", "0.x"], cwd=self.folder, env=environment, capture_output=True, text=True)
        self.assertEqual(refused.returncode, 2, refused.stderr)


class OfRanks(Command):
    """Label mpi."""

    def test_mumps_has_the_entries_counted_and_few_more(self):
        import ranks
        said = self.predict("-c", "beam.rom.toml", "--ranks", "2")
        done = ranks.run("condense", 2, "beam.fe.h5", "-c", "beam.rom.toml", "-o", "two.rom.h5", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = float(re.search(r"factor of K_ii \(([0-9.e+]+) entries\)", done.stderr).group(1))
        # MUMPS merges fronts, which stores zeros: most where fronts are as small as here.
        self.assertGreater(found, 0.99 * said["factor_entries"])
        self.assertLess(found, 1.5 * said["factor_entries"])
        self.assertTrue(np.isfinite(said["factor_seconds"]))


if __name__ == "__main__":
    unittest.main()
