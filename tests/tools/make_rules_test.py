# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter.mk: what is rebuilt and what is not, with stand-ins for the stages that record each call."""
import os
import pathlib
import subprocess
import tempfile
import unittest

RULES = pathlib.Path(__file__).resolve().parents[2] / "tools/clatter.mk"
STAGES = ("mesh", "assembly", "modal", "condense", "dynamics", "recover")

# Reads every input, writes the output through a part file, records the call; fails on request.
STAND_IN = """#!/bin/bash
set -e
inputs=()
while (( $# )); do case $1 in
  -o) output=$2; shift 2;; --depfile) depfile=$2; shift 2;; -c) inputs+=("$2"); shift 2;;
  -*) shift;; *) inputs+=("$1"); shift;; esac; done
grep -qs broken "${inputs[@]}" && { echo half > "$output.part"; exit 2; }
extra=$(sed -n 's/^reads //p' "${inputs[@]}" 2>/dev/null || true)
cat "${inputs[@]}" $extra | cksum > "$output.part"
mv "$output.part" "$output"
echo "$output: ${inputs[*]} $extra" > "$depfile"
for file in "${inputs[@]}" $extra; do echo "$file:" >> "$depfile"; done
echo "$output" >> calls
"""

MAKEFILE = f"""include {RULES}
.DEFAULT_GOAL := all
all: slap.field.h5 slap_dry.field.h5 block.modes.h5
slap.run.h5 slap_dry.run.h5: block.rom.h5 piston.rom.h5
"""


class Rules(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.bin = self.folder / "bin"
        self.bin.mkdir()
        for stage in STAGES:
            program = self.bin / f"clatter-{stage}"
            program.write_text(STAND_IN)
            program.chmod(0o755)
        (self.folder / "Makefile").write_text(MAKEFILE)
        for part in ("block", "piston"):
            for kind in ("mesh", "fe", "rom"):
                self.write(f"{part}.{kind}.toml", kind)
        self.write("block.modes.toml", "modes")
        self.write("cycle.csv", "1, 2")
        self.write("slap.run.toml", "film\nreads cycle.csv")
        self.write("slap_dry.run.toml", "dry\nreads cycle.csv")
        self.write("field.toml", "field")

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def make(self, *arguments, status=0):
        """Runs make; returns the artefacts that were made, in order."""
        calls = self.folder / "calls"
        calls.unlink(missing_ok=True)
        done = subprocess.run(["make", f"CLATTER_BIN={self.bin}", *arguments], cwd=self.folder, text=True,
                              capture_output=True, env={**os.environ, "MAKEFLAGS": ""})
        self.assertEqual(done.returncode, status, done.stderr)
        return calls.read_text().split() if calls.exists() else []

    def touch_later(self, name):
        """Changes a file; its time stamp is after everything that make has written."""
        path = self.folder / name
        path.write_text(path.read_text() + "\n# changed")
        newest = max(p.stat().st_mtime_ns for p in self.folder.iterdir())
        os.utime(path, ns=(newest + 1_000_000, newest + 1_000_000))

    def test_everything_is_made_once_and_nothing_twice(self):
        made = self.make()
        self.assertEqual(len(made), len(set(made)))
        self.assertEqual(len(made), 3 + 3 + 1 + 2 + 2)  # two parts, modes, two runs, two fields
        self.assertEqual(self.make(), [])

    def test_parallel_make_makes_the_same(self):
        serial = sorted(self.make())
        for path in self.folder.glob("*.h5"):
            path.unlink()
        self.assertEqual(sorted(self.make("-j8")), serial)
        self.assertEqual(self.make("-j8"), [])

    def test_a_changed_toml_redoes_only_what_depends_on_it(self):
        self.make()
        self.touch_later("slap_dry.run.toml")
        self.assertEqual(self.make(), ["slap_dry.run.h5", "slap_dry.field.h5"])
        self.touch_later("piston.rom.toml")
        self.assertEqual(sorted(self.make()), sorted(["piston.rom.h5", "slap.run.h5", "slap_dry.run.h5",
                                                      "slap.field.h5", "slap_dry.field.h5"]))
        self.touch_later("block.modes.toml")
        self.assertEqual(self.make(), ["block.modes.h5"])

    def test_a_file_that_a_stage_read_counts_after_the_first_run(self):
        self.make()
        self.touch_later("cycle.csv")
        self.assertEqual(sorted(self.make()), ["slap.field.h5", "slap.run.h5", "slap_dry.field.h5", "slap_dry.run.h5"])

    def test_a_file_that_is_gone_does_not_stop_make(self):
        self.make()
        (self.folder / "cycle.csv").unlink()
        for scene in ("slap", "slap_dry"):
            self.write(f"{scene}.run.toml", "no table any more")
        self.assertIn("slap.run.h5", self.make())

    def test_a_failed_stage_leaves_the_old_artefact_and_the_rest_resumes(self):
        self.make()
        old = (self.folder / "piston.fe.h5").read_text()
        good = (self.folder / "piston.fe.toml").read_text()
        self.write("piston.fe.toml", "broken")
        self.make(status=2)
        self.assertEqual((self.folder / "piston.fe.h5").read_text(), old)
        self.write("piston.fe.toml", good + " repaired")
        made = self.make()
        self.assertEqual(made[0], "piston.fe.h5")
        self.assertNotIn("piston.mesh.h5", made)

    def test_an_interrupted_run_is_resumed(self):
        noted = STAND_IN.replace('echo "$output" >> calls', 'echo "$output" >> calls; echo "$all" >> options')
        (self.bin / "clatter-dynamics").write_text(noted.replace("set -e", 'set -e; all="$*"'))
        self.make("slap.run.h5")
        self.assertIn("--resume", (self.folder / "options").read_text())

    def test_a_rebuilt_stage_redoes_its_artefacts(self):
        self.make()
        self.touch_later("bin/clatter-recover")
        self.assertEqual(sorted(self.make()), ["slap.field.h5", "slap_dry.field.h5"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
