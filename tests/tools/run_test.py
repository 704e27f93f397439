# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter run: targets, what it finds without PATH, lines on a terminal and in a pipe, the summary."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import synthetic
from clatter_command import clatter
from clatter_tools.run import screen
from pseudo_terminal import open_terminal

CLATTER = pathlib.Path(__file__).resolve().parents[2] / "tools/clatter"
STAGES = ("mesh", "assembly", "modal", "condense", "dynamics", "recover")
# Copies an artefact that is ready; says what a stage says.
STAND_IN = """#!/bin/sh
echo "result of $1"
echo "clatter-x: warning: thin cells in $1" >&2
grep -q broken "$1" && { echo "clatter-x: error: $1:1: found broken" >&2; exit 2; }
while [ "$1" != -o ]; do shift; done
cp ready.h5 "$2"
"""
MAKEFILE = """include $(shell clatter rules)
.DEFAULT_GOAL := all
all: a.mesh.h5
\t@echo all is made
kept: ; @$(call clatter_run,mesh) a.mesh.toml -o b.mesh.h5 > kept.txt
where: ; @echo $(CLATTER_BIN)
"""


class Run(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="clatter-run-test-")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.bin = self.folder / "programs"
        self.bin.mkdir()
        for stage in STAGES:
            (self.bin / f"clatter-{stage}").write_text(STAND_IN)
            (self.bin / f"clatter-{stage}").chmod(0o755)
        (self.folder / "Makefile").write_text(MAKEFILE)
        (self.folder / "a.mesh.toml").write_text("good\n")
        synthetic.write_mesh(self.folder / "ready.h5")
        self.environment = {**os.environ, "CLATTER_BIN": str(self.bin), "MAKEFLAGS": ""}

    def pipe(self, *arguments):
        return subprocess.run([sys.executable, "-B", CLATTER, "run", *arguments], cwd=self.folder, text=True, capture_output=True,
                              env=self.environment)

    def terminal(self, *arguments):
        """(exit code, what a terminal of 100 columns gets)."""
        ours, theirs = open_terminal()
        run = subprocess.Popen([sys.executable, "-B", CLATTER, "run", *arguments], cwd=self.folder,
                               stdin=theirs, stdout=theirs, stderr=theirs, env={**self.environment, "COLUMNS": "100"})
        os.close(theirs)
        text = b""
        while True:
            try:
                part = os.read(ours, 65536)
            except OSError:  # the last process that had the terminal is gone
                break
            if not part:
                break
            text += part
        os.close(ours)
        return run.wait(), text.decode()

    def test_a_pipe_gets_all_lines_and_a_summary_of_what_was_made(self):
        done = self.pipe()
        self.assertEqual(done.returncode, 0, done.stderr)
        for expected in ("result of a.mesh.toml\n", "all is made\n"):
            self.assertIn(expected, done.stdout)
        self.assertNotIn("\x1b", done.stdout)
        self.assertRegex(done.stdout, r"\nmade\n  file +stage +seconds +peak GiB +judged by\n  a\.mesh\.h5 +mesh ")
        self.assertNotIn("\nmade\n", self.pipe().stdout)  # nothing was left to make

    def test_a_terminal_gets_a_line_a_stage_with_warnings_but_no_results(self):
        code, text = self.terminal()
        self.assertEqual(code, 0, text)
        self.assertIn("clatter-x: warning: thin cells in a.mesh.toml", text)
        self.assertRegex(text, r"- mesh +a\.mesh\.h5 +\d+\.\d s")
        self.assertIn("all is made", text)
        self.assertNotIn("result of", text)
        self.assertLess(text.index("- mesh"), text.index("\r\nmade\r\n"))

    def test_a_stage_that_fails_shows_its_error_and_makes_exit_code(self):
        (self.folder / "a.mesh.toml").write_text("broken\n")
        code, text = self.terminal()
        self.assertEqual(code, 2)
        self.assertIn("clatter-x: error: a.mesh.toml:1: found broken", text)
        self.assertRegex(text, r"x mesh +a\.mesh\.h5")
        self.assertEqual(self.pipe().returncode, 2)

    def test_a_file_made_of_a_stages_output_is_the_same_on_a_terminal(self):
        self.assertEqual(self.terminal("kept")[0], 0)
        self.assertEqual((self.folder / "kept.txt").read_text(), "result of a.mesh.toml\n")

    def test_words_are_a_folder_and_targets(self):
        self.assertEqual(self.pipe("where").stdout, f"{self.bin}\n")
        self.assertEqual(self.pipe(".", "where").stdout, f"{self.bin}\n")
        self.assertEqual(clatter("run", self.folder, "-j0", folder=self.folder).returncode, 2)
        refused = clatter("run", "nowhere", folder=self.folder / "programs")
        self.assertEqual((refused.returncode, refused.stderr.count("\n")), (2, 1))
        self.assertIn("nowhere: no Makefile; `clatter new`", refused.stderr)

    def test_the_programs_are_found_where_nothing_names_them(self):
        del self.environment["CLATTER_BIN"]
        self.environment["PATH"] = f"{self.bin}{os.pathsep}/usr/bin{os.pathsep}/bin"  # without clatter
        done = self.pipe("where")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((pathlib.Path(done.stdout.strip()) / "clatter-mesh").exists(), done.stdout)


class Stages(unittest.TestCase):
    def test_a_stage_is_named_by_its_program_and_output(self):
        stage = screen.stage_of("/a b/clatter-condense part.fe.h5 -c part.rom.toml -o part one.rom.h5 --depfile x.d", 0.0)
        self.assertEqual((stage.name, stage.target), ("condense", "part one.rom.h5"))
        self.assertEqual(screen.stage_of("srun -n1 /x/clatter-modal compare a.fe.h5 a.rom.h5", 0.0).name, "modal")


if __name__ == "__main__":
    unittest.main(verbosity=2)
