# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs of samples/cpp run, and their figures agree with closed forms and with the stages."""
import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("CLATTER_BUILD", SOURCE / "build/release"))
BEAM = SOURCE / "samples/beam"


def run(program, *arguments, cwd):
    return subprocess.run([program, *arguments], cwd=cwd, check=True, capture_output=True, text=True).stdout


def chain(folder, n, k, m):
    """K and M of n masses m between springs k, both ends clamped, as Matrix Market files."""
    head = "%%MatrixMarket matrix coordinate real symmetric\n"
    K = [f"{i} {i} {2 * k}" for i in range(1, n + 1)] + [f"{i + 1} {i} {-k}" for i in range(1, n)]
    (folder / "K.mtx").write_text(head + f"{n} {n} {len(K)}\n" + "\n".join(K) + "\n")
    (folder / "M.mtx").write_text(head + f"{n} {n} {n}\n" + "\n".join(f"{i} {i} {m}" for i in range(1, n + 1)) + "\n")


class CppSamples(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def sample(self, name, *arguments):
        return run(BUILD / "samples" / name, *arguments, cwd=self.folder)

    def test_matrix_modes_of_a_chain(self):
        n, k, m = 400, 1e4, 0.5
        chain(self.folder, n, k, m)
        text = self.sample("matrix_modes", "K.mtx", "M.mtx", "3")
        found = [float(hz) for hz in re.findall(r"^(\S+) Hz", text, re.M)]
        exact = [math.sqrt(k / m) / math.pi * math.sin(j * math.pi / (2 * (n + 1))) for j in (1, 2, 3)]
        self.assertEqual(len(found), 3)
        for hz, expected in zip(found, exact):
            self.assertLess(abs(hz / expected - 1), 1e-8)
        # A unit load on every mass: u_i = i (n + 1 - i) / 2 k, and sum i (n + 1 - i) = n (n + 1) (n + 2) / 6.
        compliance = float(re.search(r"every DoF: (\S+)", text)[1])
        self.assertLess(abs(compliance * 12 * k / (n * (n + 1) * (n + 2)) - 1), 1e-8)
        self.assertIn("number of modes proved", text)

    def test_slider_film_approaches_the_closed_form(self):
        load, exact = map(float, re.search(r"load (\S+) N, exact (\S+) N", self.sample("slider_film", "200")).groups())
        self.assertLess(abs(load / exact - 1), 1e-4)

    def test_condense_part_and_expand_field_give_the_deflection_of_a_cantilever(self):
        for stage, *arguments in (["mesh", BEAM / "beam.mesh.toml", "-o", "beam.mesh.h5"],
                                  ["assembly", "beam.mesh.h5", "-c", BEAM / "beam.fe.toml", "-o", "beam.fe.h5"]):
            run(BUILD / "bin" / f"clatter-{stage}", *arguments, "--quiet", cwd=self.folder)
        self.assertIn("(craig-bampton)", self.sample("condense_part", "beam.fe.h5", "beam.rom.h5", "4000", "tip", "sensor_tip"))
        found = float(re.search(r"displacement (\S+) m", self.sample("expand_field", "beam.rom.h5", "tip_force"))[1])
        bending, shear = 0.6**3 / (3 * 210e9 * 0.04 * 0.03**3 / 12), 0.6 * 2.6 / (210e9 * 5 / 6 * 0.04 * 0.03)
        self.assertLess(abs(found / (bending + shear) - 1), 0.01)  # the clamp holds the cross-section's width as well

    def test_deck_to_rom_condenses_a_deck_to_the_mass_that_it_has(self):
        nodes = [(x, y, z) for z in (0, 10, 20) for y in (0, 10) for x in (0, 10)]
        deck = ["*NODE, NSET=ALL", *(f"{i + 1}, {x}, {y}, {z}" for i, (x, y, z) in enumerate(nodes)), "*ELEMENT, TYPE=C3D8, ELSET=BAR",
                "1, 1, 2, 4, 3, 5, 6, 8, 7", "2, 5, 6, 8, 7, 9, 10, 12, 11", "*NSET, NSET=TIP", "9, 10, 11, 12", "*MATERIAL, NAME=STEEL", "*ELASTIC",
                "210000, 0.3", "*DENSITY", "7.85e-9", "*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL"]
        (self.folder / "bar.inp").write_text("\n".join(deck) + "\n")
        text = self.sample("deck_to_rom", "bar.inp", "mm-t-s", "bar.rom.h5", "60000", "TIP")
        self.assertIn("(craig-bampton)", text)
        self.assertIn("mass 0.0157 kg", text)  # 7850 kg/m3 in 2 cm3
        with h5py.File(self.folder / "bar.rom.h5") as rom:
            self.assertEqual(list(rom["sets"]), ["TIP"])
            self.assertEqual(rom["certificate"].attrs["rigid_modes"], 6)

    def test_mass_on_spring_moves_as_the_closed_form(self):
        self.sample("mass_on_spring", "mass.run.h5")
        with h5py.File(self.folder / "mass.run.h5") as run:
            time, travel = run["history/time"][:], run["history/mass_travel"][:]
        # 1 mm of tension pulls the other way: the spring is longer without force than at the start.
        exact = -1e-3 * (1 - np.cos(np.sqrt(8e4 / 2.0) * time))
        self.assertLess(np.abs(travel - exact).max(), 2e-6)
        self.assertGreater(time[-1], 0.0999)

    def test_a_wrong_file_is_one_line(self):
        done = subprocess.run([BUILD / "samples/expand_field", "none.rom.h5", "gas"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"^expand_field: .*none\.rom\.h5.*\n$")


if __name__ == "__main__":
    unittest.main(verbosity=2)
