# SPDX-License-Identifier: GPL-3.0-or-later
"""Nastran decks that mix cards, against frequencies computed here from cells, fits and rotations of our own."""
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import abaqus_dialects as bar  # noqa: E402
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import reference_cell  # noqa: E402
import scipy.sparse as sparse  # noqa: E402
import stages  # noqa: E402

NODES = 81  # of the bar of 2 x 2 x 8 cubes of 5 mm


def lines(name, *fields, large=False):
    """A card in fields of 8 or 16 columns with its continuations."""
    count, width = (4, 16) if large else (8, 8)
    rows = [fields[i:i + count] for i in range(0, len(fields), count)]
    heads = [name + "*" * large] + ["*" if large else "+"] * (len(rows) - 1)
    text = ((f"{f:.9E}" if large else f"{f:g}") if isinstance(f, float) else str(f) for row in rows for f in row)
    return "".join(f"{head:<8}" + "".join(f"{next(text):<{width}}" for _ in row).rstrip() + "\n" for head, row in zip(heads, rows))


def bar_deck(cards, grid=lambda n: lines("GRID", n, "", *map(float, bar.position(n)))):
    cells = "".join(lines("CHEXA", c, 1, *bar.corners(c)) for c in range(1, 33))
    return ("SOL 103\nCEND\nMETHOD=1\nSPC=7\nBEGIN BULK\nPARAM,COUPMASS,1\nEIGRL,1,,,6\n"
            + "".join(grid(n) for n in range(1, NODES + 1)) + cells + "PSOLID,1,1,,TWO,,FULL\nSPC1,7,123,1,THRU,9\n" + cards + "ENDDATA\n")


def bar_matrices(density):
    """K and M in N, mm, t."""
    cell, rule = reference_cell.Cell("hex", 1), reference_cell.hex_rule(2)
    K, M = np.zeros((2, 3 * NODES, 3 * NODES))
    for c in range(1, 33):
        ids = np.array(bar.corners(c))
        x = np.array([bar.position(n) for n in ids])
        at = (3 * (ids[:, None] - 1) + range(3)).ravel()
        K[np.ix_(at, at)] += cell.stiffness(x, reference_cell.isotropic(210000.0, 0.3), rule)
        M[np.ix_(at, at)] += cell.mass(x, density, rule)
    return K, M


def frequencies(K, M, conditions):
    """Of K and M with conditions . u = 0."""
    _, s, v = np.linalg.svd(conditions)
    free = v[np.count_nonzero(s > 1e-9):].T
    half = np.linalg.inv(np.linalg.cholesky(free.T @ M @ free))
    return np.sqrt(np.linalg.eigvalsh(half @ free.T @ K @ free @ half.T)) / (2 * np.pi)


def cross(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


class MixedDecks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-mixed-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)

    def frequencies(self, deck, count):
        (self.folder / "a.bdf").write_text(deck)
        for stage, arguments in (("mesh", ["a.bdf", "--units", "mm-t-s", "-o", "a.mesh.h5", "--recipe", "a.fe.toml"]),
                                 ("assembly", ["a.mesh.h5", "-c", "a.fe.toml", "-o", "a.fe.h5"]),
                                 ("modal", ["a.fe.h5", "--count", str(count), "-o", "a.modes.h5"])):
            done = stages.run_stage(stage, *arguments, folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.folder / "a.modes.h5") as file:
            return file["frequency_hz"][()]

    def test_the_loss_of_all_stiffness_is_that_of_all_stiffness(self):
        # Solids, springs of two kinds, a bush and a bar, each with GE = .01, beside PARAM, G.
        cards = ("PARAM,G,.03\nMAT1,1,210000.,,.3,7.85-9,,,.01\nMAT1,2,70000.,,.3,2.7-9,,,.01\n"
                 "CELAS2,201,50.,74,1,,,.01\nCELAS1,202,5,75,2,76,2\nPELAS,5,70.,.01\n"
                 "GRID,900,,5.,5.,60.\nRBE2,950,900,123456,73,79,81\nGRID,901,,25.,5.,60.\nSPC1,7,123456,901\n"
                 "CBAR,203,6,900,901,0.,1.,0.\nPBARL,6,2,,ROD,,,,,+\n+,2.\nCBUSH,204,8,900,901,,,,0\n"
                 "PBUSH,8,K,30.,20.,10.,5.,4.,3.,+\n+,,GE,.01\n")
        self.frequencies(bar_deck(cards), 2)
        with h5py.File(self.folder / "a.fe.h5") as file:
            K, loss = (sparse.csc_matrix((group["data"][()], group["indices"][()], group["indptr"][()]), shape=group.attrs["shape"])
                       for group in (file["K"], file["loss"]))
        self.assertLess(abs(loss - 0.04 * K).max(), 1e-10 * abs(K).max())

    def test_masses_and_springs_need_no_solid_and_no_material(self):
        # A wall, 3 N/mm, 2e-3 t, 3 N/mm, 1e-3 t.
        found = self.frequencies("SOL 103\nCEND\nMETHOD=1\nSPC=7\nBEGIN BULK\nEIGRL,1,,,2\nGRID,1\nGRID,2,,10.,0.,0.\nGRID,3,,20.,0.,0.\n"
                                 "CELAS2,11,3.,1,1,2,1\nCELAS2,12,3.,2,1,3,1\nCONM2,13,2,,2.-3\nCONM2,14,3,,1.-3\n"
                                 "SPC1,7,123456,1\nSPC1,7,23456,2,3\nENDDATA\n", 2)
        K, M = np.array([[6.0, -3.0], [-3.0, 3.0]]), np.diag([2e-3, 1e-3])
        np.testing.assert_allclose(found, frequencies(K, M, np.zeros((1, 2))), rtol=1e-9)

    def test_an_offset_mass_on_a_weighted_mean_in_skew_axes(self):
        # RBE3 with 456, CONM2 with an offset and inertia in a system, SPC along CD, PARAM WTMASS, fields of 8 and 16 columns.
        c, s = np.cos(np.radians(30.0)), np.sin(np.radians(30.0))
        cards = (lines("CORD2R", 5, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, c, s, 0.0, large=True) + "GRID,900,,5.,5.,45.,5\n"
                 "PARAM,WTMASS,1.E-3\nPARAM,GRDPNT,0\nMAT1,1,210000.,,.3,7.85-6\nSPC,7,81,2,0.\n"
                 "RBE3,950,,900,123456,1.,123,73,75\n,79,81\n"
                 "CONM2,960,900,5,2.E-2,1.,2.,3.\n,4.,.5,5.,.1,.2,6.\n")
        found = self.frequencies(bar_deck(cards, lambda n: lines("GRID", n, "", *map(float, bar.position(n)), *[5] * (n > 72), large=n > 72)), 6)
        axes = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        offset = axes @ [1.0, 2.0, 3.0]
        moving = np.hstack([np.eye(3), -cross(offset)])
        mass = 2e-5 * moving.T @ moving
        mass[3:, 3:] += axes @ np.array([[4.0, -0.5, -0.1], [-0.5, 5.0, -0.2], [-0.1, -0.2, 6.0]]) @ axes.T * 1e-3
        mean = [73, 75, 79, 81]
        rigid = np.vstack([np.hstack([np.eye(3), -cross(np.array(bar.position(n)) - (5.0, 5.0, 45.0))]) for n in mean])
        fit = np.zeros((6, 3 * NODES))
        fit[:, [3 * (n - 1) + k for n in mean for k in range(3)]] = np.linalg.pinv(rigid)
        K, M = bar_matrices(7.85e-9)
        held = np.zeros((28, 3 * NODES))
        held[:27, :27] = np.eye(27)
        held[27, -3:] = axes[:, 1]
        np.testing.assert_allclose(found, frequencies(K, M + fit.T @ mass @ fit, held)[:6], rtol=1e-7)


if __name__ == "__main__":
    unittest.main(verbosity=2)
