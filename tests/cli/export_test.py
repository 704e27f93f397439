# SPDX-License-Identifier: GPL-3.0-or-later
"""Reduced parts written for other programs, and matrices of others read."""
import json
import unittest

import calculix
import h5py
import numpy as np
import scipy.io
import scipy.sparse as sp
import stages
from other_formats import frequencies, read_bulk


REDUCED = "this deck has matrices reduced from gmsh's mesh, so no result is stored"


def reduced_matrices(path):
    """K_rr, M_rr of a reduced part."""
    with h5py.File(path) as rom:
        return rom["K_rr"][()], rom["M_rr"][()]


class Exported(stages.PipelineTest):
    def run_stage(self, stage, *arguments):
        done = stages.run_stage(stage, *arguments, "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def export(self, name):
        """The files that the export of the beam's reduced part to `name` wrote."""
        return json.loads(self.run_stage("condense", "export", "beam.rom.h5", name, "--json"))["files"]

    def release(self):
        """The beam without its support, with enough modes for CalculiX to find ten."""
        self.edit("beam.fe.toml", '[[support]]\nsurface = "x_min"\n', "")
        self.edit("beam.rom.toml", "fmax_hz = 4000.0", "count = 45")
        self.edit("beam.rom.toml", '["tip", "sensor_tip"]', '["tip", "sensor_tip"]\nfrequency_error = 0.0')
        self.run_stage("assembly", "beam.mesh.h5", "-c", "beam.fe.toml", "-o", "beam.fe.h5")
        self.run_stage("condense", "beam.fe.h5", "-c", "beam.rom.toml", "-o", "beam.rom.h5")


class MatrixMarket(Exported):
    def test_scipy_reads_the_same_bits(self):
        self.assertEqual(self.export("part.mtx"), ["part.K.mtx", "part.M.mtx", "part.dofs.tsv"])
        for name, matrix in zip("KM", reduced_matrices(self.folder / "beam.rom.h5")):
            read = scipy.io.mmread(self.folder / f"part.{name}.mtx").toarray()
            np.testing.assert_array_equal(read, matrix)

    def test_the_map_names_every_row(self):
        self.export("part.mtx")
        rows = [line.split("\t") for line in (self.folder / "part.dofs.tsv").read_text().splitlines()
                if not line.startswith("#")]
        with h5py.File(self.folder / "beam.rom.h5") as rom:
            n_b, size = rom.attrs["n_boundary"], rom["K_rr"].shape[0]
            self.assertEqual([int(row[0]) for row in rows], list(range(1, size + 1)))
            self.assertEqual([row[3] for row in rows[n_b:]], ["modal"] * (size - n_b))
            for name, dofs in rom["sets"].items():
                for k, j in enumerate(dofs["dofs"][()]):
                    row = rows[j]
                    self.assertEqual(row[10:], [name, dofs["labels"].asstr()[k]])
                    np.testing.assert_array_equal([float(x) for x in row[4:7]], dofs["position"][k])
                    np.testing.assert_array_equal([float(x) for x in row[7:10]], dofs["direction"][k])

    def test_what_was_exported_can_be_taken_in_again(self):
        self.export("part.mtx")
        (self.folder / "back.fe.toml").write_text(
            '[matrices]\nK = "part.K.mtx"\nM = "part.M.mtx"\ndofs = "part.dofs.tsv"\nname = "back"\n')
        self.run_stage("assembly", "-c", "back.fe.toml", "-o", "back.fe.h5")
        with h5py.File(self.folder / "back.fe.h5") as back, h5py.File(self.folder / "beam.rom.h5") as rom:
            for name in "KM":
                g = back[name]
                lower = sp.csc_matrix((g["data"][()], g["indices"][()], g["indptr"][()]), shape=g.attrs["shape"])
                np.testing.assert_array_equal(lower.toarray(), np.tril(rom[f"{name}_rr"][()]))
            self.assertEqual(set(back["sets"]), set(rom["sets"]))
            # The same rigid motions, from the positions and directions of the map.
            np.testing.assert_allclose(back["rigid"][()], rom["rigid"][()], atol=1e-12)
        self.run_stage("modal", "back.fe.h5", "--count", 12, "-o", "back.modes.h5")
        self.run_stage("modal", "beam.rom.h5", "--count", 12, "-o", "rom.modes.h5")
        with h5py.File(self.folder / "back.modes.h5") as back, h5py.File(self.folder / "rom.modes.h5") as rom:
            self.assertEqual(back.attrs["rigid_modes"], rom.attrs["rigid_modes"])
            elastic = slice(int(rom.attrs["rigid_modes"]), None)
            # The same matrices, two eigen-solvers: their residuals are 1e-9 at most.
            np.testing.assert_allclose(back["frequency_hz"][elastic], rom["frequency_hz"][elastic], rtol=1e-8)

    def test_a_model_taken_in_can_be_condensed(self):
        self.export("part.mtx")
        (self.folder / "back.fe.toml").write_text(
            '[matrices]\nK = "part.K.mtx"\nM = "part.M.mtx"\ndofs = "part.dofs.tsv"\n')
        self.run_stage("assembly", "-c", "back.fe.toml", "-o", "back.fe.h5")
        text = (self.folder / "beam.rom.toml").read_text()
        (self.folder / "back.rom.toml").write_text(
            "\n".join(line for line in text.splitlines() if line.startswith("boundary")) + "\ncount = 6\nskin = []\n")
        self.run_stage("condense", "back.fe.h5", "-c", "back.rom.toml", "-o", "back.rom.h5")
        ours = frequencies(*reduced_matrices(self.folder / "back.rom.h5"))
        full = frequencies(*reduced_matrices(self.folder / "beam.rom.h5"))
        # Far below the cut-off, where the target of the certificate is 5e-4; a reduction can only raise frequencies.
        np.testing.assert_allclose(ours[:4], full[:4], rtol=5e-4)
        # Rounding of matrices whose highest frequency is so far above: eps (f_max / f)^2.
        rounding = 1e-15 * (full.max() / full[:len(ours)]) ** 2
        self.assertTrue(np.all(ours >= full[:len(ours)] * (1.0 - 1e-10 - rounding)), (ours / full[:len(ours)] - 1.0, rounding))


class Calculix(Exported):
    """CalculiX 2.20 does not support *MATRIX ASSEMBLE; the deck is equivalent, with springs, masses and equations."""

    def setUp(self):
        super().setUp()
        self.assertEqual(self.export("part.inp"), ["part.inp", "part.K.txt", "part.M.txt"])

    def calculix_hz(self, cards="", count=4):
        """The lowest frequencies by CalculiX [Hz]; with the beam's 23 coordinates it finds at most four."""
        calculix.run(f"*INCLUDE,INPUT=part.inp\n{cards}*STEP\n*FREQUENCY\n{count}\n*END STEP\n", self.folder)
        return calculix.frequencies(calculix.lines(self.folder))[:count]

    def nodes_and_components(self):
        """(node, component) of each row as the head of the deck lists them."""
        head = [line.split() for line in (self.folder / "part.inp").read_text().splitlines() if line.startswith("** ")]
        return [(int(row[2]), int(row[3])) for row in head if len(row) > 3 and all(w.isdigit() for w in row[1:4])]

    @calculix.required(REDUCED)
    def test_calculix_finds_our_frequencies(self):
        ours = frequencies(*reduced_matrices(self.folder / "beam.rom.h5"))
        np.testing.assert_allclose(self.calculix_hz(), ours[:4], rtol=1e-6)  # seven digits are printed

    @calculix.required(REDUCED)
    def test_calculix_finds_a_fifth_as_many_as_there_are_coordinates_and_zeros_beyond(self):
        most = len(self.nodes_and_components()) // 5
        self.assertIn(f"*FREQUENCY gives at most {most} modes", (self.folder / "part.inp").read_text())
        self.assertTrue(np.all(np.array(self.calculix_hz(count=most)) > 0.0))
        np.testing.assert_array_equal(self.calculix_hz(count=most + 1), 0.0)

    @calculix.required(REDUCED)
    def test_a_free_body_has_its_rigid_motions_at_a_thousandth_of_a_hertz(self):
        self.release()
        self.export("part.inp")
        ours = frequencies(*reduced_matrices(self.folder / "beam.rom.h5"))
        found = self.calculix_hz(count=10)
        np.testing.assert_allclose(found[:6], 1e-3, rtol=1e-6)
        np.testing.assert_allclose(found[6:], ours[6:10], rtol=1e-6)

    @calculix.required(REDUCED)
    def test_what_is_joined_to_the_part_in_calculix_acts_on_our_coordinate(self):
        K, M = reduced_matrices(self.folder / "beam.rom.h5")
        row = next(j for j, (_, component) in enumerate(self.nodes_and_components()) if component == 3)  # a displacement along z
        node, component = self.nodes_and_components()[row]
        K[row, row] += 2.0e6
        spring = f"*ELEMENT,TYPE=SPRING1,ELSET=EXTRA\n99999,{node}\n*SPRING,ELSET=EXTRA\n{component}\n2.e6\n"
        ours = frequencies(K, M)
        self.assertGreater(abs(ours[0] / frequencies(*reduced_matrices(self.folder / "beam.rom.h5"))[0] - 1.0), 0.01)
        np.testing.assert_allclose(self.calculix_hz(spring), ours[:4], rtol=1e-6)

    def test_the_matrix_lists_hold_the_same_bits(self):
        row_of = {key: j for j, key in enumerate(self.nodes_and_components())}
        for name, matrix in zip("KM", reduced_matrices(self.folder / "beam.rom.h5")):
            read = np.zeros_like(matrix)
            for line in (self.folder / f"part.{name}.txt").read_text().splitlines():
                a, d, b, e, value = line.split(",")
                i, j = row_of[int(a), int(d)], row_of[int(b), int(e)]
                read[i, j] = read[j, i] = float(value)
            np.testing.assert_array_equal(read, matrix)


class NastranDmig(Exported):
    def setUp(self):
        super().setUp()
        self.assertEqual(self.export("part.pch"), ["part.pch"])
        self.text = (self.folder / "part.pch").read_text()
        self.export("part.mtx")
        lines = (self.folder / "part.dofs.tsv").read_text().splitlines()
        self.map = [line.split("\t") for line in lines if not line.startswith("#")]

    def test_both_matrices_read_back_to_ten_digits(self):
        matrices, _, _ = read_bulk(self.text)
        row_of = {(int(row[1]), int(row[2])): j for j, row in enumerate(self.map)}
        for name, matrix in zip(("KCLATTR", "MCLATTR"), reduced_matrices(self.folder / "beam.rom.h5")):
            read = np.zeros_like(matrix)
            for (column, row), value in matrices[name].items():
                i, j = row_of[row], row_of[column]
                self.assertEqual(read[i, j], 0.0, "one triangle, each entry once")
                read[i, j] = read[j, i] = value
            np.testing.assert_allclose(read, matrix, rtol=5e-10, atol=1e-99)  # ten digits with a sign

    def test_every_coordinate_is_a_component_of_a_grid_or_a_scalar_point(self):
        _, grids, spoints = read_bulk(self.text)
        self.assertEqual(spoints, [int(row[1]) for row in self.map if row[2] == "0"])
        moved = {}
        for row in self.map:
            if row[2] != "0":
                moved.setdefault(int(row[1]), set()).add(row[2])
                position, constrained = grids[int(row[1])]
                np.testing.assert_allclose(position, [float(x) for x in row[4:7]], rtol=5e-10)
        self.assertEqual(moved.keys(), grids.keys())
        for node, components in moved.items():
            self.assertEqual(set("123456") - components, set(grids[node][1]))

    def test_no_line_is_longer_than_bulk_data_may_be(self):
        self.assertLessEqual(max(map(len, self.text.splitlines())), 80)


def read_fem(text):
    """MBDyn's records: {group: list of numbers}; group 1 without its revision."""
    groups, group = {}, None
    for line in text.splitlines():
        if line.startswith("** RECORD GROUP"):
            group = int(line.split()[3].rstrip(","))
            groups[group] = []
        elif not line.startswith("**"):
            groups[group] += [float(word) for word in line.split() if word != "REV0"]
    return groups


class Mbdyn(Exported):
    def records(self):
        self.assertEqual(self.export("part.fem"), ["part.fem"])
        groups = read_fem((self.folder / "part.fem").read_text())
        nodes, modes = int(groups[1][0]), int(groups[1][1])
        counts = {1: 5, 2: nodes, 3: modes, 4: modes, 5: nodes, 6: nodes, 7: nodes, 8: 6 * nodes * modes,
                  9: modes ** 2, 10: modes ** 2, 12: 13, 13: modes ** 2}
        self.assertEqual({group: len(numbers) for group, numbers in groups.items()}, counts)
        return groups, nodes, modes

    def test_the_modes_are_those_of_the_reduced_part(self):
        groups, _, modes = self.records()
        K, M = reduced_matrices(self.folder / "beam.rom.h5")
        self.assertEqual(modes, len(K))  # the beam is held
        stiffness, mass, damping = (np.reshape(groups[g], (modes, modes)) for g in (10, 9, 13))
        np.testing.assert_array_equal(mass, np.eye(modes))
        # Two dense solvers: eps lambda_max of the lowest eigenvalue, 1e-16 * (2e5 Hz / 70 Hz)^2 = 1e-9.
        np.testing.assert_allclose(frequencies(stiffness, mass), frequencies(K, M), rtol=1e-7)
        with h5py.File(self.folder / "beam.rom.h5") as rom:
            alpha, beta = rom.attrs["alpha"], rom.attrs["beta"]
            np.testing.assert_allclose(damping, alpha * stiffness + beta * mass, rtol=1e-14)
            found = [groups[12][0], groups[12][1:4], np.reshape(groups[12][4:], (3, 3))]
            for value, expected in zip(found, (rom["mass"].attrs["mass"], rom["mass/centre"], rom["mass/inertia"])):
                np.testing.assert_array_equal(value, expected)

    def test_the_rigid_motions_of_a_free_body_are_left_to_the_joint(self):
        self.release()
        groups, _, modes = self.records()
        ours = frequencies(*reduced_matrices(self.folder / "beam.rom.h5"))
        self.assertEqual(modes, len(ours) - 6)
        found = np.sqrt(np.diag(np.reshape(groups[10], (modes, modes)))) / (2.0 * np.pi)
        np.testing.assert_allclose(found, ours[6:], rtol=1e-7)

    def test_shapes_and_frequencies_together_give_flexibility_and_inverse_mass_at_the_boundary(self):
        groups, nodes, modes = self.records()
        shapes = np.reshape(groups[8], (modes, 6 * nodes))  # tip: x y z rx ry rz; sensor: x y z, no rotations
        np.testing.assert_array_equal(shapes[:, 9:], 0.0)
        Phi, eigenvalue = shapes[:, :9].T, np.diag(np.reshape(groups[10], (modes, modes)))
        for matrix, found in zip(reduced_matrices(self.folder / "beam.rom.h5"),
                                 (Phi / eigenvalue @ Phi.T, Phi @ Phi.T)):
            expected = np.linalg.inv(matrix)[:9, :9]
            scale = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
            np.testing.assert_allclose(found / scale, expected / scale, atol=1e-7)  # as the frequencies above


class MatricesOfOthers(Exported):
    def assembly(self, says, toml, mesh=()):
        (self.folder / "other.fe.toml").write_text("[matrices]\n" + toml)
        self.assert_refused("assembly", [*mesh, "-c", "other.fe.toml", "-o", "other.fe.h5"], says=says)

    def test_what_does_not_fit_together_is_refused(self):
        self.export("part.mtx")
        files = 'K = "part.K.mtx"\nM = "part.M.mtx"\n'
        self.assembly(["needs a mesh or dofs, which name the rows"], files)
        self.assembly(["a mesh and dofs exclude each other: both name the rows"], files + 'dofs = "part.dofs.tsv"\n',
                      ["beam.mesh.h5"])
        self.assembly(["part.K.mtx", "as in the mesh"], files, ["beam.mesh.h5"])
        self.assembly(["absent.tsv", "no such file"], files + 'dofs = "absent.tsv"\n')
        self.assembly(["unit", "units"], files + 'dofs = "part.dofs.tsv"\nunit = "mm-t-s"\n')
        self.assembly(["mm-kN-s", "mm-t-s"], files + 'dofs = "part.dofs.tsv"\nunits = "mm-kN-s"\n')
        self.assembly(["dofs.tsv"], 'K = "part.dofs.tsv"\nM = "part.M.mtx"\ndofs = "part.dofs.tsv"\n')
        (self.folder / "none.mtx").write_text("%%MatrixMarket matrix coordinate real symmetric\n1 1 1\n1 1 -2.0\n")
        (self.folder / "one.tsv").write_text("1\t1\t1\tdisplacement\t0\t0\t0\t1\t0\t0\ts\ts.x\n")
        self.assembly(["none.mtx", "row 1", "-2", "not negative"], 'K = "none.mtx"\nM = "none.mtx"\ndofs = "one.tsv"\n')

    def test_matrices_with_held_diagonals_have_the_frequencies_of_the_supported_part(self):
        """As Abaqus writes them: N, mm and t, "row column value" of both triangles, 1e36 where a DoF is held."""
        support = '[[support]]\nsurface = "x_min"\n'
        material = (self.folder / "beam.fe.toml").read_text().split("[damping]")[0]
        for name, text in (("free", material), ("held", material + support)):
            (self.folder / f"{name}.fe.toml").write_text(text)
            self.run_stage("assembly", "beam.mesh.h5", "-c", f"{name}.fe.toml", "-o", f"{name}.fe.h5")
        with h5py.File(self.folder / "beam.mesh.h5") as mesh:
            nodes = np.unique(np.concatenate([faces[()].ravel() for faces in mesh["surfaces/x_min"].values()]))
        held = (3 * nodes[:, None] + np.arange(3)).ravel()
        with h5py.File(self.folder / "free.fe.h5") as fe:
            for name in "KM":
                g = fe[name]
                lower = sp.csc_matrix((g["data"][()], g["indices"][()], g["indptr"][()]), shape=g.attrs["shape"])
                both = 1e-3 * (lower + sp.tril(lower, -1).T)  # N/m in N/mm, kg in t
                if name == "K":
                    both = both + sp.csc_matrix((np.full(len(held), 1e36), (held, held)), shape=both.shape)
                both = both.tocoo()
                np.savetxt(self.folder / f"{name}.mtx", np.column_stack((both.row + 1, both.col + 1, both.data)),
                           fmt="%d %d %.17g")
        (self.folder / "other.fe.toml").write_text('[matrices]\nK = "K.mtx"\nM = "M.mtx"\nunits = "mm-t-s"\n')
        self.run_stage("assembly", "beam.mesh.h5", "-c", "other.fe.toml", "-o", "other.fe.h5")
        with h5py.File(self.folder / "other.fe.h5") as fe:
            self.assertEqual(fe["certificate"].attrs["held_dofs"], len(held))
            self.assertAlmostEqual(fe["mass"].attrs["mass"], 7850.0 * 0.6 * 0.04 * 0.03, delta=1e-9)
        frequencies = {}
        for name in ("held", "other"):
            self.run_stage("modal", f"{name}.fe.h5", "--count", 10, "-o", f"{name}.modes.h5")
            with h5py.File(self.folder / f"{name}.modes.h5") as modes:
                frequencies[name] = modes["frequency_hz"][()]
        # The same matrices but for the rounding of the units: residuals are 1e-9 at most.
        np.testing.assert_allclose(frequencies["other"], frequencies["held"], rtol=1e-8)

    def test_a_wrong_export_is_refused(self):
        self.assert_refused("condense", ["export", "beam.rom.h5", "part.docx"], says=["part.docx", ".mtx"])
        self.assert_refused("condense", ["export", "beam.fe.h5", "part.mtx"], says=["beam.fe.h5", "schema"])
        self.assert_refused("condense", ["export", "beam.rom.h5"], says=["output is required", "clatter-condense export --help"])
        self.assert_refused("condense", ["beam.fe.h5", "-c", "beam.rom.toml"], says=["--output is required"])


class MakeRules(Exported):
    """`make part.mtx` by clatter.mk; no export is made twice."""

    KINDS = ("mtx", "inp", "pch", "op4", "flexascii", "fem")

    def make(self, *names):
        (self.folder / "Makefile").write_text(f"include {stages.SOURCE}/tools/clatter.mk\n")
        return stages.make(self.folder, *names)

    def test_make_writes_what_the_option_writes(self):
        exports = [f"beam.{kind}" for kind in self.KINDS]
        self.make(*exports)
        written = {name: (self.folder / name).read_bytes() for name in
                   ["beam.K.mtx", "beam.M.mtx", "beam.dofs.tsv", *exports[1:], "beam.K.txt", "beam.M.txt"]}
        self.assertEqual(set((self.folder / "beam.mtx").read_text().split()),
                         {"beam.K.mtx", "beam.M.mtx", "beam.dofs.tsv"})
        for name in exports:
            self.export(name)
        for name, content in written.items():
            self.assertEqual((self.folder / name).read_bytes(), content, name)

    def test_an_export_is_redone_after_the_part_and_not_otherwise(self):
        self.make("beam.mtx")
        self.assertIn("up to date", self.make("beam.mtx"))
        self.edit("beam.rom.toml", "4000.0", "3000.0")
        self.assertIn("export 'beam.rom.h5' 'beam.mtx'", self.make("beam.mtx"))


if __name__ == "__main__":
    unittest.main()
