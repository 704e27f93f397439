# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter study` on a deck that is not ours: its budget closes, its element rules, and its finest first frequency is that of beam theory."""
import math
import os
import pathlib
import sys
import tempfile
import unittest

import calculix_decks
import deck_study
from stage_run import BIN

sys.path.insert(0, str(deck_study.CLATTER_MK.parent))
from clatter_tools.study import run  # noqa: E402


@unittest.skipUnless(calculix_decks.DECKS.exists(), "package calculix-ccx-test is not installed")
class DeckStudy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="clatter-deck-")
        cls.addClassCleanup(scratch.cleanup)
        os.environ["CLATTER_BIN"], os.environ["CLATTER_FLAGS"] = str(BIN), "--quiet"
        cls.folder = pathlib.Path(scratch.name)
        cls.study = run.make(deck_study.write(cls.folder), 2)

    def test_the_budgets_are_closed(self):
        for quantity, budget in enumerate(self.study.budgets):
            with self.subTest(quantity=self.study.plan.quantities[quantity].name):
                self.assertLess(abs(math.log2(budget.closure())), 1.0)

    def test_full_integration_is_too_stiff_and_rules_the_error(self):
        for quantity, sign in enumerate((1.0, -1.0, -1.0)):
            parts = {self.study.plan.settings[number].name: sign * self.study.scaled(quantity, part.number()) for number, part in self.study.budgets[quantity].parts}
            element = parts.pop("element")
            self.assertGreater(element, 0.04)
            self.assertLess(max(map(abs, parts.values())), 0.2 * element)

    def test_the_finest_first_frequency_is_that_of_beam_theory(self):
        # Euler and Bernoulli's cantilever of thickness 1 mm, whose clamp lets the section contract; shear and rotatory inertia take off half a percent.
        f1 = 1.8751**2 / (2.0 * math.pi) * 1e-3 / (8e-3) ** 2 * math.sqrt(210e9 / (12.0 * 7800.0))
        self.assertLess(abs(self.study.references[0].number() / f1 - 1.0), 0.01)

    def test_the_pipeline_has_the_deck_s_own_cells(self):
        self.assertEqual(calculix_decks.frequencies(calculix_decks.reference(deck_study.DECK, ".dat.ref")).size, 10)
        reference = calculix_decks.frequencies(calculix_decks.reference(deck_study.DECK, ".dat.ref"))[0]
        self.assertLess(abs(self.study.values[0][0].number() / reference - 1.0), 1e-6)


if __name__ == "__main__":
    unittest.main(verbosity=2)
