# SPDX-License-Identifier: GPL-3.0-or-later
"""The beam's frequencies compared with CalculiX on the same exported mesh."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import calculix  # noqa: E402
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402

DECK = """*INCLUDE, INPUT=beam.inp
*MATERIAL, NAME=STEEL
*ELASTIC
{youngs}, {poisson}
*DENSITY
{density}
*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL
*BOUNDARY
X_MIN, 1, 3
*STEP
*FREQUENCY
{count}
*NODE FILE
U
*END STEP
"""


@calculix.required(calculix.GMSH)
class CalculiX(stages.PipelineTest):
    def test_cantilever_frequencies_agree_within_1e_4(self):
        done = stages.run_stage("mesh", "beam.mesh.toml", "-o", "beam.mesh.h5", "--export", "beam.inp", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.folder / "beam.modes.h5") as modes:
            ours = modes["frequency_hz"][()]
        calculix.run(DECK.format(youngs=210e9, poisson=0.3, density=7850.0, count=len(ours)), self.folder)
        theirs = calculix.frequencies(calculix.lines(self.folder))
        self.assertEqual(len(theirs), len(ours))
        error = ours / theirs - 1
        for row in zip(ours, theirs, error):
            print("    ours {:12.5f} Hz   CalculiX {:12.5f} Hz   {:+.1e}".format(*row), file=sys.stderr)
        # Same mesh and shape functions: the rest is due to the digits of the exported coordinates and of the .dat file.
        self.assertLess(np.abs(error).max(), 1e-4)


if __name__ == "__main__":
    unittest.main(verbosity=2)
