# SPDX-License-Identifier: GPL-3.0-or-later
"""A bored block, heated by films and under the pull of four bolts, through mesh, assembly, statics and shape; CalculiX solves the same."""
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import calculix  # noqa: E402
import deck_test  # noqa: E402
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402

CALCULIX = calculix.Results(__file__)
AROUND, ACROSS, ALONG = 24, 2, 5
BORE, SIDES, HEIGHT = 0.0535, (0.066, 0.078), 0.12  # radius; half widths; [m]
INSIDE, OUTSIDE, TOP = 6, 4, 2  # numbers of the faces of a C3D20
FILM_IN, FILM_OUT = (900.0, 500.0), (3000.0, 90.0)  # [W/(m2 K)], [degrees Celsius]
PULL = 6.0e4  # of a bolt [N]

RECIPE = """
[material.iron]
regions = ["BLOCK"]
E = 1.1e11
nu = 0.26
rho = 7200.0
expansion = 1.1e-5
conductivity = 48.0
[[support]]
name = "three"
node_set = "A"
[[support]]
name = "two"
node_set = "B"
directions = "yz"
[[support]]
name = "one"
node_set = "C"
directions = "z"
[[heat]]
name = "running"
[[heat.film]]
surface = "BORE"
coefficient = {inside[0]}
temperature_c = {inside[1]}
[[heat.film]]
surface = "SIDES"
coefficient = {outside[0]}
temperature_c = {outside[1]}
[[load]]
name = "warm"
kind = "temperature"
heat = "running"
reference_c = 20.0
[[nodes]]
name = "bolts"
node_set = "BOLTS"
[[load]]
name = "pull"
kind = "force"
set = "bolts"
force = [0.0, 0.0, 1.0]
[[load]]
name = "gasket"
kind = "pressure"
surface = "GASKET"
[[case]]
name = "assembly"
loads = {{ pull = {pull}, gasket = {pressure} }}
"""

STEPS = """*INITIAL CONDITIONS, TYPE=TEMPERATURE
NALL, 20.
*BOUNDARY
A, 1, 3
B, 2, 3
C, 3, 3
*STEP
{procedure}
{loads}
*NODE PRINT, NSET=NALL
U
{more}*END STEP
"""


def position(radial, around, along):
    """Position of a point of the block; radial and along from 0 to 1, around in turns."""
    angle = 2.0 * np.pi * around
    direction = np.array([np.cos(angle), np.sin(angle)])
    outer = (np.abs(direction / SIDES) ** 8).sum() ** (-1.0 / 8.0)  # a rectangle with rounded corners
    # To 0.1 nm, so that the deck is the same on machines whose sine differs in the last digit.
    return np.round([*((1.0 - radial) * BORE + radial * outer) * direction, HEIGHT * along], 10)


def block():
    """(nodes, text of *NODE and *ELEMENT, {surface: [(element, face)]})."""
    ids, nodes, lines, faces = {}, [], [], {INSIDE: [], OUTSIDE: [], TOP: []}

    def node(at):
        at = (int(at[0]), int(at[1]) % (2 * AROUND), int(at[2]))
        if at not in ids:
            ids[at] = len(ids) + 1
            nodes.append(position(at[0] / (2 * ACROSS), at[1] / (2 * AROUND), at[2] / (2 * ALONG)))
        return ids[at]

    number = 0
    for k in range(ALONG):
        for j in range(AROUND):
            for i in range(ACROSS):
                number += 1
                # The first direction of a cell is the radius, the second the angle.
                corners = deck_test.UNIT + (2 * i, 2 * j, 2 * k)
                cell = [node(c) for c in corners] + [node((corners[a] + corners[b]) // 2) for a, b in deck_test.EDGES]
                lines.append(f"{number}, " + ", ".join(map(str, cell[:10])) + ",\n" + ", ".join(map(str, cell[10:])))
                if i == 0:
                    faces[INSIDE].append(number)
                if i == ACROSS - 1:
                    faces[OUTSIDE].append(number)
                if k == ALONG - 1 and i == 0:
                    faces[TOP].append(number)
    text = "*NODE, NSET=NALL\n" + "\n".join(f"{n + 1}, {', '.join(f'{x:.14g}' for x in at)}" for n, at in enumerate(nodes))
    text += "\n*ELEMENT, TYPE=C3D20, ELSET=BLOCK\n" + "\n".join(lines)
    return np.array(nodes), text, faces


def deck():
    """(nodes, the model as a deck, faces)"""
    nodes, text, faces = block()

    def nearest(x, y, z):
        return str(int(np.argmin(((nodes - (x, y, z)) ** 2).sum(1))) + 1)

    x, y = SIDES
    sets = {"A": [nearest(-x, 0, 0)], "B": [nearest(x, 0, 0)], "C": [nearest(0, y, 0)],
            "BOLTS": [nearest(sx * 0.052, sy * 0.060, HEIGHT) for sx in (-1, 1) for sy in (-1, 1)]}
    for name, members in sets.items():
        text += f"\n*NSET, NSET={name}\n{', '.join(members)}"
    for name, face in (("BORE", INSIDE), ("SIDES", OUTSIDE), ("GASKET", TOP)):
        text += f"\n*SURFACE, NAME={name}, TYPE=ELEMENT\n" + "\n".join(f"{cell}, S{face}" for cell in faces[face])
    return nodes, text + """
*MATERIAL, NAME=IRON
*ELASTIC
1.1e11, .26
*DENSITY
7200.
*EXPANSION, ZERO=20.
1.1e-5
*CONDUCTIVITY
48.
*SPECIFIC HEAT
500.
*SOLID SECTION, ELSET=BLOCK, MATERIAL=IRON
""", faces


def rows_of(text, title):
    """Values of all nodes, in the order of their numbers."""
    rows = calculix.table(text, title)
    return rows[np.argsort(rows[:, 0]), 1:]


def orders_at(angle, radial, highest):
    """Amplitudes of the orders of equally spaced values."""
    return [abs((radial * np.exp(-1j * m * angle)).mean()) * (1 if m == 0 else 2) for m in range(highest + 1)]


class WarmBore(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-warm-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.nodes, cls.model, cls.faces = deck()
        (cls.folder / "block.inp").write_text(cls.model)
        stages.run_all(cls.folder, ["mesh", "block.inp", "--units", "m-kg-s", "-o", "block.mesh.h5"])
        with h5py.File(cls.folder / "block.mesh.h5") as mesh:
            cls.order = np.argsort(mesh["node_ids"][()]) if "node_ids" in mesh else np.arange(len(cls.nodes))
        radii = np.array([np.hypot(*position(0.5, n / 4800, 0.0)[:2]) for n in range(4800)])
        cls.pressure = 4.0 * PULL / (0.5 * (radii ** 2 - BORE ** 2).sum() * 2.0 * np.pi / 4800)
        (cls.folder / "block.fe.toml").write_text(
            RECIPE.format(inside=FILM_IN, outside=FILM_OUT, pull=4.0 * PULL, pressure=cls.pressure))
        stages.run_all(
            cls.folder, ["assembly", "block.mesh.h5", "-c", "block.fe.toml", "-o", "block.fe.h5"],
            ["modal", "statics", "block.fe.h5", "-o", "block.static.h5"],
            ["modal", "shape", "block.static.h5", "--surface", "BORE", "--axis-point", "0,0,0", "--axis", "0,0,1",
            "--zero-angle", "1,0,0", "--heights", str(2 * ALONG + 1), "--angles", str(2 * AROUND), "--case", "warm", "--case",
            "assembly", "--csv", "bore.csv", "-o", "bore.shape.h5"])

    def ours(self, case):
        with h5py.File(self.folder / "block.static.h5") as static:
            return static[f"cases/{case}/displacement"][()][self.order]

    def calculix(self, name, *titles, **step):
        """(rows of nodes, their values below each title); without ccx, of the bore's upper edge and every eighth other node."""
        def extract(folder):
            text = calculix.lines(folder)
            return {"row": np.arange(len(self.nodes)), **{title: rows_of(text, title) for title in titles}}

        def keep(found):
            rows = sorted({*self.upper_edge(), *range(0, len(self.nodes), 8)})
            return {title: values[rows] for title, values in found.items()}

        found = CALCULIX.of(name, self.model + STEPS.format(**step), extract, keep, digits=6)
        return found["row"], *(found[title] for title in titles)

    def upper_edge(self):
        """Rows of the nodes where the bore meets the top."""
        radius = np.hypot(*self.nodes[:, :2].T)
        return np.flatnonzero((abs(radius - BORE) < 1e-9) & (abs(self.nodes[:, 2] - HEIGHT) < 1e-9))

    def assert_same_orders(self, case, rows, theirs):
        """The orders of the shape at the top against those of CalculiX's nodes there."""
        at = self.upper_edge()
        angle = np.arctan2(self.nodes[at, 1], self.nodes[at, 0])
        self.assertEqual(len(at), 2 * AROUND)
        x, y = theirs[np.searchsorted(rows, at), :2].T
        radial = x * np.cos(angle) + y * np.sin(angle)
        expected = orders_at(angle, radial, 8)
        with h5py.File(self.folder / "bore.shape.h5") as shape:
            self.assertAlmostEqual(shape["height"][-1], HEIGHT, 12)
            self.assertTrue(shape["covered"][()].all())
            found = np.hypot(shape[f"cases/{case}/order_re"][-1], shape[f"cases/{case}/order_im"][-1])
        for m in (0, 2, 4):
            print(f"    {case}: order {m} ours {1e6 * found[m]:8.4f} um, CalculiX {1e6 * expected[m]:8.4f} um", file=sys.stderr)
            self.assertAlmostEqual(found[m], expected[m], delta=1e-3 * max(expected[2:5]), msg=f"order {m}")
        return found

    def test_temperatures_and_thermal_shape_are_those_of_calculix(self):
        films = "\n".join(f"{cell}, F{face}, {sink}, {h}" for face, (h, sink) in ((INSIDE, FILM_IN), (OUTSIDE, FILM_OUT))
                          for cell in self.faces[face])
        rows, theirs, displacement = self.calculix(
            "warm", "temperatures", "displacements", procedure="*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE", loads=f"*FILM\n{films}",
            more="*NODE PRINT, NSET=NALL\nNT\n")
        with h5py.File(self.folder / "block.fe.h5") as model:
            ours = model["heat/running/temperature"][()][self.order] - 273.15
            self.assertLess(model["heat/running"].attrs["balance"], 1e-10)
        ours, theirs = ours[rows], theirs[:, 0]
        self.assertGreater(np.ptp(theirs), 40.0)
        self.assertLess(np.abs(ours - theirs).max(), 1e-3 * np.ptp(theirs))
        error = np.abs(self.ours("warm")[rows] - displacement).max() / np.abs(displacement).max()
        print(f"    temperatures {theirs.min():.2f} to {theirs.max():.2f}, largest difference {np.abs(ours - theirs).max():.1e} K; "
              f"displacements differ by {error:.1e}", file=sys.stderr)
        # Measured 4e-4, which remains in a static step of CalculiX with these nodal temperatures: it interpolates temperatures
        # within a C3D20 in another way for the thermal strains.
        self.assertLess(error, 1e-3)
        found = self.assert_same_orders("warm", rows, displacement)
        self.assertGreater(found[0], 50e-6)
        self.assertGreater(found[2], 0.1e-6)

    def test_bolts_distort_the_bore_by_orders_2_and_4_as_in_calculix(self):
        pressed = "\n".join(f"{cell}, P{TOP}, {self.pressure:.9g}" for cell in self.faces[TOP])
        rows, displacement = self.calculix("assembly", "displacements", procedure="*STATIC",
                                           loads=f"*CLOAD\nBOLTS, 3, {PULL}\n*DLOAD\n{pressed}", more="")
        error = np.abs(self.ours("assembly")[rows] - displacement).max() / np.abs(displacement).max()
        print(f"    displacements differ by {error:.1e}", file=sys.stderr)
        self.assertLess(error, 1e-4)
        found = self.assert_same_orders("assembly", rows, displacement)
        self.assertGreater(found[4], 0.5e-6)
        self.assertGreater(found[2], 0.5e-6)

    def test_the_table_has_a_line_for_each_point(self):
        lines = (self.folder / "bore.csv").read_text().splitlines()
        self.assertEqual(lines[0], "height_m,angle_deg,covered,warm_um,assembly_um")
        self.assertEqual(len(lines), 1 + (2 * ALONG + 1) * 2 * AROUND)
        with h5py.File(self.folder / "bore.shape.h5") as shape:
            self.assertAlmostEqual(float(lines[2].split(",")[3]), 1e6 * shape["cases/warm/deviation"][0, 1], 3)

    def test_temperatures_go_to_the_results_and_to_paraview(self):
        with h5py.File(self.folder / "block.fe.h5") as model, h5py.File(self.folder / "block.static.h5") as static:
            rise = model["heat/running/temperature"][()] - 293.15
            self.assertLess(np.abs(static["cases/warm/temperature_rise"][()] - rise).max(), 1e-10)
            self.assertNotIn("temperature_rise", static["cases/assembly"])
        stages.run_all(self.folder, ["modal", "export", "block.static.h5", "block.vtu", "--cells", "block.fe.h5"])
        self.assertIn(b'Name="warm temperature rise"', (self.folder / "block.vtu").read_bytes())

    def test_a_table_of_these_temperatures_gives_the_same_displacements(self):
        with h5py.File(self.folder / "block.fe.h5") as model:
            points = np.column_stack([model["nodes"][()], model["heat/running/temperature"][()] - 273.15])
        np.savetxt(self.folder / "measured.csv", points, fmt="%.15g", delimiter=",", header="x,y,z,temperature_c", comments="")
        recipe = (self.folder / "block.fe.toml").read_text()
        (self.folder / "measured.fe.toml").write_text(recipe.replace('heat = "running"', 'table = "measured.csv"'))
        stages.run_all(
            self.folder, ["assembly", "block.mesh.h5", "-c", "measured.fe.toml", "-o", "measured.fe.h5", "--depfile", "measured.d"],
            ["modal", "statics", "measured.fe.h5", "--case", "warm", "-o", "measured.static.h5"])
        self.assertIn("measured.csv", (self.folder / "measured.d").read_text().splitlines()[0])
        with h5py.File(self.folder / "measured.static.h5") as static:
            theirs = static["cases/warm/displacement"][()][self.order]
        self.assertLess(np.abs(theirs - self.ours("warm")).max(), 1e-9 * np.abs(theirs).max())

    def test_wrong_options_of_the_shape_are_refused_in_one_line(self):
        axes = ["--axis-point", "0,0,0", "--axis", "0,0,1", "--zero-angle", "1,0,0"]
        bore = ["--surface", "BORE"]
        for arguments, says in ((["--surface", "BORR"], "--surface: found \"BORR\", expected one of: BORE"),
                                (bore, "found 0 contact grids on this surface"),
                                ([*bore, "--axis", "0,0"], "--axis-point: found \"\", expected 3 numbers"),
                                ([*bore, *axes[:-1], "0,0,2"], "--zero-angle: found 0,0,2 about the axis 0,0,1, expected"),
                                ([*bore, *axes, "--range", "1"], "--range: found \"1\", expected 2 numbers"),
                                ([*bore, *axes, "--angles", "2"], "--angles: found 2, expected 4 to 10000"),
                                ([*bore, *axes, "--case", "hot"], "--case: found \"hot\", expected one of: assembly, gasket")):
            with self.subTest(arguments=arguments):
                done = stages.run_stage("modal", "shape", "block.static.h5", *arguments, "-o", "x.shape.h5", folder=self.folder)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(says, done.stderr)
                self.assertFalse((self.folder / "x.shape.h5").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
