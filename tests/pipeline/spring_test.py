# SPDX-License-Identifier: GPL-3.0-or-later
"""A cube on springs: against a hand calculation, and against CalculiX on the same deck."""
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
SIDE, DENSITY = 10.0, 7.8e-9  # mm, t/mm3
UP, ACROSS, LEAN = 3.0, 5.0, 2.0  # N/mm

# Springs upward under the four lower corners, across at two, and one oblique spring from a corner to a held node.
DECK = f"""*NODE, NSET=NALL
1, 0, 0, 0
2, {SIDE}, 0, 0
3, {SIDE}, {SIDE}, 0
4, 0, {SIDE}, 0
5, 0, 0, {SIDE}
6, {SIDE}, 0, {SIDE}
7, {SIDE}, {SIDE}, {SIDE}
8, 0, {SIDE}, {SIDE}
9, 30., 25., -12.
*ELEMENT, TYPE=C3D8, ELSET=CUBE
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=SPRING1, ELSET=SUP
11, 1
12, 2
13, 3
14, 4
*ELEMENT, TYPE=SPRING1, ELSET=SY
15, 1
16, 2
*ELEMENT, TYPE=SPRING1, ELSET=SX
17, 1
*ELEMENT, TYPE=SPRINGA, ELSET=SLEAN
18, 7, 9
*SPRING, ELSET=SUP
3
{UP}
*SPRING, ELSET=SY
2
{ACROSS}
*SPRING, ELSET=SX
1
{ACROSS}
*SPRING, ELSET=SLEAN

{LEAN}
*MATERIAL, NAME=STEEL
*ELASTIC
210000., .3
*DENSITY
{DENSITY}
*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL
*BOUNDARY
9, 1, 3
"""
PUSH = "*STEP\n*STATIC\n*CLOAD\n6, 1, 1.\n6, 3, 2.\n*NODE PRINT, NSET=NALL\nU\n*END STEP\n"
MODES = "*STEP\n*FREQUENCY\n4\n*END STEP\n"  # more are too many for 24 DoFs in CalculiX
NODES = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]) * SIDE


def rigid_frequencies():
    """Of a rigid cube on these springs: K and M on its six motions about the centre."""
    centre = np.full(3, SIDE / 2)
    lean = np.array([30.0, 25.0, -12.0]) - NODES[6]
    springs = [(NODES[n], np.array([0, 0, 1.0]), UP) for n in range(4)]
    springs += [(NODES[0], np.array([0, 1.0, 0]), ACROSS), (NODES[1], np.array([0, 1.0, 0]), ACROSS),
                (NODES[0], np.array([1.0, 0, 0]), ACROSS), (NODES[6], lean / np.linalg.norm(lean), LEAN)]
    stiffness = np.zeros((6, 6))
    for at, along, k in springs:
        motion = np.concatenate([along, np.cross(at - centre, along)])
        stiffness += k * np.outer(motion, motion)
    mass = DENSITY * SIDE**3
    inverse = 1 / np.sqrt([mass] * 3 + [mass * SIDE**2 / 6] * 3)
    return np.sqrt(np.linalg.eigvalsh(inverse[:, None] * stiffness * inverse)) / (2 * np.pi)


class Springs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-spring-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "cube.inp").write_text(DECK + PUSH)
        for stage, arguments in (
                ("mesh", ["cube.inp", "--units", "mm-t-s", "-o", "cube.mesh.h5", "--recipe", "cube.fe.toml"]),
                ("assembly", ["cube.mesh.h5", "-c", "cube.fe.toml", "-o", "cube.fe.h5"]),
                ("modal", ["statics", "cube.fe.h5", "-o", "cube.static.h5"]),
                ("modal", ["cube.fe.h5", "--count", "6", "-o", "cube.modes.h5"])):
            done = stages.run_stage(stage, *arguments, folder=cls.folder)
            if done.returncode:
                raise AssertionError(f"{stage}: {done.stderr}")
        with h5py.File(cls.folder / "cube.modes.h5") as file:
            cls.hz = file["frequency_hz"][()]
        with h5py.File(cls.folder / "cube.static.h5") as file:
            cls.displacement = next(iter(file["cases"].values()))["displacement"][()].reshape(-1, 3)

    def test_the_cube_moves_as_a_rigid_body_on_its_springs(self):
        # Springs are 1e-6 of the cube's own stiffness.
        self.assertLess(np.abs(self.hz / rigid_frequencies() - 1).max(), 1e-5)

    def test_frequencies_are_those_of_calculix(self):
        theirs = CALCULIX.of("modes", DECK + MODES, lambda folder: {"hz": calculix.frequencies(calculix.lines(folder))[:4]})["hz"]
        # Seven digits are printed.
        self.assertLess(np.abs(self.hz[:4] / theirs - 1).max(), 2e-6)

    def test_displacements_are_those_of_calculix(self):
        theirs = CALCULIX.of("push", DECK + PUSH, lambda folder: {
            "displacement": calculix.table(calculix.lines(folder), "displacements")[:, 1:]})["displacement"]
        ours = 1e3 * self.displacement
        self.assertEqual(len(theirs), 9)
        # Seven digits are printed.
        self.assertLess(np.abs(ours - theirs[:8]).max(), 1e-6 * np.abs(ours).max())


if __name__ == "__main__":
    unittest.main(verbosity=2)
