# SPDX-License-Identifier: GPL-3.0-or-later
"""A deck goes through mesh, assembly and modal by itself; CalculiX solves the same deck."""
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import calculix  # noqa: E402
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402

CALCULIX = calculix.Results(__file__)
CELLS = (4, 1, 1)
SIZE = (80.0, 10.0, 12.0)  # mm
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
UNIT = np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)])


def beam_deck():
    """C3D20 cantilever in mm, t, s: clamped at x = 0, loaded at x = 80, heated, then its frequencies."""
    ids, nodes, lines = {}, [], []

    def node(at):
        if at not in ids:
            ids[at] = len(ids) + 1
            nodes.append(np.array(at) / (2 * np.array(CELLS)) * SIZE)
        return ids[at]

    for x in range(CELLS[0]):
        corners = UNIT + (2 * x, 0, 0)
        cell = [node(tuple(c)) for c in corners]
        cell += [node(tuple((corners[a] + corners[b]) // 2)) for a, b in EDGES]
        lines.append(f"{x + 1}, " + ", ".join(map(str, cell[:10])) + ",\n" + ", ".join(map(str, cell[10:])))
    x = np.array(nodes)[:, 0]
    ends = [", ".join(str(i + 1) for i in np.flatnonzero(x == at)) for at in (0.0, SIZE[0])]
    coordinates = "\n".join(f"{i + 1}, {', '.join(map(repr, map(float, at)))}" for i, at in enumerate(nodes))
    return f"""*NODE, NSET=NALL
{coordinates}
*ELEMENT, TYPE=C3D20, ELSET=BEAM
{chr(10).join(lines)}
*NSET, NSET=CLAMP
{ends[0]}
*NSET, NSET=TIP
{ends[1]}
*MATERIAL, NAME=STEEL
*ELASTIC
210000., .3
*DENSITY
7.85e-9
*EXPANSION
1.2e-5
*SOLID SECTION, ELSET=BEAM, MATERIAL=STEEL
*BOUNDARY
CLAMP, 1, 3
*INITIAL CONDITIONS, TYPE=TEMPERATURE
NALL, 20.
*STEP
*STATIC
*CLOAD
TIP, 3, 25.
*TEMPERATURE
NALL, 70.
*NODE PRINT, NSET=NALL
U
*NODE PRINT, NSET=CLAMP, TOTALS=ONLY
RF
*END STEP
"""


FREQUENCY = """*STEP
*FREQUENCY
6
*END STEP
"""


def displacement(folder):
    """Of all nodes, in the order of their numbers."""
    return {"displacement": calculix.table(calculix.lines(folder), "displacements")[:, 1:]}


class Deck(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-deck-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "beam.inp").write_text(beam_deck())
        for stage, arguments in (
                ("mesh", ["beam.inp", "--units", "mm-t-s", "-o", "beam.mesh.h5", "--recipe", "beam.fe.toml"]),
                ("assembly", ["beam.mesh.h5", "-c", "beam.fe.toml", "-o", "beam.fe.h5"]),
                ("modal", ["statics", "beam.fe.h5", "-o", "beam.static.h5"]),
                ("modal", ["beam.fe.h5", "--count", "6", "-o", "beam.modes.h5"])):
            done = stages.run_stage(stage, *arguments, folder=cls.folder)
            if done.returncode:
                raise AssertionError(f"{stage}: {done.stderr}")

    def test_displacements_are_those_of_calculix(self):
        theirs = CALCULIX.of("static", beam_deck(), displacement)["displacement"]
        with h5py.File(self.folder / "beam.static.h5") as file:
            case = next(iter(file["cases"].values()))
            ours = case["displacement"][()].reshape(-1, 3) * 1e3
        self.assertEqual(len(theirs), len(ours))
        # Six digits are printed.
        self.assertLess(np.abs(ours - theirs).max(), 2e-6 * np.abs(ours).max())

    def test_frequencies_are_those_of_calculix(self):
        head = beam_deck().split("*STEP")[0]
        theirs = CALCULIX.of("modes", head + FREQUENCY, lambda folder: {"hz": calculix.frequencies(calculix.lines(folder))})["hz"]
        with h5py.File(self.folder / "beam.modes.h5") as file:
            ours = file["frequency_hz"][()]
        # Seven digits are printed.
        self.assertLess(np.abs(ours / theirs - 1).max(), 2e-7)

    def test_the_deck_comes_back_from_both_exports(self):
        done = stages.run_stage("mesh", "beam.inp", "--units", "m-kg-s", "-o", "a.mesh.h5", "--export", "again.inp",
                                "--export", "again.bdf", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.folder / "a.mesh.h5") as first:
            nodes, cells = first["nodes"][()], first["cells/0/nodes"][()]
            tip = first["node_sets/TIP"][()]
        for name in ("again.inp", "again.bdf"):
            done = stages.run_stage("mesh", name, "--units", "m-kg-s", "-o", "b.mesh.h5", folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            with h5py.File(self.folder / "b.mesh.h5") as second:
                np.testing.assert_array_equal(second["cells/0/nodes"][()], cells)
                np.testing.assert_array_equal(second["nodes"][()], nodes)
                np.testing.assert_array_equal(second["node_sets/TIP"][()], tip)

    def test_a_deck_without_units_is_refused(self):
        done = stages.run_stage("mesh", "beam.inp", "-o", "c.mesh.h5", folder=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--units", done.stderr)


def cube_deck(supports, step):
    """One C3D8, 1 m, E = 210 GPa, nu = 0.3, alpha = 1e-5, with supports and the lines of one *STATIC step."""
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    nodes = "\n".join(f"{i + 1}, {x}, {y}, {z}" for i, (x, y, z) in enumerate(corners))
    return f"""*NODE, NSET=ALL
{nodes}
*ELEMENT, TYPE=C3D8, ELSET=CUBE
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=FAR
2, 3, 6, 7
*MATERIAL, NAME=STEEL
*ELASTIC
210.e9, .3
*DENSITY
7800.
*EXPANSION
1.e-5
*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL
*BOUNDARY
{supports}
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, 0.
*STEP
*STATIC
{step}
*END STEP
"""


class WhollyHeld(unittest.TestCase):
    """A part with all DoFs held has reactions, but neither modes nor a reduction."""

    def setUp(self):
        stages.require_stages()
        scratch = tempfile.TemporaryDirectory(prefix="clatter-held-")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "cube.inp").write_text(
            cube_deck("ALL, 1, 3", "*BOUNDARY\nFAR, 1, 1, 1.e-3\n*TEMPERATURE\nALL, 100."))
        for stage, arguments in (
                ("mesh", ["cube.inp", "--units", "m-kg-s", "-o", "cube.mesh.h5", "--recipe", "cube.fe.toml"]),
                ("assembly", ["cube.mesh.h5", "-c", "cube.fe.toml", "-o", "cube.fe.h5"])):
            done = stages.run_stage(stage, *arguments, folder=self.folder)
            self.assertEqual(done.returncode, 0, f"{stage}: {done.returncode} {done.stderr}")

    def test_reactions_are_those_of_uniaxial_strain_and_of_heat_without_expansion(self):
        done = stages.run_stage("modal", "statics", "cube.fe.h5", "-o", "cube.static.h5", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        modulus, nu = 210e9, 0.3
        across = modulus / ((1 + nu) * (1 - 2 * nu)) * 1e-3  # stress is this times 1 - nu along x, nu across
        heat = -modulus * 1e-5 * 100.0 / (1 - 2 * nu)
        with h5py.File(self.folder / "cube.static.h5") as file:
            stress = next(iter(file["cases/step_1/stress"].values()))[()]
            reactions = file["cases/step_1/reactions"][()]
            position, direction = file["supports/position"][()], file["supports/direction"][()]
            shift = file["cases/step_1/displacement"][()]
        want = np.array([across * (1 - nu) + heat, across * nu + heat, across * nu + heat, 0, 0, 0])
        # One cell, eight points: rounding only.
        np.testing.assert_allclose(stress, np.tile(want, (8, 1)), atol=1e-12 * abs(want).max())
        pull = sum(r for r, p, d in zip(reactions, position, direction) if p[0] > 0.5 and d[0] > 0.5)
        self.assertAlmostEqual(pull / want[0], 1.0, delta=1e-12)
        np.testing.assert_allclose(shift[:, 0], [0, 1e-3, 1e-3, 0] * 2, atol=1e-18)

    def test_modes_and_reductions_are_refused_with_the_supports_that_hold_it(self):
        (self.folder / "cube.rom.toml").write_text("boundary = [\"FAR\"]\nfmax_hz = 1000.0\n")
        for stage, arguments in (("modal", ["cube.fe.h5", "--count", "3", "-o", "cube.modes.h5"]),
                                 ("condense", ["cube.fe.h5", "-c", "cube.rom.toml", "-o", "cube.rom.h5"])):
            done = stages.run_stage(stage, *arguments, "--quiet", folder=self.folder)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            self.assertIn("all 24 DoFs supported (support_1", done.stderr)
            self.assertIn("clatter-modal statics", done.stderr)


class Rotating(unittest.TestCase):
    """The beam rotates about z through its held end: rho omega^2 x acts along it (nu = 0: a bar)."""

    OMEGA2 = 4.0e5  # 1/s2

    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-rotor-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        head = beam_deck().split("*BOUNDARY")[0].replace("210000., .3", "210000., 0.")
        cls.deck = (head + "*BOUNDARY\nCLAMP, 1, 1\n1, 2, 3\n4, 3, 3\n"
                    f"*STEP\n*STATIC\n*DLOAD\nBEAM, CENTRIF, {cls.OMEGA2}, 0., 5., 6., 0., 0., 2.\n"
                    "*NODE PRINT, NSET=NALL\nU\n*END STEP\n")
        (cls.folder / "bar.inp").write_text(cls.deck)
        for stage, arguments in (
                ("mesh", ["bar.inp", "--units", "mm-t-s", "-o", "bar.mesh.h5", "--recipe", "bar.fe.toml"]),
                ("assembly", ["bar.mesh.h5", "-c", "bar.fe.toml", "-o", "bar.fe.h5"]),
                ("modal", ["statics", "bar.fe.h5", "--case", "step_1", "-o", "bar.static.h5"])):
            done = stages.run_stage(stage, *arguments, folder=cls.folder)
            if done.returncode:
                raise AssertionError(f"{stage}: {done.stderr}")
        with h5py.File(cls.folder / "bar.static.h5") as file:
            cls.nodes = file["nodes"][()]
            cls.shift = file["cases/step_1/displacement"][()]
            cls.applied = file["cases/step_1/applied"][()]
            cls.stress = next(iter(file["cases/step_1/stress"].values()))[()]

    def test_force_is_that_of_the_bar(self):
        density, length, area = 7850.0, 0.08, 0.01 * 0.012
        force = density * self.OMEGA2 * area * length**2 / 2
        # Bricks: the rule integrates rho r exactly.
        self.assertAlmostEqual(self.applied[0] / force, 1.0, delta=1e-12)
        self.assertLess(np.abs(self.applied[1:3]).max(), 1e-12 * force)

    def test_stress_is_rho_omega2_l2_less_x2_over_2(self):
        density, length = 7850.0, 0.08
        x = self.nodes[:, 0]
        exact = density * self.OMEGA2 * (length**2 - x**2) / 2
        # Exact at the two Gauss points along each cell of length h: their line misses the parabola by
        # rho omega^2 h^2 / 12 at its ends.
        h = length / CELLS[0]
        self.assertLess(np.abs(self.stress[:, 0] - exact).max(), 1.001 * density * self.OMEGA2 * h**2 / 12)

    def test_displacements_are_those_of_calculix(self):
        theirs = CALCULIX.of("rotating", self.deck, displacement)["displacement"]
        # Seven digits are printed.
        self.assertLess(np.abs(1e3 * self.shift - theirs).max(), 1e-6 * 1e3 * np.abs(self.shift).max())


class Refused(unittest.TestCase):
    """The program reports all errors of a deck at once and leaves no file."""

    def test_several_errors_are_reported_in_one_run_with_exit_code_2(self):
        stages.require_stages()
        with tempfile.TemporaryDirectory(prefix="clatter-refused-") as folder:
            deck = cube_deck("ALL, 1, 3", "*CLOAD\n2, 7, 1.\n*DLOAD\nCUBE, P8, 1.").replace(
                "*BOUNDARY", "*CONTACT PAIR\nA, B\n*BOUNDARY", 1)
            (pathlib.Path(folder) / "cube.inp").write_text(deck)
            done = stages.run_stage("mesh", "cube.inp", "--units", "m-kg-s", "-o", "cube.mesh.h5", "--quiet",
                                    folder=folder)
            self.assertEqual(done.returncode, 2, done.stderr)
            lines = done.stderr.strip().splitlines()
            self.assertEqual(lines[0], "clatter-mesh: error: 3 refusals:")
            line_of = {text: deck[:deck.index(text)].count("\n") + 1 for text in ("*CONTACT PAIR", "2, 7, 1.", "CUBE, P8")}
            for line, number in zip(lines[1:], line_of.values()):
                self.assertTrue(line.startswith(f"  cube.inp:{number}: "), line)
            self.assertEqual(len(lines), 4)
            self.assertEqual([p.name for p in pathlib.Path(folder).iterdir()], ["cube.inp"])

    def test_a_deck_cut_before_its_steps_is_reported(self):
        stages.require_stages()
        with tempfile.TemporaryDirectory(prefix="clatter-cut-") as folder:
            deck = cube_deck("ALL, 1, 3", "")
            (pathlib.Path(folder) / "cube.inp").write_text(deck[:deck.index("*INITIAL")])
            done = stages.run_stage("mesh", "cube.inp", "--units", "m-kg-s", "-o", "cube.mesh.h5", folder=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stderr, r"cube.inp:\d+: the deck ends here, in \*BOUNDARY, without a \*STEP")


if __name__ == "__main__":
    unittest.main(verbosity=2)
