# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter motored-cycle`: the pressure table of a motored engine."""
import argparse
import math
import pathlib
import tempfile
import unittest

from clatter_command import clatter
from clatter.artefact import BadArtefact
from clatter_tools import motored_cycle
from clatter_tools.motored_cycle import MotoredCycle

SOURCE = pathlib.Path(__file__).resolve().parents[2]


class MotoredCycleTable(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def run_command(self, *arguments, code=0):
        done = clatter("motored-cycle", *arguments, folder=self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def rows(self, name):
        lines = [line for line in (self.folder / name).read_text().splitlines() if not line.startswith("#")]
        self.assertEqual(lines[0], "crank_angle [deg], pressure [bar]")
        return {float(angle): float(pressure) for angle, pressure in (line.split(",") for line in lines[1:])}

    def test_the_compression_is_adiabatic(self):
        done = self.run_command("a.csv", "--compression-ratio", 9, "--exponent", 1.5, "--intake-bar", 2, "--step-deg", 90)
        self.assertEqual(done.stdout, "a.csv: peak 54.00 bar\n")
        rows = self.rows("a.csv")
        self.assertEqual(list(rows), [90.0 * i for i in range(-4, 5)])
        # Closed between the bottom dead centres: p V^n = const, 2 bar * 9^1.5 = 54 bar at top dead centre.
        self.assertAlmostEqual(rows[0.0], 54.0, delta=1e-9)
        # At 90 deg the pin is at sqrt(l^2 - r^2), 275 - sqrt(210^2 - 65^2) = 75.31189... mm below its highest position.
        below = 275 - math.sqrt(210**2 - 65**2)
        self.assertAlmostEqual(rows[90.0], 2 * (9 / (1 + 8 * below / 130))**1.5, delta=1e-9)
        self.assertAlmostEqual(rows[-90.0], rows[90.0], delta=1e-9)
        for angle in (-360.0, -270.0, 180.0, 270.0, 360.0):
            self.assertAlmostEqual(rows[angle], 2.0, delta=1e-9)

    def test_the_table_of_the_sample_is_made_by_it(self):
        self.run_command("motored.csv", "--bore-mm", 107, "--stroke-mm", 130, "--rod-mm", 210, "--compression-ratio", 17,
                         "--exponent", 1.34)
        self.assertEqual((self.folder / "motored.csv").read_text(), (SOURCE / "samples/truck_diesel/motored.csv").read_text())

    def test_peak_pressures_of_the_reference(self):
        # Ratio 17, 1 bar: 39.8 / 44.5 / 48.5 bar, printed to 0.1 bar.
        for exponent, bar in ((1.30, 39.8), (1.34, 44.5), (1.37, 48.5)):
            self.assertAlmostEqual(MotoredCycle(exponent=exponent).pressure(0.0) * 1e-5, bar, delta=0.06)

    def test_the_loop_encloses_no_work(self):
        cycle = MotoredCycle()
        angles = [-2 * math.pi + 4 * math.pi * i / 7200 for i in range(7201)]
        pressure, volume = list(map(cycle.pressure, angles)), list(map(cycle.volume, angles))
        work = [0.5 * (pressure[i] + pressure[i + 1]) * (volume[i + 1] - volume[i]) for i in range(7200)]
        # Symmetric path and trapezoidal sums: only rounding is left.
        self.assertLess(abs(sum(work)), 1e-12 * sum(map(abs, work)))

    def assert_refused(self, arguments, code, words):
        with self.subTest(arguments=arguments):
            done = self.run_command(*arguments, code=code)
            self.assertIn(words, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1)
            self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_rod_and_a_place_that_do_not_fit_are_refused_in_one_line(self):
        self.assert_refused(["a.csv", "--rod-mm", 60], 2, "expected more than 65: rod > radius + offset")
        self.assert_refused(["a.csv", "--pin-offset-mm", 150], 2, "--rod-mm: found 210")
        self.assert_refused(["nowhere/a.csv"], 4, "nowhere/a.csv: cannot be written: No such file")

    def test_meaningless_values_are_refused_with_option_and_limits(self):
        # Before, all but ratios up to 1, short rods and steps of 0 were written to a table, with exit code 0: a negative bore
        # or intake pressure as well as nan.
        refused = {"--bore-mm": (-107, 0, 1e30), "--stroke-mm": (-130, 0, 1e30), "--rod-mm": (-210, 0, 1e30),
                   "--compression-ratio": (1, 0.5, -17, 1e30), "--exponent": (0, -1.3, 40), "--intake-bar": (0, -500, 1e30),
                   "--closed-deg": (0, -180, 361), "--step-deg": (0, -1, 1e-30, 721)}
        for option, values in refused.items():
            for value in (*values, "nan", "inf", "-inf"):
                found = value if isinstance(value, str) else f"{value:g}"
                with self.subTest(option=option, value=value), self.assertRaises(BadArtefact) as refusal:
                    motored_cycle.write_motored_cycle(self.parsed("a.csv", f"{option}={value}"))
                self.assertIn(f"{option}: found {found}, expected at least ", str(refusal.exception))
        self.assert_refused(["a.csv", "--bore-mm=-107"], 2, "--bore-mm: found -107, expected at least 0.1 and at most 1e+04")

    @staticmethod
    def parsed(*arguments):
        command = argparse.ArgumentParser()
        motored_cycle.add_arguments(command)
        return command.parse_args(arguments)


if __name__ == "__main__":
    unittest.main(verbosity=2)
