# SPDX-License-Identifier: GPL-3.0-or-later
"""Shells through the stages: a free plate and a pan of sheet steel, against plate theory and solid elements."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402

PAN = pathlib.Path(__file__).resolve().parents[3] / "shared" / "reference" / "shells" / "pan.py"

# 300 x 200 x 1.5 mm of steel, free: Mindlin's plate by a Ritz series [Hz].
PLATE = [83.337, 88.892, 192.213, 207.166, 239.468, 278.099]
# The pan of pan.py, 1.5 mm, free: two layers of quadratic solids of 5 mm [Hz].
SOLIDS = [207.45, 250.08, 385.74, 548.36, 598.64, 612.59, 715.58, 892.95, 963.68, 984.95, 993.95, 1161.67]
# The same, tied over its flange to a ring of cast iron that is half a thickness away.
FRAMED = [233.17, 237.04, 375.64, 422.61, 550.65, 600.19, 714.48, 786.28, 892.75, 971.33, 987.21, 1018.63]


def plate_deck(nx, ny):
    lines = ["SOL 103", "CEND", "METHOD = 3", "BEGIN BULK", "PARAM,COUPMASS,1", "EIGRL,3,,,12"]
    for j in range(ny + 1):
        lines += [f"GRID,{j * (nx + 1) + i + 1},,{300 * i / nx:.5f},{200 * j / ny:.5f},0." for i in range(nx + 1)]
    for j in range(ny):
        for i in range(nx):
            a = j * (nx + 1) + i + 1
            lines.append(f"CQUAD4,{j * nx + i + 1},5,{a},{a + 1},{a + nx + 2},{a + nx + 1}")
    return "\n".join(lines + ["PSHELL,5,1,1.5,1,,1", "MAT1,1,210000.,,.3,7.85-9", "ENDDATA", ""])


class Shells(unittest.TestCase):
    def setUp(self):
        stages.require_stages()
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-shells-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_stages(self, *commands):
        for stage, *arguments in commands:
            done = stages.run_stage(stage, *arguments, folder=self.folder)
            self.assertEqual(done.returncode, 0, f"{stage}: {done.stderr}")

    def frequencies(self, deck, count):
        name = pathlib.Path(deck).stem
        self.run_stages(("mesh", deck, "--units", "mm-t-s", "-o", f"{name}.mesh.h5", "--recipe", f"{name}.fe.toml"))
        return self.modes_of(name, count)

    def modes_of(self, name, count):
        self.run_stages(("assembly", f"{name}.mesh.h5", "-c", f"{name}.fe.toml", "-o", f"{name}.fe.h5"),
                        ("modal", f"{name}.fe.h5", "--count", str(count), "-o", f"{name}.modes.h5"))
        with h5py.File(self.folder / f"{name}.modes.h5") as file:
            return file["frequency_hz"][()]

    def test_a_free_plate_has_six_rigid_motions_and_the_frequencies_of_plate_theory(self):
        (self.folder / "plate.bdf").write_text(plate_deck(30, 20))
        hz = self.frequencies("plate.bdf", 12)
        elastic = hz[hz > 1.0]
        self.assertEqual(len(hz) - len(elastic), 6)
        # Consistent mass: from above; second order.
        np.testing.assert_allclose(elastic[:6] / PLATE, 1.0, atol=7e-3)
        (self.folder / "fine.bdf").write_text(plate_deck(60, 40))
        fine = self.frequencies("fine.bdf", 12)
        error, finer = elastic[5] / PLATE[5] - 1, fine[fine > 1.0][5] / PLATE[5] - 1
        self.assertGreater(error / finer, 3.5)

    def pan(self, *options):
        subprocess.run([sys.executable, str(PAN), "pan.inp", "--cells", "s4", "--level", "2", "--t", "1.5", *options],
                       check=True, capture_output=True, cwd=self.folder)
        hz = self.frequencies("pan.inp", 18)
        return hz[hz > 1.0][:12]

    @unittest.skipUnless(PAN.exists(), "the reference's pan is not here")
    def test_a_pan_agrees_with_quadratic_solids(self):
        np.testing.assert_allclose(self.pan() / SOLIDS, 1.0, atol=8e-3)

    def test_pans_of_coarse_fillets_are_shells_throughout(self):
        # Quadrilaterals of fillets that are almost triangles, and warped, are two triangles.
        (self.folder / "a.fe.toml").write_text('[material.steel]\nregions = ["pan"]\nE_gpa = 210\nnu = 0.3\nrho = 7850\n')
        for size, turn in ((7, 11), (12, 10)):
            (self.folder / "a.mesh.toml").write_text('name = "pan"\nkind = "pan"\n[pan]\nthickness = 1.5\n[mesh]\n'
                                                     f"element_size_mm = {size}\nelements_per_turn = {turn}\n")
            with self.subTest(size=size, turn=turn):
                self.run_stages(("mesh", "a.mesh.toml", "-o", "a.mesh.h5"),
                                ("assembly", "a.mesh.h5", "-c", "a.fe.toml", "-o", "a.fe.h5"))

    def test_a_pan_of_cad_agrees_with_quadratic_solids(self):
        (self.folder / "cad.mesh.toml").write_text('name = "pan"\nkind = "pan"\n[pan]\nthickness = 1.5\n[mesh]\n'
                                                   "element_size_mm = 5\nelements_per_turn = 16\n")
        (self.folder / "cad.fe.toml").write_text('[material.steel]\nregions = ["pan"]\nE_gpa = 210\nnu = 0.3\nrho = 7850\n')
        self.run_stages(("mesh", "cad.mesh.toml", "-o", "cad.mesh.h5", "--write-step", "pan.step"))
        hz = self.modes_of("cad", 18)
        np.testing.assert_allclose(hz[hz > 1.0][:12] / SOLIDS, 1.0, atol=1e-2)
        # The geometry that was written, as a stranger's file of faces.
        (self.folder / "faces.mesh.toml").write_text('name = "pan"\nkind = "sheet"\n[sheet]\nsource = "pan.step"\n'
                                                     'region = "pan"\nthickness = 1.5\n[mesh]\nelement_size_mm = 5\n'
                                                     "elements_per_turn = 16\n")
        shutil.copy(self.folder / "cad.fe.toml", self.folder / "faces.fe.toml")
        self.run_stages(("mesh", "faces.mesh.toml", "-o", "faces.mesh.h5"))
        faces = self.modes_of("faces", 10)
        np.testing.assert_allclose(faces[6:10] / hz[6:10], 1.0, atol=2e-3)

    @unittest.skipUnless(PAN.exists(), "the reference's pan is not here")
    def test_a_pan_tied_to_a_frame_has_the_arm_of_half_its_thickness(self):
        np.testing.assert_allclose(self.pan("--frame", "tied") / FRAMED, 1.0, atol=1e-2)

    def test_a_condensed_plate_keeps_its_frequencies_below_the_cut_off(self):
        (self.folder / "plate.bdf").write_text(plate_deck(30, 20))
        full = self.frequencies("plate.bdf", 10)
        with h5py.File(self.folder / "plate.mesh.h5") as file:
            self.assertEqual(len(file["shells"]), 1)
        recipe = (self.folder / "plate.fe.toml").read_text()
        with h5py.File(self.folder / "plate.mesh.h5", "r+") as file:
            file["node_sets/corners"] = np.array([0, 30, 20 * 31, 21 * 31 - 1], dtype=np.int32)
        (self.folder / "plate.fe.toml").write_text(recipe + '\n[[nodes]]\nname = "corners"\n[[nodes.term]]\n'
                                                   'node_set = "corners"\ndirections = "xyz"\n')
        (self.folder / "plate.rom.toml").write_text('boundary = ["corners"]\nfmax_hz = 800.0\nskin = ["skin"]\n')
        self.run_stages(("assembly", "plate.mesh.h5", "-c", "plate.fe.toml", "-o", "plate.fe.h5"),
                        ("condense", "plate.fe.h5", "-c", "plate.rom.toml", "-o", "plate.rom.h5"),
                        ("modal", "plate.rom.h5", "--count", "10", "-o", "rom.modes.h5"))
        with h5py.File(self.folder / "rom.modes.h5") as file:
            reduced = file["frequency_hz"][()]
        np.testing.assert_allclose(reduced[6:10], full[6:10], rtol=1e-3)
        # Air on both sides: both radiate, and no lid closes anything.
        (self.folder / "plate.sound.toml").write_text("[grid]\nfrom_hz = 100.0\nto_hz = 800.0\ntolerance_db = 1.0\n")
        self.run_stages(("recover", "sound", "plate.rom.h5", "-c", "plate.sound.toml", "-o", "plate.sound.h5"))
        with h5py.File(self.folder / "plate.sound.h5") as file:
            self.assertLess(file["certificate"].attrs["lid_area_m2"], 0.05 * 2 * 0.3 * 0.2)


if __name__ == "__main__":
    unittest.main()
