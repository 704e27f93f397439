# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter collect`: all runs of a sweep in one file, and orders from it."""
import os
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

import synthetic
import synthetic_drive
from clatter_command import clatter
from clatter import artefact
from clatter_tools import collect, orders

SPEEDS = (1000, 2000, 3000)
AT = "analysis/cycle"


class Collect(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        for rpm in (*SPEEDS, 10000):
            (self.folder / f"{rpm}.run.toml").write_text(f'base = "a.toml"\ntitle = "x"\ndrive.crank.speed_rpm = {rpm}\ncontact.oil = "film"\n')
        for rpm in SPEEDS[:2]:
            synthetic_drive.write_drive(self.folder / f"{rpm}.run.h5", rpm=float(rpm), amplitude=rpm / 500.0)
        (self.folder / "3000.run.failed.h5").write_bytes(b"")
        self.write_field(2000)

    def write_field(self, rpm):
        path = self.folder / f"{rpm}.field.h5"
        synthetic.write_field(path)
        with h5py.File(path, "a") as field:
            field[AT].attrs["speed_rpm"] = float(rpm)
            count = len(field[f"{AT}/panels/exposed/erp"])
            field[f"{AT}/order"] = 0.5 * np.arange(1, count + 1)
            field[f"{AT}/panels/exposed/erp"][...] = 0.0
            field[f"{AT}/panels/exposed/erp"][2] = 4e-6  # order 1.5
            field[f"{AT}/sound/power"] = 0.25 * field[f"{AT}/panels/exposed/erp"][()]
            field[f"{AT}/sound"].attrs["power_db"], field[f"{AT}/sound"].attrs["power_dba"] = 60.0, 40.0
            for sensor in field[f"{AT}/sensors"]:
                shape = (count, len(field[f"{AT}/sensors/{sensor}/labels"]))
                for part in ("re", "im"):
                    field[f"{AT}/sensors/{sensor}/spectrum/acceleration_{part}"] = np.zeros(shape)
            field[f"{AT}/sensors/sensor_liner/spectrum/acceleration_im"][39, 1] = 0.5  # order 20

    def run_command(self, *arguments, code=0):
        done = clatter(*arguments, folder=self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def test_rows_are_the_scenes_in_order_of_their_numbers_with_what_is_known(self):
        done = self.run_command("collect", ".")
        self.assertEqual(done.stdout, "sweep.h5: 4 runs, 2 complete, 1 failed, 1 missing\nfailed: 3000\nmissing: 10000\n")
        with artefact.open_artefact(self.folder / "sweep.h5", "sweep") as sweep:
            self.assertEqual([name.decode() for name in sweep["name"]], ["1000", "2000", "3000", "10000"])
            np.testing.assert_array_equal(sweep["keys/drive.crank.speed_rpm"], [1000.0, 2000.0, 3000.0, 10000.0])
            self.assertEqual(sweep["keys/contact.oil"][0], b"film")
            np.testing.assert_allclose(sweep["speed_rpm"], [1000.0, 2000.0, np.nan, np.nan], rtol=1e-9)
            np.testing.assert_array_equal(np.isnan(sweep["cost"][:, 0]), [False, False, True, True])
            np.testing.assert_array_equal(np.isnan(sweep["cost"][:, 2]), [True, False, True, True])
            with artefact.open_artefact(self.folder / "1000.run.h5", "run") as run:
                _, order, rms, _ = orders.of_run(run, "chain_cam_speed")
            np.testing.assert_array_equal(sweep["histories/chain_cam_speed/rms"][0, :len(rms)], rms)
            self.assertAlmostEqual(sweep["panels/exposed/rms"][1, 3] ** 2, 4e-6, delta=1e-18)
            self.assertTrue(np.isnan(sweep["panels/exposed/level_db"][0]))
            self.assertAlmostEqual(sweep["sound/power/rms"][1, 3] ** 2, 1e-6, delta=1e-18)
            self.assertEqual((sweep["sound/power/level_db"][1], sweep["sound/power/level_dba"][1]), (60.0, 40.0))
            self.assertAlmostEqual(sweep["sensors/sensor_liner.y/rms"][1, 40], 0.5 / np.sqrt(2.0), delta=1e-12)
            self.assertEqual(sweep["title"][0], b"x")
            self.assertTrue(np.isnan(sweep["slap/peak"][0]))
            self.assertAlmostEqual(sweep["slap/time"][1], 0.44e-3, delta=0.03e-3)  # an impact at 0.3 ms, a quarter of its period later
            self.assertGreater(sweep["slap/peak"][1], sweep["slap/block_peak"][1])
            self.assertEqual(sweep["slap/liner_db"].shape, (4, len(sweep["slap/mid_hz"])))
            (speed, order, rms, unit), = orders.of_sweep(sweep, "panels/exposed")
            self.assertAlmostEqual(speed, 2000.0, delta=1e-6)
            self.assertEqual((order[3], unit), (1.5, "W^0.5"))
            self.assertAlmostEqual(orders.level(orders.fluctuation(rms), unit), 10.0 * np.log10(4e6), delta=1e-9)
            self.assertEqual(orders.level_name(unit), "level [dB re 1 pW]")
            with self.assertRaisesRegex(artefact.BadArtefact, "found exposed.*, expected panels/lid$"):
                orders.of_sweep(sweep, "panels/lid")
        self.assertIn("checksums of all", self.run_command("info", "sweep.h5").stdout)

    def test_orders_are_drawn_from_the_file_as_from_the_runs(self):
        self.run_command("collect", ".", "-o", "all.h5")
        one = self.run_command("orders", "all.h5", "--history", "chain_cam_speed", "-o", "a.svg").stdout
        two = self.run_command("orders", "1000.run.h5", "2000.run.h5", "--history", "chain_cam_speed", "-o", "a.svg").stdout
        self.assertEqual(one, two)
        self.assertTrue((self.folder / "a.svg").exists())

    def test_scenes_of_an_earlier_sweep_and_results_before_a_failure_are_left_out(self):
        (self.folder / "sweep.mk").write_text("# x\nspeeds_names := 1000 2000\nspeeds_runs := a\n")
        failed = self.folder / "2000.run.failed.h5"
        failed.write_bytes(b"")
        os.utime(failed, ns=(2**62, 2**62))
        done = self.run_command("collect", ".")
        self.assertEqual(done.stdout, "sweep.h5: 2 runs, 1 complete, 1 failed\nfailed: 2000\n")
        with artefact.open_artefact(self.folder / "sweep.h5", "sweep") as sweep:
            np.testing.assert_array_equal(np.isnan(sweep["speed_rpm"]), [False, True])
            self.assertNotIn("sound", sweep)  # its field is of the run before

    def test_runs_are_selected_by_the_values_of_keys(self):
        self.run_command("collect", ".")
        with artefact.open_artefact(self.folder / "sweep.h5", "sweep") as sweep:
            name = "histories/chain_cam_speed"
            self.assertEqual([round(one[0]) for one in orders.of_sweep(sweep, name)], [1000, 2000])
            self.assertEqual([round(one[0]) for one in orders.of_sweep(sweep, name, ["drive.crank.speed_rpm=2e3", "contact.oil=film"])], [2000])
            for where, said in (("contact.air=1", "keys: found contact.oil, drive.crank.speed_rpm, expected contact.air$"),
                                ("contact.oil=none", "--where contact.oil=none: found no such run; contact.oil is film$"),
                                ("drive.crank.speed_rpm=fast", "found fast, expected a number, as drive.crank.speed_rpm has$")):
                with self.assertRaisesRegex(artefact.BadArtefact, said):
                    orders.of_sweep(sweep, name, [where])

    def test_a_folder_without_scenes_and_a_damaged_one_are_refused(self):
        (self.folder / "empty").mkdir()
        done = self.run_command("collect", "empty", code=2)
        self.assertEqual(done.stderr, "clatter: error: empty: found no scene, expected those of `clatter sweep`\n")
        (self.folder / "2000.run.toml").write_text("a = ")
        self.assertRegex(self.run_command("collect", ".", code=2).stderr, r"^clatter: error: 2000\.run\.toml: not TOML: ")
        self.assertFalse((self.folder / "sweep.h5").exists())

    def test_scenes_with_different_keys_are_sorted(self):
        for path in self.folder.glob("*.run.toml"):
            path.unlink()
        for name, keys in (("base", "a = 0"), ("oil_0", 'a = 0\nrom = "x.rom.h5"'), ("oil_28", 'a = 0\nrom = "y.rom.h5"'), ("other", "a = 0")):
            (self.folder / f"{name}.run.toml").write_text(f'base = "a.toml"\ntitle = "x"\n{keys}\n')
        self.assertEqual([name for name, _, _ in collect.scenes(self.folder)], ["base", "other", "oil_0", "oil_28"])

    def test_keys_of_nested_tables_are_dotted(self):
        self.assertEqual(collect.flat({"a": {"b": {"c": 1}}, "d": 2}), {"a.b.c": 1, "d": 2})


if __name__ == "__main__":
    unittest.main(verbosity=2)
