# SPDX-License-Identifier: GPL-3.0-or-later
"""Every deck of the table in docs/validation.md agrees with its reference within what the table allows."""
import pathlib
import tempfile
import unittest

import calculix_decks


@unittest.skipUnless(calculix_decks.DECKS.exists(), "package calculix-ccx-test is not installed")
class CalculixDecks(unittest.TestCase):
    def test_every_deck_agrees_within_the_digits_printed_or_its_named_difference(self):
        rows = calculix_decks.table()
        left_out = calculix_decks.left_out()
        self.assertGreaterEqual(len(rows) + len(left_out), 90)
        self.assertLess(len(left_out), 5)
        for name, reason in left_out.items():
            with self.subTest(deck=name):
                self.skipTest(reason)
        for name, _, quantity, count, error, limit, _ in rows:
            with self.subTest(deck=name):
                self.assertGreater(count, 0)
                self.assertLess(error, limit, quantity)


    def test_every_refusal_of_the_package_names_file_and_line_or_cells(self):
        with tempfile.TemporaryDirectory(prefix="clatter-ccx-") as folder:
            messages = calculix_decks.all_decks(pathlib.Path(folder))
        self.assertGreater(len(messages), 300)
        for name, text in messages.items():
            lines = [line.strip() for line in text.splitlines()]
            if lines and lines[0].endswith("refusals:"):
                lines = lines[1:]
            for line in lines:
                with self.subTest(deck=name, message=line):
                    # Invalid cells are named by their numbers and positions instead.
                    self.assertRegex(line.removeprefix("clatter-mesh: clatter-mesh: error: "),
                                     rf"^{name}\.inp(:\d+: |: \d+ of \d+ cells are inverted or folded)")


if __name__ == "__main__":
    unittest.main(verbosity=2)
