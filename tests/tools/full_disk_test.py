# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `clatter` on a full disk: pictures, pages, tables and standard output (hard case P16)."""
import contextlib
import io
import os
import pathlib
import resource
import subprocess
import tempfile
import unittest

import synthetic
import synthetic_drive
from clatter_tools.command_line import main
from observed import observed

CLATTER = pathlib.Path(__file__).resolve().parents[2] / "tools/clatter"
LIMIT = 300  # bytes of a file
WRITERS = {
    "piston.png": ["plot", "piston", "slap.run.h5", "-o", "piston.png"],
    "report.html": ["report", ".", "--html"],
    "gas.csv": ["motored-cycle", "gas.csv", "--bore-mm", "107", "--stroke-mm", "130", "--rod-mm", "210"],
    "speeds/sweep.mk": ["sweep", "a.run.toml", "engine.speed_rpm=1000:9000:100", "-o", "speeds"],
    "sweep.h5": ["collect", "."],
}


class HardP16ToolsOnAFullDisk(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        synthetic.write_run(self.folder / "slap.run.h5")
        synthetic_drive.write_drive(self.folder / "2000.run.h5", rpm=2000.0)
        (self.folder / "2000.run.toml").write_text('base = "a.run.toml"\nengine.speed_rpm = 2000\n')
        (self.folder / "speeds").mkdir()
        (self.folder / "a.run.toml").write_text("engine.speed_rpm = 1000\n")
        self.addCleanup(os.chdir, pathlib.Path.cwd())
        os.chdir(self.folder)

    def run_command(self, arguments, limit=None):
        """(exit code, standard error) of a command line in this process, its files at most `limit` bytes long."""
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        said = io.StringIO()
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(said):
            try:
                if limit is not None:
                    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, before[1]))
                code = main(arguments, rules="clatter.mk")
            finally:
                resource.setrlimit(resource.RLIMIT_FSIZE, before)
        return code, said.getvalue()

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def test_pictures_pages_and_tables_are_complete_or_absent(self):
        for name, arguments in WRITERS.items():
            with self.subTest(file=name):
                (self.folder / name).write_text("the older file")
                before = self.names()
                code, said = self.run_command(arguments, LIMIT)
                self.assertEqual(code, 4, said)
                self.assertRegex(said, r"^clatter: error: \S+: cannot be written: File too large\n$")
                self.assertEqual(self.names(), before)
                self.assertEqual((self.folder / name).read_text(), "the older file")
                (self.folder / name).unlink()
        observed(f"refused: {said.partition('error: ')[2].strip()}")

    def test_the_same_commands_write_their_files_where_there_is_room(self):
        for name, arguments in WRITERS.items():
            with self.subTest(file=name):
                code, said = self.run_command(arguments)
                self.assertEqual(code, 0, said)
                self.assertGreater((self.folder / name).stat().st_size, LIMIT)
                self.assertEqual(list(self.folder.glob("*.part")), [])

    def test_standard_output_that_is_full_is_an_error_and_one_that_nobody_reads_is_none(self):
        for redirection, code, said in ((">/dev/full", 4, "clatter: error: standard output: cannot be written: No space left on device\n"),
                                        ("| true", 0, ""), (">&-", 0, "")):
            with self.subTest(redirection=redirection):
                done = subprocess.run(["/bin/bash", "-c", f"set -o pipefail; {CLATTER} info *.run.h5 {redirection}"], capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (code, said))


if __name__ == "__main__":
    unittest.main()
