# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/launch.cpp: an installation runs the build for the processor at hand."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

LAUNCHER = pathlib.Path(os.environ["CLATTER_BUILD"]) / "tools/clatter-launch"


def levels_of_glibc():
    """The levels of x86-64 that the dynamic loader supports here. /proc/cpuinfo does not list all that a processor has."""
    said = subprocess.run(["/lib64/ld-linux-x86-64.so.2", "--help"], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"^  (x86-64-v\d) \(supported", said, re.MULTILINE))


@unittest.skipUnless(os.uname().machine == "x86_64", "the levels are those of x86-64")
class Launcher(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        (self.root / "bin").mkdir()
        self.program = self.root / "bin/clatter-some"
        shutil.copy(LAUNCHER, self.program)

    def install(self, *levels):
        for level in levels:
            build = self.root / "libexec/clatter" / level / "clatter-some"
            build.parent.mkdir(parents=True)
            build.write_text(f'#!/bin/sh\necho {level} "$@"\nexit 3\n')
            build.chmod(0o755)

    def run_program(self, level=None):
        environment = {key: value for key, value in os.environ.items() if key != "CLATTER_LEVEL"}
        if level:
            environment["CLATTER_LEVEL"] = level
        return subprocess.run([self.program, "--count", "a b"], env=environment, capture_output=True, text=True)

    def test_the_highest_level_of_the_processor_runs_with_arguments_and_exit_code(self):
        self.install("x86-64", "x86-64-v3")
        done = self.run_program()
        level = "x86-64-v3" if "x86-64-v3" in levels_of_glibc() else "x86-64"
        self.assertEqual(done.stdout, f"{level} --count a b\n")
        self.assertEqual(done.returncode, 3)

    def test_a_level_can_be_selected(self):
        self.install("x86-64", "x86-64-v3")
        for level in ("x86-64", "x86-64-v3"):
            self.assertEqual(self.run_program(level).stdout, f"{level} --count a b\n")

    def test_an_installation_for_all_processors_runs_on_new_ones(self):
        self.install("x86-64")
        self.assertEqual(self.run_program().stdout, "x86-64 --count a b\n")

    def test_an_installation_without_a_suitable_build_is_an_error(self):
        self.install("x86-64")
        done = self.run_program("x86-64-v9")
        self.assertEqual(done.returncode, 4)
        self.assertEqual(done.stderr, f"error: clatter-some: found no build for x86-64-v9 in {self.root}/libexec/clatter, "
                                      "expected x86-64-v3 or x86-64\n")


if __name__ == "__main__":
    unittest.main()
