# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter study`: orders, budget, costs and proposals against known ones, and what is refused."""
import csv
import itertools
import math
import unittest
import unittest.mock

import h5py
import numpy as np
from study_stand_ins import H, N, SMALL, STUDY, TAU, StandIns, exact, write_given

from clatter_command import clatter
from clatter.artefact import BadArtefact
from clatter_tools.study import effect_keys, effects, effects_page, findings, markdown, place, proof, proposal, run


class Numbers(StandIns):
    def test_orders_limits_budget_and_cost_are_the_known_ones(self):
        said = self.command()
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
                      f"{100 * fine:.2g} % costs 40 s (0.05); below 2 % cell size dominates; 126 s of other stages", said)
        self.assertIn("tolerance, of the part: no value changes it", said)
        self.assertIn(f"\nvalue: {exact():.4g} N, total error {100 * abs(exact() / reference - 1.0):.2g} % for 136 s; cell size dominates with 2 %\n", said)
        self.assertIn("sum / run 1.00", said)
        self.assertIn("value: the budget is closed, sum over run 1.00", said)
        self.assertNotIn("does not converge", said)
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
            proved = proof.prove(study, 0, best, 2, place.place_of(study, 0, within / reference, 2))
            error, spent = proved.error, proved.seconds
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
        self.assertLessEqual(best.seconds, proposal.SAME * min(seconds))

        # With values that the model does not state nothing is proposed, nor between them and others.
        few = [k for k, one in enumerate(study.variants) if one.values in [((H,), (TAU,), (n,)) for n in (1, 2)]]
        self.assertEqual({one.value[0] for one in proposal.candidates(study, 0, 2)}, {1, 2, 3, 4, 6, 8})
        for k in few:
            study.values[0][k].beyond = "above what is stated"
        self.assertEqual({one.value[0] for one in proposal.candidates(study, 0, 2)}, {4, 6, 8})
        self.assertIn("it is beyond what the model states with base (above what is stated), modes 1 (above what is stated)", findings.verdict(study, 0))

    def test_what_cannot_be_reached_is_said_with_the_nearest(self):
        self.write("study.toml", SMALL)
        line = self.command("--within", "value 0.001 %", code=3)
        self.assertIn("no settings of this study are within 0.001 %: add finer values, or allow a larger error", line)
        for text in ("level 1", "value", "value -1", "value 1 m", ""):
            self.calls()
            self.assertIn(f"--within: found {text!r}, expected a quantity and an error, as \"value 2 %\" or \"value 0.5\"; known: value", self.command("--within", text, code=2))
            self.assertEqual(self.calls(), [])
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

    def test_a_proposal_is_proved_in_a_scene_that_the_study_has_not_seen(self):
        study = self.study()
        within = 0.1
        there = place.place_of(study, 0, within, 2, place.elsewhere(study.plan, ["slap.run.toml:more.both=0.0"]))
        reference = exact(0.5, 0.05, 8) - sum(line.errors[-1].number() for line in study.lines[0].values())
        # Of each setting the value before the base's is run there: of the modes 1 instead of 2, which here change more than a tenth of what is asked for.
        self.assertEqual([study.variants[one].name for one in place.neighbours(study, 0).values()], ["cell size 4 mm", "tolerance 0.4", "modes 1"])
        self.assertEqual(place.those_that_matter(study, 0, within), list(place.neighbours(study, 0).values()))
        best, _ = place.propose_there(study, 0, within, math.inf, 2, there)
        times = []
        for changed in ({"h": 4.0}, {"tau": 0.4}, {"n": 1}):
            elsewhere, here = (abs(exact(both=both, **changed) / exact(both=both) - 1.0) for both in (0.0, self.both))
            times.append(max(elsewhere / here, place.LEAST))
        np.testing.assert_allclose(there.times(study), times, rtol=1e-9)
        # Along those that are not tried differences are as along the worst of the others, but not smaller.
        self.assertEqual([study.variants[one].name for one in place.those_that_matter(study, 0, 1e3 * within)], ["tolerance 0.4"])
        there.tried = {1: 0.7}
        self.assertEqual(there.times(study), [1.0, 0.7, 1.0])
        there.tried = {1: 3.0}
        self.assertEqual(there.times(study), [3.0, 3.0, 3.0])
        # What a proposal has coarser than the base is tried before it is believed, and counts at least as much as it does there.
        there.sizes = {}
        rough, _ = place.propose_there(study, 0, 1e3 * within, math.inf, 2, there)
        coarse = {one for number, one in enumerate(rough.variants) if place.is_coarser(study, 0, number, one)}
        self.assertTrue(coarse and coarse <= set(there.sizes))
        for one in there.sizes:
            h, tau, n = (value[0] for value in study.variants[one].values)
            self.assertAlmostEqual(there.sizes[one], study.scale(0) * abs(exact(h, tau, n) / exact() - 1.0), delta=1e-9)
        jump = proposal.propose(study, 0, 1e3 * within, times=[1.0] * 3, sizes={one: 1e9 for one in coarse})[0]
        self.assertEqual(coarse & set(jump.variants), set())
        plain, _ = proposal.propose(study, 0, within, times=[1.0] * 3)
        self.assertLess(best.seconds, plain.seconds)  # what acts on both settings is most of their errors in the study, and is off there
        self.assertLessEqual(best.expected, best.most)
        h, tau, n = (value[0] for value in best.values)
        write_given(self.given, 0.0, [h], [None, n], [None, tau])
        proved = proof.prove(study, 0, best, 2, there)
        self.assertAlmostEqual(proved.error, abs(exact(h, tau, n) - reference) / reference, delta=1e-12)
        # The run without the effect is three seconds shorter, the other stages are not.
        self.assertAlmostEqual(proved.expected, best.seconds - 3.0 * best.factors["slap.run.h5"], delta=1e-12)
        for text, said in (("slap.run.toml:more.both", "expected a key of a file and its value"), ("more.both=1", "found key more.both, expected a file"),
                           ("slap.run.toml:accuracy.tau=1", "which is a setting of")):
            with self.assertRaisesRegex(BadArtefact, said):
                place.elsewhere(study.plan, [text])

    def test_proofs_are_kept_once_for_each_request_and_scene(self):
        study = self.study()
        row = ["value 1 %", "the study's", "h 2", "1 %, 10 s", "2 %, 10 s", "2.00", "1.00"]
        for last in ("1.00", "1.10"):
            proof.keep_proof(study.plan, [*row[:-1], last])
        proof.keep_proof(study.plan, [row[0], "elsewhere", *row[2:]])
        self.assertEqual([one[-1] for one in proof.read_proofs(study.plan)[1:]], ["1.10", "1.00"])
        self.assertEqual(len(markdown.proofs(study.plan)), 4)

    def test_an_effect_is_switched_off_and_its_change_and_cost_are_known(self):
        self.write("study.toml", STUDY[STUDY.index("[[quantity]]"):] + """
            [[effect]]
            name = "tolerance as an effect"
            key = "slap.run.toml:accuracy.tau"
            off = 0.1
            """)
        with unittest.mock.patch.dict(effect_keys.PLAIN, {"both": [("more.both", 0.0, None)], "rings": [("more.both", 0.0, None)]}):
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
        self.assertIn("without it 75 % more time: costs little, keep", effects.report(found)[1])
        self.assertIn("both,off,", effects.write(found).read_text())
        self.assertIn("<td>both</td><td>off</td>", effects_page.write(found).read_text())
        self.assertIn("| both | off |", markdown.effects(found)[2])
        # Without a value of one quantity it is kept, without any it could not be run.
        found.switches[0].changes[1] = None
        self.assertTrue(effects.report(found)[0].endswith("keep (some results cannot be computed without it)"), effects.report(found)[0])
        found.switches[0].changes[0] = None
        self.assertTrue(effects.report(found)[0].endswith("cannot be switched off here: see what its stage said"))

    def test_only_the_scene_runs_again_without_an_effect(self):
        self.write("study.toml", STUDY[STUDY.index("[[quantity]]"):])
        self.calls()
        with unittest.mock.patch.dict(effect_keys.PLAIN, {"both": [("more.both", 0.0, None)]}):
            effects.make(self.folder / "study.toml", 2)
            effects.make(self.folder / "study.toml", 2)  # nothing is made again
        made = [line.split(" ")[0] for line in self.calls()]
        self.assertEqual(sorted(made), sorted(["part.mesh.h5", "part.fe.h5", "part.rom.h5", *3 * ["slap.run.h5", "slap.field.h5"]]))
        # The third time is the base's: its seconds are those of the run beside the others.
        shown = self.folder / "study/variants/base-once-more"
        self.assertEqual({one.name: "once-more" in str(one.readlink()) for one in shown.iterdir() if one.suffix == ".h5"},
                         {"part.mesh.h5": False, "part.fe.h5": False, "part.rom.h5": False, "slap.run.h5": True, "slap.field.h5": True})


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
        self.refused('unit = "mm"', "units = 1", "setting[0].units: unknown key, did you mean unit?")
        self.refused("part.mesh.toml:mesh.h", "part.mesh.toml:mesh.size", "part.mesh.toml: found no mesh.size, expected it there, or its default as base")
        self.refused("part.mesh.toml:mesh.h", "other.mesh.toml:mesh.h", "other.mesh.toml: no such file")
        self.refused("part.mesh.toml:mesh.h", "part.mesh.toml", "found key part.mesh.toml, expected a file of the pipeline's folder and a path of keys")
        self.refused("part.rom.toml:basis.n", "part.mesh.toml:mesh.h", "found part.mesh.toml:mesh.h twice")
        self.refused("[4.0, 2.0,", "[2.0, 2.0,", "setting[0].values: found a value twice")
        self.refused('reference = "finest"', 'reference = "best"', "setting[2].reference: found 'best', expected one of: auto, finest, richardson")
        self.refused('take = "dataset"', 'take = "data"', "quantity[0].take: found 'data', expected one of: frequency, line, slap_time")
        self.refused('path = "result/value"', 'route = "result/value"', "quantity[0].route: unknown key, did you mean ")
        self.refused('name = "modes"', 'name = "tolerance"', "found two tables [[setting]] named tolerance")
        self.refused('file = "slap.field.h5"', 'file = "slip.field.h5"', "No rule to make target 'slip.field.h5'")
        self.refused("part.rom.toml:basis.n", "field.toml:b.n", "field.toml: found no b.n")
        self.refused("[4.0, 2.0,", "[nan, 2.0,", "setting[0].values: found nan, expected a number, text, true or false")
        self.refused("[4.0, 2.0,", "[2, 2.0,", "setting[0].values: found a value twice")
        self.refused('name = "value"', 'name = "of-the part"',
                     "found two tables [[quantity]] whose pictures are of-the-part.png, as of-the part: expected names that differ")
        self.refused('\n[[setting]]', 'pipeline = 3\n[[setting]]', "pipeline: found 3, expected a path")
        self.refused('\n[[setting]]', 'reuse = true\ncost = "processor"\n[[setting]]', "reuse = true needs cost = \"seconds\"")
        self.refused('unit = "N"', "unit = 3", "quantity[0].unit: found 3, expected a text")
        self.refused('values = [4.0, 2.0, 1.0, 0.5]', "values = [8.0, 4.0]", "cell size: found 2 mm in the base, finer than the finest value 4 mm")
        self.refused('values = [0.4, 0.2, 0.1, 0.05]', 'values = [0.4, [0.2, 0.1]]', "setting[1].values: found [0.2, 0.1], expected a number, text, true or false")

    def test_a_setting_that_no_quantity_depends_on_is_named(self):
        self.write("other.toml", "n = 1")
        self.refused("part.rom.toml:basis.n\"\nvalues = [1, 2, 4, 8]", "other.toml:n\"\nvalues = [1, 2]", "modes: found no quantity that depends on other.toml")

    def test_a_quantity_that_is_not_in_its_file_is_named(self):
        self.write("study.toml", STUDY.replace("result/value", "result/values", 1))
        self.calls()
        said = self.command(code=2)
        self.assertIn("study.toml: value: ", said)
        self.assertIn("slap.field.h5: result/values: missing; result contains: curve, value", said)
        self.assertEqual(len(self.calls()), 5)  # the base is made first, and nothing else

    def test_what_a_proof_cannot_use_is_said_before_anything_is_made(self):
        self.calls()
        for at, said in (("nix.toml:a=3", "--at: found nix.toml, expected a file of"), ("slap.run.toml:a=", "expected a key of a file and its value")):
            self.assertIn(said, self.command("--within", "value 1", "--at", at, code=2))
        self.assertIn("-j: found 0, expected a number from 1", self.command("-j", "0", code=2))
        self.assertEqual(self.calls(), [])
        self.write("study.toml", SMALL)
        self.write("other.toml", "n = 1")
        self.assertIn("--at: found other.toml:n, on which value does not depend, expected a key that changes it",
                      self.command("--within", "value 5 %", "--at", "other.toml:n=2", code=2))


class Said(StandIns):
    def test_an_artefact_is_a_line_with_its_warnings_and_a_stage_that_fails_is_shown_in_full(self):
        self.write("study.toml", SMALL.replace("[2.0, 1.0]", "[20.0, 2.0, 1.0]"))
        done = clatter("study", "study.toml", folder=self.folder, environment={"CLATTER_BIN": "../bin"})
        self.assertEqual(done.returncode, 3, done.stderr)
        lines = done.stdout.splitlines()
        self.assertEqual(lines[1:6], [f"  {name} of base" for name in ("part.mesh.h5", "part.fe.h5", "part.rom.h5", "slap.run.h5", "slap.field.h5")])
        self.assertIn("  slap.run.h5 of tolerance-0.1", lines)
        self.assertNotIn("details of", done.stdout)
        said = done.stderr.splitlines()
        self.assertEqual(said.count("  warning: slap.run.h5 is expensive"), 2)  # tolerance 0.1, all refined
        self.assertIn(["details of part.mesh.h5", "too coarse"], [said[k:k + 2] for k in range(len(said))])
        self.assertNotIn("details of slap.run.h5", said)
        logs = self.folder.glob("study/made/slap.run-*/.log")
        self.assertEqual({log.read_text().splitlines()[-1] for log in logs} - {"warning: slap.run.h5 is expensive"}, {"details of slap.run.h5"})


class Missing(StandIns):
    def test_without_its_finest_value_a_setting_s_error_is_from_the_finest_that_was_made(self):
        self.write("study.toml", SMALL.replace("[2.0, 1.0]", "[4.0, 2.0, 20.0]"))
        said = self.command(code=3)
        self.assertIn("2 of 5 variants lack a result: cell size 20 mm, all refined", said)
        with h5py.File(self.folder / "study/study.h5") as file:
            self.assertEqual(file["said/verdict"][0].decode(), "value: lacks the finest value of cell size, which could not be made: what is beyond the one before is not seen")
            self.assertAlmostEqual(file["quantity/value/budget"][1] * file["quantity/value/reference"][0], exact() - exact(tau=0.1), delta=1e-12)
        self.assertIn("the finest value of cell size could not be made: errors are not known", self.command("--within", "value 5 %", code=3))

    def test_a_variant_without_what_a_quantity_takes_lacks_its_value_only(self):
        study = run.make(self.folder / "study.toml", 2)
        wanted, made = study.plan, run.Making(study.plan, run.pipeline_of(study.plan))
        own = made.add({})
        wanted.quantities[1].keys["path"] = "result/other"
        self.assertEqual([one and one.number() for one in made.values(own, "modes-4")], [exact(), None])
        with self.assertRaisesRegex(BadArtefact, "study.toml: of the part: .*part.rom.h5: result/other: missing"):
            made.values(own)

    def test_a_base_between_the_values_is_one_of_them(self):
        self.write("study.toml", SMALL.replace("[0.2, 0.1]", "[0.4, 0.1]"))
        study = self.study()
        self.assertEqual([len(study.variants), study.plan.settings[1].values], [5, [(0.4,), (0.2,), (0.1,)]])
        self.assertEqual([study.variants[k].name for k in study.lines[0][1].variants], ["tolerance 0.4", "base", "tolerance 0.1"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
