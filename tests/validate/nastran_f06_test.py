# SPDX-License-Identifier: GPL-3.0-or-later
"""Nastran decks with printed results: every value agrees to its digits, and the page says what is refused."""
import re
import unittest

import docs_table
import nastran_f06


def documented():
    """{deck: verdict} of the table in docs/validation.md."""
    text = docs_table.PAGE.read_text().split("<!-- nastran_f06 -->\n", 1)[1].split("<!-- end -->", 1)[0]
    rows = [re.split(r"(?<!\\\\)\|", line)[1:-1] for line in text.splitlines() if line.startswith("| ")][1:]
    return nastran_f06.verdicts([nastran_f06.Row(*(cell.strip() for cell in row)) for row in rows])


@unittest.skipUnless(nastran_f06.DECKS.exists(), f"{nastran_f06.DECKS} is absent")
class NastranDecks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.rows = nastran_f06.all_rows()

    def test_no_value_differs_by_more_than_its_printed_digits_allow(self):
        compared = [row for row in self.rows
                    if row.verdict in ("agrees", "differs") and row.deck not in nastran_f06.EXPLAINED]
        self.assertGreater(len(compared), 10)
        for row in compared:
            with self.subTest(deck=row.deck):
                self.assertEqual(row.verdict, "agrees", f"{row.figure}: {row.ours}, printed {row.theirs}")

    def test_the_page_has_the_verdict_of_each_deck(self):
        self.assertEqual(documented(), nastran_f06.verdicts(self.rows), "tests/validate/nastran_f06.py --write")


if __name__ == "__main__":
    unittest.main(verbosity=2)
