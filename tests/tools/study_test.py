# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter study` with stand-ins for the stages, whose errors and seconds are known exactly."""
import csv
import fcntl
import itertools
import math
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import tomllib
import unittest
import unittest.mock

import h5py
import numpy as np

from clatter_tools.artefact import BadArtefact, schema_of
from clatter_tools.study import convergence, effects, findings, plan, proposal, quantities, run, toml_text

SOURCE = pathlib.Path(__file__).resolve().parents[2]
STAGES = ("mesh", "assembly", "modal", "condense", "dynamics", "recover")

# What an artefact was made of, as "h=2.0 n=2 tau=0.2", is kept by its inode; the artefacts of all combinations were written before.
STAND_IN = """#!/bin/bash
set -e
inputs=()
while (( $# )); do case $1 in -o) output=$2; shift 2;; --depfile) shift 2;; -*) shift;; *) inputs+=("$1"); shift;; esac; done
declare -A made
take() { while IFS='= ' read -r key value || [[ $key ]]; do case $key=$value in *=-) ;; h=*|n=*|tau=*|both=*) made[$key]=$value;; esac; done; }
for file in $([[ $0 != *dynamics ]] || sed -nE 's/^(base|rom) = "(.*)"/\\2/p' *.run.toml) "${inputs[@]}"; do
  case $file in *.h5) take < <(tr ' ' '\\n' < "$GIVEN/of-$(stat -Lc %i "$file")");; *) take < "$file";; esac
done
kind=${output%.h5}; kind=${kind##*.}
[ $kind = run ] && : ${made[both]:=0.0}
[ $kind = run ] && [ -e $GIVEN/wait ] && { touch $GIVEN/waiting; exec sleep 60; }
[ $kind = run ] && [ -e $GIVEN/fail ] && { echo told to fail >&2; exit 2; }
[ "${made[h]}" = 20.0 ] && { echo too coarse >&2; exit 2; }
of="h=${made[h]} n=${made[n]:--} tau=${made[tau]:--} both=${made[both]:--}"
cp "$GIVEN/$kind $of" "$output.part"
echo "$of" > "$GIVEN/of-$(stat -c %i "$output.part")"
mv "$output.part" "$output"
echo "$output $LAUNCHED" >> $GIVEN/calls
"""
SECONDS = {"mesh": lambda h, n, tau: 0.1, "fe": lambda h, n, tau: 1000.0 / h**3, "rom": lambda h, n, tau: 0.5 * n, "run": lambda h, n, tau: 2.0 / tau,
           "field": lambda h, n, tau: 0.25}


MAKEFILE = """include ../tools/clatter.mk
all: slap.field.h5
slap.run.h5: part.rom.h5
"""
STUDY = """
[[setting]]
name = "cell size"
unit = "mm"
key = "part.mesh.toml:mesh.h"
values = [4.0, 2.0, 1.0, 0.5]

[[setting]]
name = "tolerance"
key = "slap.run.toml:accuracy.tau"
values = [0.4, 0.2, 0.1, 0.05]

[[setting]]
name = "modes"
key = "part.rom.toml:basis.n"
values = [1, 2, 4, 8]
reference = "finest"

[[quantity]]
name = "value"
file = "slap.field.h5"
take = "dataset"
path = "result/value"
unit = "N"

[[quantity]]
name = "of the part"
file = "part.rom.h5"
take = "dataset"
path = "result/value"
"""
SMALL = """
[[setting]]
name = "cell size"
unit = "mm"
key = "part.mesh.toml:mesh.h"
values = [2.0, 1.0]

[[setting]]
name = "tolerance"
key = "slap.run.toml:accuracy.tau"
values = [0.2, 0.1]

[[quantity]]
name = "value"
file = "slap.field.h5"
take = "dataset"
path = "result/value"
"""
H, TAU, N = 2.0, 0.2, 2


def write_given(folder, both=0.0, lengths=(4.0, 2.0, 1.0, 0.5), modes=(None, 1, 2, 4, 8), tolerances=(None, 0.4, 0.3, 0.2, 0.1, 0.05, 0.025)):
    """The artefacts of all combinations of values; `both` is an effect of the scene, which makes the run three seconds longer."""
    for h, n, tau in itertools.product(lengths, modes, tolerances):
        value = exact(h, tau or 1.0, n or 1.0, both if tau else 0.0)
        for kind, seconds in SECONDS.items():
            if (kind in ("mesh", "fe")) != (n is None) or (kind in ("run", "field")) != (tau is not None):
                continue
            own = both if kind in ("run", "field") else "-"
            with h5py.File(folder / f"{kind} h={h} n={n or '-'} tau={tau or '-'} both={own}", "w") as file:
                file.attrs["schema"] = schema_of(kind)
                file["result/value"], file["result/curve"] = value, [value, 2.0 * value]
                timing = file.create_group("timing")
                timing.attrs["total_seconds"], timing.attrs["peak_gib"] = seconds(h, n, tau) + 3.0 * (both != 0.0 and kind == "run"), 0.125 * (n or 0)
                if kind == "run":
                    file["effects/name"], file["effects/state"] = ["both", "rings"], ["on" if both else "off", "off"]


def exact(h=H, tau=TAU, n=N, both=0.0):
    return 100.0 + 0.5 * h**2 - 8.0 * tau + 3.0 / n**3 + both * h * tau


class StandIns(unittest.TestCase):
    """A pipeline of one part, and the study of three settings."""
    both = 0.0

    @classmethod
    def setUpClass(cls):
        cls.given = pathlib.Path(tempfile.mkdtemp(prefix="clatter-study-"))
        cls.addClassCleanup(shutil.rmtree, cls.given)
        for both in {0.0, cls.both}:
            write_given(cls.given, both)

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        (self.root / "tools").symlink_to(SOURCE / "tools")
        self.folder, programs = self.root / "pipeline", self.root / "bin"
        for folder in (self.folder, programs):
            folder.mkdir()
        for stage in STAGES:
            (programs / f"clatter-{stage}").write_text(STAND_IN)
            (programs / f"clatter-{stage}").chmod(0o755)
        for name, text in {"Makefile": MAKEFILE, "part.mesh.toml": f"[mesh]\nh = {H}", "part.fe.toml": "",
                           "part.rom.toml": f"[basis]\nn = {N}", "slap.run.toml": 'base = "engine.run.toml"\nrom = "part.rom.h5"',
                           "engine.run.toml": f"[accuracy]\ntau = {TAU}\n[more]\nboth = {self.both}", "field.toml": "", "study.toml": STUDY}.items():
            self.write(name, text)
        self.environment = {**os.environ, "CLATTER_BIN": str(programs), "GIVEN": str(self.given), "MAKEFLAGS": ""}
        patched = unittest.mock.patch.dict(os.environ, self.environment)
        patched.start()
        self.addCleanup(patched.stop)

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def calls(self):
        """Calls of stages since the last time."""
        path = self.given / "calls"
        lines = path.read_text().splitlines() if path.exists() else []
        path.unlink(missing_ok=True)
        return lines

    def study(self, jobs=2):
        """The Study; `made`: artefacts of this run."""
        self.calls()
        found = run.make(self.folder / "study.toml", jobs)
        self.made = [line.split(" ")[0] for line in self.calls()]
        return found

    def command(self, *arguments, code=0):
        """Runs the command in the pipeline's folder; returns what it says."""
        done = subprocess.run([SOURCE / "tools/clatter", "study", "study.toml", *arguments], cwd=self.folder, text=True, capture_output=True,
                              env={**self.environment, "CLATTER_BIN": "../bin"}, check=False)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout if code == 0 else done.stderr


class Numbers(StandIns):
    def test_orders_limits_budget_and_cost_are_the_known_ones(self):
        said = self.command("-j2")
        with h5py.File(self.folder / "study/study.h5") as file:
            value = file["quantity/value"]
            self.assertEqual([round(one, 6) for one in value["order"][:2]], [2.0, 1.0])
            self.assertEqual([one.decode() for one in value["source"]], ["richardson", "richardson", "finest"])
            # Of h^2 and tau Richardson's limit is exact, of n the finest value 8 is the reference.
            reference = 100.0 + 3.0 / 8**3
            self.assertAlmostEqual(value["reference"][0], reference, delta=1e-9)
            parts = [0.5 * H**2 / reference, -8.0 * TAU / reference, (3.0 / N**3 - 3.0 / 8**3) / reference]
            np.testing.assert_allclose(value["budget"], parts, rtol=1e-9)
            finest = exact() - np.array([exact(h=0.5), exact(tau=0.05), exact(n=8)])
            self.assertAlmostEqual(value["budget_sum"][0], finest.sum() / reference, delta=1e-12)
            self.assertAlmostEqual(value["budget_run"][0], finest.sum() / reference, delta=1e-12)
            names = [one.decode() for one in file["variant"]]
            self.assertEqual(len(names), 1 + 3 * 3 + 1)
            at = names.index("cell size 0.5 mm")
            self.assertAlmostEqual(value["value"][at, 0], exact(h=0.5), delta=1e-12)
            part = 0.1 + 8000.0 + 0.5 * N
            self.assertAlmostEqual(file["cost"][at], part + 2.0 / TAU + 0.25, delta=1e-9)
            self.assertAlmostEqual(file["quantity/of the part/cost"][at], part, delta=1e-9)
            self.assertAlmostEqual(file["stage/peak_gib"][at].max(), 0.125 * N, delta=1e-12)
            # What the tolerance does is no error of the part.
            self.assertEqual(file["quantity/of the part/budget"][1], 0.0)
        coarse, fine = abs(8.0 * 0.4) / reference, abs(8.0 * 0.05) / reference
        self.assertIn(f"tolerance, value: {100 * coarse:.2g} % costs 5.2 s (0.4), 1.6 % costs 10 s (0.2, the base), "
                      f"{100 * fine:.2g} % costs 40 s (0.05); below 2 % cell size rules; 126 s of other stages", said)
        self.assertIn("tolerance, of the part: no value changes it", said)
        self.assertIn("sum / run 1.00", said)
        with open(self.folder / "study/study.csv", newline="") as stream:
            rows = {row["variant"]: row for row in csv.DictReader(stream)}
        self.assertAlmostEqual(float(rows["all refined"]["value [N]"]), exact(0.5, 0.05, 8), delta=1e-6)
        self.assertEqual(rows["modes 4"]["modes"], "4")
        page = (self.folder / "study/study.html").read_text()
        self.assertIn("tolerance, of the part: no value changes it.", page)
        self.assertEqual(page.count("<svg"), 2)

    def test_the_exact_value_shows_what_no_setting_explains(self):
        self.write("study.toml", SMALL + "exact = 90.0\n")
        said = "\n".join(findings.report(self.study()))
        # What is left with both settings at their finest, their references.
        self.assertRegex(said, rf"not of these settings +\+{100 * (exact(h=1.0, tau=0.1) / 90.0 - 1.0):.3g} %")
        self.assertRegex(said, rf"against the exact value +\+{100 * (exact() / 90.0 - 1.0):.3g} %")


class Proposals(StandIns):
    """Errors of different settings add up and seconds are products, as in the model."""

    def test_the_cheapest_settings_are_found_and_hold_in_a_run(self):
        study = self.study()
        reference = study.references[0].values[0]
        for within, seconds in ((2.0, math.inf), (0.7, math.inf), (4.0, 200.0)):
            best, _ = proposal.propose(study, 0, within / reference, seconds)
            h, tau, n = (value[0] for value in best.values)
            write_given(self.given, 0.0, [h], [None, n], [None, tau])
            error, spent = proposal.prove(study, 0, best, 2)
            self.assertAlmostEqual(error, abs(exact(h, tau, n) - reference) / reference, delta=1e-12)
            self.assertLessEqual(error * reference, within)
            self.assertLessEqual(spent, seconds)
            # A middle between tested values is rounded, its seconds are interpolated.
            self.assertAlmostEqual(best.seconds / spent, 1.0, delta=0.02)
            self.assertAlmostEqual(best.expected / error, 1.0, delta=0.35)
            parts = [0.5 * h**2, 8.0 * tau, 3.0 / n**3 - 3.0 / 8**3]
            self.assertLessEqual(sum(map(abs, parts)), 1.05 * best.most * reference)

        # No tested settings are cheaper.
        best, _ = proposal.propose(study, 0, 1.5 / reference)
        seconds = [0.1 + 1000.0 / h**3 + 0.5 * n + 2.0 / tau + 0.25 for h, tau, n in itertools.product((4.0, 2.0, 1.0, 0.5), (0.4, 0.2, 0.1, 0.05), (1, 2, 4))
                   if 0.5 * h**2 + 8.0 * tau + 3.0 / n**3 - 3.0 / 8**3 <= 1.5]
        self.assertLessEqual(best.seconds, min(seconds) + 1e-9)

    def test_what_cannot_be_reached_is_said_with_the_nearest(self):
        self.write("study.toml", SMALL)
        line = self.command("--within", "value 0.001 %", code=3)
        self.assertIn("no settings of this study are within 0.001 %: add finer values, or ask for less", line)
        self.assertIn("--within: found 'level 1', expected a quantity and an error, as \"value 0.5\"; known: value", self.command("--within", "level 1", code=2))
        self.assertIn("--seconds: found 3, expected a positive number, and --within", self.command("--seconds", "3", code=2))


class Interaction(StandIns):
    both = -40.0

    def test_settings_that_act_on_each_other_leave_the_budget_open(self):
        study = self.study()
        sums = 2 * exact(both=-40.0) - exact(h=0.5, both=-40.0) - exact(tau=0.05, both=-40.0) + exact() - exact(n=8)
        difference = exact(both=-40.0) - exact(0.5, 0.05, 8, both=-40.0)
        self.assertAlmostEqual(study.budgets[0].closure(), sums / difference, delta=1e-9)
        self.assertGreater(abs(sums / difference - 1.0), 0.2)
        open_ = not 0.5 <= sums / difference <= 2.0
        self.assertEqual("NOT CLOSED" in "\n".join(findings.report(study)), open_)

    def test_an_effect_is_switched_off_and_its_change_and_cost_are_known(self):
        self.write("study.toml", STUDY[STUDY.index("[[quantity]]"):] + """
            [[effect]]
            name = "tolerance as an effect"
            key = "slap.run.toml:accuracy.tau"
            off = 0.1
            """)
        with unittest.mock.patch.dict(effects.KNOWN, {"both": [("more.both", 0.0, None)], "rings": [("more.both", 0.0, None)]}):
            found = effects.make(self.folder / "study.toml", 2)
        self.assertEqual([(one.name, one.to) for one in found.switches], [("both", "off"), ("tolerance as an effect", "off")])
        base = exact(both=-40.0)
        self.assertAlmostEqual(found.switches[0].changes[0].number(), exact() - base, delta=1e-12)
        self.assertAlmostEqual(found.switches[1].changes[0].number(), exact(tau=0.1, both=-40.0) - base, delta=1e-12)
        seconds = 2.0 / TAU + 3.0 + 0.25  # of run and field
        self.assertAlmostEqual(found.switches[0].saved, 3.0 / seconds, delta=1e-12)
        # Of the part nothing changes; of the value it does, by more than the 1 % that is small.
        lines = effects.report(found)
        self.assertEqual(lines[0], f"both: value {100 * (exact() / base - 1):+.2g} %, of the part +0 %, 23 % of the time: keep")
        found.plan.quantities[0].small = 1.0
        self.assertTrue(effects.report(found)[0].endswith("leave out"), effects.report(found)[0])
        self.assertIn("without it 75 % more time: costs nothing, keep", effects.report(found)[1])
        self.assertIn("both,off,", effects.write(found).read_text())

    def test_only_the_scene_runs_again_without_an_effect(self):
        self.write("study.toml", STUDY[STUDY.index("[[quantity]]"):])
        self.calls()
        with unittest.mock.patch.dict(effects.KNOWN, {"both": [("more.both", 0.0, None)]}):
            effects.make(self.folder / "study.toml", 2)
        made = [line.split(" ")[0] for line in self.calls()]
        self.assertEqual(sorted(made), sorted(["part.mesh.h5", "part.fe.h5", "part.rom.h5", *2 * ["slap.run.h5", "slap.field.h5"]]))


class Sharing(StandIns):
    """Two settings with the base and a finer value each."""

    def setUp(self):
        super().setUp()
        self.write("study.toml", SMALL)

    def test_what_variants_have_in_common_is_made_once_and_nothing_twice(self):
        self.study()
        count = {kind: sum(one.endswith(f".{kind}.h5") for one in self.made) for kind in SECONDS}
        # Two meshes and their reduced models; runs of both with both tolerances.
        self.assertEqual(count, {"mesh": 2, "fe": 2, "rom": 2, "run": 4, "field": 4})
        self.study()
        self.assertEqual(self.made, [])
        self.assertEqual(list(self.folder.glob("*.h5")), [])
        base = self.folder / "study/variants/base"
        self.assertEqual(sorted(path.name for path in base.iterdir()),
                         ["part.fe.h5", "part.mesh.h5", "part.rom.h5", "slap.field.h5", "slap.run.h5"])

    def test_a_new_value_and_a_changed_file_make_only_what_is_new(self):
        self.study()
        self.write("study.toml", SMALL.replace("[0.2, 0.1]", "[0.4, 0.2, 0.1]"))
        self.study()
        self.assertEqual(sorted(self.made), ["slap.field.h5", "slap.run.h5"])
        self.write("field.toml", "# new\n")
        self.study()
        self.assertEqual(set(self.made), {"slap.field.h5"})
        # The scene that another one is based on has the key: it counts.
        scene = (self.folder / "engine.run.toml").read_text()
        self.write("engine.run.toml", "[accuracy]\ntau = 0.3")
        self.study()
        self.assertEqual(set(self.made), {"slap.run.h5", "slap.field.h5"})
        # What a Makefile says elsewhere changes nothing, the commands of an artefact do.
        changed = MAKEFILE.replace("all:", "# a comment\nall:") + "other := 1\nother: ; echo other\n"
        self.write("Makefile", changed)
        self.study()
        self.assertEqual(self.made, [])
        self.write("Makefile", changed + "slap.field.h5: more = $(extra)\nextra = 1\n")
        self.study()
        self.assertEqual(set(self.made), {"slap.field.h5"})
        self.write("Makefile", changed + "slap.field.h5: more = $(extra)\nextra = 2\n")
        self.study()
        self.assertEqual(set(self.made), {"slap.field.h5"})
        self.write("Makefile", MAKEFILE)
        # An older state is still there.
        self.write("engine.run.toml", scene)
        self.study()
        self.assertEqual(self.made, [])

    def test_a_file_that_only_a_stage_knows_counts_after_the_first_run(self):
        self.write("deck.inc", "1")
        self.study()
        meshes = list(self.folder.glob("study/made/part.mesh-*"))
        for folder in meshes:
            (folder / "part.mesh.h5.d").write_text("part.mesh.h5: part.mesh.toml \\\n  deck.inc\n")
        self.study()
        self.assertEqual(self.made, [])
        newest = max((folder / "part.mesh.h5").stat().st_mtime_ns for folder in meshes)
        os.utime(self.folder / "deck.inc", ns=(newest + 1, newest + 1))
        oldest = min(meshes, key=lambda folder: (folder / "part.mesh.h5").stat().st_mtime_ns)
        (oldest / "part.mesh.h5.d").unlink()
        self.study()
        self.assertEqual(sorted(set(self.made)), ["part.fe.h5", "part.mesh.h5", "part.rom.h5", "slap.field.h5", "slap.run.h5"])
        self.assertEqual(self.made.count("part.mesh.h5"), 1)

    def test_what_make_finds_up_to_date_in_the_folder_is_taken_over(self):
        self.write("study.toml", "reuse = true\n" + SMALL)
        subprocess.run(["make", "slap.field.h5"], cwd=self.folder, check=True, capture_output=True)
        (self.folder / "field.toml").write_text("# newer\n")
        later = (self.folder / "slap.field.h5").stat().st_mtime_ns + 1_000_000
        os.utime(self.folder / "field.toml", ns=(later, later))
        self.study()
        count = {kind: sum(one.endswith(f".{kind}.h5") for one in self.made) for kind in SECONDS}
        self.assertEqual(count, {"mesh": 1, "fe": 1, "rom": 1, "run": 3, "field": 4})
        # What the pipeline's folder gets later does not change what the study has.
        (self.folder / "part.rom.h5").unlink()
        self.study()
        self.assertEqual(self.made, [])

    def test_a_failed_variant_is_reported_and_the_rest_is_complete(self):
        self.write("study.toml", SMALL.replace("[2.0,", "[20.0, 2.0,"))
        study = self.study()
        self.assertRegex("\n".join(findings.report(study)), r"cell size 20 mm +missing")
        self.assertAlmostEqual(study.budgets[0].closure(), 1.0, delta=1e-9)
        self.assertEqual([one.name for one, value in zip(study.variants, study.values[0]) if value is None], ["cell size 20 mm"])

    def test_a_base_that_fails_is_reported_and_resumed(self):
        (self.given / "fail").touch()
        self.addCleanup((self.given / "fail").unlink, missing_ok=True)
        self.assertIn("study.toml: the base has no slap.field.h5", self.command(code=3))
        self.assertFalse((self.folder / "study/study.h5").exists())
        (self.given / "fail").unlink()
        self.study()
        self.assertEqual({one.split(".")[1] for one in self.made}, {"run", "field"})

    def test_an_interrupted_study_leaves_nothing_half_made_and_resumes(self):
        for name in ("wait", "waiting"):
            self.addCleanup((self.given / name).unlink, missing_ok=True)
        (self.given / "wait").touch()
        process = subprocess.Popen([SOURCE / "tools/clatter", "study", "study.toml"], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until = time.monotonic() + 60.0
        while not (self.given / "waiting").exists() and time.monotonic() < until:
            time.sleep(0.02)
        process.terminate()
        self.assertEqual(process.wait(timeout=30), 3)
        self.assertEqual([path.name for path in self.folder.glob("study/made/*/*.run.h5*") if not path.is_symlink()], [])
        before = self.calls()
        self.assertIn("part.rom.h5 ", before)
        (self.given / "wait").unlink()
        self.study()
        self.assertEqual(len(before) + len(self.made), 14)

    def test_two_studies_do_not_work_in_one_folder(self):
        (self.folder / "study").mkdir()
        with open(self.folder / "study/.lock", "w") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            with self.assertRaisesRegex(BadArtefact, "another clatter study works in this folder"):
                self.study()
            self.assertEqual(self.calls(), [])
        self.study()
        self.assertEqual(len(self.made), 14)

    def test_launchers_come_before_each_stage(self):
        os.environ["CLATTER_LAUNCH"] = "env LAUNCHED=cluster"
        self.calls()
        run.make(self.folder / "study.toml", 1)
        self.assertEqual({line.split(" ")[1] for line in self.calls()}, {"cluster"})

    def test_paths_that_lead_out_of_the_folder_still_lead_there(self):
        (self.root / "common.run.toml").write_text(f"[accuracy]\ntau = {TAU}")
        self.write("slap.run.toml", 'base = "../common.run.toml"\nrom = "part.rom.h5"')
        self.assertAlmostEqual(self.study().values[0][0].number(), exact(), delta=1e-12)


class Refused(StandIns):
    def refused(self, old, new, said):
        self.assertIn(old, STUDY)
        self.write("study.toml", STUDY.replace(old, new, 1))
        self.calls()
        with self.assertRaises(BadArtefact) as caught:
            run.make(self.folder / "study.toml", 1)
        self.assertIn(said, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))
        self.assertEqual(self.calls(), [])

    def test_what_is_wrong_is_said_in_one_line_before_anything_is_made(self):
        self.refused('unit = "mm"', "units = 1", "setting[0]: units: unknown key, expected one of base, key, keys")
        self.refused("part.mesh.toml:mesh.h", "part.mesh.toml:mesh.size", "part.mesh.toml: found no mesh.size, expected it there, or its default as base")
        self.refused("part.mesh.toml:mesh.h", "other.mesh.toml:mesh.h", "other.mesh.toml: no such file")
        self.refused("part.mesh.toml:mesh.h", "part.mesh.toml", "found key part.mesh.toml, expected a file of the pipeline's folder and a path of keys")
        self.refused("part.rom.toml:basis.n", "part.mesh.toml:mesh.h", "found part.mesh.toml:mesh.h twice")
        self.refused("[4.0, 2.0,", "[2.0, 2.0,", "setting[0].values: found a value twice")
        self.refused('reference = "finest"', 'reference = "best"', "setting[2].reference: found 'best', expected auto, finest, richardson")
        self.refused('take = "dataset"', 'take = "data"', "quantity[0].take: found 'data', expected one of frequency, line, slap_time")
        self.refused('path = "result/value"', 'route = "result/value"', "quantity[0].route: unknown key of dataset, expected one of path, reduce")
        self.refused('name = "modes"', 'name = "tolerance"', "found two setting named tolerance")
        self.refused('file = "slap.field.h5"', 'file = "slip.field.h5"', "No rule to make target 'slip.field.h5'")
        self.refused("part.rom.toml:basis.n", "field.toml:b.n", "field.toml: found no b.n")
        self.refused('values = [0.4, 0.2, 0.1, 0.05]', 'values = [0.4, [0.2, 0.1]]', "setting[1].values: found [0.2, 0.1], expected a number, text, true or false")

    def test_a_setting_that_no_quantity_depends_on_is_named(self):
        self.write("other.toml", "n = 1")
        self.refused("part.rom.toml:basis.n\"\nvalues = [1, 2, 4, 8]", "other.toml:n\"\nvalues = [1, 2]", "modes: found no quantity that depends on other.toml")

    def test_a_quantity_that_is_not_in_its_file_is_named(self):
        self.write("study.toml", STUDY.replace("result/value", "result/values", 1))
        self.assertIn("slap.field.h5: result/values: missing; result contains: curve, value", self.command(code=2))


class Convergence(unittest.TestCase):
    def test_orders_of_uneven_steps_are_exact(self):
        for p in (0.5, 1.0, 2.0, 4.3):
            h = [3.0, 2.0, 0.7]
            q = [5.0 - 0.4 * one**p for one in h]
            self.assertAlmostEqual(convergence.order_of(h, q), p, delta=1e-9)
            self.assertAlmostEqual(convergence.limit_of(h, q, p), 5.0, delta=1e-12)

    def test_what_has_no_order_gives_none(self):
        h = [4.0, 2.0, 1.0]
        for q in ([1.0, 2.0, 1.5], [1.0, 1.0, 1.0], [1.0, 1.1, 1.3]):
            self.assertTrue(np.isnan(convergence.order_of(h, q)), q)

    def test_orders_that_disagree_give_the_finest_value_as_reference(self):
        q = [quantities.number(one) for one in (1.0, 0.5, 0.45, 0.40)]
        found = convergence.line("auto", [0, 1, 2, 3], [8.0, 4.0, 2.0, 1.0], q, q[1])
        self.assertEqual((found.source, found.reference.values[0]), ("finest", 0.40))
        self.assertAlmostEqual(found.base_error.values[0], 0.1)

    def test_the_pareto_front_is_what_nothing_beats(self):
        self.assertEqual(convergence.pareto([1.0, 2.0, 3.0, 2.5, 9.0], [1.0, 0.5, 0.6, 0.1, float("nan")]), [0, 1, 3])


class Values(unittest.TestCase):
    def test_differences_of_curves_are_where_both_are_known(self):
        one = quantities.Value(np.array([1.0, 2.0, 3.0]), np.array([100.0, 125.0, 160.0]))
        other = quantities.Value(np.array([1.5, 5.0]), np.array([125.0, 160.0]))
        np.testing.assert_array_equal(one.minus(other).values, [0.5, -2.0])
        self.assertEqual((one.minus(other).size(), one.minus(other).number()), (2.0, -2.0))
        np.testing.assert_array_equal(one.plus(other).values, [3.5, 8.0])

    def test_histories_are_reduced_over_their_last_cycle(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.run.h5"
            with h5py.File(path, "w") as file:
                angle = np.linspace(0.0, 1440.0, 2881)
                file["history/crank_angle_deg"], file["history/force"] = angle, np.where(angle < 700.0, 99.0, np.cos(np.radians(angle)))
                file["history/c_tension_a_b"], file["history/c_tension_min"] = 7.0 + 0.0 * angle, 9.0 + 0.0 * angle
                file["energy/terms/piston_liner lost"], file["energy/time"], file["energy/crank_angle_deg"] = angle**2, angle / 1440.0, angle
            take = lambda reduce: quantities.extract(path, "dataset", {"path": "history/force", "reduce": reduce, "column": 0, "last_cycle_only": True})  # noqa: E731
            self.assertAlmostEqual(take("max").number(), 1.0)
            self.assertAlmostEqual(take("range").number(), 2.0)
            self.assertAlmostEqual(take("rms").number(), np.sqrt(0.5), delta=1e-3)
            curve = take("curve")
            np.testing.assert_allclose(curve.values, np.cos(2.0 * 2.0 * np.pi * curve.at), atol=1e-4)
            self.assertEqual(quantities.extract(path, "link_force", {"chain": "c"}).number(), 7.0)
            self.assertAlmostEqual(quantities.extract(path, "loss", {"element": "piston_liner"}).number(), (1440.0**2 - 720.0**2) / 0.5)

    def test_a_table_is_the_same_after_it_was_written(self):
        text = """a = 1\nb = "x\\"y"\nc = [1.5, 2]\nd = inf\n"odd key" = true\n[t]\ne = 2024-01-02\n[t.u]\nf = [{ g = 1 }, 2]\n[[list]]\nname = "n"\n[[list.inner]]\nh = -1e-3\n[[list]]\nk = []\n"""
        table = tomllib.loads(text)
        self.assertEqual(tomllib.loads(toml_text.text_of(table)), table)

    def test_keys_go_through_names_and_numbers_of_tables_in_lists(self):
        table = {"body": [{"name": "a", "v": 1}, {"name": "b", "v": 2}], "load": [{"v": 3}], "list": [1, 2]}
        for path, value in ((("body", "b", "v"), 2), (("load", "0", "v"), 3), (("list", "1"), 2)):
            self.assertEqual(toml_text.value_at(table, path), value)
            toml_text.set_value("", table, path, 9)
            self.assertEqual(toml_text.value_at(table, path), 9)
        toml_text.set_value("", table, ("new", "key"), True)
        self.assertIs(table["new"]["key"], True)
        with self.assertRaisesRegex(BadArtefact, "found no table c, expected one"):
            toml_text.set_value("x", table, ("body", "c", "v"), 1)

    def test_step_sizes_follow_the_only_number_that_changes(self):
        self.assertEqual(plan.step_sizes([(4,), (2,)]), [4.0, 2.0])
        self.assertEqual(plan.step_sizes([(10, 24), (10, 48)]), [1 / 24, 1 / 48])
        self.assertIsNone(plan.step_sizes([(10, 24), (20, 64)]))
        self.assertIsNone(plan.step_sizes([("a",), ("b",)]))
        self.assertIsNone(plan.step_sizes([(1,), (3,), (2,)]))


if __name__ == "__main__":
    unittest.main(verbosity=2)
