# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter sweep`: scenes of all combinations, and what make does with them."""
import os
import pathlib
import subprocess
import tempfile
import tomllib
import unittest

from clatter_command import clatter
from clatter.artefact import BadArtefact
from clatter_tools import sweep

SOURCE = pathlib.Path(__file__).resolve().parents[2]
STAGES = ("mesh", "assembly", "modal", "condense", "dynamics", "recover")

MAKEFILE = f"""include {SOURCE}/tools/clatter.mk
speeds/sweep.mk: slap.run.toml Makefile
	$(clatter_tool) sweep slap.run.toml engine.speed_rpm=1000:2000:500 contact.lubrication=film,none -o speeds --field speeds.field.toml
	touch $@
include speeds/sweep.mk
$(speeds_runs): block.rom.h5
.DEFAULT_GOAL := all
all: $(speeds_fields)
"""

STAND_IN = """#!/bin/bash
set -e
case $1 in *broken*) exit 2;; esac
while (( $# )); do case $1 in -o) output=$2; shift 2;; -c) settings=$2; shift 2;; *) shift;; esac; done
echo made > "$output"
echo "$output $settings $LAUNCHED" >> calls
"""


class Values(unittest.TestCase):
    def test_ranges_are_exact_and_include_their_end(self):
        self.assertEqual(sweep.parse("engine.speed_rpm=1000:3000:1000"), ("engine.speed_rpm", ["1000", "2000", "3000"]))
        self.assertEqual(sweep.parse("a.b=0.1:0.4:0.1")[1], ["0.1", "0.2", "0.3", "0.4"])
        self.assertEqual(sweep.parse("a=2:1:-0.5")[1], ["2.0", "1.5", "1.0"])
        self.assertEqual(sweep.parse("a=1:2:0.6")[1], ["1.0", "1.6"])

    def test_lists_values_and_names_in_quotes(self):
        self.assertEqual(sweep.parse("contact.lubrication=film,none")[1], ["film", "none"])
        self.assertEqual(sweep.parse('cam_torque."intake valves 1".lift_mm=7'), ('cam_torque."intake valves 1".lift_mm', ["7"]))
        self.assertEqual(sweep.parse("a=[1, 2]")[1], ["[1, 2]"])

    def test_scenes_are_toml_with_the_values_types(self):
        text = sweep.scene_text(["e.n", "c.mode", "on", "drive.crank.v"], ["1.5", 'a "b"', "false", "[1, 2]"])
        self.assertEqual(tomllib.loads(text), {
            "title": 'e.n = 1.5, c.mode = "a \\"b\\"", on = false, drive.crank.v = [1, 2]',
            "e": {"n": 1.5}, "c": {"mode": 'a "b"'}, "on": False, "drive": {"crank": {"v": [1, 2]}}})

    def test_files_are_named_by_what_differs(self):
        self.assertEqual(sweep.file_names([("1000", "5", "a/b"), ("1500", "5", "c d")]), ["1000_a-b", "1500_c-d"])
        self.assertEqual(sweep.file_names([("1000", "5")]), ["1000"])
        with self.assertRaisesRegex(BadArtefact, "^found values that give files the same name$"):
            sweep.file_names([("a/b",), ("a b",)])

    def test_what_is_no_sweep_is_refused(self):
        for argument, said in (("speed", "speed: expected key=values, as engine.speed_rpm=1000:3000:50"),
                               ("a=1:2:-1", "1:2:-1: the step does not lead from 1 to 2"),
                               ("a=1:2:0", "1:2:0: the step does not lead from 1 to 2"),
                               ("a=0:1e9:1", "0:1e9:1: found 1000000001 values, expected at most 100000"),
                               ("a=1,2,1", "a=1,2,1: found a value twice or an empty one"),
                               ("a=1000,1e3", "a=1000,1e3: found a value twice or an empty one"),
                               ('a="x","y"', 'a="x","y": not TOML, expected one value, or several without brackets and quotes, as a=a,b')):
            with self.assertRaises(BadArtefact) as refused:
                sweep.parse(argument)
            self.assertEqual(str(refused.exception), said)
        with self.assertRaisesRegex(BadArtefact, "^a: found twice, expected each key once$"):
            sweep.read_keys(["a=1", "a=2"])
        with self.assertRaisesRegex(BadArtefact, "^found 1002001 combinations, expected at most 100000$"):
            sweep.read_keys(["a=0:1000:1", "b=0:1000:1"])


class Keys(unittest.TestCase):
    """What scenes cannot have is said before any is written."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "below.run.toml").write_text('[engine]\nspeed_rpm = 1\n[[stop]]\nname = "wall"\n[[mount]]\nsets = ["a"]\n')
        (self.folder / "slap.run.toml").write_text('base = "below.run.toml"\n[stop.wall]\nfriction = 0.1\n')

    def swept(self, *arguments):
        """(code, the last line) of the command."""
        done = clatter("sweep", "slap.run.toml", *arguments, "-o", "made", folder=self.folder)
        return done.returncode, (done.stderr or done.stdout).strip().split("\n")[-1].removeprefix("clatter: error: ")

    def test_misspelt_keys_and_impossible_values_are_refused_with_what_is_meant(self):
        for argument, said in (
                ("engine.speed_rmp=1000,2000", "engine.speed_rmp: unknown key speed_rmp, did you mean speed_rpm?"),
                ("stop.wal.friction=0.1,0.2", "stop.wal.friction: found no [[stop]] wal in the base, expected one of: wall"),
                ("spring.a.friction=1", "spring.a.friction: found no [[spring]] a in the base, expected one of: none, it has no such table"),
                ("mount.1.sets=[\"b\"]", "mount.1.sets: found no [[mount]] 1 in the base, expected one of: 0"),
                ("engine.speed_rpm.x=1", "engine.speed_rpm.x: found x below speed_rpm, which is no table"),
                ("stop.wall=1", "stop.wall: found a table, expected a key of it, as stop.wall.name"),
                ("engine=3", "engine: found 3, expected a table"),
                ("engine.speed_rpm=fast", "engine.speed_rpm: found 'fast', expected a number at least 0.01 at most 100000"),
                ("contact.lubrication=film,oil", "contact.lubrication: found 'oil', expected one of: film, none"),
                ("engine.speed_rpm=1000,nan", "engine.speed_rpm: found nan, expected a finite number"),
                ("stop.wall.normal=[0, 0, inf]", "stop.wall.normal: found [0, 0, inf], expected a finite number"),
                ("base=other.run.toml", "base: found it as a key, expected another one: the base of the scenes is slap.run.toml"),
                ("é=1", "é: no key of TOML, expected names joined by points, such as engine.speed_rpm")):
            self.assertEqual(self.swept(argument), (2, said))
            self.assertFalse((self.folder / "made").exists(), argument)

    def test_keys_of_the_base_and_new_ones_are_accepted(self):
        code, line = self.swept("stop.wall.friction=0.1,0.2", "engine.pin_offset_mm=0.5", "mount=[]")
        self.assertEqual(code, 0, line)
        self.assertEqual(sorted(path.name for path in (self.folder / "made").iterdir()), ["0.1.run.toml", "0.2.run.toml", "sweep.mk"])

    def test_keys_of_which_one_is_a_part_of_the_other_are_refused(self):
        self.assertEqual(self.swept("stop=[]", "stop.wall.friction=0.1"), (2, "stop.wall.friction and stop exclude each other: one is a part of the other"))

    def test_parameters_are_checked_alike(self):
        (self.folder / "p.toml").write_text('[[parameter]]\nname = "speed"\nvalues = [1]\nkeys = { "engine.sped_rpm" = "{}" }\n')
        self.assertEqual(self.swept("--parameters", "p.toml"), (2, "engine.sped_rpm: unknown key sped_rpm, did you mean speed_rpm?"))


class Command(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "bin").mkdir()
        for stage in STAGES:
            program = self.folder / f"bin/clatter-{stage}"
            program.write_text(STAND_IN)
            program.chmod(0o755)
        for name in ("slap.run.toml", "block.rom.h5", "speeds.field.toml"):
            (self.folder / name).write_text("x = 1\n")
        (self.folder / "Makefile").write_text(MAKEFILE)

    def make(self, *arguments):
        calls = self.folder / "calls"
        calls.unlink(missing_ok=True)
        done = subprocess.run(["make", f"CLATTER_BIN={self.folder}/bin", *arguments], cwd=self.folder, text=True,
                              capture_output=True, env={**os.environ, "MAKEFLAGS": ""})
        self.assertEqual(done.returncode, 0, done.stderr)
        return calls.read_text().splitlines() if calls.exists() else []

    def test_make_runs_each_combination_once_and_resumes(self):
        made = self.make("-j2")
        names = [f"{speed}_{oil}" for speed in (1000, 1500, 2000) for oil in ("film", "none")]
        self.assertCountEqual(made, [f"speeds/{name}.run.h5  " for name in names] +
                              [f"speeds/{name}.field.h5 speeds.field.toml " for name in names])
        scene = tomllib.loads((self.folder / "speeds/1500_none.run.toml").read_text())
        self.assertEqual(scene["base"], "../slap.run.toml")
        self.assertEqual((scene["engine"], scene["contact"]), ({"speed_rpm": 1500}, {"lubrication": "none"}))
        self.assertEqual(self.make(), [])
        for kind in ("run", "field"):
            (self.folder / f"speeds/1500_none.{kind}.h5").unlink()
        self.assertEqual(len(self.make()), 2)

    def test_more_values_leave_what_was_run(self):
        self.make()
        text = (self.folder / "Makefile").read_text().replace("1000:2000:500", "1000:2500:500")
        (self.folder / "Makefile").write_text(text)
        self.assertCountEqual([call.split()[0] for call in self.make()],
                              [f"speeds/2500_{oil}.{kind}.h5" for oil in ("film", "none") for kind in ("run", "field")])

    def test_the_launcher_is_put_before_each_program(self):
        made = self.make("CLATTER_LAUNCH=env LAUNCHED=yes")
        self.assertEqual(len(made), 12)
        self.assertTrue(all(call.endswith(" yes") for call in made), made)

    def test_a_missing_base_is_refused(self):
        done = clatter("sweep", "no.run.toml", "a=1", folder=self.folder)
        self.assertEqual((done.returncode, done.stderr),
                         (2, "clatter: error: no.run.toml: no such file, expected a scene, name.run.toml\n"))


if __name__ == "__main__":
    unittest.main()
