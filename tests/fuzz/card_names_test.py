# SPDX-License-Identifier: GPL-3.0-or-later
"""The fuzzers know every card of the readers' tables."""
import pathlib
import sys
import tempfile
import unittest

import fuzz_run


class CardNames(unittest.TestCase):
    def test_each_card_has_a_seed_and_an_entry_of_the_dictionary(self):
        for reader, some in (('nastran', ('CHEXA', 'RBE3', 'SUBCASE')), ('abaqus', ('SOLID SECTION', 'C3D8'))):
            with self.subTest(reader=reader), tempfile.TemporaryDirectory() as folder:
                names = fuzz_run.card_names(reader)
                self.assertGreater(len(names), 90)
                fuzz_run.write_seeds(reader, pathlib.Path(folder))
                words = (pathlib.Path(folder) / 'dictionary').read_text().splitlines()
                for name in some:
                    self.assertIn(f'"{name}"', words)
                texts = [path.read_text() for path in (pathlib.Path(folder) / 'seeds').iterdir()]
                self.assertTrue(any(some[0] + ',' in text for text in texts))
                self.assertGreater(len(texts), len(names) + 100)  # those of the tests as well


if __name__ == '__main__':
    sys.exit(unittest.main())
