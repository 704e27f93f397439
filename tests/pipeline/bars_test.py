# SPDX-License-Identifier: GPL-3.0-or-later
"""A Nastran deck of bars alone, from the deck to its deflection and frequencies, against closed forms."""
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402

LENGTH, COUNT = 400.0, 8  # mm; bars along a direction that is no axis
ALONG = np.array([2.0, 3.0, 6.0]) / 7
ACROSS = np.array([6.0, 2.0, -3.0]) / 7
RADIUS, E, NU, DENSITY, FORCE = 10.0, 210000.0, 0.3, 7.85e-9, 500.0


def grid(number):
    return "GRID    {:8d}        {:8.4f}{:8.4f}{:8.4f}\n".format(number, *(ALONG * LENGTH * (number - 1) / COUNT))


DECK = ("SOL 103\nCEND\nSUBCASE 1\n SPC = 1\n LOAD = 2\n METHOD = 3\nBEGIN BULK\nPARAM,COUPMASS,1\nEIGRL,3,,,4\n" +
        "".join(grid(n) for n in range(1, COUNT + 2)) +
        "".join(f"CBAR,{n},7,{n},{n + 1},6.,2.,-3.\n" for n in range(1, COUNT + 1)) +
        f"PBARL,7,1,,ROD,,,,,+\n+,{RADIUS}\nMAT1,1,{E},,{NU},{DENSITY}\nSPC1,1,123456,1\n" +
        "FORCE,2,{},,{},{:.9f},{:.9f},{:.9f}\nENDDATA\n".format(COUNT + 1, FORCE, *ACROSS))


class Bars(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-bars-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "rod.bdf").write_text(DECK)
        cls.said = {}
        for stage, arguments in (
                ("mesh", ["rod.bdf", "--units", "mm-t-s", "-o", "rod.mesh.h5", "--recipe", "rod.fe.toml"]),
                ("assembly", ["rod.mesh.h5", "-c", "rod.fe.toml", "-o", "rod.fe.h5"]),
                ("modal", ["statics", "rod.fe.h5", "-o", "rod.static.h5"]),
                ("modal", ["rod.fe.h5", "--count", "2", "-o", "rod.modes.h5"])):
            done = stages.run_stage(stage, *arguments, folder=cls.folder)
            if done.returncode:
                raise AssertionError(f"{stage}: {done.stderr}")
            cls.said[arguments[0]] = done.stdout

    def test_a_cantilever_deflects_by_bending_and_shear(self):
        inertia, area = np.pi * RADIUS**4 / 4, np.pi * RADIUS**2
        shear = 6 / 7 * E / (2 * (1 + NU)) * area
        tip = FORCE * (LENGTH**3 / (3 * E * inertia) + LENGTH / shear)
        with h5py.File(self.folder / "rod.static.h5") as file:
            case = next(case for name, case in file["cases"].items() if "force" in name)
            u = 1e3 * case["points"][()].reshape(-1, 6)[-1]
        np.testing.assert_allclose(u[:3], tip * ACROSS, atol=1e-6 * tip)  # coordinates have four digits after the point
        np.testing.assert_allclose(u[3:], 1e3 * np.cross(ALONG, ACROSS) * FORCE * LENGTH**2 / (2 * E * inertia),
                                   rtol=1e-6)

    def test_the_largest_displacement_is_that_of_the_tip(self):
        self.assertIn("m at ({:.4f}, {:.4f}, {:.4f}) m".format(*(1e-3 * LENGTH * ALONG)), self.said["statics"])

    def test_its_first_frequency_is_that_of_a_beam(self):
        # Kirchhoff's rod: 1.875104^2 sqrt(E I / (rho A)) / (2 pi L^2); shear and rotary inertia take .5 % away.
        kirchhoff = 1.875104**2 / (2 * np.pi * LENGTH**2) * np.sqrt(E * RADIUS**2 / 4 / DENSITY)
        with h5py.File(self.folder / "rod.modes.h5") as file:
            hz = file["frequency_hz"][()]
        np.testing.assert_allclose(hz[0] / kirchhoff, 1, atol=5e-3)
        np.testing.assert_allclose(hz[0], hz[1], rtol=1e-5)  # the same in both planes
        self.assertLess(hz[0], kirchhoff)


if __name__ == "__main__":
    unittest.main()
