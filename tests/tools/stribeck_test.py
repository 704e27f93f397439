# SPDX-License-Identifier: GPL-3.0-or-later
"""The Stribeck curve: its numbers by hand, its picture, and what it refuses."""
import contextlib
import pathlib
import tempfile
import unittest

import numpy as np
import synthetic
from clatter_command import clatter
from clatter.artefact import BadArtefact, open_artefact
from clatter_tools.plots import stribeck

CONFIG = "engine.speed_rpm = 600\nengine.stroke_mm = 100\ncontact.bore_mm = 100\ncontact.viscosity_pa_s = {}\n"


class Stribeck(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def run_file(self, name, viscosity=0.01, friction=20.0, more=""):
        """A cycle with a side force of 1000 N one half of it and 3000 N the other, after a cycle that does not count."""
        path = self.folder / f"{name}.run.h5"
        with synthetic.new_file(path, "run") as file:
            file.attrs["config"] = CONFIG.format(viscosity) + more
            angle = np.arange(-1080.0, 360.25, 0.5)
            side = np.where(angle < 0.0, -1000.0, 3000.0)
            side[angle < -360.0] = 77.0
            synthetic.put(file, "history/crank_angle_deg", angle, unit="deg")
            synthetic.put(file, "history/side_force", side, unit="N")
            synthetic.put(file, "history/friction_force", np.full(len(angle), -friction), unit="N")
            synthetic.put(file, "history/asperity_share", np.where(angle < 0.0, 0.0, 0.2), unit="1")
        return path

    def test_a_point_is_the_hand_computed_mean_of_the_last_cycle(self):
        with contextlib.closing(open_artefact(self.run_file("one"), "run")) as run:
            point = stribeck.point(run)
        # Mean load 2000 N, mean speed 2 m/s: 0.01 x 2 x 0.1 / 2000; half a step of the jump is 1e-3.
        self.assertAlmostEqual(point.hersey / 1e-6, 1.0, delta=1e-3)
        self.assertAlmostEqual(point.coefficient / 0.01, 1.0, delta=1e-3)
        self.assertAlmostEqual(point.share / 0.15, 1.0, delta=2e-3)

    def test_the_command_draws_runs_of_a_sweep(self):
        files = [self.run_file(f"s{k}", 10.0 ** -k, friction) for k, friction in ((1, 40.0), (2, 5.0), (3, 90.0))]
        done = clatter("plot", "stribeck", *files, "-o", "curve.svg", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("0.0025", (self.folder / "curve.svg").read_text())  # the minimum, 5 N of 2000 N

    def test_runs_without_one_viscosity_or_a_contact_are_refused_in_one_line(self):
        law = self.run_file("law", more='contact.oil.law = "vogel"\n')
        with contextlib.closing(open_artefact(law, "run")) as run, self.assertRaisesRegex(BadArtefact, "expected one viscosity"):
            stribeck.point(run)
        for files, said in (([self.run_file("alone")], "at least two"), ([self.run_file("a"), law], "contact.oil.law")):
            done = clatter("plot", "stribeck", *files, folder=self.folder)
            self.assertEqual(done.returncode, 2)
            self.assertIn(said, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
