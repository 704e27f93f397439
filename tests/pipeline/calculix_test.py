# SPDX-License-Identifier: GPL-3.0-or-later
"""The beam's frequencies compared with CalculiX on the same exported mesh."""
import pathlib
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
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


def calculix_frequencies(folder, name):
    """Frequencies [Hz] from the table in a .dat file: mode, eigenvalue, rad/time, cycles/time, imaginary part."""
    found = []
    for line in (folder / f"{name}.dat").read_text().splitlines():
        words = line.split()
        if "P A R T I C I P A T I O N" in line:
            break
        if len(words) == 5 and words[0].isdigit():
            found.append(float(words[3]))
    return np.array(found)


@unittest.skipUnless(shutil.which("ccx"), "CalculiX (package calculix-ccx) is not installed")
class CalculiX(stages.PipelineTest):
    def test_cantilever_frequencies_agree_within_1e_4(self):
        done = stages.run_stage("mesh", "beam.mesh.toml", "-o", "beam.mesh.h5", "--export", "beam.inp", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.folder / "beam.modes.h5") as modes:
            ours = modes["frequency_hz"][()]
        (self.folder / "check.inp").write_text(DECK.format(youngs=210e9, poisson=0.3, density=7850.0, count=len(ours)))
        solved = subprocess.run(["ccx", "check"], cwd=self.folder, capture_output=True, text=True, timeout=300)
        theirs = calculix_frequencies(self.folder, "check")
        self.assertEqual(len(theirs), len(ours), solved.stdout[-2000:])
        error = ours / theirs - 1
        for row in zip(ours, theirs, error):
            print("    ours {:12.5f} Hz   CalculiX {:12.5f} Hz   {:+.1e}".format(*row), file=sys.stderr)
        # Same mesh and shape functions: the rest is due to the digits of the exported coordinates and of the .dat file.
        self.assertLess(np.abs(error).max(), 1e-4)


if __name__ == "__main__":
    unittest.main(verbosity=2)
