# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets of layers through the stages: against CalculiX, which makes solids of them, and an exact solution."""
import math
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import calculix  # noqa: E402
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import scipy.linalg  # noqa: E402
import scipy.spatial.transform  # noqa: E402
import stages  # noqa: E402

# Material, thickness [mm], angle [degrees]: not symmetric, fibres askew, a sheet of aluminium between.
PLIES = [("UD", 0.5, 0), ("UD", 0.5, 45), ("AL", 0.8, 0), ("UD", 0.5, -30), ("UD", 0.7, 90)]
CALCULIX = calculix.Results(__file__)


def rows(numbers, each=10):
    return [", ".join(str(n) for n in numbers[i:i + each]) for i in range(0, len(numbers), each)]


def plate_deck(kind, long=20, wide=10, plies=PLIES):
    """A cantilever of 200 x 100 mm."""
    numbers, lines, cells = {}, [], []

    def node(i, j):
        if (i, j) not in numbers:
            numbers[i, j] = len(numbers) + 1
            lines.append(f"{len(numbers)}, {100 * i / long:.9g}, {50 * j / wide:.9g}, 0.")
        return numbers[i, j]

    around = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)] if kind == "S8R" else [(0, 0), (2, 0), (2, 2), (0, 2)]
    for j in range(wide):
        for i in range(long):
            cells.append([node(2 * i + a, 2 * j + b) for a, b in around])
    held = [number for (i, j), number in numbers.items() if i == 0]
    text = ["*NODE", *lines, f"*ELEMENT, TYPE={kind}, ELSET=PLATE"]
    text += [f"{k}, " + ", ".join(map(str, cell)) for k, cell in enumerate(cells, 1)]
    text += ["*NSET, NSET=WALL", *rows(held), "*MATERIAL, NAME=UD", "*ELASTIC, TYPE=ENGINEERING CONSTANTS",
             "140000., 10000., 10000., .3, .3, .4, 5000., 5000.,", "3500.", "*DENSITY", "1.6e-9",
             "*MATERIAL, NAME=AL", "*ELASTIC", "70000., .3", "*DENSITY", "2.7e-9"]
    for angle in sorted({angle for _, _, angle in plies}):
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        text += [f"*ORIENTATION, NAME=AT_{angle}", f"{c:.12g}, {s:.12g}, 0., {-s:.12g}, {c:.12g}, 0.", "3, 0."]
    text += ["*SHELL SECTION, ELSET=PLATE, COMPOSITE, ORIENTATION=AT_0"]
    text += [f"{thickness}, , {material}, AT_{angle}" for material, thickness, angle in plies]
    return "\n".join([*text, "*BOUNDARY", "WALL, 1, 6", "*STEP", "*FREQUENCY", "8", "*NODE FILE", "U", "*END STEP", ""])


def plate_bulk(long, wide, first, direction):
    """The same plate of PCOMP: its CQUAD4 begin at corner `first` and have this THETA or MCID."""
    lines = ["SOL 103", "CEND", "BEGIN BULK", "PARAM,COUPMASS,1", "MAT8,8,140000.,10000.,.3,5000.,5000.,3500.,1.6-9",
             "MAT1,2,70000.,,.3,2.7-9", "CORD2R,5,,0.,0.,0.,0.,0.,1.,+", "+,1.,0.,0."]
    for j in range(wide + 1):
        for i in range(long + 1):
            grid = j * (long + 1) + i + 1
            lines.append(f"GRID,{grid},,{200 * i / long:.9g},{100 * j / wide:.9g},0.,,{123456 if i == 0 else ''}")
            corners = [grid, grid + 1, grid + long + 2, grid + long + 1]
            around = ",".join(str(corners[(first + k) % 4]) for k in range(4))
            if i < long and j < wide:
                lines.append(f"CQUAD4,{grid},1,{around},{direction}")
    fields = [field for name, t, angle in PLIES for field in ("8" if name == "UD" else "2", f"{t}", f"{angle}.", "")]
    layers = [",".join(fields[k:k + 8]) for k in range(0, len(fields), 8)]
    return "\n".join([*lines, "PCOMP,1,,,,,,,,+\n+," + ",+\n+,".join(layers), "ENDDATA", ""])


def moved(text, rotation):
    """A deck with its nodes and orientations turned."""
    lines, keyword = [], ""
    for line in text.splitlines():
        values = [] if line.startswith("*") else line.split(",")
        keyword = line.split(",")[0] if line.startswith("*") else keyword
        if keyword == "*NODE":
            line = ", ".join([values[0], *(f"{x:.15g}" for x in rotation @ np.array(values[1:], float))]) if values else line
        if keyword == "*ORIENTATION" and len(values) == 6:
            line = ", ".join(f"{x:.15g}" for x in (np.array(values, float).reshape(2, 3) @ rotation.T).ravel())
        lines.append(line)
    return "\n".join(lines) + "\n"


def strip_deck(long, length, thickness):
    """0/90/0, to bend as a cylinder under a sinusoidal load; stiffness 25, 1, 0.5, 0.2 (Pagano 1969)."""
    lines = ["SOL 101", "CEND", "SPC = 1", "LOAD = 1", "BEGIN BULK", "MAT8,1,25.,1.,.25,.5,.5,.2",
             "PCOMP,1,,,,,,,,+", f"+,1,{thickness / 3:.9g},0.,,1,{thickness / 3:.9g},90.,,+", f"+,1,{thickness / 3:.9g},0."]
    x = [length * i / long for i in range(long + 1)]
    for i in range(long + 1):
        for side in (0, 1):
            grid = 2 * i + side + 1
            held = "12346" if i == 0 and side == 0 else "2346" if i in (0, long) else "246"
            lines += [f"GRID,{grid},,{x[i]:.9g},{side:.1f},0.", f"SPC1,1,{held},{grid}",
                      f"FORCE,1,{grid},,{0.5 * length / long * math.sin(math.pi * i / long):.9e},0.,0.,1."]
    lines += [f"CQUAD4,{i + 1},1,{2 * i + 1},{2 * i + 3},{2 * i + 4},{2 * i + 2}" for i in range(long)]
    return "\n".join([*lines, "ENDDATA", ""])


def exact_strip(length, thickness):
    """Deflection of its middle by elasticity: u, w, sigma_zz and tau_xz through the layers, by matrix exponentials."""
    p = math.pi / length
    # By fibres along x, across: compliances of x y z, and the shear modulus.
    along = ([[1 / 25, -.01, -.01], [-.01, 1, -.25], [-.01, -.25, 1]], 0.5)
    across = ([[1, -.01, -.25], [-.01, 1 / 25, -.01], [-.25, -.01, 1]], 0.2)
    steps = []
    for compliance, shear in (along, across, along):
        C = np.linalg.inv(compliance)
        A = np.array([[0, -p, 0, 1 / shear], [C[0, 2] * p / C[2, 2], 0, 1 / C[2, 2], 0], [0, 0, 0, p],
                      [p * p * (C[0, 0] - C[0, 2] ** 2 / C[2, 2]), 0, -p * C[0, 2] / C[2, 2], 0]])
        steps.append(scipy.linalg.expm(A * thickness / 3))
    through = steps[2] @ steps[1] @ steps[0]
    bottom = np.linalg.solve(through[2:, :2], [1.0, 0.0])
    half = scipy.linalg.sqrtm(steps[1]) @ steps[0]
    return float((half[:, :2] @ bottom)[1].real)


class Laminate(unittest.TestCase):
    def setUp(self):
        stages.require_stages()
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-laminate-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_stages(self, *commands):
        for stage, *arguments in commands:
            done = stages.run_stage(stage, *arguments, folder=self.folder)
            self.assertEqual(done.returncode, 0, f"{stage}: {done.stderr}")

    def assemble(self, deck, units):
        self.run_stages(("mesh", deck, "--units", units, "-o", "a.mesh.h5", "--recipe", "a.fe.toml"),
                        ("assembly", "a.mesh.h5", "-c", "a.fe.toml", "-o", "a.fe.h5"))

    def frequencies(self, text, count=8, deck="plate.inp"):
        (self.folder / deck).write_text(text)
        self.assemble(deck, "mm-t-s")
        self.run_stages(("modal", "a.fe.h5", "--count", str(count), "-o", "a.modes.h5"))
        with h5py.File(self.folder / "a.modes.h5") as file:
            return file["frequency_hz"][()]

    def test_hardU11_layers_askew_stretch_bend_and_twist_together(self):
        hz = self.frequencies(plate_deck("S4", 60, 30))
        solids = CALCULIX.of("plate", plate_deck("S8R"), lambda folder: {"hz": calculix.frequencies(calculix.lines(folder))})["hz"]
        np.testing.assert_allclose(hz / solids, 1.0, atol=4e-3)
        # In the opposite order, or with angles of the other sign, it is another plate.
        mirrored = self.frequencies(plate_deck("S4", 60, 30, [(name, t, -angle) for name, t, angle in PLIES]))
        self.assertLess(np.abs(mirrored / hz - 1).max(), 1e-6)  # as the plate is its own mirror image
        other = self.frequencies(plate_deck("S4", 60, 30, PLIES[:2] + PLIES[3:1:-1] + PLIES[4:]))
        self.assertGreater(np.abs(other / hz - 1).max(), 0.05)

    def test_decks_of_both_programs_are_the_same_plate(self):
        wanted = self.frequencies(plate_deck("S4", 20, 10))
        for first, direction in ((0, ""), (1, "-90."), (2, "5")):
            with self.subTest(first=first):
                found = self.frequencies(plate_bulk(20, 10, first, direction), deck="plate.bdf")
                np.testing.assert_allclose(found, wanted, rtol=1e-9)

    def test_a_free_plate_has_six_rigid_motions_in_any_direction(self):
        free = plate_deck("S4", 20, 10).replace("*BOUNDARY\nWALL, 1, 6\n", "")
        flat = self.frequencies(free, 12)
        turned = self.frequencies(moved(free, scipy.spatial.transform.Rotation.random(random_state=1).as_matrix()), 12)
        self.assertLess(flat[5], 1e-3 * flat[6])
        self.assertLess(turned[5], 1e-3 * flat[6])
        np.testing.assert_allclose(turned[6:], flat[6:], rtol=1e-9)

    def test_a_strip_shears_as_by_elasticity(self):
        for slender, within in ((10, 0.02), (20, 0.006), (100, 0.0005)):
            with self.subTest(slender=slender):
                (self.folder / "strip.bdf").write_text(strip_deck(100, float(slender), 1.0))
                self.assemble("strip.bdf", "m-kg-s")
                self.run_stages(("modal", "statics", "a.fe.h5", "-o", "a.static.h5"))
                with h5py.File(self.folder / "a.static.h5") as file:
                    w = next(iter(file["cases"].values()))["displacement"][()].reshape(-1, 3)[:, 2].max()
                self.assertAlmostEqual(w / exact_strip(slender, 1.0), 1.0, delta=within)


if __name__ == "__main__":
    unittest.main()
