# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter-mesh as a process ends properly on every part: a short seeded run, and a long one for `make validate`."""
import os
import sys
import unittest

import mesh_process_fuzz as fuzz
from observed import expect_at_most


class MeshProcess(unittest.TestCase):
    def check(self, runs):
        done = list(runs)
        print(fuzz.table(done), file=sys.stderr)
        self.assertGreater(len(done), 0)
        expect_at_most(self, f"faults of {len(done)} runs", sum(bool(run.faults) for run in done), 0)
        self.assertEqual([], [(run.label(), run.faults, run.said) for run in done if run.faults])


class HardN17Short(MeshProcess):
    def test_a_few_parts_in_seconds(self):
        self.check(fuzz.runs(14, 7, time_limit=2, seconds=12, quick=True))


class Long(MeshProcess):
    def test_many_parts(self):
        count = int(os.environ.get('CLATTER_FUZZ_RUNS', '200'))
        self.check(fuzz.runs(count, 1, time_limit=int(os.environ.get('CLATTER_FUZZ_TIME_LIMIT', '20'))))


if __name__ == '__main__':
    unittest.main(verbosity=2)
