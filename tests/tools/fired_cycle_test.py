# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter fired-cycle`: the pressure table of a fired engine."""
import math
import pathlib
import tempfile
import unittest

import numpy as np

from clatter_command import clatter
from clatter_tools.fired_cycle import Burn, FiredCycle
from clatter_tools.motored_cycle import DEGREE, MotoredCycle

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def fired(burns, heat, motored=None, opened=130.0):
    return FiredCycle(motored or MotoredCycle(), burns, heat, opened * DEGREE, 50.0 * DEGREE)


class FiredCycleTable(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def run_command(self, *arguments, code=0):
        done = clatter("fired-cycle", *arguments, folder=self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def test_without_heat_it_is_the_motored_cycle_while_the_valves_are_closed(self):
        motored = MotoredCycle()
        cycle = fired([(1.0, Burn(-0.1, 1.0, 1.0))], 0.0)
        for angle in np.linspace(-math.pi, 130 * DEGREE, 100):
            self.assertAlmostEqual(cycle.pressure(angle) / motored.pressure(angle), 1.0, delta=1e-14)

    def test_a_sudden_burn_raises_the_pressure_at_constant_volume(self):
        # At top dead centre by (n - 1) Q / V_c; the burn lasts 0.1 deg.
        cycle = fired([(1.0, Burn(0.0, 0.1 * DEGREE, 1.0))], 1000.0)
        expected = MotoredCycle().pressure(0.0) + 0.34 * 0.999 * 1000.0 / MotoredCycle().volume(0.0)
        self.assertAlmostEqual(cycle.pressure(0.1 * DEGREE) / expected, 1.0, delta=1e-4)

    def test_heat_is_work_and_internal_energy(self):
        # d(p V) / (n - 1) + p dV = dQ, by sums over a fine table; 99.9 % of the heat within the durations.
        burns = [(0.2, Burn(-4 * DEGREE, 8 * DEGREE, 2.0)), (0.8, Burn(-4 * DEGREE, 60 * DEGREE, 0.8))]
        cycle = fired(burns, 3000.0)
        angles = np.linspace(-20 * DEGREE, 70 * DEGREE, 18001)
        p = np.array([cycle.pressure(angle) for angle in angles])
        v = np.array([cycle.motored.volume(angle) for angle in angles])
        heat = (p[-1] * v[-1] - p[0] * v[0]) / 0.34 + 0.5 * (p[1:] + p[:-1]) @ np.diff(v)
        shares = sum(share * (1 - math.exp(-6.908 * ((angles[-1] - burn.start) / burn.duration) ** (burn.form + 1)))
                     for share, burn in burns)
        self.assertAlmostEqual(heat / (3000.0 * shares), 1.0, delta=2e-6)

    def test_it_is_continuous_and_returns_to_the_intake(self):
        cycle = fired([(1.0, Burn(-0.1, 1.0, 1.0))], 3000.0)
        for edge in (-math.pi, 130 * DEGREE, math.pi, -0.1):
            self.assertAlmostEqual(cycle.pressure(edge - 1e-9) / cycle.pressure(edge + 1e-9), 1.0, delta=1e-6)
        self.assertEqual(cycle.pressure(181 * DEGREE), 1e5)
        self.assertEqual(cycle.pressure(181 * DEGREE), cycle.pressure(181 * DEGREE - 4 * math.pi))

    def test_the_wanted_mean_effective_pressure_comes_out(self):
        done = self.run_command("f.csv", "--imep-bar", 15, "--intake-bar", 2.2)
        self.assertIn("mean effective pressure 15.00 bar, heat ", done.stdout)
        rows = [tuple(map(float, line.split(","))) for line in (self.folder / "f.csv").read_text().splitlines() if line[0] in "-0123456789"]
        volume = np.array([MotoredCycle(intake=2.2e5).volume(angle * DEGREE) for angle, _ in rows])
        p = 1e5 * np.array([pressure for _, pressure in rows])
        self.assertAlmostEqual(0.5 * (p[1:] + p[:-1]) @ np.diff(volume) / np.ptp(volume), 15e5, delta=0.01e5)
        self.assertEqual((self.folder / "f.csv").read_text(), (SOURCE / "samples/truck_diesel/fired.csv").read_text())

    def test_contradictions_are_refused_in_one_line(self):
        for arguments, words in ((["f.csv"], "give --imep-bar or --heat-j"),
                                 (["f.csv", "--imep-bar", 5, "--heat-j", 5], "--imep-bar and --heat-j exclude each other"),
                                 (["f.csv", "--heat-j", 5, "--premixed", 1.5], "--premixed: found 1.5, expected at least 0 and at most 1"),
                                 (["f.csv", "--heat-j", 5, "--open-deg", 340], "--blowdown-deg: found 50 after 340"),
                                 (["f.csv", "--heat-j", 5, "--closed-deg", 1], "--start-deg: found -4, expected it between -1,"),
                                 (["f.csv", "--imep-bar", 0], "--imep-bar: found 0, expected at least 0.0"),
                                 (["f.csv", "--heat-j", "nan"], "--heat-j: found nan")):
            with self.subTest(arguments=arguments):
                done = self.run_command(*arguments, code=2)
                self.assertIn(words, done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1)
                self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
