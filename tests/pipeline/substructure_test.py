# SPDX-License-Identifier: GPL-3.0-or-later
"""Guyan's matrix of CalculiX's own deck `substructure`: a cantilever of C3D20R of which 20 nodes are retained.

The installed CalculiX 2.20 does not condense: its *SUBSTRUCTURE GENERATE prints K_bb for this deck, the stiffness
of the retained nodes with all others held (and the package's reference file is empty). So the condensed matrix
is compared with its definition in the manual: the reactions to unit displacements, from 60 static steps; and with
CalculiX's K, read by [matrices] and condensed by clatter.
"""
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import calculix  # noqa: E402
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import scipy.sparse as sp  # noqa: E402
import stages  # noqa: E402

CALCULIX = calculix.Results(__file__)
DECK = "\n".join(calculix.package("substructure", ".inp"))
NEWTON_PER_MILLIMETRE = 1e3  # CalculiX's K is in N/mm, clatter's in N/m
ROM = 'method = "guyan"\nboundary = ["retained"]\nskin = []\n'


def symmetric(group):
    """The full matrix of a sparse group that contains the lower triangle."""
    lower = sp.csc_matrix((group["data"][()], group["indices"][()], group["indptr"][()]), shape=group.attrs["shape"])
    lower = lower.toarray()
    return lower + np.tril(lower, -1).T


def numbers(lines):
    return [[float(word) for word in line.split(",") if word.strip()] for line in lines]


def some_columns(found):
    """What is stored of a 60 x 60 matrix: every seventh column, directions x, y, z in turn."""
    return {"K": found["K"][:, ::7]}


def columns_of(found):
    """The matrix, and its columns in the full one."""
    return found["K"], slice(None) if found["K"].shape[1] == 60 else slice(None, None, 7)


def printed_matrix(folder):
    """The matrix that *SUBSTRUCTURE GENERATE writes: the lower triangle row by row."""
    body = (folder / "substructure.mtx").read_text().split("*MATRIX,TYPE=STIFFNESS")[1]
    lower = np.zeros((60, 60))
    lower[np.tril_indices(60)] = [value for row in numbers(body.splitlines()) for value in row]
    return {"K": lower + np.tril(lower, -1).T}


@unittest.skipUnless(DECK, "package calculix-ccx-test is not installed")
class Substructure(stages.PipelineTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        # A mass, which *SUBSTRUCTURE does not need: clatter does not condense without one.
        cls.text = DECK.replace("*SOLID SECTION", "*DENSITY\n7.8E-9\n*SOLID SECTION")
        cls.model = cls.text[:cls.text.index("*STEP")]
        block = re.search(r"\*NODE\n(.*?)\n\*", cls.model, re.S).group(1)
        cls.position = {int(row[0]): np.array(row[1:]) for row in numbers(block.splitlines())}
        block = re.search(r"NSET=N1\n(.*)", cls.model, re.S).group(1)
        cls.retained = [int(node) for row in numbers(block.splitlines()) for node in row]

    def stage(self, name, *arguments):
        done = stages.run_stage(name, *arguments, "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)

    def assemble(self):
        (self.folder / "sub.inp").write_text(self.text)
        self.stage("mesh", "sub.inp", "--units", "mm-t-s", "-o", "sub.mesh.h5", "--recipe", "sub.fe.toml")
        self.stage("assembly", "sub.mesh.h5", "-c", "sub.fe.toml", "-o", "sub.fe.h5")

    def guyan(self, name):
        """K_rr [N/mm] on x y z of the retained nodes in the deck's order."""
        (self.folder / "sub.rom.toml").write_text(ROM)
        self.stage("condense", f"{name}.fe.h5", "-c", "sub.rom.toml", "-o", f"{name}.rom.h5")
        with h5py.File(self.folder / f"{name}.rom.h5") as rom:
            order = self.in_deck_order(rom["sets/retained"])
            return rom["K_rr"][()][np.ix_(order, order)] / NEWTON_PER_MILLIMETRE

    def in_deck_order(self, dofs):
        position, direction = dofs["position"][()] * 1e3, dofs["direction"][()]
        order = []
        for node in self.retained:
            near = np.linalg.norm(position - self.position[node], axis=1) < 1e-9
            order += [int(np.flatnonzero(near & (direction[:, axis] == 1.0))[0]) for axis in range(3)]
        return dofs["dofs"][()][order]

    def reactions(self, folder):
        tables = (folder / "deck.dat").read_text().split("forces (fx,fy,fz)")[1:]
        self.assertEqual(len(tables), 60)
        reaction = []
        for table in tables:
            rows = (line.split() for line in table.splitlines())
            force = {int(row[0]): [float(word) for word in row[1:]] for row in rows if len(row) == 4 and row[0].isdigit()}
            reaction.append(np.concatenate([force[node] for node in self.retained]))
        return {"K": np.array(reaction).T}

    def test_guyan_is_the_reaction_to_unit_displacements_in_all_printed_digits(self):
        held = "".join(f"{node}, 1, 3\n" for node in self.retained)
        steps = "".join(f"*STEP\n*STATIC\n*BOUNDARY, OP=NEW\nFIX, 1, 3\n{held}*BOUNDARY\n{node}, {axis}, {axis}, 1.0\n"
                        "*NODE PRINT, NSET=N1\nRF\n*END STEP\n" for node in self.retained for axis in (1, 2, 3))
        theirs, columns = columns_of(CALCULIX.of(
            "unit displacements", re.sub(r"\*BOUNDARY\nFIX, \d\n", "", self.model) + steps, self.reactions, keep=some_columns))
        self.assemble()
        ours = self.guyan("sub")[:, columns]
        # Seven digits are printed; a force that the symmetry makes zero is rounding, 1e-13 of the largest.
        np.testing.assert_allclose(ours, theirs, rtol=5.01e-7, atol=1e-10 * abs(theirs).max())

    def test_the_matrix_that_calculix_prints_is_not_condensed_and_ours_of_the_same_block_has_its_digits(self):
        printed, columns = columns_of(CALCULIX.of("printed matrix", self.text, printed_matrix, keep=some_columns, digits=13))
        self.assemble()
        with h5py.File(self.folder / "sub.fe.h5") as model:
            order = self.in_deck_order(model["sets/retained"])
            K = symmetric(model["K"]) / NEWTON_PER_MILLIMETRE
        others = np.setdiff1d(np.arange(len(K)), order)
        # Thirteen digits; where the symmetry makes zeros, rounding of both: 1e-13 of the largest entry.
        np.testing.assert_allclose(K[np.ix_(order, order)][:, columns], printed, rtol=1e-12, atol=1e-13 * abs(printed).max())
        condensed = K[np.ix_(order, order)] - K[np.ix_(order, others)] @ np.linalg.solve(
            K[np.ix_(others, others)], K[np.ix_(others, order)])
        np.testing.assert_allclose(self.guyan("sub"), condensed, rtol=0, atol=1e-12 * abs(condensed).max())
        self.assertGreater(abs(condensed[:, columns] - printed).max(), 0.4 * abs(printed).max())

    @calculix.required("the matrices of this deck, 2 MB, are too large to store")
    def test_guyan_of_the_matrices_that_calculix_wrote_is_that_of_our_own(self):
        calculix.run(self.model + "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n1\n*END STEP\n", self.folder, "stored")
        dofs = [tuple(map(int, line.split("."))) for line in (self.folder / "stored.dof").read_text().split()]
        for ending, name in (("sti", "K"), ("mas", "M")):
            lines = (self.folder / f"stored.{ending}").read_text().splitlines()  # the upper triangle: row, column, value
            turned = [f"{j} {i} {value}" for i, j, value in (line.split() for line in lines)]
            (self.folder / f"stored.{name}.mtx").write_text("\n".join(
                ["%%MatrixMarket matrix coordinate real symmetric", f"{len(dofs)} {len(dofs)} {len(turned)}", *turned, ""]))
        rows = []
        for i, (node, axis) in enumerate(dofs):
            position, direction = self.position[node] * 1e-3, np.eye(3)[axis - 1]
            name = ["retained", f"{node}.{axis}"] if node in self.retained else ["", ""]
            rows.append("\t".join(map(str, [i + 1, node, axis, "displacement", *position, *direction, *name])))
        (self.folder / "stored.dofs.tsv").write_text("\n".join(rows) + "\n")
        (self.folder / "stored.fe.toml").write_text(
            '[matrices]\nK = "stored.K.mtx"\nM = "stored.M.mtx"\ndofs = "stored.dofs.tsv"\nunits = "mm-t-s"\n')
        self.stage("assembly", "-c", "stored.fe.toml", "-o", "stored.fe.h5")
        self.assemble()
        theirs, ours = self.guyan("stored"), self.guyan("sub")
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-11 * abs(theirs).max())  # 14 digits in the files


if __name__ == "__main__":
    unittest.main(verbosity=2)
