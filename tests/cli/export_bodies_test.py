# SPDX-License-Identifier: GPL-3.0-or-later
"""Reduced parts for multibody programs and OP4: against the definition of each quantity on the nodes of the mesh."""
import unittest

import h5py
import numpy as np
import scipy.linalg
import scipy.sparse as sp
from export_deck_test import Part, bar
from other_formats import frequencies, read_exudyn, read_flex_ascii, read_op4, read_sid


def tilde(v):
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def plain_bar(held):
    """Four hexahedra without a spider: every node is on the skin, and no two modes have one frequency."""
    without = ("RBE2", "GRID,900") if held else ("RBE2", "GRID,900", "SPC1")
    lines = [line for line in bar(depth=8.0).splitlines() if not line.startswith(without)]
    return "\n".join(lines) + "\nASET1,123,109,THRU,112\nASET1,123,119\nENDDATA\n"


class Bodies(Part):
    """A bar, free or clamped, in SI with its nodes X, their masses m (M = m x I) and modes Phi."""

    def make(self, held):
        self.assemble("free", plain_bar(False))
        self.condense(plain_bar(held), ["retained"], count=10, more="inertia_invariants = true\n", skin=["skin"])
        with h5py.File(self.folder / "free.fe.h5") as fe:
            g = fe["M"]
            lower = sp.csc_matrix((g["data"][()], g["indices"][()], g["indptr"][()]), shape=g.attrs["shape"]).toarray()
            self.X, ids = fe["nodes"][()], fe["node_ids"][()]
        M = lower + np.tril(lower, -1).T
        self.m = M[::3, ::3]
        np.testing.assert_allclose(M, np.kron(self.m, np.eye(3)), atol=1e-14 * abs(M).max())
        with h5py.File(self.folder / "part.rom.h5") as rom:
            self.K_rr, self.M_rr = rom["K_rr"][()], rom["M_rr"][()]
            T, skin = rom["skin/T"][()], rom["skin/nodes"][()]
            self.dofs, self.position = rom["sets/retained/dofs"][()], rom["sets/retained/position"][()]
            self.ids, self.rates = rom["sets/retained/node_ids"][()], (rom.attrs["alpha"], rom.attrs["beta"])
        self.at = [int(np.argmin(np.linalg.norm(skin - x, axis=1))) for x in self.X]
        np.testing.assert_allclose(skin[self.at], self.X, atol=1e-12)
        values, vectors = scipy.linalg.eigh(self.K_rr, self.M_rr)
        rigid = 0 if held else 6
        self.omega2, self.vectors = values[rigid:], vectors[:, rigid:]
        self.Phi = np.einsum("aik,kj->aij", T.reshape(len(skin), 3, -1)[self.at], self.vectors)
        self.row_of_id = {int(number): row for row, number in enumerate(ids)}

    def oriented(self, shapes):
        """self.Phi with the signs of `shapes` (3 x modes of the first retained node)."""
        ours = self.Phi[self.row_of_id[109]]
        signs = np.sign(np.sum(ours * shapes, axis=0))
        np.testing.assert_allclose(ours * signs, shapes, rtol=1e-6, atol=1e-7 * abs(shapes).max())
        return self.Phi * signs


class StandardInputData(Bodies):
    def make(self, held):
        super().make(held)
        self.export("part.SID_FEM")
        self.sid = read_sid((self.folder / "part.SID_FEM").read_text())
        self.Phi = self.oriented(self.sid["frame"][109]["phi"][0])
        self.nq = self.Phi.shape[2]

    def of_the_nodes(self, q, v, w):
        """Mass matrix (6 + nq) and inertia forces without accelerations of the nodes themselves."""
        Y, V = self.X + self.Phi @ q, self.Phi @ v
        J = np.hstack((np.tile(np.eye(3), (len(Y), 1)), np.vstack([-tilde(y) for y in Y]), self.Phi.reshape(-1, self.nq)))
        M = np.kron(self.m, np.eye(3))
        a = np.cross(w, np.cross(w, Y)) + 2.0 * np.cross(w, V)
        return J.T @ M @ J, J.T @ M @ a.ravel()

    def of_the_data(self, q, v, w):
        """The same by the equations of Wallrapp 1994, from the Taylor expansions."""
        s = {name: value[0] + value[1] @ q for name, value in self.sid.items() if isinstance(value, tuple)}
        mass, n = float(self.sid["mass"]), self.nq
        M = np.zeros((6 + n, 6 + n))
        mc = s["mdCM"][:, 0]
        M[:3, :3], M[3:6, :3], M[:3, 3:6] = mass * np.eye(3), tilde(mc), tilde(mc).T
        M[3:6, 3:6], M[6:, :3], M[:3, 6:] = s["J"], s["Ct"], s["Ct"].T
        M[6:, 3:6], M[3:6, 6:], M[6:, 6:] = s["Cr"], s["Cr"].T, s["Me"]
        Gr = sum(s["Gr"][:, 3 * k:3 * k + 3] * v[k] for k in range(n))
        Ge = sum(s["Ge"][:, 3 * k:3 * k + 3] * v[k] for k in range(n))
        products = np.array([w[0] ** 2, w[1] ** 2, w[2] ** 2, w[0] * w[1], w[1] * w[2], w[0] * w[2]])
        return M, np.concatenate((np.cross(w, np.cross(w, mc)) + 2.0 * np.cross(w, s["Ct"].T @ v),
                                  np.cross(w, s["J"] @ w) + Gr @ w, s["Oe"] @ products + Ge @ w))

    def test_the_equations_of_motion_are_those_of_the_nodes_to_first_order(self):
        for held in (False, True):  # modes of a free body carry no momentum: Ct and Cr are zero
            with self.subTest(held=held):
                self.make(held)
                self.compare()

    def compare(self):
        rng = np.random.default_rng(3)
        w = rng.normal(size=3)
        q, v = 1e-3 * rng.normal(size=(2, self.nq))
        for data, nodes in zip(self.of_the_data(0 * q, 0 * v, w), self.of_the_nodes(0 * q, 0 * v, w)):
            np.testing.assert_allclose(data, nodes, atol=1e-10 * abs(nodes).max())
        # Both are polynomials of second order in (q, v): the odd part is that of first order.
        odd = [[(plus - minus) / 2.0 for plus, minus in zip(f(q, v, w), f(-q, -v, w))]
               for f in (self.of_the_data, self.of_the_nodes)]
        for data, nodes in zip(*odd):
            self.assertGreater(abs(nodes).max(), 0.0)
            # Two dense solvers: their modes differ by eps lambda_max over the gap to the next eigenvalue.
            np.testing.assert_allclose(data, nodes, atol=1e-7 * abs(nodes).max())

    def test_stiffness_and_nodes_are_those_of_the_part(self):
        self.make(held=False)
        self.assertEqual(int(self.sid["nelastq"]), len(self.omega2))
        np.testing.assert_allclose(np.diag(self.sid["Ke"][0]), self.omega2, rtol=1e-7)
        self.assertEqual(set(self.sid["frame"]), set(int(number) for number in self.ids))
        for number, node in self.sid["frame"].items():
            row = self.row_of_id[number]
            np.testing.assert_allclose(node["origin"][0][:, 0], self.X[row], rtol=1e-12, atol=1e-15)
            np.testing.assert_allclose(node["origin"][1][:, 0], self.Phi[row], atol=1e-6 * abs(self.Phi).max())
            np.testing.assert_array_equal(node["AP"][0], np.eye(3))

    def test_it_is_in_si_and_needs_the_invariants(self):
        self.condense(plain_bar(held=True), ["retained"], count=6)
        self.assert_refused("condense", ["export", "part.rom.h5", "--units", "mm-t-s", "part.SID_FEM"],
                            says=["--units mm-t-s", "SI"])
        self.assert_refused("condense", ["export", "part.rom.h5", "part.SID_FEM"], says=["inertia_invariants = true"])


class Exudyn(Bodies):
    def test_the_arrays_are_those_that_exudyn_computes_from_the_mesh(self):
        for held in (False, True):
            with self.subTest(held=held):
                self.make(held)
                self.compare()

    def compare(self):
        self.export("part.npy")
        a = read_exudyn(self.folder / "part.npy")
        boundary = len(set(self.ids))
        nodes, modes = a["xRef"].reshape(-1, 3), a["modeBasis"].reshape(-1, 3, a["modeBasis"].shape[1])
        rows = [boundary + at for at in self.at]  # nodes of the mesh among those of the skin
        np.testing.assert_allclose(nodes[rows], self.X, atol=1e-15)
        Phi = self.oriented(modes[0])  # grid 109 is the first retained one
        np.testing.assert_allclose(modes[rows], Phi, atol=1e-6 * abs(Phi).max())
        Psi, M, n, m = Phi.reshape(-1, Phi.shape[2]), np.kron(self.m, np.eye(3)), len(self.X), Phi.shape[2]
        Phit, Xtilde = np.tile(np.eye(3), (n, 1)), np.vstack([tilde(x) for x in self.X])
        Ptilde = np.vstack([np.hstack([tilde(Phi[k, :, j]) for j in range(m)]) for k in range(n)])
        expected = {"massMatrixReduced": Psi.T @ M @ Psi, "inertiaLocal": Xtilde.T @ M @ Xtilde, "Mtt": Phit.T @ M @ Phit,
                    "mPsiTildePsi": Ptilde.T @ M @ Psi, "mPsiTildePsiTilde": Ptilde.T @ M @ Ptilde,
                    "mPhitTPsi": Phit.T @ M @ Psi, "mPhitTPsiTilde": Phit.T @ M @ Ptilde,
                    "mXRefTildePsi": Xtilde.T @ M @ Psi, "mXRefTildePsiTilde": Xtilde.T @ M @ Ptilde,
                    "chiU": Phit.T @ M @ self.X.ravel() / self.m.sum()}
        for name, value in expected.items():
            # The free bar's modes carry no momentum: what is zero is so to the rounding of its terms.
            scale = max(abs(value).max(), abs(self.m).sum() * abs(self.X).max() * abs(Phi).max())
            self.assertEqual(a[name].shape, value.shape, name)
            np.testing.assert_allclose(a[name], value, atol=1e-7 * scale, err_msg=name)
        self.assertAlmostEqual(float(a["totalMass"]), self.m.sum(), delta=1e-12)
        np.testing.assert_array_equal(a["chiUtilde"], tilde(a["chiU"]))
        np.testing.assert_allclose(np.diag(a["stiffnessMatrixReduced"]), self.omega2, rtol=1e-7)
        self.assertEqual(a["infoList"].tolist(), [m, len(nodes), 3, 4, 7, 7 + m])
        self.assertEqual(str(a["rigidBodyNodeType"]), "NodeType.RotationEulerParameters")
        self.assertNotIn("matrix", a["postProcessingModes"])
        self.export("mm.npy", "--units", "mm-t-s")
        mm, root = read_exudyn(self.folder / "mm.npy"), np.sqrt(1e-3)  # of a kilogram in tonnes
        for name, factor in (("totalMass", 1e-3), ("chiU", 1e3), ("xRef", 1e3), ("inertiaLocal", 1e3),
                             ("modeBasis", 1.0 / root), ("mPhitTPsi", root), ("mXRefTildePsiTilde", 1e3 * root),
                             ("mPsiTildePsi", 1.0), ("massMatrixReduced", 1.0), ("stiffnessMatrixReduced", 1.0)):
            np.testing.assert_allclose(mm[name], factor * a[name], rtol=1e-6, atol=1e-7 * abs(factor * a[name]).max() +
                                       1e-12 * factor * abs(self.m).sum() * abs(Phi).max(), err_msg=name)
        self.assertGreaterEqual(a["trigList"].min(), boundary)
        corners = nodes[a["trigList"]]
        outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2.0
        self.assertAlmostEqual(np.sum(outward * corners.mean(axis=1)) / 3.0, 0.01 * 0.008 * 0.04, delta=1e-12)


class OpenFast(Part):
    def setUp(self):
        super().setUp()
        self.condense(bar() + "ASET1,123456,900\nASET1,123,109\nENDDATA\n", ["point_900", "retained"], count=8)

    def test_the_interface_comes_first_and_the_pencil_is_the_same(self):
        self.export("part.flexascii")
        M, K, D, times, loads = read_flex_ascii((self.folder / "part.flexascii").read_text())
        with h5py.File(self.folder / "part.rom.h5") as rom:
            K_rr, M_rr, dofs = rom["K_rr"][()], rom["M_rr"][()], rom["sets/point_900/dofs"][()]
        np.testing.assert_allclose(frequencies(K, M), frequencies(K_rr, M_rr), rtol=1e-7)
        rest = np.setdiff1d(np.arange(len(K_rr)), dofs)
        static = K_rr[np.ix_(dofs, dofs)] - K_rr[np.ix_(dofs, rest)] @ np.linalg.solve(
            K_rr[np.ix_(rest, rest)], K_rr[np.ix_(rest, dofs)])
        np.testing.assert_allclose(K[:6, :6], static, rtol=1e-8, atol=1e-9 * abs(static).max())
        np.testing.assert_array_equal(K[6:, :6], 0.0)
        np.testing.assert_allclose(M[6:, 6:], np.eye(len(rest)), atol=1e-10)
        np.testing.assert_allclose(frequencies(K[6:, 6:], M[6:, 6:]),
                                   frequencies(K_rr[np.ix_(rest, rest)], M_rr[np.ix_(rest, rest)]), rtol=1e-7)
        np.testing.assert_array_equal(D, 0.0)  # the deck has none
        np.testing.assert_array_equal(times, [0.0, 1e4])
        np.testing.assert_array_equal(loads, 0.0)

    def test_a_part_without_one_interface_of_six_is_refused(self):
        self.assert_refused("condense", ["export", "part.rom.h5", "--interface", "retained", "part.flexascii"],
                            says=["retained", "--interface SET", "point_900"])
        self.assert_refused("condense", ["export", "part.rom.h5", "--interface", "absent", "part.flexascii"],
                            says=["absent", "point_900"])
        self.condense(bar() + "ASET1,123,109\nENDDATA\n", ["retained"], count=8)
        self.assert_refused("condense", ["export", "part.rom.h5", "part.flexascii"], says=["0 sets", "none"])


class Output4(Part):
    def test_matrices_are_in_the_sequence_of_the_grid_numbers_to_the_last_bit(self):
        self.condense(bar() + "ASET1,123456,900\nASET1,123,109\nENDDATA\n", ["point_900", "retained"], count=8)
        self.export("part.op4", "--units", "m-kg-s")
        self.export("binary.op4", "--binary", "--units", "m-kg-s")
        self.export("part.mtx")
        lines = (self.folder / "part.dofs.tsv").read_text().splitlines()
        keys = [tuple(int(x) for x in line.split("\t")[1:3]) for line in lines if not line.startswith("#")]
        order = sorted(range(len(keys)), key=lambda j: keys[j])
        self.assertEqual(keys[order[0]], (109, 1))  # the boundary begins with grid 900
        self.assertNotEqual(order, sorted(order))
        with h5py.File(self.folder / "part.rom.h5") as rom:
            expected = {name: rom[f"{name[0]}_rr"][()][np.ix_(order, order)] for name in ("KAA", "MAA")}
        for file in ("part.op4", "binary.op4"):
            found = read_op4(self.folder / file)
            self.assertEqual(list(found), ["KAA", "MAA", "DOFS"])
            for name, matrix in expected.items():
                np.testing.assert_array_equal(found[name][0], matrix)
                self.assertEqual(found[name][1], 6)
            self.assertEqual([tuple(row) for row in found["DOFS"][0]], [keys[j] for j in order])


if __name__ == "__main__":
    unittest.main()
