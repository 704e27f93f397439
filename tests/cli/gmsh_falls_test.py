# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter-mesh when Gmsh crashes, exits, hangs or exhausts memory (hard case N17): one line, exit 3, no file left."""
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

import stages
from observed import observed

BUILD = pathlib.Path(os.environ.get("CLATTER_BUILD", stages.SOURCE / "build/release"))
SHIM = BUILD / "tests/cli/libfalling_gmsh.so"
TUBE = """name = "tube"
kind = "cylinder"
[cylinder]
radius = 20.0
inner_radius = 16.0
length = 40.0
[mesh]
element_size_mm = 9.0
"""


class HardN17GmshFalls(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="clatter-falls-")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "tmp").mkdir()
        (self.folder / "tube.mesh.toml").write_text(TUBE)
        (self.folder / "curved.mesh.toml").write_text(TUBE + "elements_per_turn = 12\n")
        (self.folder / "tube.mesh.h5").write_bytes(b"the older artefact")
        self.before = self.files()

    def files(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*"))

    def environment(self, way):
        # The sanitizers' run-time library must normally come first; not here.
        return {**os.environ, "LD_PRELOAD": str(SHIM), "CLATTER_TEST_GMSH": way, "TMPDIR": str(self.folder / "tmp"),
                "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":verify_asan_link_order=0"}

    def mesh(self, way, part="tube.mesh.toml", *more):
        return subprocess.run([stages.BIN / "clatter-mesh", part, "-o", "tube.mesh.h5", *more], cwd=self.folder,
                              env=self.environment(way), text=True, capture_output=True, timeout=120)

    def assert_falls(self, way, says, *more, part="tube.mesh.toml"):
        done = self.mesh(way, part, "--quiet", "--write-step", "tube.step", *more)
        errors = [line for line in done.stderr.splitlines() if "error:" in line]
        others = [line for line in done.stderr.splitlines()
                  if "error:" not in line and not line.startswith("warning: ")]
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual((len(errors), others), (1, []), done.stderr)
        for text in says:
            self.assertIn(text, errors[0])
        self.assertEqual(done.stdout, "")
        self.assertEqual(self.files(), self.before, "files are left or the older artefact is gone")
        self.assertEqual((self.folder / "tube.mesh.h5").read_bytes(), b"the older artefact")
        return done.stderr

    def test_a_crash_is_reported_with_step_and_sizes_and_a_simpler_setting_is_tried(self):
        said = self.assert_falls("abort", ["crashed (signal 6, Aborted)", "gmsh: meshing", "element_size_mm = 9",
                                           "elements_per_turn = 12", "without elements_per_turn", "heal the part"],
                                 part="curved.mesh.toml")
        observed(f"refused: {next(line for line in said.splitlines() if 'error: ' in line).partition('error: ')[2]}")
        self.assertEqual(said.count("warning: "), 1)
        self.assertIn("trying again without elements_per_turn", said)
        # Advice is tried: no size works.
        self.assert_falls("abort", ["MeshAdapt", "; tried in vain: element_size_mm = 4.8; elements_per_turn = 12; or heal"])
        self.assertNotIn("this works", said)

    def test_advice_has_been_tried_and_works(self):
        self.assert_falls("large-abort", ["; this works, it was tried: element_size_mm = 4.8 (", " cells); or heal"])
        (self.folder / "tube.mesh.toml").write_text(TUBE.replace("9.0", "4.8"))
        self.assertEqual(self.mesh("large-abort").returncode, 0)

    def test_aborts_exits_and_unknown_exceptions_are_reported(self):
        self.assert_falls("terminate", ["signal 6", "terminate called after throwing an instance of 'std::string'"])
        self.assert_falls("exit", ["ended with exit code 0 and no result"])
        self.assert_falls("throw", ["threw an exception without text"])

    def test_hangs_and_memory_exhaustion_end_at_their_limits_without_a_second_attempt(self):
        said = self.assert_falls("hang", ["was stopped after 2 s (--time-limit)", "raise the limit"], "--time-limit",
                                 "2")
        self.assertEqual(said.count("\n"), 1)
        said = self.assert_falls("eat", ["ran out of memory (0.4 GiB, --memory-limit)"], "--memory-limit", "0.4")
        self.assertEqual(said.count("\n"), 1)

    def test_the_simpler_setting_makes_the_mesh_and_says_so(self):
        for way, part, text in (("curved-abort", "curved.mesh.toml", "without elements_per_turn"),
                                ("frontal-abort", "tube.mesh.toml", "MeshAdapt")):
            done = self.mesh(way, part, "--quiet", "--json")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stdout.count("\n"), 1)
            self.assertIn(f"trying again {'with Gmsh' + chr(39) + 's ' if text == 'MeshAdapt' else ''}{text}",
                          done.stderr)
            self.assertIn("Gmsh crashes with the requested settings", done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 2, done.stderr)

    def test_a_signal_takes_the_child_with_it_and_leaves_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = subprocess.Popen([stages.BIN / "clatter-mesh", "tube.mesh.toml", "-o", "tube.mesh.h5",
                                        "--write-step", "tube.step"], cwd=self.folder, env=self.environment("hang"),
                                       stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
            self.wait_for(lambda: children.read_text().split() and self.files() != self.before)
            child = children.read_text().split()[0]
            process.send_signal(number)
            # This returns when all processes with the pipe have ended, the child too.
            process.communicate(timeout=60)
            self.assertEqual(process.returncode, -number)
            self.assertFalse(pathlib.Path(f"/proc/{child}/exe").exists())
            self.assertEqual(self.files(), self.before)

    def wait_for(self, holds):
        for _ in range(1500):
            if holds():
                return
            time.sleep(0.02)
        self.fail("it did not come to that")


if __name__ == "__main__":
    unittest.main(verbosity=2)
