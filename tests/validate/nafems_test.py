# SPDX-License-Identifier: GPL-3.0-or-later
"""The main figures of the NAFEMS tables in docs/validation.md."""
import functools
import unittest

import numpy as np

import nafems
import nafems_mesh


RESULTS = nafems.calculix.Results(__file__)


def results(name, digits=7):
    return functools.partial(RESULTS.of, name, digits=digits)


class PlateFV52(unittest.TestCase):
    def test_hex20_and_hex8_match_the_published_figures_of_the_same_mesh_to_four_digits(self):
        for kind, (bricks, published) in nafems.OPTISTRUCT.items():
            ratio = (nafems.fv52(kind, bricks) / nafems.FV52)[nafems.DISTINCT]
            with self.subTest(cell=kind):
                np.testing.assert_array_equal(ratio.round(4), published)

    def test_hex20_is_near_the_published_bricks_of_20_nodes(self):
        error = nafems.fv52("C3D20", (4, 4, 1))[nafems.DISTINCT] / nafems.BRICKS_20 - 1
        self.assertLess(np.abs(error[3:]).max(), 3e-5)  # in the plane: the digits printed
        self.assertLess(np.abs(error[:3]).max(), 8e-4)  # bending: their formulation is not known

    def test_the_mode_in_the_plane_converges_to_the_reference(self):
        coarse, fine = (nafems.fv52("C3D20", bricks)[4] / 193.59 - 1 for bricks in ((4, 4, 1), (8, 8, 2)))
        self.assertLess(abs(fine), 1.5e-4)
        self.assertGreater(coarse / fine, 8)

    def test_calculix_finds_the_same_frequencies_from_the_same_deck(self):
        deck = nafems_mesh.plate("C3D20", (4, 4, 1))
        ours, theirs = nafems.frequencies(deck, 10)[3:], nafems.calculix_frequencies(deck, 10, results("plate"))
        self.assertLess(np.abs(ours / theirs - 1).max(), 1e-6)  # seven digits are printed

    def test_c3d8i_of_calculix_agrees_once_its_incompatible_modes_have_no_mass(self):
        bricks = (4, 4, 2)
        deck = nafems_mesh.plate("C3D8I", bricks)
        nodes = len(nafems_mesh.Grid("C3D8I", bricks, None).nodes)
        ours = nafems.frequencies(deck, 10)[3:]
        theirs = nafems.calculix_frequencies_without_mode_mass(deck, nodes, 10, results("plate of C3D8I", 10))
        self.assertLess(np.abs(ours / theirs - 1).max(), 1e-7)  # measured 1e-9


class HardPlate(unittest.TestCase):
    def rate(self, kind):
        exact = nafems.hard_plate_exact(6)
        error = [np.abs(nafems.hard_plate(kind, bricks) / exact - 1).max() for bricks in ((4, 4, 1), (8, 8, 2))]
        return np.log2(error[0] / error[1])

    def test_frequencies_converge_to_the_exact_ones_with_fourth_order_in_quadratic_cells(self):
        # Half a wave over two cells of the coarse mesh: tetrahedra are not yet in the limit.
        for kind, least in (("C3D20", 3.8), ("C3D20R", 3.8), ("C3D15", 3.3), ("C3D10", 3.0)):
            with self.subTest(cell=kind):
                self.assertGreater(self.rate(kind), least)

    def test_frequencies_converge_to_the_exact_ones_with_second_order_in_hex8(self):
        self.assertGreater(self.rate("C3D8I"), 1.9)


class MembraneFV32(unittest.TestCase):
    def test_hex20_and_tet10_of_16_by_8_bricks_meet_the_reference(self):
        for kind, limit in (("C3D20", 5e-5), ("C3D20R", 2e-4), ("C3D10", 5e-4)):
            with self.subTest(cell=kind):
                self.assertLess(np.abs(nafems.fv32(kind, (16, 8, 1)) / nafems.FV32 - 1).max(), limit)

    def test_u_z_held_everywhere_would_be_plane_strain_and_off_by_several_percent(self):
        deck = nafems_mesh.membrane("C3D20", (8, 4, 1))
        grid = nafems_mesh.Grid("C3D20", (8, 4, 1), None)
        strain = deck + "*BOUNDARY\n" + "".join(f"{node}, 3, 3\n" for node in grid.nodes.values())
        self.assertGreater(np.abs(nafems.frequencies(strain, 6) / nafems.FV32 - 1).max(), 0.03)


class EllipseLE10(unittest.TestCase):
    def test_stress_at_d_is_within_the_accuracy_of_each_mesh(self):
        for kind, limit in (("C3D20R", 0.005), ("C3D15", 0.005), ("C3D10", 0.01), ("C3D8I", 0.05)):
            with self.subTest(cell=kind):
                self.assertLess(abs(nafems.le10(kind, (8, 12, 8)) / nafems.LE10 - 1), limit)

    def test_stress_of_hex20_converges_to_the_reference(self):
        error = [abs(nafems.le10("C3D20", (2 * k, 3 * k, 2 * k)) / nafems.LE10 - 1) for k in (1, 2, 4)]
        self.assertGreater(error[0] / error[1], 3)
        self.assertGreater(error[1] / error[2], 3)
        self.assertLess(error[2], 0.015)

    def test_calculix_finds_the_same_stress_from_the_same_deck(self):
        ours, theirs = nafems.le10("C3D20R", (4, 6, 2)), nafems.calculix_le10("C3D20R", (4, 6, 2), results("ellipse", 6))
        self.assertLess(abs(ours / theirs - 1), 2e-4)  # 2 x 2 points for pressure, constants of four digits


if __name__ == "__main__":
    unittest.main(verbosity=2)
