# SPDX-License-Identifier: GPL-3.0-or-later
"""The block of samples/timing_drive: its reduced model has the interfaces of the front view, and keeps the modes."""
import pathlib
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import stages  # noqa: E402

CAMS = [-127.5, -42.5, 42.5, 127.5]  # x of the bearings
NODES = {"crank": (0, 0, -127.5), "guide_bolt_1": (60, 80, -152.5), "guide_bolt_2": (102, 235, -152.5),
         "arm_pivot": (-85, 245, -152.5), "tensioner": (-85, 160, -152.5),
         **{f"cam_intake_{k + 1}": (-60, 326, x) for k, x in enumerate(CAMS)},
         **{f"cam_exhaust_{k + 1}": (60, 326, x) for k, x in enumerate(CAMS)}}


class TimingDriveBlock(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = stages.copy_sample(cls, "timing_drive")
        stages.make(cls.folder, "models")
        cls.rom = h5py.File(cls.folder / "block.rom.h5")
        cls.addClassCleanup(cls.rom.close)
        cls.certificate = cls.rom["certificate"].attrs

    def test_each_interface_is_a_node_with_six_coordinates_at_its_place_in_the_front_view(self):
        for name, (right, up, x) in NODES.items():
            members = self.rom[f"sets/{name}"]
            numpy.testing.assert_allclose(members["position"][()], numpy.tile([1e-3 * x, -1e-3 * right, 1e-3 * up], (6, 1)),
                                          atol=1e-12, err_msg=name)

    def test_the_retained_sets_are_those_of_the_interfaces_and_four_mounts(self):
        boundary = 6 * (len(NODES) + 4)
        kept = self.certificate["fixed_interface_modes"] + self.certificate["residual_modes"]
        self.assertEqual(self.rom["K_rr"].shape[0], boundary + kept)
        self.assertLess(self.rom["K_rr"].shape[0], 250)  # what a scene with 131 links can afford

    def test_frequencies_hold_up_to_order_40_at_6000_rpm(self):
        self.assertGreaterEqual(self.certificate["accurate_to_hz"], 40 * 6000 / 60)
        self.assertEqual(self.certificate["count_proved"], 1)
        self.assertLess(self.certificate["frequency_error_estimate"], 1e-4)  # 2e-5 is reached
        self.assertLess(self.certificate["mass_error"], 1e-9)

    def test_a_rigid_motion_moves_the_sensors_with_the_block(self):
        # Turned by 1 rad about the crankshaft: u = x^ x r.
        turned = self.rom["rigid"][()][:, 3]
        for name in ("sensor_arm", "sensor_head"):
            members = self.rom[f"sets/{name}"]
            rows = numpy.asarray(members["dofs"][()]) - self.rom["K_rr"].shape[0]
            _, y, z = members["position"][0]
            found = self.rom["combined"][()][rows] @ turned
            numpy.testing.assert_allclose(found, [0.0, -z, y], atol=1e-9)


if __name__ == "__main__":
    unittest.main(verbosity=2)
