# SPDX-License-Identifier: GPL-3.0-or-later
"""A part of a deck goes out as a superelement and comes back beside the rest of the deck: numbers, units, frequencies."""
import json
import unittest

import calculix
import h5py
import numpy as np
import stages
from other_formats import Residual, bulk_entries, frequencies, read_dmig

STEEL = "MAT1,1,210000.,,.3,7.85-9\nPSOLID,1,1\n"
# Springs, one to the ground, and a mass on the spider's grid; grid 901 has no rotations.
REST = """GRID,901,,5.,5.,60.
CELAS2,81,2000.,900,1,901,1
CELAS2,82,3000.,900,2,901,2
CELAS2,83,40000.,900,3,901,3
CELAS2,84,90000.,900,5
CONM2,85,901,,2.-6
SPC1,1,456,901
"""


def bar(cells=4, first=101, depth=10.0):
    """Bulk data of hexahedra of 10 mm on top of each other, clamped below, with a spider to grid 900 on top."""
    text = [f"GRID,{first + 4 * level + corner},,{10.0 * x},{depth * y},{10.0 * level}"
            for level in range(cells + 1) for corner, (x, y) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1)))]
    for cell in range(cells):
        nodes = [first + 4 * cell + k for k in range(8)]
        text.append(f"CHEXA,{cell + 1},1,{','.join(map(str, nodes[:6]))}\n+,{nodes[6]},{nodes[7]}")
    top = [first + 4 * cells + k for k in range(4)]
    text += [f"SPC1,1,123,{first},THRU,{first + 3}", f"GRID,900,,5.,5.,{10.0 * cells + 5.0}",
             f"RBE2,60,900,123456,{','.join(map(str, top))}"]
    return "\n".join(text) + "\n" + STEEL


class Part(stages.PipelineTest):
    @staticmethod
    def commands():
        """Each test makes its own part."""
        return []

    def run_stage(self, stage, *arguments):
        done = stages.run_stage(stage, *arguments, "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def assemble(self, name, deck, units="mm-t-s"):
        """name.fe.h5 of the deck."""
        suffix = "inp" if deck.lstrip().startswith("*") else "bdf"
        (self.folder / f"{name}.{suffix}").write_text(deck)
        self.run_stage("mesh", f"{name}.{suffix}", "--units", units, "-o", f"{name}.mesh.h5",
                       "--recipe", f"{name}.fe.toml")
        self.run_stage("assembly", f"{name}.mesh.h5", "-c", f"{name}.fe.toml", "-o", f"{name}.fe.h5")

    def condense(self, deck, boundary, count=24, more="", skin=()):
        self.assemble("part", deck)
        (self.folder / "part.rom.toml").write_text(
            f'method = "craig-bampton"\nboundary = {json.dumps(boundary)}\ncount = {count}\n'
            f"skin = {json.dumps(list(skin))}\n{more}")
        self.run_stage("condense", "part.fe.h5", "-c", "part.rom.toml", "-o", "part.rom.h5")

    def modes(self):
        """Coordinates of the part that are no displacements, residual modes too."""
        with h5py.File(self.folder / "part.rom.h5") as rom:
            return len(rom["K_rr"]) - int(rom.attrs["n_boundary"])

    def export(self, *arguments):
        return self.run_stage("condense", "export", "part.rom.h5", *arguments)

    def entries(self, name="part.pch"):
        return bulk_entries((self.folder / name).read_text())


class NastranResidual(Part):
    def setUp(self):
        super().setUp()
        self.condense(bar() + "ASET1,123456,900\nENDDATA\n", ["point_900"])

    def of_the_complete_deck(self, count):
        self.assemble("whole", bar() + REST + "ENDDATA\n")
        self.run_stage("modal", "whole.fe.h5", "--count", count, "-o", "whole.modes.h5")
        with h5py.File(self.folder / "whole.modes.h5") as modes:
            return modes["frequency_hz"][:count]

    def test_the_rest_of_the_deck_with_the_superelement_has_the_frequencies_of_the_complete_deck(self):
        self.export("part.pch")
        grid = "GRID,900,,5.,5.,45.\n"
        found = Residual(grid + REST + (self.folder / "part.pch").read_text()).frequencies()
        # 24 fixed-interface modes of 48; ten digits in a field of DMIG.
        np.testing.assert_allclose(found[:8], self.of_the_complete_deck(8), rtol=2e-6)

    def test_the_superelement_has_its_own_scalar_points_and_leaves_the_grids_to_the_deck(self):
        self.export("part.pch")
        names = [entry[0] for entry in self.entries()]
        self.assertNotIn("GRID", names)
        spoints = [int(entry[1]) for entry in self.entries() if entry[0] == "SPOINT"]
        self.assertEqual(spoints, list(range(1001, 1001 + self.modes())))  # after 900
        matrices, kinds = read_dmig(self.entries())
        self.assertEqual(set(kinds.values()), {("6", "2")})
        nodes = {node for matrix in matrices.values() for pair in matrix for node, _ in pair}
        self.assertEqual(nodes, {900, *spoints})

    def test_numbers_and_units_can_be_chosen(self):
        self.export("part.pch", "--first-spoint", 5001, "--deck-nodes", "--units", "m-kg-s")
        grid = next(entry for entry in self.entries() if entry[0] == "GRID")
        self.assertEqual(grid[1], "900")
        np.testing.assert_allclose([float(x.replace("D", "E")) for x in grid[3:6]], [5e-3, 5e-3, 45e-3])
        spoints = [int(entry[1]) for entry in self.entries() if entry[0] == "SPOINT"]
        self.assertEqual(spoints, list(range(5001, 5001 + self.modes())))
        si, _ = read_dmig(self.entries())
        self.export("mm.pch", "--first-spoint", 5001)
        mm, _ = read_dmig(self.entries("mm.pch"))
        for key, value in ((((900, 1), (900, 1)), 1e-3), (((900, 4), (900, 4)), 1e3), (((900, 1), (900, 5)), 1.0)):
            pair = key if key in si["KCLATTR"] else key[::-1]
            self.assertAlmostEqual(mm["KCLATTR"][pair] / si["KCLATTR"][pair], value, delta=1e-8 * value)
        self.assertAlmostEqual(mm["MCLATTR"][(900, 1), (900, 1)] / si["MCLATTR"][(900, 1), (900, 1)], 1e-3, delta=1e-11)
        self.assertEqual(mm["MCLATTR"][(5001, 0), (5001, 0)], 1.0)  # unit modal masses in both

    def test_a_number_that_is_taken_is_refused_and_a_low_one_is_named(self):
        self.assert_refused("condense", ["export", "part.rom.h5", "--first-spoint", "890", "part.pch"],
                            says=["number 900", "point_900.x", "--first-spoint", "1001"])
        self.assert_refused("condense", ["export", "part.rom.h5", "--first-spoint", "-3", "part.pch"], says=["-3"])
        self.assert_refused("condense", ["export", "part.rom.h5", "--units", "inch", "part.pch"], says=["inch", "mm-t-s"])
        self.assert_refused("condense", ["export", "part.rom.h5", "--first-spoint", "99999990", "part.pch"],
                            says=["100000000", "99999999"])
        done = stages.run_stage("condense", "export", "part.rom.h5", "part.pch", "--first-spoint", 201, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("begin at 201, but the deck has numbers up to 900", done.stderr)
        self.assertIn("part.pch: units mm-t-s, 1 nodes have the numbers of the deck, others begin at 201", done.stderr)

    def test_the_external_superelement_joins_its_grids_to_those_of_the_same_number(self):
        self.export("part.asm", "--extid", 7)
        main = self.entries("part.asm")
        self.assertEqual(next(entry for entry in main if entry[0] == "SEBULK")[1:5], ["7", "EXTERNAL", "", "MANUAL"])
        connection = next(entry for entry in main if entry[0] == "SECONCT")
        self.assertEqual([field for field in connection[1:] if field], ["7", "0", "NO", "900", "900"])
        self.assertIn("INCLUDE 'part.super.pch'", (self.folder / "part.asm").read_text())
        self.assertNotIn("GRID", [entry[0] for entry in main])
        inner = self.entries("part.super.pch")
        self.assertEqual(inner[0][0], "BEGIN SUPER=7")
        self.assertEqual([entry[1] for entry in inner if entry[0] == "GRID"], ["900"])
        aset = {(int(node), c) for entry in inner if entry[0] == "ASET1" for node in entry[2:] if node
                for c in entry[1]}
        spoints = {int(entry[1]) for entry in inner if entry[0] == "SPOINT"}
        self.assertEqual(aset, {(900, c) for c in "123456"} | {(node, "0") for node in spoints})
        self.export("part.pch")
        beside, _ = read_dmig(self.entries())
        matrices, _ = read_dmig(inner)
        self.assertEqual(matrices["KAAX"], beside["KCLATTR"])
        self.assertEqual(matrices["MAAX"], beside["MCLATTR"])

    def test_nodes_of_solids_keep_their_numbers_too(self):
        self.condense(bar() + "ASET1,123,109,111\nENDDATA\n", ["retained"])
        self.export("part.mtx")
        lines = (self.folder / "part.dofs.tsv").read_text().splitlines()
        rows = [line.split("\t") for line in lines if not line.startswith("#")]
        self.assertEqual([(row[1], row[2]) for row in rows if row[3] == "displacement"],
                         [(node, c) for node in ("109", "111") for c in "123"])

    def test_numbers_of_grids_that_nothing_uses_are_not_given_again(self):
        self.condense(bar() + "GRID,5000,,0.,0.,0.\nASET1,123456,900\nENDDATA\n", ["point_900"], count=2)
        self.export("part.pch")
        self.assertEqual([entry[1] for entry in self.entries() if entry[0] == "SPOINT"], [str(10001 + k) for k in range(self.modes())])

    def test_numbers_of_scalar_points_are_not_given_again(self):
        self.condense(bar() + "SPOINT,20000\nCELAS4,9,5.,20000\nASET1,123456,900\nENDDATA\n", ["point_900"], count=2)
        self.export("part.pch")
        self.assertEqual([entry[1] for entry in self.entries() if entry[0] == "SPOINT"], [str(100001 + k) for k in range(self.modes())])

    SKEW = np.array([[2.0, -2.0, 1.0], [1.0, 2.0, 2.0], [-2.0, -1.0, 2.0]]) / 3.0  # columns: x, y, z
    CORD = "CORD2R,7,,0.,0.,0.,1.,2.,2.\n+,2.,1.,-2.\n"

    def of_grids(self, name, grids, matrix="KCLATTR"):
        """The matrix of the six components of grids, or of three."""
        entries = read_dmig(self.entries(name))[0][matrix]
        return np.array([[entries.get((a, b), entries.get((b, a), 0.0)) for b in grids] for a in grids])

    def test_components_of_a_grid_with_its_own_axes_are_along_these(self):
        plain = bar() + "ASET1,123456,900\nASET1,123,109\nENDDATA\n"
        turned = self.CORD + plain.replace("GRID,900,,5.,5.,45.0", "GRID,900,,5.,5.,45.0,7").replace(
            "GRID,109,,0.0,0.0,20.0", "GRID,109,,0.0,0.0,20.0,7")
        rows = [(900, c) for c in range(1, 7)] + [(109, c) for c in range(1, 4)]
        R = np.kron(np.eye(3), self.SKEW)
        self.condense(plain, ["retained"])
        self.export("plain.pch")
        self.condense(turned, ["retained"])
        self.export("turned.pch")
        for matrix in ("KCLATTR", "MCLATTR"):
            want = R.T @ self.of_grids("plain.pch", rows, matrix) @ R
            np.testing.assert_allclose(self.of_grids("turned.pch", rows, matrix), want, atol=1e-8 * abs(want).max())
        text = (self.folder / "turned.pch").read_text()
        self.assertIn("components are along the displacement axes of their grids (CD)", text)
        self.assertIn("$ GRID 900: keep the deck's, with its CD", text)
        self.export("own.pch", "--deck-nodes")
        grid = next(entry for entry in self.entries("own.pch") if entry[:2] == ["GRID", "900"])
        self.assertEqual(grid[6], "900")  # CD: the system beside it
        system = next(entry for entry in self.entries("own.pch") if entry[:2] == ["CORD2R", "900"])
        axes = [float(x.replace("D", "E")) for x in system[6:12]]
        np.testing.assert_allclose(axes, [*self.SKEW[:, 2], *self.SKEW[:, 0]], atol=1e-10)

    def test_single_components_of_such_a_grid_are_retained_and_no_others(self):
        # x and y of the system are y and -x of the basic one.
        cord = "CORD2R,7,,0.,0.,0.,0.,0.,1.\n+,0.,1.,0.\n"
        self.condense(bar() + "ASET1,2,109\nASET1,13,111\nENDDATA\n", ["retained"])
        self.export("plain.pch")
        deck = cord + bar().replace("GRID,109,,0.0,0.0,20.0", "GRID,109,,0.0,0.0,20.0,7").replace(
            "GRID,111,,10.0,10.0,20.0", "GRID,111,,10.0,10.0,20.0,7")
        self.condense(deck + "ASET1,1,109\nASET1,23,111\nENDDATA\n", ["retained"])
        self.export("turned.pch")
        want = self.of_grids("plain.pch", [(109, 2), (111, 1), (111, 3)])
        S = np.diag([1.0, -1.0, 1.0])
        np.testing.assert_allclose(self.of_grids("turned.pch", [(109, 1), (111, 2), (111, 3)]), S @ want @ S,
                                   atol=1e-8 * abs(want).max())

    def test_axes_of_their_own_are_said_when_the_deck_is_read(self):
        (self.folder / "turned.bdf").write_text(
            self.CORD + bar().replace("GRID,111,,10.0,10.0,20.0", "GRID,111,,10.0,10.0,20.0,7") + "ASET1,123,111\nENDDATA\n")
        done = stages.run_stage("mesh", "turned.bdf", "--units", "mm-t-s", "-o", "turned.mesh.h5", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("retained along the axes of system cord_7, the deck's own", done.stderr)

    def test_a_part_without_a_deck_is_numbered_from_one_in_si(self):
        with h5py.File(self.folder / "part.rom.h5", "r+") as rom:
            for name in ("deck_units", "deck_largest_node", "deck_largest_element"):
                del rom.attrs[name]
        self.export("part.pch", "--first-grid", 41)
        self.assertEqual([entry[1] for entry in self.entries() if entry[0] == "GRID"], ["41"])
        self.assertIn("SI: m, kg, s, N", (self.folder / "part.pch").read_text())


class Bricks:
    """C3D20 of 10 x 10 x 10 mm on top of each other, with the numbers that a complete deck has."""

    CORNERS = ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2))
    EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))

    def __init__(self, cells):
        self.node, self.cells = {}, []
        for cell in cells:
            corners = [np.add(c, (0, 0, 2 * cell)) for c in self.CORNERS]
            points = corners + [(corners[a] + corners[b]) // 2 for a, b in self.EDGES]
            self.cells.append((cell + 1, [self.number(tuple(int(x) for x in p)) for p in points]))

    def number(self, point):
        x, y, z = point
        number = 1 + x + 3 * y + 9 * z
        self.node[number] = (5.0 * x, 5.0 * y, 5.0 * z)
        return number

    def level(self, z):
        return sorted(node for node, position in self.node.items() if position[2] == z)

    def text(self):
        lines = ["*NODE"] + [f"{node},{x},{y},{z}" for node, (x, y, z) in sorted(self.node.items())]
        lines.append("*ELEMENT,TYPE=C3D20,ELSET=BAR")
        for number, nodes in self.cells:
            lines += [f"{number},{','.join(map(str, nodes[:10]))},", ",".join(map(str, nodes[10:]))]
        lines += ["*MATERIAL,NAME=STEEL", "*ELASTIC", "210000.,.3", "*DENSITY", "7.85E-9",
                  "*SOLID SECTION,ELSET=BAR,MATERIAL=STEEL"]
        return "\n".join(lines) + "\n"

    @staticmethod
    def held(nodes):
        return "*BOUNDARY\n" + "".join(f"{node},1,3\n" for node in nodes)


@calculix.required("the rest of the deck includes a superelement, whose last digits depend on the host")
class CalculixResidual(Part):
    def calculix_hz(self, name, deck, count):
        calculix.run(deck + f"*STEP\n*FREQUENCY\n{count}\n*END STEP\n", self.folder, name)
        rows = [line.split() for line in (self.folder / f"{name}.dat").read_text().splitlines()]
        return np.array([float(row[3]) for row in rows if len(row) == 5 and row[0].isdigit()])[:count]

    def retain(self, bricks, nodes, more=""):
        retained = "".join(f"{node},1,3\n" for node in nodes)
        self.condense(bricks.text() + more + Bricks.held(bricks.level(0.0)) +
                      f"*STEP\n*SUBSTRUCTURE GENERATE\n*RETAINED NODAL DOFS,SORTED=NO\n{retained}*END STEP\n",
                      ["retained"], count=30)

    def test_calculix_finds_the_frequencies_of_the_complete_deck_with_the_superelement_in_the_rest(self):
        whole, lower, upper = Bricks(range(6)), Bricks(range(4)), Bricks(range(4, 6))
        expected = self.calculix_hz("whole", whole.text() + Bricks.held(whole.level(0.0)), 6)
        self.retain(lower, lower.level(40.0))
        self.export("super.inp")
        found = self.calculix_hz("rest", upper.text() + "*INCLUDE,INPUT=super.inp\n", 6)
        # 30 fixed-interface modes: the certificate's error at the sixth frequency; seven digits are printed.
        np.testing.assert_allclose(found, expected, rtol=1e-5)

    def test_nodes_with_transform_are_joined_along_their_axes(self):
        whole, lower, upper = Bricks(range(6)), Bricks(range(4)), Bricks(range(4, 6))
        expected = self.calculix_hz("whole", whole.text() + Bricks.held(whole.level(0.0)), 6)
        nodes = lower.level(40.0)
        turned = "*NSET,NSET=TURNED\n" + "".join(f"{node},\n" for node in nodes)
        self.retain(lower, nodes, turned + "*TRANSFORM,NSET=TURNED,TYPE=R\n2.,1.,-2.,-2.,2.,-1.\n")
        with h5py.File(self.folder / "part.rom.h5") as rom:
            directions = rom["sets/retained/direction"][()]
        np.testing.assert_allclose(directions[0], [2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0], atol=1e-14)
        self.export("super.inp")
        found = self.calculix_hz("rest", upper.text() + "*INCLUDE,INPUT=super.inp\n", 6)
        np.testing.assert_allclose(found, expected, rtol=1e-5)

    def test_the_node_of_the_rotations_is_the_rot_node_of_a_rigid_body_in_the_rest(self):
        """Two bars whose faces follow grid 900; the lower one is condensed to it."""
        lower, upper = Bricks(range(4)), Bricks(range(5, 7))
        centre = "*NODE\n900,5.,5.,45.\n"

        def rigid(name, nodes, rotations=""):
            return (f"*NSET,NSET={name}\n" + "".join(f"{node},\n" for node in nodes) +
                    f"*RIGID BODY,NSET={name},REF NODE=900{rotations}\n")

        whole = Bricks([*range(4), *range(5, 7)])
        expected = self.calculix_hz("whole", whole.text() + centre + "901,5.,5.,45.\n" + Bricks.held(lower.level(0.0)) +
                                    rigid("LOW", lower.level(40.0), ",ROT NODE=901") +
                                    rigid("UP", upper.level(50.0), ",ROT NODE=901"), 6)
        self.condense(lower.text() + centre + Bricks.held(lower.level(0.0)) + rigid("LOW", lower.level(40.0)) +
                      "*STEP\n*FREQUENCY\n6\n*END STEP\n", ["point_900"], count=30)
        self.export("super.inp")
        head = (self.folder / "super.inp").read_text().splitlines()
        rows = [line.split()[2:4] for line in head if "rotation of" in line]
        self.assertEqual([component for _, component in rows], ["1", "2", "3"])
        found = self.calculix_hz("rest", upper.text() + "*INCLUDE,INPUT=super.inp\n" +
                                 rigid("UP", upper.level(50.0), f",ROT NODE={rows[0][0]}"), 6)
        np.testing.assert_allclose(found, expected, rtol=1e-5)

    def test_new_nodes_and_elements_come_after_those_of_the_deck_or_where_they_are_told(self):
        lower = Bricks(range(4))
        self.retain(lower, lower.level(40.0))
        self.export("super.inp")

        def numbers(name, keyword):
            blocks = (self.folder / name).read_text().split("*")
            return [int(line.split(",")[0]) for block in blocks if block.startswith(keyword)
                    for line in block.splitlines()[1:]]

        self.assertEqual(sorted(set(numbers("super.inp", "NODE,NSET=CLATTER_BOUNDARY"))), lower.level(40.0))
        self.assertEqual(max(lower.node), 81)
        self.assertEqual(min(numbers("super.inp", "NODE,NSET=CLATTER_MODES")), 101 + self.modes())
        self.assertEqual(min(numbers("super.inp", "ELEMENT")), 11)  # the deck has 4
        self.export("other.inp", "--first-spoint", 70001, "--first-element", 80001)
        self.assertEqual(min(numbers("other.inp", "NODE,NSET=CLATTER_MODES")), 70001 + self.modes())
        self.assertEqual(min(numbers("other.inp", "ELEMENT")), 80001)


if __name__ == "__main__":
    unittest.main()
