# SPDX-License-Identifier: GPL-3.0-or-later
"""find_package(clatter): the programs of samples/cpp are built against an installation, and run."""
import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("CLATTER_BUILD", SOURCE / "build/release"))
SANITIZED = "CLATTER_SANITIZE:BOOL=ON" in (BUILD / "CMakeCache.txt").read_text()
PROGRAMS = "matrix_modes", "condense_part", "deck_to_rom", "mass_on_spring", "slider_film", "expand_field"


def cmake(*arguments):
    return subprocess.run(["cmake", *arguments], capture_output=True, text=True)


class InstalledLibraries(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.prefix = cls.folder / "installed"
        done = cmake("--install", BUILD, "--prefix", cls.prefix)
        assert done.returncode == 0, done.stderr

    def configure(self, source, build):
        return cmake("-S", source, "-B", self.folder / build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                     f"-DCMAKE_PREFIX_PATH={self.prefix}", *(["-DCMAKE_CXX_FLAGS=-fsanitize=address,undefined"] if SANITIZED else []))

    def test_the_samples_need_nothing_but_the_installation(self):
        source = self.folder / "samples"
        source.mkdir()
        for path in (SOURCE / "samples/cpp").iterdir():
            (source / path.name).write_bytes(path.read_bytes())
        done = self.configure(source, "build")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        done = cmake("--build", self.folder / "build")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for name in PROGRAMS:
            self.assertTrue((self.folder / "build" / name).exists(), name)
        slider = subprocess.run([self.folder / "build/slider_film", "200"], capture_output=True, text=True)
        self.assertRegex(slider.stdout, r"load \S+ N, exact \S+ N")
        mass = subprocess.run([self.folder / "build/mass_on_spring", self.folder / "mass.run.h5"], capture_output=True, text=True)
        self.assertEqual(mass.returncode, 0, mass.stderr)
        self.assertIn("energy residue", mass.stdout)

    def test_a_component_that_does_not_exist_is_named(self):
        source = self.folder / "wrong"
        source.mkdir()
        (source / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(wrong CXX)\n"
                                               "find_package(clatter REQUIRED COMPONENTS core condence)\n")
        done = self.configure(source, "wrong_build")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("condence", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
