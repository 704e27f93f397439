# SPDX-License-Identifier: GPL-3.0-or-later
"""The response functions of bench/ on two masses and two springs, against the 2 x 2 system solved by hand, and on a chain."""
import pathlib
import sys
import unittest

import numpy as np
import scipy.sparse as sparse

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
import frequency_response as response  # noqa: E402
from full_model import TERMS, FullModel  # noqa: E402

# Two masses of 1 kg, wall - 3 N/m - 1 - 1 N/m - 2: K = [4 -1; -1 1].
STIFFNESS = np.array([[4.0, -1.0], [-1.0, 1.0]])
LOSS = 0.02
HZ = np.geomspace(0.02, 0.6, 200)  # resonances at 0.134 and 0.331 Hz
ROUNDING = 1e-12  # condition of the dynamic stiffness below 1e3 at these frequencies


def by_hand():
    """Both displacements for a unit force on the first mass: Cramer's rule."""
    omega2 = (2 * np.pi * HZ) ** 2
    k = STIFFNESS * (1 + 1j * LOSS)
    determinant = (k[0, 0] - omega2) * (k[1, 1] - omega2) - k[0, 1] ** 2
    return np.array([(k[1, 1] - omega2) / determinant, -k[0, 1] / determinant])


class Superposition(unittest.TestCase):
    def setUp(self):
        self.eigenvalues, self.shapes = np.linalg.eigh(STIFFNESS)

    def test_all_modes_give_the_exact_response(self):
        found = response.superposed(self.shapes, self.eigenvalues, self.shapes[0], HZ, LOSS)
        self.assertLess(np.abs(found / by_hand() - 1).max(), ROUNDING)

    def test_a_rigid_mode_moves_as_a_free_mass(self):
        found = response.superposed(np.array([[0.5]]), [0.0], np.array([0.5]), HZ, LOSS)
        np.testing.assert_allclose(found[0], -1 / (4 * (2 * np.pi * HZ) ** 2))

    def test_the_series_replaces_the_mode_that_was_left_out(self):
        shift, terms = -0.5, 40
        below = HZ < 0.2  # the series' ratio: (1.58 + 0.5) / (4.3 + 0.5) = 0.43, its 40th power 3e-15
        kept = response.superposed(self.shapes[:, :1], self.eigenvalues[:1], self.shapes[0, :1], HZ[below], LOSS)
        shifted = np.linalg.inv(STIFFNESS - shift * np.eye(2))
        chain = response.chain(lambda force: shifted @ force, np.eye(2), self.shapes[:, :1].T, np.array([1.0, 0.0]), terms)
        found = kept + response.left_out(chain, shift, HZ[below], LOSS)
        self.assertLess(np.abs(found / by_hand()[:, below] - 1).max(), ROUNDING)
        self.assertGreater(np.abs(kept / by_hand()[:, below] - 1).max(), 0.01)


class Chain(unittest.TestCase):
    """Forty free masses: the first ten modes, rigid one included, and the series for the others."""

    def setUp(self):
        self.stiffness = sparse.diags([[-1.0] * 39, [1.0, *[2.0] * 38, 1.0], [-1.0] * 39], [-1, 0, 1], format="csc")
        self.mass = sparse.identity(40, format="csc")
        values, vectors = np.linalg.eigh(self.stiffness.toarray())
        self.model = FullModel(sparse.identity(40, format="csr"), vectors.T[:10].copy(), values[:10], self.stiffness, self.mass,
                               -0.1 * values[1], LOSS)
        self.force = np.eye(1, 40, 3)[0]
        self.ratio = (values[4] - self.model.shift) / (values[10] - self.model.shift)  # of the series at the fifth mode
        self.hz = np.sqrt(values[4]) / (2 * np.pi)

    def test_response_is_that_of_the_dynamic_stiffness(self):
        dynamic = self.stiffness.toarray() * (1 + 1j * LOSS) - (2 * np.pi * self.hz) ** 2 * np.eye(40)
        exact = np.linalg.solve(dynamic, self.force)
        found = self.model.response(self.force, np.array([self.hz]))[:, 0]
        # The error of the truncated series: its ratio to the power of the number of terms, times the static response.
        self.assertLess(np.linalg.norm(found - exact) / np.linalg.norm(exact), self.ratio**TERMS)

    def test_residual_sees_a_mode_that_is_missing(self):
        self.assertLess(self.model.residual(self.force, self.hz), self.ratio**TERMS)
        keep = np.arange(10) != 3
        self.model.shapes, self.model.eigenvalues = self.model.shapes[keep], self.model.eigenvalues[keep]
        self.assertGreater(self.model.residual(self.force, self.hz), 0.01)


class Surface(unittest.TestCase):
    def test_normal_motion_of_a_plane_is_its_root_of_area_and_sliding_is_none(self):
        nodes = np.array([[0, 0, 2], [3, 0, 2], [0, 4, 2], [1.5, 0, 2], [1.5, 2, 2], [0, 2, 2]], float)
        motion = response.normal_motion(nodes, np.array([[0, 1, 2, 3, 4, 5]]))
        self.assertAlmostEqual((motion @ np.tile([7.0, -5.0, 1.0], 6))[0], np.sqrt(6.0), places=12)

    def test_a_quadratic_motion_is_taken_at_the_centre(self):
        nodes = np.array([[0, 0, 0], [3, 0, 0], [0, 3, 0], [1.5, 0, 0], [1.5, 1.5, 0], [0, 1.5, 0]], float)
        lift = np.zeros((6, 3))
        lift[:, 2] = nodes[:, 0] ** 2 + nodes[:, 1]
        motion = response.normal_motion(nodes, np.array([[0, 1, 2, 3, 4, 5]])) @ lift.ravel()
        self.assertAlmostEqual(motion[0], (1.0 + 1.0) * np.sqrt(4.5), places=12)


class Differences(unittest.TestCase):
    def test_a_response_ten_percent_too_large_is_wrong_by_a_tenth_and_0_83_db(self):
        hz = np.geomspace(50.0, 3000.0, 500)
        reference = np.array([1.0 + 0.5j, -2.0j])[:, None] * np.sqrt(hz)
        self.assertAlmostEqual(response.relative_difference(1.1 * reference, reference, hz), 0.1, places=12)
        levels = response.band_levels(1.1 * reference, hz) - response.band_levels(reference, hz)
        np.testing.assert_allclose(levels, 20 * np.log10(1.1))

    def test_bands_from_63_to_2500_hz_lie_between_50_and_3000_hz(self):
        mids = [mid for _, mid, _ in response.third_octaves(np.array([50.0, 3000.0]))]
        self.assertEqual(len(mids), 17)
        np.testing.assert_allclose([mids[0], mids[-1]], [63.1, 2511.9], atol=0.05)

    def test_the_level_of_a_constant_response_is_its_mean_square(self):
        hz = np.geomspace(50.0, 3000.0, 300)
        response_ = np.array([[3.0], [4.0j]]) * np.ones_like(hz)
        np.testing.assert_allclose(response.band_levels(response_, hz), 10 * np.log10(12.5), atol=1e-9)


if __name__ == "__main__":
    unittest.main()
