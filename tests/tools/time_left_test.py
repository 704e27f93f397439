# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/time_left: a build's progress with the time left."""
import pathlib
import subprocess
import sys
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools/time_left"


def run_printing(text, code=0):
    program = f"import sys; sys.stdout.write({text!r}); sys.exit({code})"
    return subprocess.run([TOOL, sys.executable, "-c", program], capture_output=True, text=True)


class TimeLeft(unittest.TestCase):
    def test_it_follows_from_the_steps_done(self):
        done = run_printing("[0/246 0.0] Checking\n[12/246 35.2] Building X\n[240/246 700.123] Linking Y\n")
        self.assertEqual(done.stdout, "[0/246, unknown time left] Checking\n"
                         "[12/246, about 11 min left] Building X\n[240/246, about 17 s left] Linking Y\n")

    def test_other_lines_and_the_exit_code_are_unchanged(self):
        text = "ninja: error: \\x [1/2] 'a b'\n  note: [3/4 5.6] \n\nlast line"
        done = run_printing(text, 3)
        self.assertEqual(done.stdout, text + "\n")
        self.assertEqual(done.returncode, 3)


if __name__ == "__main__":
    unittest.main()
