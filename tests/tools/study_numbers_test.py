# SPDX-License-Identifier: GPL-3.0-or-later
"""Orders, references, differences, step sizes and keys of `clatter study`."""
import pathlib
import tempfile
import tomllib
import types
import unittest

import h5py
import numpy as np
import synthetic

from clatter.artefact import BadArtefact
from clatter_tools import slap
from clatter_tools.keys import rows, study_keys
from clatter_tools.study import convergence, effect_keys, effects, plan, quantities, toml_text


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

    def test_differences_that_fall_steadily_are_expected_with_their_sign(self):
        values = [quantities.number(one) for one in (1.5, 1.2, 1.05, 1.0)]
        found, steady = convergence.expected(convergence.line("finest", [0, 1, 2, 3], None, values, values[1]))
        self.assertTrue(steady)
        np.testing.assert_allclose([one.number() for one in found], [0.5, 0.2, 0.05, 0.025], atol=1e-12)
        # Of Richardson's limit the finest value has the known difference.
        values = [quantities.number(1.0 + h) for h in (0.8, 0.4, 0.2, 0.1)]
        found, steady = convergence.expected(convergence.line("auto", [0, 1, 2, 3], [8.0, 4.0, 2.0, 1.0], values, values[1]))
        self.assertTrue(steady)
        np.testing.assert_allclose([one.number() for one in found], [0.8, 0.4, 0.2, 0.1], atol=1e-9)

    def test_along_a_line_that_jumps_no_value_is_better_than_a_finer_one(self):
        for values, wanted in (((1.02, 0.7, 1.3, 1.0), (0.3, 0.3, 0.3, 0.3)), ((1.5, 1.02, 1.2, 1.0), (0.5, 0.2, 0.2, 0.2)),
                               ((1.0, 1.1, 1.2, 1.0), (0.2, 0.2, 0.2, 0.2)), ((1.4, 1.0), (0.4, 0.4)), ((1.0, 1.0), (0.0, 0.0))):
            values = [quantities.number(one) for one in values]
            found, steady = convergence.expected(convergence.line("auto", list(range(len(values))), None, values, values[0]))
            self.assertEqual(steady, wanted[0] == 0.0)
            np.testing.assert_allclose([one.size() for one in found], wanted, atol=1e-12)

    def test_curves_fall_steadily_where_their_changes_point_the_same_way(self):
        curve = lambda *values: quantities.Value(np.array(values), np.arange(len(values)) + 1.0)  # noqa: E731
        line = lambda *values: convergence.line("auto", list(range(len(values))), None, list(values), values[0])  # noqa: E731
        self.assertTrue(convergence.expected(line(curve(4.0, 2.0), curve(2.0, 1.1), curve(1.0, 0.5)))[1])
        self.assertFalse(convergence.expected(line(curve(4.0, 2.0), curve(2.0, 1.1), curve(3.0, 1.5)))[1])
        # Bands that a coarse value lacks do not count.
        self.assertTrue(convergence.expected(line(curve(4.0), curve(2.0, 1.1), curve(1.0, 0.5)))[1])

    def test_the_budget_of_a_curve_is_compared_where_the_run_differs_most(self):
        curve = lambda *values: quantities.Value(np.array(values), np.arange(len(values)) + 1.0)  # noqa: E731
        budget = lambda run, *sums: convergence.Budget([], curve(*sums), run and curve(*run), curve(*sums))  # noqa: E731
        self.assertAlmostEqual(budget((1.0, -4.0), 5.0, -2.0).closure(), 0.5)
        self.assertAlmostEqual(budget((1.0, -4.0), 5.0, 4.0).closure(), -1.0)
        self.assertAlmostEqual(budget((2.0,), 3.0).closure(), 1.5)
        self.assertTrue(np.isnan(budget((0.0, 0.0), 1.0, 1.0).closure()) and np.isnan(budget(None, 1.0).closure()))

    def test_the_pareto_front_is_what_nothing_beats(self):
        self.assertEqual(convergence.pareto([1.0, 2.0, 3.0, 2.5, 9.0], [1.0, 0.5, 0.6, 0.1, float("nan")]), [0, 1, 3])


class EffectKeys(unittest.TestCase):
    SCENE = {"contact": {"friction": True}, "cylinder": [{"name": "c1"}, {"name": "c3", "contact": {"friction": True}}], "shaft": [{"name": "intake"}],
             "valve": [{"name": "intake", "model": "full"}], "piston": {}}

    def keys(self, name):
        return effect_keys.keys_of(name, lambda path: toml_text.value_at(self.SCENE, path))

    def test_effects_of_all_cylinders_have_one_name(self):
        for name, plain in (("c3: oil film", "oil film"), ("elastic c1_piston", "elastic piston"), ("elastic piston", "elastic piston"),
                            ("other: oil film", "other: oil film"), ("elastic block", "elastic block")):
            self.assertEqual(effect_keys.plain_name(name, ["c1", "c3"]), plain)
        states = effects.plain_states({"c1: friction": "off", "c3: friction": "on", "c1: oil film": "off", "c3: oil film": "off"},
                                      lambda path: toml_text.value_at(self.SCENE, path))
        self.assertEqual(states, {"friction": "on", "oil film": "off"})

    def test_an_effect_that_needs_another_one_is_not_switched_on_without_it(self):
        scene = {"contact": {"lubrication": "none", "asperities": True}, "gravity_m_s2": 0.0}
        pipeline = types.SimpleNamespace(base_value=lambda file, path: toml_text.value_at(scene, path), table=lambda file: scene)
        wanted = types.SimpleNamespace(path="study.toml", effects=[])
        for film, names in (("off", ["oil film", "gravity"]), ("on", ["oil film", "cavitation", "gravity"])):
            states = {"slap.run.toml": {"oil film": film, "cavitation": "off", "gravity": "off"}}
            self.assertEqual([one.name for one in effects.switches_of(wanted, pipeline, states)], names)

    def test_keys_are_those_of_the_scene_and_of_the_cylinders_that_have_their_own(self):
        self.assertEqual(self.keys("friction"), [(("contact", "friction"), False, True), (("cylinder", "c3", "contact", "friction"), False, True)])
        self.assertEqual(self.keys("intake bending"), [(("shaft", "intake", "model"), "torsion", None)])
        self.assertEqual(self.keys("valve train intake"), [(("valve", "intake", "model"), "quasi_static", "full")])
        self.assertEqual(self.keys("exhaust bending"), [])
        self.assertEqual(self.keys("balance by other cylinders"), [])  # the scene has no [engine]
        self.assertEqual(self.keys("gravity"), [(("gravity_m_s2",), 0.0, 9.81)])


class Onset(unittest.TestCase):
    def test_the_first_of_two_peaks_counts_whichever_is_higher(self):
        time = np.arange(-0.005, 0.01, 1e-5)
        bump = lambda at: np.maximum(0.0, 1.0 - np.abs(time - at) / 1e-4)  # noqa: E731
        for second in (0.9, 1.1):
            values = -bump(0.5e-3) + second * bump(3e-3)
            level = 0.5 * max(1.0, second)
            self.assertAlmostEqual(slap.onset(time, values, 0.5), 0.4e-3 + level * 1e-4, delta=1e-9)
            self.assertAlmostEqual(slap.onset(time, values, 1.0), 0.5e-3 if second < 1.0 else 3e-3, delta=1e-9)
        self.assertEqual(slap.peak(time, -bump(0.5e-3) + 1.1 * bump(3e-3))[0], time[np.argmin(np.abs(time - 3e-3))])

    def test_its_part_has_a_range(self):
        for part in (0.0, 1.1, -1):
            with self.assertRaisesRegex(BadArtefact, "part: found .*, expected a number above 0 at most 1"):
                rows.check("study.toml", {"name": "a", "file": "b.h5", "take": "slap_time", "part": part}, study_keys.QUANTITY)

    def test_a_key_of_another_kind_is_refused(self):
        with self.assertRaisesRegex(BadArtefact, "quantity\\[0\\].chain: no key of loss, which has element"):
            quantities.own_keys("study.toml: quantity[0]", {"take": "loss", "element": "a", "chain": "b"})
        with self.assertRaisesRegex(BadArtefact, "quantity\\[0\\].element: found nothing, loss needs it"):
            quantities.own_keys("study.toml: quantity[0]", {"take": "loss"})


class Values(unittest.TestCase):
    def test_differences_of_curves_are_where_both_are_known(self):
        one = quantities.Value(np.array([1.0, 2.0, 3.0]), np.array([100.0, 125.0, 160.0]))
        other = quantities.Value(np.array([1.5, 5.0]), np.array([125.0, 160.0]))
        np.testing.assert_array_equal(one.minus(other).values, [0.5, -2.0])
        self.assertEqual((one.minus(other).size(), one.minus(other).number()), (2.0, -2.0))
        np.testing.assert_array_equal(one.plus(other).values, [3.5, 8.0])

    def test_means_have_standard_errors_and_an_effect_within_them_is_not_decided(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.field.h5"
            synthetic.write_field(path)
            with h5py.File(path, "r+") as file:
                once = float(file["analysis/cycle/panels/skin"].attrs["erp_dba"])
                synthetic.add_mean(file, error=0.3, more_db=1.0)
            one = quantities.extract(path, "erp_dba", {"panel": "skin"})
        self.assertAlmostEqual(one.number(), once + 1.0)
        self.assertEqual(one.text(4), f"{once + 1.0:.4g} ± 0.30")
        change = quantities.mean(once + 1.5, 0.4).minus(one)
        self.assertAlmostEqual(change.error, 0.5)  # 0.3 and 0.4, independent
        self.assertAlmostEqual(change.times(-2.0).error, 1.0)
        own = quantities.Quantity("power", "a.field.h5", "erp_dba", {}, "dB(A)", False, 0.1)
        found = effects.Effects(types.SimpleNamespace(quantities=[own]), [one], [])
        self.assertEqual(effects.change_text(found, 0, change), "+0.5 ± 0.5 dB(A)")
        advice = lambda value, error: effects.advice(found, effects.Switch("x", "off", {}, [quantities.mean(value, error)], 0.5))  # noqa: E731
        self.assertEqual(advice(0.5, 0.5), "keep (within twice the standard error: more cycles decide)")
        self.assertEqual(advice(1.5, 0.5), "keep")
        self.assertEqual(advice(0.02, 0.03), "leave out")
        self.assertEqual(advice(0.5, np.nan), "keep")

    def test_a_frequency_above_what_the_certificate_covers_is_said(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.rom.h5"
            with h5py.File(path, "w") as file:
                file["K_rr"], file["M_rr"] = np.diag([0.0, 1.0, 4.0]) * (2.0 * np.pi) ** 2, np.eye(3)
                file.create_group("certificate").attrs["accurate_to_hz"] = 1.5
            found = [quantities.extract(path, "frequency", {"number": number}) for number in (2, 3)]
            self.assertEqual([one.beyond for one in found], ["", "2 Hz of 1.5 Hz"])
            self.assertAlmostEqual(found[1].number(), 2.0)

    def test_a_slap_up_to_a_frequency_lacks_what_rings_above_it(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.field.h5"
            synthetic.write_field(path, ring_hz=1800.0)
            take = lambda to_hz, name="slap_height": quantities.extract(path, name, {"to_hz": to_hz})  # noqa: E731
            with h5py.File(path) as file:
                self.assertEqual(take(0.0).number(), slap.peak(*slap.band_limited(file, "analysis/cycle/sensors/sensor_liner", "analysis/cycle"))[1])
            self.assertLess(take(1000.0).number(), 0.3 * take(0.0).number())
            self.assertEqual(take(4984.0).number(), take(0.0).number())
            self.assertEqual([take(0.0).beyond, take(4990.0).beyond, take(6000.0, "rings_until").beyond], ["", "", "spectra to 4983 Hz of 6000 Hz"])
            bands = lambda to_hz: quantities.extract(path, "third_octaves", {"of": "panels/skin", "from_hz": 900.0, "to_hz": to_hz})  # noqa: E731
            self.assertEqual([bands(4500.0).beyond, bands(quantities.EVERYTHING).beyond, bands(5500.0).beyond], ["", "", "third octaves to 3981.07 Hz of 5500 Hz"])

    def test_histories_are_reduced_over_their_last_cycle(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.run.h5"
            with h5py.File(path, "w") as file:
                angle = np.linspace(0.0, 1440.0, 2881)
                file["history/crank_angle_deg"], file["history/force"] = angle, np.where(angle < 700.0, 99.0, np.cos(np.radians(angle)))
                file["history/c_tension_a_b"], file["history/c_tension_min"] = 7.0 + 0.0 * angle, 9.0 + 0.0 * angle
                file["energy/terms/piston_liner lost"], file["energy/time"], file["energy/crank_angle_deg"] = -angle**2, angle / 1440.0, angle
            take = lambda reduce: quantities.extract(path, "dataset", {"path": "history/force", "reduce": reduce, "column": 0, "last_cycle_only": True})  # noqa: E731
            self.assertAlmostEqual(take("max").number(), 1.0)
            self.assertAlmostEqual(take("range").number(), 2.0)
            self.assertAlmostEqual(take("rms").number(), np.sqrt(0.5), delta=1e-3)
            # Rows of histories are steps of the integration: means are over time, whatever their number.
            with h5py.File(path, "r+") as file:
                time = np.concatenate([np.linspace(0.0, 0.5, 1000), np.linspace(0.5, 1.0, 12)[1:]])
                file["chain/time"], file["chain/ramp"], file["chain/other"] = time, time, np.append(time, 9.0)
            mean = lambda name, reduce="mean": quantities.extract(path, "dataset", {  # noqa: E731
                "path": name, "reduce": reduce, "column": 0, "last_cycle_only": False}).number()
            self.assertAlmostEqual(mean("chain/ramp"), 0.5, delta=1e-12)
            self.assertAlmostEqual(mean("chain/ramp", "rms"), np.sqrt(1.0 / 3.0), delta=1e-3)
            self.assertAlmostEqual(mean("chain/other"), np.mean(np.append(time, 9.0)))
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
