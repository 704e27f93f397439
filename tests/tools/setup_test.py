# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/setup and tools/packages.txt: what is requested from apt on each release, with an apt-get and a dpkg-query of the test."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
PHASES = "build mpi demo check browser docs lint tidy deb bench".split()
FAKES = {"dpkg-query": "exit 1", "id": "echo 0",
         "apt-get": 'case "$*" in *nonesuch*) echo "E: Unable to locate package nonesuch" >&2; exit 100;; *) echo "$*" >>"$LOG";; esac'}


class Setup(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="clatter-setup-")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        for name in ("setup", "packages.txt"):
            shutil.copy(TOOLS / name, self.folder)
        (self.folder / "bin").mkdir()
        for name, script in FAKES.items():
            (self.folder / "bin" / name).write_text(f"#!/bin/sh\n{script}\n")
            (self.folder / "bin" / name).chmod(0o755)

    def setup(self, release, *phases):
        """(exit code, packages requested, standard error)"""
        log = self.folder / "log"
        log.unlink(missing_ok=True)
        done = subprocess.run([self.folder / "setup", *phases], text=True, capture_output=True, env={
            **os.environ, "CLATTER_DEBIAN": release, "LOG": str(log), "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}"})
        requested = log.read_text().splitlines()[-1].partition(" -y ")[2].split() if log.exists() else []
        return done.returncode, requested, done.stderr

    def add(self, line):
        with open(self.folder / "packages.txt", "a") as file:
            file.write(line + "\n")

    def test_the_releases_differ_by_calculix_alone(self):
        (code, twelve, said), (again, thirteen, _) = (self.setup(release, *PHASES) for release in ("12", "13"))
        self.assertEqual((code, again), (0, 0), said)
        self.assertEqual([name for name in twelve if name not in thirteen], ["calculix-ccx"])
        self.assertEqual([name for name in thirteen if name not in twelve], [])
        self.assertEqual(len(twelve), len(set(twelve)))

    def test_a_phase_has_its_own_packages(self):
        self.assertEqual(self.setup("13", "lint")[1], ["clang-format"])
        self.assertIn("python3-markdown-it", self.setup("12", "check")[1])

    def test_a_package_that_the_release_does_not_have_is_an_error(self):
        self.add("nonesuch lint a typing error")
        code, _, said = self.setup("13", "lint")
        self.assertEqual(code, 4)
        self.assertIn("Unable to locate package nonesuch", said)

    def test_a_wrong_phase_or_release_is_refused_with_its_line(self):
        for word in ("chek", "check@1", "check@14"):
            with self.subTest(word=word):
                shutil.copy(TOOLS / "packages.txt", self.folder)
                self.add(f"nonesuch {word} a typing error")
                code, requested, said = self.setup("12", "lint")
                self.assertEqual((code, requested), (2, []))
                self.assertRegex(said, rf"packages.txt:\d+: found {word}, expected")


if __name__ == "__main__":
    unittest.main(verbosity=2)
