# SPDX-License-Identifier: GPL-3.0-or-later
"""[prestress]: modes of what is pulled or pressed, against closed forms and CalculiX."""
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
import stages  # noqa: E402

CALCULIX = calculix.Results(__file__)
LENGTH, SIDE, E, DENSITY = 400.0, 10.0, 210000.0, 7.85e-9  # mm, MPa, t/mm3
BUCKLING = np.pi**2 * E * SIDE**4 / 12 / (4 * LENGTH**2)  # of a cantilever by a load along it [N]
HEX20 = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2), (1, 0, 0), (2, 1, 0),
         (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2), (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)]


def column(force, steps):
    """A cantilever of C3D20 along x, pressed by `force` on the nodes of its end."""
    numbers, nodes, cells = {}, [], []

    def node(i, j, k):
        if (i, j, k) not in numbers:
            numbers[i, j, k] = len(numbers) + 1
            nodes.append(f"{len(numbers)}, {LENGTH * i / 40:.9g}, {SIDE * j / 2:.9g}, {SIDE * k / 2:.9g}")
        return numbers[i, j, k]

    for i in range(20):
        cell = [node(2 * i + a, b, c) for a, b, c in HEX20]
        cells.append(f"{i + 1}, " + ", ".join(map(str, cell[:15])) + ",\n" + ", ".join(map(str, cell[15:])))
    wall, end = (", ".join(str(number) for (i, _, _), number in numbers.items() if i == at) for at in (0, 40))
    text = ["*NODE", *nodes, "*ELEMENT, TYPE=C3D20, ELSET=BAR", *cells, f"*NSET, NSET=WALL\n{wall}", f"*NSET, NSET=END\n{end}",
            "*MATERIAL, NAME=STEEL", "*ELASTIC", f"{E}, .3", "*DENSITY", f"{DENSITY}", "*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL", "*BOUNDARY", "WALL, 1, 3"]
    return "\n".join([*text, *(line.format(load=f"*CLOAD\nEND, 1, {-force / 8:.9g}") for line in steps), ""])


STATIC = "*STEP, NLGEOM\n*STATIC\n{load}\n*END STEP"
MODES = "*STEP, PERTURBATION\n*FREQUENCY\n6\n*END STEP"


def theory(share):
    """f^2 of the first bending mode over that of no load, where `share` of the buckling load presses: 40 beams of Hermite."""
    n, h = 40, 1.0 / 40
    K, G, M = (np.zeros((2 * n + 2, 2 * n + 2)) for _ in range(3))
    k = np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h], [-12, -6 * h, 12, -6 * h],
                  [6 * h, 2 * h * h, -6 * h, 4 * h * h]]) / h**3
    g = np.array([[36, 3 * h, -36, 3 * h], [3 * h, 4 * h * h, -3 * h, -h * h], [-36, -3 * h, 36, -3 * h],
                  [3 * h, -h * h, -3 * h, 4 * h * h]]) / (30 * h)
    m = np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h], [54, 13 * h, 156, -22 * h],
                  [-13 * h, -3 * h * h, -22 * h, 4 * h * h]]) * h / 420
    for e in range(n):
        at = slice(2 * e, 2 * e + 4)
        K[at, at] += k
        G[at, at] += g
        M[at, at] += m
    first = [scipy.linalg.eigh((K - s * np.pi**2 / 4 * G)[2:, 2:], M[2:, 2:], eigvals_only=True)[0] for s in (share, 0.0)]
    return first[0] / first[1]


class Stages(unittest.TestCase):
    def setUp(self):
        stages.require_stages()
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-prestress-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_stage(self, stage, *arguments):
        done = stages.run_stage(stage, *arguments, folder=self.folder)
        self.assertEqual(done.returncode, 0, f"{stage}: {done.stderr}")
        return done.stderr

    def refusal(self, stage, *arguments):
        done = stages.run_stage(stage, *arguments, folder=self.folder)
        self.assertEqual(done.returncode, 2, done.stderr)
        return done.stderr

    def assemble(self, deck, name="part.inp"):
        (self.folder / name).write_text(deck)
        self.run_stage("mesh", name, "--units", "mm-t-s", "-o", "part.mesh.h5", "--recipe", "part.fe.toml")
        self.run_stage("assembly", "part.mesh.h5", "-c", "part.fe.toml", "-o", "part.fe.h5")

    def pressed(self, keys=""):
        """The modes [Hz] of the state of part.static.h5, and what the assembly says."""
        base = (self.folder / "part.fe.toml").read_text()
        (self.folder / "pressed.fe.toml").write_text(base + f'\n[prestress]\nfile = "part.static.h5"\ncase = "step_1"\n{keys}\n')
        said = self.run_stage("assembly", "part.mesh.h5", "-c", "pressed.fe.toml", "-o", "pressed.fe.h5")
        return self.modes("pressed.fe.h5"), said

    def modes(self, model):
        self.run_stage("modal", model, "--count", "6", "-o", "one.modes.h5")
        with h5py.File(self.folder / "one.modes.h5") as file:
            return file["frequency_hz"][()]


class Column(Stages):
    def test_frequencies_of_a_pressed_and_a_pulled_column(self):
        self.assemble(column(0.5 * BUCKLING, [STATIC.replace(", NLGEOM", "")]))
        self.run_stage("modal", "statics", "part.fe.h5", "-o", "part.static.h5")
        free = self.modes("part.fe.h5")
        for factor in (1.0, -4.0, 1.6):
            hz, said = self.pressed(f"factor = {factor}")
            self.assertAlmostEqual((hz[0] / free[0])**2 / theory(0.5 * factor), 1.0, delta=0.006 if factor < 1.5 else 0.03)
            self.assertIn("changes the stiffness of the cells against its own displacements by", said)

    def test_a_column_beyond_its_buckling_load_is_no_place_of_rest(self):
        self.assemble(column(0.5 * BUCKLING, [STATIC.replace(", NLGEOM", "")]))
        self.run_stage("modal", "statics", "part.fe.h5", "-o", "part.static.h5")
        base = (self.folder / "part.fe.toml").read_text()
        (self.folder / "pressed.fe.toml").write_text(base + '\n[prestress]\nfile = "part.static.h5"\ncase = "step_1"\nfactor = 2.1\n')
        self.run_stage("assembly", "part.mesh.h5", "-c", "pressed.fe.toml", "-o", "pressed.fe.h5")
        done = stages.run_stage("modal", "pressed.fe.h5", "--count", "3", "-o", "one.modes.h5", folder=self.folder)
        self.assertEqual(done.returncode, 3, done.stderr)

    def test_as_calculix(self):
        self.assemble(column(-2000.0, [STATIC.replace(", NLGEOM", "")]))
        self.run_stage("modal", "statics", "part.fe.h5", "-o", "part.static.h5")
        hz, _ = self.pressed()
        other = CALCULIX.of("column", column(-2000.0, [STATIC, MODES]),
                             lambda folder: {"hz": calculix.frequencies(calculix.lines(folder))})["hz"]
        self.assertLess(np.abs(hz / other[:6] - 1).max(), 2e-4, (hz, other))

    def test_refusals(self):
        self.assemble(column(100.0, [STATIC.replace(", NLGEOM", "")]))
        self.run_stage("modal", "statics", "part.fe.h5", "-o", "part.static.h5")
        base = (self.folder / "part.fe.toml").read_text()
        (self.folder / "pressed.fe.toml").write_text(base + '\n[prestress]\nfile = "part.static.h5"\ncase = "heat"\n')
        arguments = ["part.mesh.h5", "-c", "pressed.fe.toml", "-o", "pressed.fe.h5"]
        self.assertIn('part.static.h5: case: found "heat", expected one of: ', self.refusal("assembly", *arguments))
        (self.folder / "pressed.fe.toml").write_text(base + '\n[prestress]\nfile = "part.static.h5"\ncase = "step_1"\n')
        deck = column(100.0, [STATIC.replace(", NLGEOM", "")]).replace("1, 0, 0, 0\n", "1, 1., 0, 0\n", 1)
        (self.folder / "other.inp").write_text(deck)
        self.run_stage("mesh", "other.inp", "--units", "mm-t-s", "-o", "part.mesh.h5")
        self.assertIn("results of clatter-modal statics for the same mesh", self.refusal("assembly", *arguments))


class Wire(Stages):
    def test_a_wire_of_beams_sounds_as_a_string(self):
        count, length, radius, tension = 40, 1000.0, 0.5, 100.0
        text = ["*NODE", *(f"{n + 1}, {length * n / count}, 0., 0." for n in range(count + 1)), "*ELEMENT, TYPE=B31, ELSET=WIRE",
                *(f"{n}, {n}, {n + 1}" for n in range(1, count + 1)), "*MATERIAL, NAME=STEEL", "*ELASTIC", f"{E}, .3", "*DENSITY",
                f"{DENSITY}", "*BEAM SECTION, ELSET=WIRE, MATERIAL=STEEL, SECTION=CIRC", f"{radius}", "0., 1., 0.", "*BOUNDARY",
                "1, 1, 4", f"{count + 1}, 2, 3", "*STEP", "*STATIC", "*CLOAD", f"{count + 1}, 1, {tension}", "*END STEP", ""]
        self.assemble("\n".join(text))
        self.run_stage("modal", "statics", "part.fe.h5", "-o", "part.static.h5")
        hz, _ = self.pressed()
        area, inertia = np.pi * radius**2, np.pi * radius**4 / 4
        n = np.array([1, 1, 2, 2, 3, 3])  # both planes
        wave = n * np.pi / length
        exact = wave / (2 * np.pi) * np.sqrt((tension + E * inertia * wave**2) / (DENSITY * area))
        self.assertLess(np.abs(hz / exact - 1).max(), 1e-4)


if __name__ == "__main__":
    unittest.main()
