# SPDX-License-Identifier: GPL-3.0-or-later
"""A minute of libFuzzer over the reader of .unv files."""
import sys
import unittest

from fuzz_run import run_fuzzer


class UnvFuzz(unittest.TestCase):
    def test_no_text_breaks_the_reader(self):
        run_fuzzer(self, 'unv')


if __name__ == '__main__':
    sys.exit(unittest.main())
