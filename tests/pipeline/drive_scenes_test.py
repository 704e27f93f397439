# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of drives: what gravity and orders of a speed do, against closed forms."""
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402

# Two sprockets 328.98 mm apart along y or z, 40 links of 12 g and 40 of 10 g.
CHAIN = """
gravity_m_s2 = 9.81
[time]
end_s = 0.1
output_step_us = 200
[[drive]]
name = "d"
axis = "{normal}"
speed_rpm = 1
[[rigid_body]]
name = "cam"
motion = "{plane}"
mass_kg = 2
inertia_kg_m2 = 0.01
centre_mm = {centre}
start_spin_rad_s = 0.062831853072
[[bushing]]
name = "cb"
a = {{ body = "cam", at_mm = {centre} }}
b = {{ }}
stiffness_n_m = 1e8
damping_n_s_m = 1e4
[[torque]]
name = "load"
body = "cam"
value_n_m = -2
viscous_n_m_s = 0.02
[[chain]]
name = "c"
plane = "{plane}"
links = 80
pitch_mm = 12.7
bush_mm = 8.5
plate_half_height_mm = 6
inner = {{ mass_kg = 0.012, inertia_kg_m2 = 5e-7 }}
outer = {{ mass_kg = 0.010, inertia_kg_m2 = 4e-7 }}
joint = {{ stiffness_n_m = 2e7, damping_n_s_m = 300 }}
[[chain.over]]
sprocket = "S1"
teeth = 21
turn = "counter-clockwise"
on = {{ body = "d", at_mm = [0, 0, 0] }}
contact = {{ bed_n_m3 = 1e12, width_mm = 8, damping_s_m = 1 }}
[[chain.over]]
sprocket = "S2"
teeth = 35
turn = "counter-clockwise"
on = {{ body = "cam", at_mm = {centre} }}
contact = {{ bed_n_m3 = 1e12, width_mm = 8, damping_s_m = 1 }}
"""
ORDERS = """
[time]
cycle_of = "d"
cycles = 1
[[drive]]
name = "d"
axis = "z"
speed_rpm = {rpm}
[[drive.order]]
order = 0.5
amplitude_rpm = 600
phase_deg = 30
[[rigid_body]]
name = "b"
motion = "slide"
axis = [1, 0, 0]
mass_kg = 1
[[bushing]]
name = "k"
a = {{ body = "b", at_mm = [0, 0, 0] }}
b = {{ }}
stiffness_n_m = 1e4
damping_n_s_m = 10
"""


class DriveScenes(unittest.TestCase):
    def setUp(self):
        stages.require_stages()
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-drives-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_scene(self, text):
        (self.folder / "one.run.toml").write_text(text)
        done = stages.run_stage("dynamics", "one.run.toml", "-o", "one.run.h5", "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.folder / "one.run.h5") as file:
            history = {name: data[()] for name, data in file["history"].items()}
        (self.folder / "one.run.h5").unlink()
        return history, done.stderr

    def test_sprockets_carry_the_weight_of_the_chain_in_any_plane(self):
        for plane, normal, centre in (("yz", "x", "[0, 328.982223952, 0]"), ("zx", "y", "[0, 0, 328.982223952]")):
            found, _ = self.run_scene(CHAIN.format(plane=plane, normal=normal, centre=centre))
            last = found["time"] > 0.08
            force = [np.mean((found[f"c_S1_force_{d}"] + found[f"c_S2_force_{d}"])[last]) for d in "xy"]
            self.assertAlmostEqual(np.hypot(*force), 80 * 0.011 * 9.81, delta=0.02, msg=plane)

    def test_the_crank_angle_of_a_cycle_has_the_orders_of_its_drive(self):
        for rpm in (3000, -3000):
            found, _ = self.run_scene(ORDERS.format(rpm=rpm))
            turning, k, phase = rpm * np.pi / 30, 0.5, np.pi / 6
            swing = 600 * np.pi / 30 / (k * turning) * (np.sin(k * turning * found["time"] + phase) - np.sin(phase))
            angle = np.sign(rpm) * (turning * found["time"] + swing)
            np.testing.assert_allclose(found["crank_angle_deg"], np.degrees(angle), atol=1e-6)

    def test_gravity_across_all_planes_is_said_to_do_nothing(self):
        _, said = self.run_scene("gravity_m_s2 = 9.81\n" + ORDERS.format(rpm=3000))
        self.assertIn("gravity_m_s2 has no effect", said)
        _, said = self.run_scene("gravity_m_s2 = 9.81\n" + ORDERS.format(rpm=3000).replace("[1, 0, 0]", "[0, 0, 1]"))
        self.assertNotIn("gravity_m_s2 has no effect", said)


if __name__ == "__main__":
    unittest.main()
