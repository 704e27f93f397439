"""Every deck of the table in docs/validation.md agrees with its reference within what the table allows."""
import unittest

import calculix_decks


@unittest.skipUnless(calculix_decks.DECKS.exists(), "package calculix-ccx-test is not installed")
class CalculixDecks(unittest.TestCase):
    def test_every_deck_agrees_within_the_digits_printed_or_its_named_difference(self):
        rows = calculix_decks.table()
        self.assertGreaterEqual(len(rows), 25)
        for name, _, quantity, count, error, limit, _ in rows:
            with self.subTest(deck=name):
                self.assertGreater(count, 0)
                self.assertLess(error, limit, quantity)


if __name__ == "__main__":
    unittest.main(verbosity=2)
