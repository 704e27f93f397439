# SPDX-License-Identifier: GPL-3.0-or-later
"""A minute of libFuzzer over the reader of MED files."""
import sys
import unittest

from fuzz_run import run_fuzzer


class MedFuzz(unittest.TestCase):
    def test_no_content_breaks_the_reader(self):
        run_fuzzer(self, 'med')


if __name__ == '__main__':
    sys.exit(unittest.main())
