# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter study` on samples/beam with the programs themselves."""
import os
import pathlib
import subprocess
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import stages  # noqa: E402
from clatter_tools.study import effects, findings, run  # noqa: E402

STUDY = """
[[setting]]
name = "modes up to"
unit = "Hz"
key = "beam.rom.toml:fmax_hz"
values = [300.0, 4000.0]

[[setting]]
name = "largest step"
key = "step.run.toml:time.largest_step_us"
values = [400.0, 50.0]

[[quantity]]
name = "fourth frequency"
file = "beam.rom.h5"
take = "frequency"
number = 4
exact = { file = "beam.modes.h5", take = "frequency", number = 4 }

[[quantity]]
name = "mean of the tip"
file = "step.run.h5"
take = "dataset"
path = "bodies/beam/q"
column = 2
reduce = "mean"
unit = "m"

[[effect]]
name = "force"
key = "step.run.toml:load.0.value"
off = 0.0
"""


class BeamStudy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = stages.copy_sample(cls, "beam")
        stages.make(cls.folder, "beam.modes.h5", "beam.rom.h5")
        (cls.folder / "short.toml").write_text(STUDY)
        os.environ["CLATTER_BIN"] = str(stages.BIN)
        os.environ["CLATTER_FLAGS"] = "--quiet"
        cls.study = run.make(cls.folder / "short.toml", 2)
        cls.made = [path.name.split("-")[0] for path in (cls.folder / "short/made").iterdir()]

    def test_the_artefacts_are_those_of_the_pipeline_to_the_bit(self):
        with h5py.File(self.folder / "beam.rom.h5") as own, h5py.File(self.folder / "short/variants/base/beam.rom.h5") as made:
            for name in ("K_rr", "M_rr"):
                np.testing.assert_array_equal(own[name][()], made[name][()])

    def test_variants_share_the_mesh_and_few_modes_have_the_larger_error(self):
        self.assertEqual({kind: self.made.count(kind) for kind in self.made}, {"beam.mesh": 1, "beam.fe": 1, "beam.rom": 2, "step.run": 3})
        names = [one.name for one in self.study.variants]
        errors = dict(zip(names, (self.study.error(0, k) for k in range(len(names)))))
        self.assertGreater(errors["modes up to 300 Hz"], 0.02)  # the fourth mode is at 570 Hz
        self.assertLess(errors["base"], 1e-6)
        self.assertEqual([one.name for one, value in zip(self.study.variants, self.study.values[0]) if value.beyond], ["modes up to 300 Hz"])
        self.assertRegex(findings.verdict(self.study, 0), r"is beyond what the model states with modes up to 300 Hz \(\d+\.?\d* Hz of 150 Hz\)")
        self.assertEqual(errors["largest step 400"], errors["base"])
        self.assertTrue(all(self.study.cost(k) > 0.0 for k in range(len(names))))

    def test_effects_are_switched_off_and_on(self):
        found = effects.make(self.folder / "short.toml", 2)
        self.assertEqual([(one.name, one.to) for one in found.switches], [("elastic beam", "off"), ("gravity", "on"), ("force", "off")])
        elastic, gravity, force = found.switches
        self.assertEqual([one.changes[0].number() for one in found.switches], [0.0, 0.0, 0.0])
        # A rigid beam that is clamped has no coordinate that could move: its run is refused.
        self.assertIsNone(elastic.changes[1])
        self.assertEqual(effects.advice(found, elastic), "keep (some results cannot be computed without it)")
        self.assertLess(gravity.changes[1].number(), 0.0)  # along -z
        self.assertAlmostEqual(force.changes[1].number(), -found.base[1].number(), delta=1e-15)  # without it nothing moves
        self.assertTrue(effects.report(found)[1].startswith("gravity (off): fourth frequency +0 %, mean of the tip -"))
        self.assertTrue(effects.report(found)[2].endswith("keep"))

    def test_the_sample_s_study_is_read_and_names_what_the_pipeline_has(self):
        done = subprocess.run(["make", "-n", "study"], cwd=self.folder, capture_output=True, text=True, env={**os.environ, "MAKEFLAGS": ""}, check=True)
        self.assertIn("clatter study study.toml", done.stdout)
        wanted = run.plan.read(self.folder / "study.toml")
        pipeline = run.pipeline_of(wanted)
        self.assertEqual(run.variants.base_values(wanted, pipeline), ((15.0,), (4000.0,), (50.0,)))


if __name__ == "__main__":
    unittest.main(verbosity=2)
