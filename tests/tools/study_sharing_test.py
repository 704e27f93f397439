# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter study`: what variants have in common is made once, also after an interruption, by launchers and in two studies."""
import fcntl
import os
import shutil
import signal
import subprocess
import time
import unittest

from study_stand_ins import MAKEFILE, SECONDS, SMALL, SOURCE, TAU, StandIns, exact

from clatter.artefact import BadArtefact
from clatter_tools.study import findings, run


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
        self.assertEqual(self.made, [])
        self.write("field.toml", "new = 1\n")
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
        said = "\n".join(findings.report(self.study(jobs=1)))
        self.assertRegex(said, r"\nbase .* \(taken over\)")
        self.assertIn("tolerance, value: no seconds are compared: 0.2, the base (taken over)", said)
        # What the pipeline's folder gets later does not change what the study has.
        (self.folder / "part.rom.h5").unlink()
        self.study()
        self.assertEqual(self.made, [])
        # Nothing is known of the processor seconds of what was taken over: it is made where they are asked for.
        self.write("study.toml", 'cost = "processor"\n' + SMALL)
        self.study()
        self.assertEqual(sorted(self.made), ["part.fe.h5", "part.mesh.h5", "part.rom.h5", "slap.run.h5"])
        self.study()
        self.assertEqual(self.made, [])

    def test_seconds_of_stages_that_ran_beside_others_are_not_ranked(self):
        self.assertEqual(findings.alike(self.study(jobs=1)), [])
        said = "\n".join(findings.report(self.study()))
        self.assertIn("% costs 10 s (0.2, the base)", said)
        # Both runs of the fine mesh at the same time; that of the base is still alone.
        fine = [path.parent for path in (self.folder / "study/made").glob("slap.run-*/.span")
                if os.path.samefile(path.parent / "part.rom.h5", next((self.folder / "study/variants").glob("cell*")) / "part.rom.h5")]
        self.assertEqual(len(fine), 2)
        shutil.copy(fine[0] / ".span", fine[1] / ".span")
        study = self.study()
        base, cell, tolerance, refined = range(4)
        self.assertEqual([study.conditions(one) for one in (base, cell, tolerance, refined)], [[], ["beside others"], [], ["beside others"]])
        self.assertNotIn(cell, findings.front(study, 0))
        said = "\n".join(findings.report(study))
        self.assertRegex(said, r"cell size 1 mm .* \(beside others\)")
        self.assertIn('seconds of stages that were measured beside others are not compared with others: cost = "processor", or -j1 without reuse', said)
        line = self.command("--within", "value 5 %", code=3)
        self.assertIn("--within: seconds of stages that were measured beside others are not compared", line)
        self.assertIn("found cell size 1 mm, all refined", line)
        # A launcher gives each stage processors of its own, and processor seconds do not depend on what else runs.
        (fine[1] / ".span").write_text((fine[1] / ".span").read_text().strip() + " launched\n")
        self.assertEqual(sum(bool(self.study().conditions(one)) for one in (cell, refined)), 1)
        self.write("study.toml", 'cost = "processor"\n' + SMALL)
        self.assertEqual(findings.alike(self.study()), [])
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
        self.calls()
        self.assertIn("study.toml: the base has no slap.field.h5", self.command(code=3))
        first = self.calls()
        self.assertEqual(sorted(one.split()[0] for one in first), ["part.fe.h5", "part.mesh.h5", "part.rom.h5"])  # the base is made first
        self.assertFalse((self.folder / "study/study.h5").exists())
        (self.given / "fail").unlink()
        self.study()
        self.assertEqual(len(first) + len(self.made), 14)  # nothing twice

    def test_an_interrupted_study_leaves_nothing_half_made_and_resumes(self):
        for number in (signal.SIGTERM, signal.SIGINT):
            with self.subTest(signal=number.name):
                shutil.rmtree(self.folder / "study", ignore_errors=True)
                self.interrupt(number)

    def interrupt(self, number):
        for name in ("wait", "waiting"):
            self.addCleanup((self.given / name).unlink, missing_ok=True)
        (self.given / "wait").touch()
        process = subprocess.Popen([SOURCE / "tools/clatter", "study", "study.toml"], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until = time.monotonic() + 60.0
        while not (self.given / "waiting").exists() and time.monotonic() < until:
            time.sleep(0.02)
        stage = int((self.given / "waiting").read_text())
        process.send_signal(number)
        self.assertEqual(process.wait(timeout=30), 3)
        self.assertFalse(is_running(stage))
        self.assertEqual([path.name for path in self.folder.glob("study/made/*/*.run.h5*") if not path.is_symlink()], [])
        before = self.calls()
        self.assertIn("part.rom.h5 ", before)
        for name in ("wait", "waiting"):
            (self.given / name).unlink()
        self.study()
        self.assertEqual(len(before) + len(self.made), 14)

    def test_seconds_before_an_interruption_count_where_the_stage_went_on_from_them(self):
        self.write("study.toml", SMALL)
        self.study()
        for goes_on in (True, False):
            folder = next((self.folder / "study/made").glob("slap.run-*"))
            (folder / "slap.run.h5").unlink()
            (folder / ".times.part").write_text("0m0.010000s 0m0.010000s\n1m40.000000s 0m0.500000s\n")
            if goes_on:
                (folder / "slap.run.h5.checkpoint").touch()
            study = self.study()
            self.assertIn("slap.run.h5", self.made)
            spent = max(stage.processor for stages in study.stages for stage in stages if stage.folder == folder.name)
            self.assertEqual(100.5 <= spent < 110.0 if goes_on else spent < 10.0, True, spent)
            (folder / "slap.run.h5.checkpoint").unlink(missing_ok=True)

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


def is_running(process):
    """Whether a process runs; one that has ended but was not waited for by its parent does not."""
    try:
        with open(f"/proc/{process}/stat", encoding="utf-8") as stat:
            return stat.read().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


if __name__ == "__main__":
    unittest.main(verbosity=2)
