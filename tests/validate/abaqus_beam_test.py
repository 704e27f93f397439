# SPDX-License-Identifier: GPL-3.0-or-later
"""The matrices that Abaqus wrote for a C3D10 beam have the frequencies that it found.

The beam is data of a public project next to the source tree; CMake registers this test where it is.
"""
import pathlib
import tempfile
import unittest

import h5py
import numpy as np
import stage_run

DATA = next((up / "shared/data/abaqus_beam" for up in stage_run.SOURCE.parents
             if (up / "shared/data/abaqus_beam").exists()), None)


class AbaqusBeam(unittest.TestCase):
    def test_the_matrices_that_abaqus_wrote_have_their_frequencies(self):
        scratch = tempfile.TemporaryDirectory(prefix="clatter-abaqus-")
        self.addCleanup(scratch.cleanup)
        folder = pathlib.Path(scratch.name)
        stage_run.run("mesh", DATA / "abq_beam.inp", "--units", "mm-t-s", "-o", "abq.mesh.h5", folder=folder)
        (folder / "abq.fe.toml").write_text(
            f'[matrices]\nK = "{DATA}/STIF1_coord_style.mtx"\nM = "{DATA}/MASS1_coord_style.mtx"\nunits = "mm-t-s"\n')
        stage_run.run("assembly", "abq.mesh.h5", "-c", "abq.fe.toml", "-o", "abq.fe.h5", folder=folder)
        stage_run.run("modal", "abq.fe.h5", "--count", 10, "-o", "abq.modes.h5", folder=folder)
        with h5py.File(folder / "abq.fe.h5") as fe:
            self.assertEqual(fe["certificate"].attrs["held_dofs"], 27)  # nine nodes carry 1e36
            self.assertAlmostEqual(fe["mass"].attrs["mass"], 1.57, delta=1e-9)  # 20 x 20 x 500 mm of 7.85 t/m3
        with h5py.File(folder / "abq.modes.h5") as modes:
            # Abaqus printed seven digits.
            np.testing.assert_allclose(modes["frequency_hz"][()], [
                66.79947, 66.81689, 416.1196, 416.2134, 1154.0607, 1154.3076, 1596.5447, 2235.0158, 2235.2421,
                2578.8752], rtol=1e-6)


if __name__ == "__main__":
    unittest.main(verbosity=2)
