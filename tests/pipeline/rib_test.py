# SPDX-License-Identifier: GPL-3.0-or-later
"""A rib of sheet that stands on a block of solids, against solids alone."""
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402

# Steel block of 100 x 60 x 20 mm, rib of 100 x 40 x 2 mm on it, free, all of quadratic hexahedra that are graded to the rib
# [Hz]: ../shared/reference/shells/rib.py, made once.
SOLIDS = np.array([1166.9, 1463.3, 2451.3])
HEX20 = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2), (1, 0, 0), (2, 1, 0),
         (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2), (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)]


def rows(numbers, each=10):
    return [", ".join(str(n) for n in numbers[i:i + each]) for i in range(0, len(numbers), each)]


def deck(along, across, rib_along, rib_up=12, deep=5):
    """Block of along x across x deep cells; the rib has nodes of its own, those of its foot in the set FOOT."""
    numbers, lines, cells = {}, [], []

    def node(i, j, k):
        if (i, j, k) not in numbers:
            numbers[i, j, k] = len(numbers) + 1
            lines.append(f"{len(numbers)}, {50 * i / along:.9g}, {-30 + 30 * j / across:.9g}, {10 * k / deep:.9g}")
        return numbers[i, j, k]

    for k in range(deep):
        for j in range(across):
            for i in range(along):
                cells.append([node(2 * i + a, 2 * j + b, 2 * k + c) for a, b, c in HEX20])
    first = len(numbers) + 1
    lines += [f"{first + j * (rib_along + 1) + i}, {100 * i / rib_along:.9g}, 0, {20 + 40 * j / rib_up:.9g}"
              for j in range(rib_up + 1) for i in range(rib_along + 1)]
    text = ["*NODE", *lines, "*ELEMENT, TYPE=C3D20, ELSET=BLOCK"]
    for number, cell in enumerate(cells, 1):
        text.append(f"{number}, " + ",\n".join(rows(cell, 15)))
    text.append("*ELEMENT, TYPE=S4, ELSET=RIB")
    for j in range(rib_up):
        for i in range(rib_along):
            a = first + j * (rib_along + 1) + i
            text.append(f"{len(cells) + 1 + j * rib_along + i}, {a}, {a + 1}, {a + rib_along + 2}, {a + rib_along + 1}")
    top = list(range(len(cells) - along * across + 1, len(cells) + 1))
    return "\n".join([*text, "*NSET, NSET=FOOT", *rows(range(first, first + rib_along + 1)), "*ELSET, ELSET=TOP_CELLS", *rows(top),
                      "*SURFACE, NAME=TOP", "TOP_CELLS, S2", "*MATERIAL, NAME=STEEL", "*ELASTIC", "210000., .3", "*DENSITY",
                      "7.85e-9", "*SOLID SECTION, ELSET=BLOCK, MATERIAL=STEEL", "*SHELL SECTION, ELSET=RIB, MATERIAL=STEEL", "2.",
                      "*STEP", "*FREQUENCY", "10", "*END STEP", ""])


class Rib(unittest.TestCase):
    def setUp(self):
        stages.require_stages()
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-rib-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_stage(self, stage, *arguments):
        done = stages.run_stage(stage, *arguments, folder=self.folder)
        self.assertEqual(done.returncode, 0, f"{stage}: {done.stderr}")
        return done.stderr

    def off(self, *cells):
        """Frequencies of three elastic modes against SOLIDS [%], and what the assembly says."""
        (self.folder / "rib.inp").write_text(deck(*cells))
        self.run_stage("mesh", "rib.inp", "--units", "mm-t-s", "-o", "rib.mesh.h5", "--recipe", "rib.fe.toml")
        with open(self.folder / "rib.fe.toml", "a") as recipe:
            recipe.write('\n[[tie]]\nname = "weld"\nedge = "FOOT"\nmaster = "TOP"\n')
        said = self.run_stage("assembly", "rib.mesh.h5", "-c", "rib.fe.toml", "-o", "rib.fe.h5")
        self.run_stage("modal", "rib.fe.h5", "--count", "9", "-o", "rib.modes.h5")
        with h5py.File(self.folder / "rib.modes.h5") as file:
            hz = file["frequency_hz"][()]
        self.assertLess(hz[5], 1.0)
        return 100.0 * (hz[6:9] / SOLIDS - 1.0), said

    def test_the_foot_converges_to_that_of_solids(self):
        wide, said = self.off(20, 12, 20)  # 5 mm
        self.assertIn("weld: the edge follows TOP over 100.0 % of its footprint", said)
        self.assertNotIn("warning", said)
        narrow, _ = self.off(20, 24, 20)   # 2.5 mm
        self.assertTrue((np.abs(wide) < 2.2).all(), wide)
        self.assertTrue((np.abs(narrow) < 0.9).all(), narrow)

    def test_cells_of_rib_and_block_need_not_match(self):
        matching, _ = self.off(20, 12, 20)
        other, _ = self.off(20, 12, 33)
        self.assertTrue((np.abs(other - matching) < 0.3).all(), other)

    def test_hardU10_a_solid_twenty_times_coarser(self):
        off, said = self.off(2, 6, 40)
        self.assertTrue((np.abs(off) < 3.0).all(), off)
        self.assertIn("the cells of TOP at the edge are 0.01 m wide, of a sheet 0.002 m thick", said)

    def test_hardU10_a_solid_twenty_times_finer(self):
        # The rib of two cells bends as such a rib does; its foot is neither a hinge nor loose.
        fine, _ = self.off(40, 12, 2)
        alike, _ = self.off(2, 12, 2)
        self.assertTrue((np.abs(fine - alike) < 0.5).all(), fine - alike)


if __name__ == "__main__":
    unittest.main()
