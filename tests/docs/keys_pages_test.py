# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/keys/*.md say what the programs read today."""
import pathlib
import tempfile
import unittest

import repository

from clatter_tools.keys import files, pages

KEYS = repository.SOURCE / "docs/keys"


class KeysPages(unittest.TestCase):
    def test_they_are_those_that_make_keys_pages_writes(self):
        tables, missing = files.read()
        with tempfile.TemporaryDirectory() as folder:
            written = pages.write(tables, folder)
            self.assertGreaterEqual(len(written), len(pages.PAGES) - len(missing))
            for path in written:
                current = (KEYS / path.name).read_text(encoding="utf-8") if (KEYS / path.name).exists() else ""
                self.assertEqual(current, path.read_text(encoding="utf-8"), f"run: make keys-pages (docs/keys/{path.name})")

    def test_there_is_no_other_page(self):
        self.assertEqual({path.stem for path in KEYS.glob("*.md")} - set(pages.PAGES), set())


if __name__ == "__main__":
    unittest.main()
