# SPDX-License-Identifier: GPL-3.0-or-later
"""K and M of one cell of each type, entry by entry, compared with those that CalculiX writes
with SOLVER=MATRIXSTORAGE. Differences are due to the quadrature
only, as an independent implementation (reference_cell.py) with CalculiX's points shows."""
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import calculix  # noqa: E402
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import scipy.sparse as sp  # noqa: E402

import reference_cell as reference  # noqa: E402
import stages  # noqa: E402

CALCULIX = calculix.Results(__file__)
VECTOR = np.random.default_rng(7).uniform(-1.0, 1.0, 60)
E, NU, RHO = 2.1, 0.3, 7.8
SAME = 1e-11  # of the largest entry: the decks carry 12 digits
# name, shape, order, CalculiX's points, where clatter's K is the same, where its M is: box, straight, curved
TYPES = [
    ("C3D4", "tet", 1, reference.tet_rule(1), "box straight curved", ""),
    ("C3D6", "wedge", 1, reference.wedge_rule(1, 2), "box straight curved", ""),
    ("C3D8", "hex", 1, reference.hex_rule(2), "box straight curved", "box"),
    ("C3D8I", "hex", 1, reference.hex_rule(2), "box", "box"),
    ("C3D10", "tet", 2, reference.tet_rule(4), "box straight", ""),
    ("C3D15", "wedge", 2, reference.wedge_rule(3, 3), "box straight curved", ""),
    ("C3D20", "hex", 2, reference.hex_rule(3), "box straight curved", "box"),
    ("C3D20R", "hex", 2, reference.hex_rule(2), "box straight curved", ""),
]


def placed(cell, kind):
    """Nodes of the cell: as its reference, with shifted corners, with shifted mid-side nodes too."""
    random = np.random.default_rng(3)
    corners = cell.nodes[:len(cell.nodes) if cell.order == 1 else len(cell.nodes) - len(reference.EDGES[cell.shape])]
    if kind != "box":
        corners = corners + random.uniform(-0.15, 0.15, corners.shape)
    if cell.order == 1:
        return corners
    mid_side_nodes = np.array(reference.mid_side_nodes(cell.shape, corners))
    if kind == "curved":
        mid_side_nodes += random.uniform(-0.05, 0.05, mid_side_nodes.shape)
    return np.vstack([corners, mid_side_nodes])


def deck(name, x):
    ids = [str(i + 1) for i in range(len(x))]
    cell = ", ".join(["1", *ids[:10]]) + (",\n" + ", ".join(ids[10:]) if len(ids) > 10 else "")
    nodes = "\n".join(f"{i}, " + ", ".join(f"{c:.12g}" for c in at) for i, at in zip(ids, x))
    return (f"*NODE, NSET=NALL\n{nodes}\n*ELEMENT, TYPE={name}, ELSET=EALL\n{cell}\n*MATERIAL, NAME=M\n*ELASTIC\n"
            f"{E}, {NU}\n*DENSITY\n{RHO}\n*SOLID SECTION, ELSET=EALL, MATERIAL=M\n")


def written(folder, n):
    """K, M on 3n displacements in the deck's order of nodes; CalculiX's own modes condensed out of K."""
    dofs = [tuple(map(int, line.split("."))) for line in (folder / "deck.dof").read_text().split()]
    order = sorted(range(len(dofs)), key=lambda i: dofs[i])

    def read(ending):
        row, column, value = np.loadtxt(folder / f"deck.{ending}", ndmin=2).T
        upper = sp.coo_matrix((value, (row.astype(int) - 1, column.astype(int) - 1)), shape=(len(dofs),) * 2).toarray()
        return (upper + np.triu(upper, 1).T)[np.ix_(order, order)]

    K, M = read("sti"), read("mas")
    return {"K": reference.without(K, 3 * n) if len(K) > 3 * n else K, "M": M[:3 * n, :3 * n]}


def theirs(name, text, n):
    """K and M of CalculiX, and what of another matrix is compared with them: with ccx all of it, otherwise its product with a
    vector, because only such products are stored."""
    found = CALCULIX.of(name, text + "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n1\n*END STEP\n", lambda folder: written(folder, n),
                        keep=lambda both: {of: product(matrix) for of, matrix in both.items()}, digits=13)
    return found["K"], found["M"], product if found["K"].ndim == 1 else lambda matrix: matrix


def product(matrix):
    return matrix @ VECTOR[:len(matrix)]


def clatter(folder, text):
    (folder / "mine.inp").write_text(text)
    for command in (("mesh", "mine.inp", "--units", "m-kg-s", "-o", "m.mesh.h5", "--recipe", "m.fe.toml", "--quiet"),
                    ("assembly", "m.mesh.h5", "-c", "m.fe.toml", "-o", "m.fe.h5", "--quiet")):
        done = stages.run_stage(*command, folder=folder)
        if done.returncode:
            raise AssertionError(done.stderr)
    with h5py.File(folder / "m.mesh.h5") as mesh:
        row = np.argsort(mesh["node_ids"][()])
    at = (3 * row[:, None] + np.arange(3)).ravel()

    def read(file, name):
        q = file[name]
        lower = sp.csc_matrix((q["data"][()], q["indices"][()], q["indptr"][()]), shape=q.attrs["shape"]).toarray()
        return (lower + np.tril(lower, -1).T)[np.ix_(at, at)]

    with h5py.File(folder / "m.fe.h5") as fe:
        return read(fe, "K"), read(fe, "M")


def difference(a, b):
    return abs(a - b).max() / abs(b).max()


class MatrixStorage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-matrices-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def each(self, kinds):
        for name, shape, order, rule, same_K, same_M in TYPES:
            cell = reference.Cell(shape, order)
            for kind in kinds:
                with self.subTest(type=name, kind=kind):
                    x = placed(cell, kind)
                    text = deck(name, x)
                    yield name, cell, x, rule, kind in same_K, kind in same_M, theirs(f"{name}, {kind}", text, len(x)), text

    def test_stiffness_and_mass_are_those_of_calculix_where_the_points_are_the_same(self):
        for _, _, _, _, same_K, same_M, (K, M, of), text in self.each(("box", "straight", "curved")):
            ours_K, ours_M = map(of, clatter(self.folder, text))
            self.assertEqual(difference(ours_K, K) < SAME, same_K, difference(ours_K, K))
            self.assertEqual(difference(ours_M, M) < SAME, same_M, difference(ours_M, M))

    def test_calculix_is_the_second_cell_with_the_points_named(self):
        elasticity = reference.isotropic(E, NU)
        for name, cell, x, rule, _, _, (K, M, of), _ in self.each(("box", "straight", "curved")):
            again = (cell.bubble_stiffness(x, elasticity, rule, scaled=False) if name == "C3D8I"
                     else cell.stiffness(x, elasticity, rule))
            self.assertLess(difference(of(again), K), SAME)
            self.assertLess(difference(of(cell.mass(x, RHO, rule)), M), SAME)

    def test_our_incompatible_modes_are_scaled_so_that_constant_stress_stays_in_balance(self):
        cell = reference.Cell("hex", 1)
        x = placed(cell, "straight")
        elasticity, rule = reference.isotropic(E, NU), reference.hex_rule(2)
        K, _ = clatter(self.folder, deck("C3D8I", x))
        ours = cell.bubble_stiffness(x, elasticity, rule, scaled=True)
        self.assertLess(difference(K, ours), SAME)
        stretch = np.kron(x[:, :1], [[1.0], [0.0], [0.0]]).ravel()  # u = (x, 0, 0)
        balance = cell.stiffness(x, elasticity, rule) @ stretch  # forces of the constant stress
        unscaled = cell.bubble_stiffness(x, elasticity, rule, scaled=False) @ stretch
        self.assertLess(difference(K @ stretch, balance), SAME)
        self.assertGreater(difference(unscaled, balance), 1e-3)  # so C3D8I of CalculiX fails the patch test


if __name__ == "__main__":
    unittest.main(verbosity=2)
