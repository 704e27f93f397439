# SPDX-License-Identifier: GPL-3.0-or-later
"""What the end of `make check` says about skipped tests, from a run of CTest over programs that skip in each way."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import skipped

PYTHON = """import unittest
class A(unittest.TestCase):
    def test_a(self):
        '''Has a docstring, which unittest prints as well.'''
        self.skipTest("gmsh's mesh")
    def test_b(self):
        for k in range(2):
            with self.subTest(k=k):
                self.skipTest("no ccx")
    def test_c(self):
        pass
@unittest.skip("no ccx")
class B(unittest.TestCase):
    def test_d(self):
        pass
class C(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        raise unittest.SkipTest("not built")
    def test_e(self):
        pass
unittest.main()
"""
GOOGLE = "/a/b_test.cpp:17: Skipped\nno ccx\n\n[  SKIPPED ] Cantilever.Hz (0 ms)\n"


class Skipped(unittest.TestCase):
    def run_ctest(self, **programs):
        with tempfile.TemporaryDirectory(prefix="clatter-skipped-") as folder:
            for name, text in programs.items():
                (pathlib.Path(folder) / f"{name}.py").write_text(text)
            (pathlib.Path(folder) / "CTestTestfile.cmake").write_text("".join(
                f'add_test({name} "{sys.executable}" "{folder}/{name}.py" -v)\nset_tests_properties({name} PROPERTIES SKIP_RETURN_CODE 77)\n'
                for name in programs))
            subprocess.run(["ctest", "-j2"], cwd=folder, check=True, capture_output=True)
            done = subprocess.run([skipped.__file__, folder], check=True, capture_output=True, text=True)
        return done.stdout.splitlines()

    def test_every_way_to_skip_is_counted_with_its_reason(self):
        self.assertEqual(self.run_ctest(
            methods=PYTHON, program="import sys\nprint('skipped: Chromium is not installed')\nsys.exit(77)", google=f"print({GOOGLE!r})"), [
            "skipped: 7 tests",
            "skipped: 4, no ccx (google, methods)",
            "skipped: 1, Chromium is not installed (program)",
            "skipped: 1, gmsh's mesh (methods)",
            "skipped: 1, not built (methods)"])

    def test_a_run_that_skipped_nothing_says_so(self):
        self.assertEqual(self.run_ctest(speaks="print('nothing was skipped, lines such as skipped: this do not count')"),
                         ["skipped: no test"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
