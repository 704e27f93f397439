# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions below the absolute tolerance of [accuracy]: dynamics reports the error of its velocities and a remedy."""
import re
import unittest

import h5py
import numpy as np
import stages


class SmallMotion(stages.PipelineTest):
    """The beam under a step force of 100 nN: nanometres, where 10 um and 0.1 m/s are no bound."""

    def response(self, force, accuracy="", step_us=600.0, exact=True):
        """(velocities at the samples, warnings) of a step force [N] on the beam's tip; the
        default of the largest step is that of a scene, a hundredth of the span."""
        scene = (stages.SOURCE / "samples/beam/step.run.toml").read_text()
        for old, new in (("value = 100.0", f"value = {force}"), ("largest_step_us = 50.0", f"largest_step_us = {step_us}\nexact_modes = {str(exact).lower()}")):
            self.assertIn(old, scene)
            scene = scene.replace(old, new)
        (self.folder / "step.run.toml").write_text(scene + accuracy)
        done = stages.run_stage("dynamics", "step.run.toml", "-o", "step.run.h5", "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.folder / "step.run.h5") as run:
            return run["bodies/beam/v"][()], done.stderr.strip()

    def error(self, found, reference):
        """Largest error of the velocity over its largest value, by kinetic energy."""
        with h5py.File(self.folder / "beam.rom.h5") as rom:
            M = rom["M_rr"][()]
        norm = lambda v: np.sqrt(np.einsum("ti,ij,tj->t", v, M, v)).max()
        return norm(found - reference) / norm(reference)

    def test_the_warning_has_the_size_of_the_error_and_its_advice_helps(self):
        reference, _ = self.response(1e-7, step_us=1.0)
        found, warning = self.response(1e-7, exact=False)
        percent, scale = map(float, re.search(r"beam: .*off by about (\S+) %.*velocity_m_s = (\S+) there", warning).groups())
        actual = 100.0 * self.error(found, reference)
        print(f"    stated {percent} %, found {actual:.2f} %: {warning}")
        self.assertGreater(actual, 2.0)
        # The estimate adds all local errors in phase: an upper bound, by less than three for a beam that rings in a few modes.
        self.assertTrue(0.9 * actual < percent < 3.0 * actual, (percent, actual))
        found, warning = self.response(1e-7, f"\n[accuracy]\nvelocity_m_s = {scale}\n", exact=False)
        actual = 100.0 * self.error(found, reference)
        print(f"    with the advice {actual:.2f} %")
        self.assertEqual(warning, "")
        self.assertLess(actual, 1.0)

    def test_where_free_modes_are_exact_the_warning_is_above_the_error(self):
        # The embedded error is that of the method without exact modes: it counts a free motion that is exact.
        reference, _ = self.response(1e-7, step_us=1.0)
        found, warning = self.response(1e-7)
        percent = float(re.search(r"beam: .*off by about (\S+) %", warning).group(1))
        actual = 100.0 * self.error(found, reference)
        print(f"    stated {percent} %, found {actual:.2f} %")
        self.assertTrue(0.9 * actual < percent < 20.0 * actual, (percent, actual))

    def test_motions_well_above_the_tolerance_give_no_warning(self):
        self.assertEqual(self.response(1e4)[1], "")


if __name__ == "__main__":
    unittest.main(verbosity=2)
