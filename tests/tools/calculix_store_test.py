# SPDX-License-Identifier: GPL-3.0-or-later
"""calculix.py: what is stored takes the part of ccx, and a result that does not fit is an error that says how to store it again."""
import json
import pathlib
import re
import tempfile
import unittest
from unittest import mock

import calculix
import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
# A ccx whose result is a row of the first numbers of the deck's lines.
CCX = """#!/bin/sh
[ "$1" = -v ] && { echo "This is Version 2.20"; exit; }
grep -q broken "$1.inp" && { echo "*ERROR in the deck"; exit 201; }
cut -d, -f1 "$1.inp" >"$1.dat"
echo "Job finished"
"""


def values(folder):
    return {"hz": np.array([float(line) for line in calculix.lines(folder)])}


class Store(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="clatter-store-")
        self.addCleanup(scratch.cleanup)
        folder = pathlib.Path(scratch.name)
        self.ccx = folder / "ccx"
        self.ccx.write_text(CCX)
        self.ccx.chmod(0o755)
        self.patch(mock.patch.object(calculix, "FOLDER", folder))
        self.results = calculix.Results("some_test.py")

    def patch(self, one):
        one.start()
        self.addCleanup(one.stop)

    def of(self, deck, program=True, store=False, **options):
        with mock.patch.object(calculix, "PROGRAM", str(self.ccx) if program else None), \
                mock.patch.dict("os.environ", CLATTER_STORE_CALCULIX="1" if store else ""):
            return self.results.of("modes", deck, values, **options)["hz"].tolist()

    def assert_fails(self, *says, **arguments):
        with self.assertRaises(AssertionError) as raised:
            self.of(**arguments)
        for words in says:
            self.assertIn(words, str(raised.exception))

    def test_a_stored_result_is_found_without_ccx(self):
        self.assertEqual(self.of("62.5, Hz\n-1e-20\n", store=True), [62.5, -1e-20])
        self.assertEqual(self.of("62.5, Hz\n-1e-20\n", program=False), [62.5, 0.0])
        self.assertEqual(self.of("62.5, Hz\n-1e-20\n"), [62.5, -1e-20])

    def test_only_what_is_kept_is_stored(self):
        def keep(all_of_them):
            return {"hz": all_of_them["hz"][:1]}
        self.assertEqual(self.of("1.23456789\n2\n", store=True, keep=keep, digits=3), [1.23456789, 2.0])
        self.assertEqual(self.of("1.23456789\n2\n", program=False), [1.23])

    def test_a_missing_result_or_another_deck_fails_with_the_command(self):
        command = "store it by: CLATTER_STORE_CALCULIX=1 ctest --test-dir build/release -R '^some_test'"
        self.assert_fails("modes: no result is stored", command, deck="1\n", program=False)
        self.assert_fails("modes: no result is stored", command, deck="1\n")
        self.of("1\n", store=True)
        self.assert_fails("that of another deck", command, deck="1 \n", program=False)
        self.assert_fails("that of another deck", command, deck="1 \n")

    def test_a_stored_result_that_ccx_does_not_find_fails(self):
        self.of("1.000001\n", store=True)
        text = self.results.path.read_text()
        self.results.path.write_text(text.replace("1.000001", "1.000003"))
        self.assert_fails("ccx 2.20 finds other values than are stored", "-R '^some_test'", deck="1.000001\n")
        self.results.path.write_text(text.replace("1.000001", "1.0"))  # one unit of the last digit
        self.assertEqual(self.of("1.000001\n"), [1.000001])

    def test_decks_of_the_same_result_share_it_and_others_replace_it(self):
        for deck in ("1\n", "1, with a comment\n"):
            self.of(deck, store=True)
        self.assertEqual(self.of("1\n", program=False), [1.0])
        self.of("2\n", store=True)
        self.assertEqual(self.of("2\n", program=False), [2.0])
        self.assert_fails("that of another deck", deck="1\n", program=False)

    def test_an_error_of_ccx_is_shown(self):
        self.assert_fails("ccx ended with 201", "*ERROR in the deck", deck="broken\n")

    def test_nothing_is_stored_without_ccx(self):
        self.assert_fails("package calculix-ccx is not installed", deck="1\n", program=False, store=True)


class Stored(unittest.TestCase):
    def test_the_files_are_small_and_belong_to_tests(self):
        paths = sorted(calculix.FOLDER.glob("*.json"))
        self.assertGreater(len(paths), 5)
        self.assertLess(sum(path.stat().st_size for path in paths), 300_000)
        for path in paths:
            with self.subTest(file=path.name):
                self.assertEqual(len([*SOURCE.glob(f"tests/*/{path.stem}.py")]), 1)
                self.assertEqual(json.loads(path.read_text())["made by"], calculix.Results(path.stem).command)

    def test_no_other_test_in_python_starts_ccx(self):
        others = [str(path.relative_to(SOURCE)) for path in (SOURCE / "tests").rglob("*.py")
                  if path.name not in ("calculix.py", "calculix_store_test.py") and re.search(r"""["']ccx["']""", path.read_text())]
        self.assertEqual(others, [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
