# SPDX-License-Identifier: GPL-3.0-or-later
"""Order analysis: signals of known amplitudes, at a speed that varies, sampled at uneven steps."""
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

import synthetic
import synthetic_drive
from clatter import artefact
from clatter_tools import orders


def uneven(cycles, samples):
    """(crank angles [deg] of a crank whose speed varies by 5 % in order 1.5, the angles at its mean speed) at random steps of
    time."""
    time = np.cumsum(np.random.default_rng(3).uniform(0.2, 1.8, samples))
    mean = 720.0 * cycles * time / time[-1]
    return mean + np.degrees(0.05 / 1.5 * np.sin(np.radians(1.5 * mean))), mean


class HalfOrders(unittest.TestCase):
    def test_amplitudes_are_found_over_the_angle_at_varying_speed_and_uneven_steps(self):
        angle, _ = uneven(4, 40000)
        phi = np.radians(angle)
        signal = 7.0 + 3.0 * np.sin(1.5 * phi + 0.4) + 0.5 * np.cos(20.0 * phi) + 0.02 * np.sin(40.0 * phi)
        order, rms = orders.half_orders(angle, signal, 3)
        self.assertEqual(order[3], 1.5)
        # Between samples the signal is taken as linear: 10000 a cycle are 250 a period of order 40, (pi / 250)^2 / 3 = 5e-5 of
        # it; uneven steps and the ends of the window some times that.
        for wanted, amplitude, tolerance in ((1.5, 3.0, 2e-5), (20.0, 0.5, 1e-4), (40.0, 0.02, 1e-3)):
            self.assertAlmostEqual(orders.of_order(order, rms, wanted) / (amplitude / np.sqrt(2.0)), 1.0, delta=tolerance)
        self.assertAlmostEqual(rms[0], 7.0, delta=1e-5)
        others = np.delete(rms, [0, 3, 40, 80])
        self.assertLess(others.max(), 1e-4)
        self.assertAlmostEqual(orders.fluctuation(rms), np.sqrt(0.5 * (9.0 + 0.25 + 0.0004)), delta=1e-4)

    def test_over_time_an_order_would_be_spread_over_its_neighbours(self):
        # The phase of order 20 swings by 20 x 0.05 / 1.5 rad: J0 and J1 of 2/3 are its line and those at 1.5 beside it.
        angle, mean = uneven(4, 40000)
        signal = np.sqrt(2.0) * np.cos(20.0 * np.radians(angle))
        order, rms = orders.half_orders(mean, signal, 3)
        self.assertAlmostEqual(orders.of_order(order, rms, 20.0), 0.8920, delta=1e-3)
        self.assertAlmostEqual(orders.of_order(order, rms, 21.5), 0.3153, delta=1e-3)
        order, rms = orders.half_orders(angle, signal, 3)
        self.assertAlmostEqual(orders.of_order(order, rms, 20.0), 1.0, delta=1e-4)
        self.assertLess(orders.of_order(order, rms, 21.5), 1e-3)

    def test_the_energy_of_an_order_between_two_lines_is_in_its_band(self):
        # Order 1.6 over 5 cycles is a line of its own, a tenth of an order from 1.5, whose band reaches from 1.25 to 1.75.
        angle = np.linspace(0.0, 3600.0, 50001)
        order, rms = orders.half_orders(angle, np.sin(1.6 * np.radians(angle)), 5)
        self.assertAlmostEqual(orders.of_order(order, rms, 1.5), np.sqrt(0.5), delta=1e-5)

    def test_orders_beyond_the_samples_are_not_known(self):
        angle = np.linspace(0.0, 720.0, 101)
        order, rms = orders.half_orders(angle, np.sin(np.radians(angle)), 1)
        self.assertLessEqual(order[-1], 25.0)
        self.assertTrue(np.isnan(orders.of_order(order, rms, 40.0)))

    def test_cycles_at_the_end_are_analysed(self):
        recorded = np.linspace(0.1, 720.0, 5000)  # from the first step on
        self.assertEqual(orders.whole_cycles(recorded, None), 1)
        self.assertEqual(orders.whole_cycles(np.linspace(0.0, 7200.0, 100), None), 3)
        self.assertEqual(orders.whole_cycles(np.linspace(0.0, 7200.0, 100), 20), 10)
        self.assertEqual(orders.whole_cycles(np.linspace(0.0, 700.0, 100), None), 0)

    def test_a_peak_is_the_top_of_the_parabola(self):
        speeds = np.array([3000.0, 1000.0, 2000.0, 4000.0])
        speed, value = orders.peak_of(speeds, 9.0 - ((speeds - 2300.0) / 1000.0) ** 2)
        self.assertAlmostEqual(speed, 2300.0, delta=1e-6)
        self.assertAlmostEqual(value, 9.0, delta=1e-9)
        self.assertEqual(orders.peak_of([1000.0, 2000.0], [1.0, 3.0]), (2000.0, 3.0))


class Files(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def test_an_acceleration_of_a_run_has_levels_in_decibels(self):
        synthetic_drive.write_drive(self.folder / "one.run.h5", rpm=2400.0)
        with artefact.open_artefact(self.folder / "one.run.h5", "run") as run:
            rpm, order, rms, unit = orders.of_run(run, "bracket_acceleration")
        self.assertAlmostEqual(rpm, 2400.0, delta=1e-6)
        # 2 m/s2 at its peak: 123.01 dB re 1 um/s2; 36 samples a period of order 20: 0.3 % or 0.02 dB
        self.assertAlmostEqual(orders.level(orders.of_order(order, rms, 1.5), unit), 20.0 * np.log10(np.sqrt(2.0) / 1e-6), delta=2e-3)
        self.assertAlmostEqual(orders.level(orders.of_order(order, rms, 20.0), unit), 20.0 * np.log10(0.5 / np.sqrt(2.0) / 1e-6), delta=0.08)
        self.assertEqual(orders.level_name(unit), "level [dB re 1e-06 m/s², RMS]")
        self.assertEqual(orders.level_name("N"), "RMS [N]")

    def test_a_sensor_of_a_field_file_has_the_same_orders(self):
        path = self.folder / "one.field.h5"
        synthetic.write_field(path)
        with h5py.File(path, "a") as field:
            at = "analysis/cycle"
            field[at].attrs["speed_rpm"] = 2400.0
            field[f"{at}/order"] = 0.5 * np.arange(1, 300)
            spectrum = np.zeros((299, 3))
            spectrum[2, 1], spectrum[39, 1] = 3.0, 0.5  # orders 1.5 and 20: peaks 3 + 4i and 0.5
            field[f"{at}/sensors/sensor_liner/spectrum/acceleration_re"] = spectrum
            spectrum[2, 1], spectrum[39, 1] = 4.0, 0.0
            field[f"{at}/sensors/sensor_liner/spectrum/acceleration_im"] = spectrum
        with artefact.open_artefact(path, "field") as field:
            rpm, order, rms, unit = orders.of_field(field, "sensor_liner.y")
            self.assertEqual((rpm, unit, order[3]), (2400.0, "m/s2", 1.5))
            self.assertAlmostEqual(rms[3], 5.0 / np.sqrt(2.0), delta=1e-12)
            self.assertAlmostEqual(rms[40], 0.5 / np.sqrt(2.0), delta=1e-12)
            with self.assertRaisesRegex(artefact.BadArtefact, "sensor_block.x.*expected sensor_lid.x"):
                orders.of_field(field, "sensor_lid.x")

    def test_less_than_a_cycle_is_refused(self):
        synthetic_drive.write_drive(self.folder / "short.run.h5", turns=1.5)
        with artefact.open_artefact(self.folder / "short.run.h5", "run") as run:
            with self.assertRaisesRegex(artefact.BadArtefact, "found 0.75 cycles of 720 deg, expected at least one"):
                orders.of_run(run, "chain_cam_speed")


if __name__ == "__main__":
    unittest.main(verbosity=2)
