# SPDX-License-Identifier: GPL-3.0-or-later
"""Decks that FreeCAD writes agree with CalculiX in all digits, or for a reason that docs/validation.md states."""
import unittest

import calculix
import freecad_decks


@unittest.skipUnless(freecad_decks.FOLDER.exists(), "package freecad-common is not installed")
@calculix.required("the decks are not ours to store")
class FreecadDecks(unittest.TestCase):
    def test_every_deck_agrees_or_says_why(self):
        rows = [freecad_decks.row_of(path) for path in sorted(freecad_decks.FOLDER.glob("*.inp"))]
        self.assertGreater(len(rows), 30)
        for name, what, difference, verdict, remark in rows:
            with self.subTest(deck=name, compared=what, difference=difference):
                self.assertTrue(verdict != "differs" or remark)


if __name__ == "__main__":
    unittest.main(verbosity=2)
