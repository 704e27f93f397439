# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that a TOML file names, and scenes that sweep.mk lists: what the rules for Snakemake depend on."""
import contextlib
import pathlib
import tempfile
import unittest

from clatter_tools import named_files, sweep, sweep_list


class InAFolder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.enterContext(contextlib.chdir(scratch.name))

    def write(self, path, text):
        path = pathlib.Path(path)
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)


class NamedFiles(InAFolder):
    def test_artefacts_count_before_they_exist_and_other_files_when_they_do(self):
        self.write("cycle.csv", "")
        self.write("film", "")
        self.write("slap.run.toml", 'title = "no.file"\n[gas]\ntable = "cycle.csv"\nlubrication = "film"\n[block]\nrom = "block.rom.h5"\n'
                   '[[body]]\nrom = "piston.rom.h5"\n[[body]]\nsizes = [1, "./block.rom.h5"]\n')
        self.assertEqual(named_files.of("slap.run.toml"), ["block.rom.h5", "cycle.csv", "piston.rom.h5"])

    def test_of_a_base_only_what_is_not_changed_counts_from_its_own_folder(self):
        self.write("parts/slap.run.toml", '[block]\nrom = "block.rom.h5"\n[piston]\nrom = "piston.rom.h5"\n[[body]]\nrom = "head.rom.h5"\n')
        self.write("speeds/1000.run.toml", 'base = "../parts/slap.run.toml"\npiston.rom = "other.rom.h5"\nbody = []\n')
        self.assertEqual(named_files.of("speeds/1000.run.toml"), ["parts/block.rom.h5", "parts/slap.run.toml", "speeds/other.rom.h5"])

    def test_a_file_that_is_missing_names_nothing_and_a_circle_is_refused(self):
        self.assertEqual(named_files.of("no.run.toml"), [])
        self.write("a.run.toml", 'base = "a.run.toml"\n')
        with self.assertRaisesRegex(ValueError, r"^a\.run\.toml: found a base that is its own base$"):
            named_files.of("a.run.toml")

    def test_a_dependency_file_gives_what_still_exists(self):
        self.write("two words.bdf", "")
        self.write("block.mesh.h5.d", "block.mesh.h5: two words.bdf gone.bdf\ntwo words.bdf:\ngone.bdf:\n")
        self.assertEqual(named_files.of_dependency_file("block.mesh.h5.d"), ["two words.bdf"])
        self.assertEqual(named_files.of_dependency_file("no.d"), [])


class SweepList(InAFolder):
    def test_scenes_and_field_settings_come_back_in_their_order(self):
        self.write("slap.run.toml", "x = 1\n")
        for field in ("speeds.field.toml", None):
            sweep.write_files(pathlib.Path("slap.run.toml"), pathlib.Path("speeds"), ["engine.speed_rpm"], [("900",), ("1000",)], field)
            self.assertEqual(sweep_list.names(pathlib.Path("speeds")), ["900", "1000"])
            self.assertEqual(sweep_list.field_settings(pathlib.Path("speeds")), field)
        self.assertIsNone(sweep_list.names(pathlib.Path("elsewhere")))


if __name__ == "__main__":
    unittest.main()
