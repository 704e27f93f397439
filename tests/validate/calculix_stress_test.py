# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodal stresses agree with CalculiX's own on every deck of the table, within what the table allows."""
import unittest

import calculix_decks
import calculix_stress


@unittest.skipUnless(calculix_decks.DECKS.exists(), "package calculix-ccx-test is not installed")
class CalculixStress(unittest.TestCase):
    def test_every_deck_agrees_within_the_digits_printed_or_its_named_difference(self):
        for name, _, nodes, error, limit, _ in calculix_stress.table():
            with self.subTest(deck=name):
                self.assertGreater(nodes, 50)
                self.assertLess(error, limit)


if __name__ == "__main__":
    unittest.main(verbosity=2)
