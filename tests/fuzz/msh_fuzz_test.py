# SPDX-License-Identifier: GPL-3.0-or-later
"""A minute of libFuzzer over the scan of Gmsh files."""
import sys
import unittest

from fuzz_run import run_fuzzer


class MshFuzz(unittest.TestCase):
    def test_no_text_breaks_the_scan(self):
        run_fuzzer(self, 'msh')


if __name__ == '__main__':
    sys.exit(unittest.main())
