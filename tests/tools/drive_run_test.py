# SPDX-License-Identifier: GPL-3.0-or-later
"""From a scene with a chain to its pictures: the run file of clatter-dynamics is what the tools read."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
from clatter_command import clatter
from clatter import artefact, chains

DYNAMICS = pathlib.Path(os.environ.get("CLATTER_BIN", "")) / "clatter-dynamics"
RPM, PITCH, TEETH = 3000.0, 8e-3, 20
# 60 links around two sprockets, stretched by 0.02 %: the pitch circles' distance is 20 pitches and a little.
DISTANCE_MM = 160.05

SCENE = f"""
title = "two sprockets"
[time]
end_s = 0.002
output_step_us = 100
largest_step_us = 20
[accuracy]
displacement_um = 10
velocity_m_s = 0.1
[[drive]]
name = "crank"
axis = "z"
speed_rpm = {-RPM}
[[rigid_body]]
name = "cam"
motion = "xy"
mass_kg = 1.0
inertia_kg_m2 = 1e-3
centre_mm = [0, {DISTANCE_MM}, 0]
start_spin_rad_s = {-RPM * np.pi / 30.0}
[[bushing]]
name = "cam"
a = {{ body = "cam", at_mm = [0, {DISTANCE_MM}, 0] }}
b = {{ }}
stiffness_n_m = 1e9
damping_n_s_m = 1e4
[[chain]]
name = "chain"
links = 60
first = "outer"
pitch_mm = {1e3 * PITCH}
bush_mm = 5.0
plate_half_height_mm = 3.6
shape_every_us = 100
inner = {{ mass_kg = 2.2e-3, inertia_kg_m2 = 4.0e-8 }}
outer = {{ mass_kg = 2.6e-3, inertia_kg_m2 = 4.8e-8 }}
joint = {{ stiffness_n_m = 1e7, damping_n_s_m = 200 }}
[[chain.over]]
sprocket = "crank"
on = {{ body = "crank", at_mm = [0, 0, 0] }}
teeth = {TEETH}
contact = {{ bed_n_m3 = 5e12, width_mm = 4.6, damping_s_m = 0.5 }}
[[chain.over]]
sprocket = "cam"
on = {{ body = "cam", at_mm = [0, {DISTANCE_MM}, 0] }}
teeth = {TEETH}
contact = {{ bed_n_m3 = 5e12, width_mm = 4.6, damping_s_m = 0.5 }}
"""


class Run(unittest.TestCase):
    def test_what_dynamics_writes_is_drawn(self):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            (folder / "two.run.toml").write_text(SCENE)
            done = subprocess.run([DYNAMICS, "two.run.toml", "--quiet"], cwd=folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            with artefact.open_artefact(folder / "two.run.h5", "run") as run:
                chain = chains.read_chain(run)
                self.assertAlmostEqual(chains.mean_rpm(run), RPM, delta=1e-6)
            self.assertGreaterEqual(len(chain.time), 20)
            self.assertLess(np.abs(chain.angle - 6.0 * RPM * chain.time).max(), 1e-3)
            self.assertEqual([(one.name, one.teeth) for one in chain.over], [("crank", TEETH), ("cam", TEETH)])
            radius = 0.5 * PITCH / np.sin(np.pi / TEETH)
            for instant in range(len(chain.time)):
                # Front pin of a link and the next one's rear pin are one joint, but for its micrometres of stretch.
                pins = chain.pins(instant)
                next_ = np.roll(chain.links[instant], -1, axis=0)
                rear = next_[:, :2] - 0.5 * PITCH * np.column_stack([np.cos(next_[:, 2]), np.sin(next_[:, 2])])
                self.assertLess(np.abs(pins - rear).max(), 1e-4)
                for one, outwards in zip(chain.over, (-1.0, 1.0)):
                    centre = one.place[instant, :2]
                    from_centre = pins - centre
                    wrapped = from_centre[outwards * from_centre[:, 1] > 0.4 * radius]
                    self.assertTrue(6 <= len(wrapped) <= 8)
                    # On the pitch circle, or some tenths of a millimetre up the flanks.
                    self.assertLess(np.abs(np.linalg.norm(wrapped, axis=1) - radius).max(), 4e-4)
                    # Bushes are in the tooth gaps that are drawn: the roots are 2.58 mm, the seat's radius, below.
                    outline = one.at(instant)[:-1] - centre
                    height = np.linalg.norm(outline, axis=1)
                    roots = outline[height < height.min() + 1e-5]
                    below = [np.linalg.norm(roots - pin, axis=1).min() for pin in wrapped]
                    self.assertLess(np.abs(np.array(below) - 2.584e-3).max(), 4e-4)
            for command in (("drive", "two.run.h5"), ("report", ".")):
                done = clatter(*command, folder=folder)
                self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("chain drive of two, 3000 rpm", done.stdout)
            self.assertEqual({path.name for path in (folder / "two").iterdir()}, {"drive.svg", "loop.svg", "speed.svg", "drive.html"})


if __name__ == "__main__":
    unittest.main(verbosity=2)
