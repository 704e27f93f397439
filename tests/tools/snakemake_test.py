# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter.smk: what Snakemake runs and what it does not, with stand-ins for the stages that record each call, and the beam of the
samples by the stages themselves."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("CLATTER_BIN", SOURCE / "build/release/bin"))
STAGES = ("mesh", "assembly", "modal", "condense", "dynamics", "recover")

# Reads its inputs, writes the output, records output and settings.
STAND_IN = """#!/bin/bash
set -e
[ "$1" = sound ] && shift
inputs=()
while (( $# )); do case $1 in
  -o) output=$2; shift 2;; --depfile|--threads) shift 2;; -c) settings=$2; shift 2;; -*) shift;; *) inputs+=("$1"); shift;; esac; done
cat "${inputs[@]}" $settings | cksum > "$output"
echo "$output${settings:+ $settings}" >> calls
"""

SNAKEFILE = """include: shell("{clatter} rules --snakemake", read=True).strip()
rule all:
    input: {wanted}
"""


@unittest.skipIf(shutil.which("snakemake") is None, "Snakemake (package snakemake) is not installed")
class Snakemake(unittest.TestCase):
    programs = BIN

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def wanted(self, text, before=""):
        head, rest = SNAKEFILE.format(clatter=SOURCE / "tools/clatter", wanted=text).split("\n", 1)
        self.write("Snakefile", f"{head}\n{before}\n{rest}")

    def snakemake(self, *arguments, status=0):
        """Runs Snakemake; returns the calls of stand-ins in order, and all that was said."""
        calls = self.folder / "calls"
        calls.unlink(missing_ok=True)
        done = subprocess.run(["snakemake", "-c2", *arguments], cwd=self.folder, text=True, capture_output=True,
                              env={**os.environ, "CLATTER_BIN": str(self.programs), "PYTHONPATH": ""})
        self.assertEqual(done.returncode, status, done.stderr)
        return calls.read_text().splitlines() if calls.exists() else [], done.stderr + done.stdout

    def sweep(self, *arguments):
        subprocess.run([SOURCE / "tools/clatter", "sweep", *arguments], cwd=self.folder, check=True, capture_output=True)


class Rules(Snakemake):
    def setUp(self):
        super().setUp()
        self.programs = self.folder / "bin"
        self.programs.mkdir()
        for stage in STAGES:
            program = self.programs / f"clatter-{stage}"
            program.write_text(STAND_IN)
            program.chmod(0o755)
        for part in ("block", "piston"):
            for kind in ("mesh", "fe", "rom"):
                self.write(f"{part}.{kind}.toml", f'kind = "{kind}"\n')
        self.write("cycle.csv", "1, 2\n")
        self.write("slap.run.toml", 'block.rom = "block.rom.h5"\npiston.rom = "piston.rom.h5"\ngas.table = "cycle.csv"\nspeed = 1\n')
        self.write("field.toml", 'sound = "block.sound.h5"\n')

    def test_everything_is_made_once_in_order_and_nothing_twice(self):
        self.wanted('"slap.field.h5", "block.modes.h5"')
        made, _ = self.snakemake()
        self.assertCountEqual(made, [f"{part}.{kind}" for part in ("block", "piston") for kind in
                                     ("mesh.h5", f"fe.h5 {part}.fe.toml", f"rom.h5 {part}.rom.toml")] +
                              ["block.modes.h5", "block.sound.h5", "slap.run.h5", "slap.field.h5 field.toml"])
        at = {call.split()[0]: k for k, call in enumerate(made)}
        self.assertLess(max(at["block.rom.h5"], at["piston.rom.h5"]), at["slap.run.h5"])
        self.assertLess(max(at["block.sound.h5"], at["slap.run.h5"]), at["slap.field.h5"])
        self.assertEqual(self.snakemake()[0], [])

    def test_what_changed_is_redone_with_what_depends_on_it(self):
        self.wanted('"slap.field.h5", "piston.modes.h5"')
        self.snakemake()
        self.write("cycle.csv", "1, 3\n")
        self.assertEqual(self.snakemake()[0], ["slap.run.h5", "slap.field.h5 field.toml"])
        self.write("slap.field.toml", 'sound = "block.sound.h5"\nbody = "block"\n')
        self.assertEqual(self.snakemake()[0], ["slap.field.h5 slap.field.toml"])
        self.write("piston.modes.toml", "count = 3\n")
        self.assertEqual(self.snakemake()[0], ["piston.modes.h5 piston.modes.toml"])

    def test_a_sweep_runs_each_of_its_scenes_with_its_own_field_settings(self):
        self.write("speeds.field.toml", 'body = "block"\n')
        self.sweep("slap.run.toml", "speed=1,2,3", "-o", "speeds", "--field", "speeds.field.toml")
        self.wanted("speeds.fields", 'speeds = clatter_sweep("speeds")')
        made, _ = self.snakemake()
        self.assertCountEqual([call for call in made if call.startswith("speeds/")],
                              [f"speeds/{name}.run.h5" for name in (1, 2, 3)] + [f"speeds/{name}.field.h5 speeds.field.toml" for name in (1, 2, 3)])
        self.sweep("slap.run.toml", "speed=1,2,3,4", "-o", "speeds", "--field", "speeds.field.toml")
        self.assertEqual(self.snakemake()[0], ["speeds/4.run.h5", "speeds/4.field.h5 speeds.field.toml"])

    def test_a_missing_program_and_a_missing_sweep_are_named(self):
        self.wanted('"slap.field.h5"', 'speeds = clatter_sweep("speeds")')
        self.assertIn("speeds: found no sweep.mk, expected that of `clatter sweep", self.snakemake(status=1)[1])
        (self.programs / "clatter-modal").unlink()
        self.assertIn(f"clatter-modal: found no such program in {self.programs}", self.snakemake(status=1)[1])


class Beam(Snakemake):
    def test_the_stages_make_the_beam_and_a_sweep_of_it(self):
        for path in (SOURCE / "samples/beam").glob("*.toml"):
            shutil.copy(path, self.folder)
        self.write("step.field.toml", (self.folder / "step.field.toml").read_text().replace('body = "beam"', 'body = "beam"\nsound = "beam.sound.h5"'))
        self.write("beam.sound.toml", "[skin]\nopening = 0.02\n[grid]\nfrom_hz = 50\nto_hz = 500\ntolerance_db = 1\n")
        self.sweep("step.run.toml", "time.largest_step_us=50,25", "-o", "steps", "--field", "step.field.toml")
        self.wanted('steps.fields, "beam.compare.txt"', 'steps = clatter_sweep("steps")')
        self.snakemake("--config", "clatter_flags=--quiet")
        levels = []
        for name in ("50", "25"):
            with h5py.File(self.folder / f"steps/{name}.field.h5") as field:
                levels.append(float(field["analysis/swing/sound"].attrs["power_db"]))
                self.assertEqual(field["acoustic/triangles"].shape, field["lines/acoustic_normal_velocity_re/00000"].shape + (3,))
        self.assertLess(np.ptp(levels), 0.5)
        self.assertIn("smallest MAC", (self.folder / "beam.compare.txt").read_text())
        self.assertIn("Nothing to be done", self.snakemake("--config", "clatter_flags=--quiet")[1])


if __name__ == "__main__":
    unittest.main()
