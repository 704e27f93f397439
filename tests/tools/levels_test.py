# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter levels`: overall levels over speed from fields and from a sweep file, A-weighting by hand, refusals."""
import contextlib
import io
import pathlib
import re
import tempfile
import unittest

import h5py
import numpy as np

import synthetic
from clatter_tools import command_line, weighting

AT = "analysis/cycle"
# (speed, order of the only line, its peak acceleration): at 1000, 100 and 1000 Hz
LINES = ((1200.0, 50.0, 2.0), (2400.0, 2.5, 4.0), (3000.0, 20.0, 1.0))


class Levels(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        for k, (rpm, order, peak) in enumerate(LINES):
            (self.folder / f"{rpm:.0f}.run.toml").write_text(f'base = "a.toml"\nengine.speed_rpm = {rpm}\n')
            (self.folder / f"{rpm:.0f}.run.h5").touch()
            self.write_field(self.folder / f"{rpm:.0f}.field.h5", rpm, order, peak, k)

    @staticmethod
    def write_field(path, rpm, order, peak, k):
        synthetic.write_field(path)
        with h5py.File(path, "a") as field:
            field[AT].attrs["speed_rpm"] = rpm
            count = len(field[f"{AT}/panels/exposed/erp"])
            field[f"{AT}/order"] = 0.5 * np.arange(1, count + 1)
            field[f"{AT}/panels/exposed"].attrs.update({"erp_db": 90.0 + k, "erp_dba": 80.0 + k})
            field[f"{AT}/sound/power"] = np.full(count, 1e-6)
            field[f"{AT}/sound"].attrs.update({"power_db": 70.0 + k, "power_dba": 65.0 - k})
            for sensor in field[f"{AT}/sensors"]:
                for part in ("re", "im"):
                    field[f"{AT}/sensors/{sensor}/spectrum/acceleration_{part}"] = np.zeros((count, 3))
            field[f"{AT}/sensors/sensor_liner/spectrum/acceleration_im"][int(2 * order) - 1, 1] = peak

    def run_command(self, *arguments, code=0):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            found = command_line.main([str(one) for one in arguments], rules="")
        self.assertEqual(found, code, err.getvalue())
        return out.getvalue() if code == 0 else err.getvalue().removeprefix("clatter: error: ").rstrip("\n")

    def tables(self, said):
        """{heading: rows of numbers}"""
        found = {}
        for line in said.splitlines():
            if ", re " in line:
                rows = found.setdefault(line, [])
            elif re.match(r"^[\d .-]+$", line):
                rows.append([float(cell) for cell in line.split()])
        return found

    def test_powers_are_those_of_the_files_and_accelerations_sums_of_their_lines(self):
        said = self.run_command("levels", *sorted(path.name for path in self.folder.glob("*.field.h5")), "--sound", "--panel", "exposed",
                                "--sensor", "sensor_liner.y", "-o", "l.svg")
        found = self.tables(said)
        self.assertEqual(found["sound power, re 1 pW"], [[1200, 70, 65], [2400, 71, 64], [3000, 72, 63]])
        self.assertEqual(found["ERP of exposed, re 1 pW"], [[1200, 90, 80], [2400, 91, 81], [3000, 92, 82]])
        # A-weighting (IEC 61672-1, table 3): 0 dB at 1 kHz, -19.1 dB at 100 Hz
        for (rpm, order, peak), row in zip(LINES, found["acceleration of sensor_liner.y, re 1e-06 m/s2"]):
            plain = 20.0 * np.log10(peak / np.sqrt(2.0) / 1e-6)
            self.assertEqual(row[0], rpm)
            self.assertAlmostEqual(row[1], plain, delta=0.051)  # tables have one decimal
            self.assertAlmostEqual(row[2], plain - (19.1 if order * rpm / 60 == 100 else 0.0), delta=0.15)
        self.assertIn("sound power, dB(A)", (self.folder / "l.svg").read_text())

    def test_a_sweep_file_gives_the_same_as_its_fields(self):
        for path in self.folder.glob("*.run.h5"):
            with synthetic.new_file(path, "run"):
                pass
        self.run_command("collect", ".")
        what = ("--sound", "--panel", "exposed", "--sensor", "sensor_liner.y", "-o", "l.png")
        fields = [f"{rpm:.0f}.field.h5" for rpm, _, _ in LINES]
        self.assertEqual(self.run_command("levels", "sweep.h5", *what), self.run_command("levels", *fields, *what))
        one = self.run_command("levels", "sweep.h5", "--sound", "--where", "engine.speed_rpm=1200", "-o", "l.png")
        self.assertEqual(self.tables(one)["sound power, re 1 pW"], [[1200, 70, 65]])
        self.assertEqual(self.run_command("levels", "sweep.h5", "--sound", "--window", "mean", code=2),
                         "sweep.h5: found a sweep file with --window mean, expected fields: a sweep file has their cycles alone")

    def test_a_window_has_the_level_of_its_mean_and_the_standard_error(self):
        with h5py.File(self.folder / "1200.field.h5", "a") as field:
            synthetic.add_mean(field)
        what = ("--sound", "--sensor", "sensor_liner.y", "-o", "l.png")
        cycle, said = (self.run_command("levels", "1200.field.h5", *what, "--window", window) for window in ("cycle", "mean"))
        self.assertEqual(self.run_command("levels", "1200.field.h5", *what), said)
        self.assertIn("    1200     71.0     66.0 +- 0.27\n", said)
        self.assertNotIn("+-", cycle)
        self.assertEqual(said.splitlines()[-2], cycle.splitlines()[-2])  # of the sensor, by its mean squares
        self.assertEqual(self.run_command("levels", "1200.field.h5", "--sound", "--window", "men", code=2),
                         "1200.field.h5: analysis: found cycle, ftdc, mean, expected men")
        self.run_command("orders", "1200.field.h5", "--sound", "--window", "mean", "-o", "o.png")

    def test_a_sweep_file_has_the_means_and_their_standard_errors(self):
        with h5py.File(self.folder / "1200.field.h5", "a") as field:
            synthetic.add_mean(field, cycles=5, error=0.31)
        for path in self.folder.glob("*.run.h5"):
            with synthetic.new_file(path, "run"):
                pass
        self.run_command("collect", ".")
        with h5py.File(self.folder / "sweep.h5") as sweep:
            np.testing.assert_array_equal(sweep["cycles"], [5, 1, 1])
            np.testing.assert_array_equal(sweep["sound/power/level_dba"], [66.0, 64.0, 63.0])
            np.testing.assert_array_equal(sweep["sound/power/standard_error_dba"], [0.31, np.nan, np.nan])
        what = ("--sound", "--panel", "exposed", "-o", "l.png")
        said = self.run_command("levels", "sweep.h5", *what)
        self.assertIn("    1200     71.0     66.0 +- 0.31\n", said)
        self.assertEqual(said, self.run_command("levels", *(f"{rpm:.0f}.field.h5" for rpm, _, _ in LINES), *what))

    def test_what_cannot_be_drawn_is_refused(self):
        for arguments, message in (
                (["1200.field.h5"], "levels: give --sound, --panel or --sensor"),
                (["1200.field.h5", "2400.field.h5", "--panel", "lid"], "1200.field.h5: analysis/cycle/panels: found exposed, skin, expected lid")):
            self.assertEqual(self.run_command("levels", *arguments, code=2), message)
        with h5py.File(self.folder / "2400.field.h5", "r+") as field:
            field[AT].attrs["speed_rpm"] = 1200.0
        self.assertEqual(self.run_command("levels", "1200.field.h5", "2400.field.h5", "--sound", code=2),
                         "levels: found two runs at 1200 rpm with different levels of sound/power, expected one; --where selects")


class Weighting(unittest.TestCase):
    def test_a_weighting_is_that_of_the_standard(self):
        # IEC 61672-1, table 3, of exact frequencies 10^(n/10) Hz
        for n, wanted in ((15, -39.4), (18, -26.2), (20, -19.1), (24, -8.6), (30, 0.0), (36, 1.0), (39, -1.1)):
            self.assertAlmostEqual(10.0 * np.log10(weighting.a_weight(10 ** (n / 10))), wanted, delta=0.05)


if __name__ == "__main__":
    unittest.main()
