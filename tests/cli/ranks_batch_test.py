# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/condense.sbatch as Slurm runs it, with its variables and without Slurm."""
import os
import unittest

import ranks
import ranks_condense_test
import stages

SLURM = {"SLURM_CPUS_PER_TASK": "1", "SLURM_MEM_PER_NODE": "4096", "SLURM_NTASKS_PER_NODE": "2"}


class Batch(ranks_condense_test.OfRanks):
    def test_the_script_makes_both_files(self):
        script = stages.SOURCE / "docs/condense.sbatch"
        done = ranks.finish(["bash", str(script), "beam"], self.folder, **SLURM, PATH=f"{stages.BIN}:{os.environ['PATH']}",
                            OMPI_MCA_hwloc_base_binding_policy="none", OMPI_MCA_mpi_yield_when_idle="1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("basis holds modes to 4000 Hz", done.stdout)
        self.assertIn("none is missing", done.stdout)
        for name in ("beam.rom.h5", "beam.modes.h5"):
            self.assertTrue((self.folder / name).exists(), name)


if __name__ == "__main__":
    unittest.main()
