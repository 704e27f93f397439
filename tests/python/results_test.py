# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter.Run, Field and Sound on the beam: against h5py, beam theory, and each other."""
import importlib.util
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import clatter  # noqa: E402
import h5py  # noqa: E402
import stages  # noqa: E402
import synthetic  # noqa: E402
from clatter import run as run_module  # noqa: E402

STEP_N = 100.0  # on the tip, step.run.toml


class Results(stages.PipelineTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.master / "beam.sound.toml").write_text("[grid]\nfrom_hz = 400\nto_hz = 800\n")
        (cls.master / "loud.field.toml").write_text('sound = "beam.sound.h5"\n' + (cls.master / "step.field.toml").read_text())
        for arguments in (["sound", "beam.rom.h5", "-c", "beam.sound.toml", "-o", "beam.sound.h5"],
                          ["step.run.h5", "-c", "loud.field.toml", "-o", "loud.field.h5"]):
            done = stages.run_stage("recover", *arguments, folder=cls.master)
            if done.returncode:
                raise RuntimeError(done.stderr)

    def open(self, name, *arguments):
        found = clatter.open(self.folder / name) if not arguments else clatter.Field(self.folder / name, *arguments)
        self.addCleanup(found.close)
        return found

    def without_pandas(self):
        self.addCleanup(setattr, run_module, "pandas", run_module.pandas)
        run_module.pandas = None

    def test_columns_of_a_table_are_the_datasets_of_the_file(self):
        self.without_pandas()
        run = self.open("step.run.h5")
        table = run.table("beam")
        with h5py.File(self.folder / "step.run.h5") as file, h5py.File(self.folder / "beam.rom.h5") as rom:
            np.testing.assert_array_equal(table["time"], file["output/time"])
            labels = [label.decode() for name in rom["sets"] for label in rom[f"sets/{name}/labels"]]
            self.assertEqual(list(table.dtype.names), ["time", *labels])
            for name in rom["sets"]:
                for label, dof in zip(rom[f"sets/{name}/labels"], rom[f"sets/{name}/dofs"]):
                    np.testing.assert_array_equal(table[label.decode()], file["bodies/beam/q"][:, dof])
                    np.testing.assert_array_equal(run[f"beam.{label.decode()}"], file["bodies/beam/q"][:, dof])
            np.testing.assert_array_equal(run.motion("beam", "tip", "velocity"), file["bodies/beam/v"][:, rom["sets/tip/dofs"][()]])
            np.testing.assert_array_equal(run.table()["time"], file["history/time"])
        self.assertEqual((run.units["beam.tip.z"], run.units["beam.tip.ry"]), ("m", "rad"))
        self.assertTrue(run.complete)

    def test_the_tip_moves_as_the_step_response_of_the_modes(self):
        run = self.open("step.run.h5")
        rom, time = run.rom("beam"), run.time[:, None]
        hz, shapes = rom.modes(8)
        squared = (2.0 * np.pi * hz) ** 2
        decay = 0.5 * np.diag(shapes.T @ rom.D @ shapes)
        damped = np.sqrt(squared - decay**2)
        swing = 1.0 - np.exp(-decay * time) * (np.cos(damped * time) + decay / damped * np.sin(damped * time))
        amounts = shapes.T @ rom.loads["tip_force"] * STEP_N / squared * (rom.T("tip.z") @ shapes)[0]
        others = (rom.T("tip.z") @ rom.static({"tip_force": STEP_N}))[0] - amounts.sum()  # higher modes follow the force
        expected = swing @ amounts + others
        # At the start the higher modes do not follow yet: 8e-4 of the motion. Steps of 50 us resolve the eight to 2e-4.
        np.testing.assert_allclose(run["beam.tip.z"], expected, atol=2e-3 * abs(expected).max())

    def test_histories_of_a_run_are_columns_with_their_units(self):
        self.without_pandas()
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "slap.run.h5"
            synthetic.write_run(path)
            with h5py.File(path, "a") as file:
                file["history/time"] = file["history/crank_angle_deg"][()] / 12000.0
                file["film/crank_angle_deg"], file["film/time"] = [0.0, 10.0], [0.0, 1e-3]
                file["film/thrust/angle_deg"], file["film/thrust/axial"] = [-10.0, 0.0, 10.0], [0.0, 0.01]
                file["film/thrust/gap"] = np.arange(12.0).reshape(2, 3, 2)
            with clatter.Run(path) as run:
                self.assertEqual(run.units, {"piston_lateral": "m", "piston_tilt": "rad", "side_force": "N", "film_min": "m"})
                table = run.table()
                np.testing.assert_array_equal(table["side_force"], run["side_force"])
                np.testing.assert_array_equal(table["crank_angle_deg"], np.arange(0, 1440.5, 0.5))
                film = run.films["thrust"]
                self.assertEqual((film.names, list(film.crank_angle_deg), list(film.time)), (["gap"], [0.0, 10.0], [0.0, 1e-3]))
                np.testing.assert_array_equal(film.map("gap", 1), [[6, 7], [8, 9], [10, 11]])
                self.assertEqual((film.map("gap", 1).shape), (len(film.angle_deg), len(film.axial)))
                with self.assertRaisesRegex(clatter.Refused, "found no map of fill, expected gap"):
                    film.map("fill", 0)

    @unittest.skipIf(run_module.pandas is None, "python3-pandas is not installed")
    def test_with_pandas_a_table_is_a_data_frame_over_time(self):
        run = self.open("step.run.h5")
        frame = run.table("beam", "acceleration")
        np.testing.assert_array_equal(frame.index, run.time)
        np.testing.assert_array_equal(frame["tip.z"], run.motion("beam", "tip.z", "acceleration")[:, 0])

    @unittest.skipIf(importlib.util.find_spec("xarray") is None, "python3-xarray is not installed")
    def test_with_xarray_columns_have_their_units_and_the_crank_angle_is_a_coordinate(self):
        run = self.open("step.run.h5")
        found = run.dataset("beam", "velocity")
        np.testing.assert_array_equal(found["time"], run.time)
        np.testing.assert_array_equal(found["tip.z"], run.motion("beam", "tip.z", "velocity")[:, 0])
        self.assertEqual([found[name].attrs["units"] for name in ("tip.z", "tip.ry", "time")], ["m/s", "rad/s", "s"])
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "slap.run.h5"
            synthetic.write_run(path)
            with h5py.File(path, "a") as file:
                file["history/time"] = file["history/crank_angle_deg"][()] / 12000.0
            with clatter.Run(path) as run:
                found = run.dataset()
                self.assertEqual(set(found.coords), {"time", "crank_angle_deg"})
                self.assertEqual({name: one.attrs["units"] for name, one in found.data_vars.items()}, run.units)

    def test_without_xarray_a_dataset_is_refused_with_the_package(self):
        with unittest.mock.patch.dict(sys.modules, {"xarray": None}), self.assertRaisesRegex(clatter.Refused, "apt-get install python3-xarray"):
            self.open("step.run.h5").dataset()

    def test_a_reduced_model_that_changed_or_is_missing_names_no_columns(self):
        run = self.open("step.run.h5")
        for column, said in (("beam.top.z", "beam.rom.h5: sets: found no top.z"),
                             ("bean.tip.z", "found no column bean.tip.z, expected one of beam.sensor_tip.x"),
                             ("side_force", "found no column side_force")):
            with self.assertRaisesRegex(clatter.Refused, said):
                run[column]
        self.edit("beam.rom.toml", "fmax_hz = 4000.0", "fmax_hz = 3000.0")
        self.assertEqual(stages.run_stage("condense", *self.command("condense"), folder=self.folder).returncode, 0)
        with self.assertRaisesRegex(clatter.Refused, "bodies/beam: beam.rom.h5 has changed since the run: repeat the run"):
            self.open("step.run.h5")["beam.tip.z"]
        (self.folder / "beam.rom.h5").unlink()
        with self.assertRaisesRegex(clatter.Refused, "bodies/beam: beam.rom.h5 is missing"):
            self.open("step.run.h5").table("beam")
        alone = self.open("step.run.h5")
        self.assertEqual((alone.q("beam").shape[1], alone.units), (23, {}))

    def test_powers_of_a_field_add_up_to_its_levels(self):
        field = self.open("step.field.h5")
        self.assertEqual((field.body, field.pieces, field.has_sound, field.sound_to_hz, field.microphones),
                         ("beam", ["swing"], False, 0.0, []))
        with h5py.File(self.folder / "step.field.h5") as file:
            at = file["analysis/swing/panels/top"]
            # rho c S <v^2>: the definition of the ERP.
            np.testing.assert_allclose(field.erp("top"), 1.204 * 343.2 * field.panels["top"] * field.mean_square_velocity("top"), rtol=1e-9)
            inside = (field.frequency_hz >= 20.0) & (field.frequency_hz <= 3000.0)
            # Of the total, less than a thousandth lies in lines below 20 Hz.
            self.assertAlmostEqual(field.erp("top")[inside].sum(), at.attrs["erp_w"], delta=1e-3 * at.attrs["erp_w"])
            self.assertEqual(field.level_dba("top"), at.attrs["erp_dba"])
        self.assertEqual(field.level_dba(), field.level_dba("exposed"))
        self.assertTrue(np.isnan(field.level_error_dba("top")))  # of one segment
        for panel, path in ((None, "exposed"), ("top", "top")):
            mid, levels = field.third_octaves(panel)
            with h5py.File(self.folder / "step.field.h5") as file:
                np.testing.assert_array_equal(levels, file[f"analysis/swing/panels/{path}/third_octave/erp_dba"])
                np.testing.assert_array_equal(mid, file["analysis/swing/third_octave/mid_hz"])
        with self.assertRaisesRegex(clatter.Refused, "sound/power: missing"):
            field.sound_power

    def test_the_standard_error_of_a_mean_is_that_of_its_power(self):
        with h5py.File(self.folder / "step.field.h5", "r+") as file:
            for panel, error in (("top", 0.3), ("exposed", 0.4)):
                file[f"analysis/swing/panels/{panel}"].attrs["erp_standard_error_dba"] = error
        field = self.open("step.field.h5")
        self.assertEqual((field.level_error_dba("top"), field.level_error_dba()), (0.3, 0.4))

    def test_a_sensor_of_a_field_moves_as_in_the_run(self):
        field, run = self.open("step.field.h5"), self.open("step.run.h5")
        for quantity in ("displacement", "velocity"):  # the window ends before the last sample of the run
            np.testing.assert_allclose(field.history("sensor_tip", quantity), run.motion("beam", "sensor_tip", quantity)[:-1], atol=1e-12)
        spectrum = field.spectrum("sensor_tip.z", "velocity")
        self.assertEqual(field.spectrum("sensor_tip").shape, (len(field.frequency_hz), 3))
        np.testing.assert_allclose(field.power_spectrum("sensor_tip.z"), 0.5 * abs(spectrum) ** 2)
        # The first mode rules: its line is the nearest one to its frequency.
        peak = field.frequency_hz[np.argmax(abs(spectrum))]
        self.assertAlmostEqual(peak, run.rom("beam").modes(1).frequency_hz[0], delta=0.51 * (field.frequency_hz[1] - field.frequency_hz[0]))
        with self.assertRaisesRegex(clatter.Refused, "swing/sensors: found no tip, expected one of sensor_tip"):
            field.history("tip")
        with self.assertRaisesRegex(clatter.Refused, "analysis: found swing, expected cycle"):
            self.open("step.field.h5", "cycle")

    def test_the_sound_of_reduced_velocities_is_that_of_the_field(self):
        run, field, sound = self.open("step.run.h5"), self.open("loud.field.h5"), self.open("beam.sound.h5")
        count = len(run.time) - 1  # the window ends before the last sample of the run
        v = np.fft.rfft(run.v("beam")[:-1], axis=0) * 2.0 / count
        hz = np.fft.rfftfreq(count, run.time[1])
        lines = [k for k, line in enumerate(field.frequency_hz) if 350.0 < line < 750.0]
        own = [int(np.argmin(abs(hz - field.frequency_hz[k]))) for k in lines]
        power = [sound.power(v[k], line) for k, line in zip(own, field.frequency_hz[lines])]
        np.testing.assert_allclose(field.sound_power[lines], power, rtol=1e-3)
        level = 10.0 * np.log10(field.sound_power[field.frequency_hz >= 20.0].sum() / 1e-12)
        self.assertAlmostEqual(level, field.file["analysis/swing/sound"].attrs["power_db"], delta=0.01)
        row = sound.microphones.index("top")
        pressure = [sound.H(line)[row] @ v[k] for k, line in zip(own, field.frequency_hz[lines])]
        np.testing.assert_allclose(field.pressure("top")[lines], pressure, rtol=2e-3)

    def test_resistance_between_frequencies_is_within_its_certified_error(self):
        sound = self.open("beam.sound.h5")
        np.testing.assert_allclose(sound.R(sound.frequency_hz[2]), sound.file["resistance/00002"], rtol=1e-12)
        np.testing.assert_allclose(sound.R(200.0), sound.R(400.0) / 4.0)  # below the first, as f^2
        (self.folder / "other.sound.toml").write_text("[grid]\nfrom_hz = 430\nto_hz = 800\n")
        done = stages.run_stage("recover", "sound", "beam.rom.h5", "-c", "other.sound.toml", "-o", "other.sound.h5", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        other = self.open("other.sound.h5")
        new = [hz for hz in other.frequency_hz if np.min(abs(sound.frequency_hz - hz)) > 1.0]
        self.assertTrue(new)
        for hz in new:
            solved = np.diag(other.R(hz))
            moving = solved > 1e-12 * solved.max()
            error = 10.0 * np.log10(np.diag(sound.R(hz))[moving] / solved[moving])
            self.assertLess(abs(error).max(), sound.certificate["interpolation_error_db"])
        with self.assertRaisesRegex(clatter.Refused, "found 900 Hz, expected a positive frequency up to 800 Hz"):
            sound.R(900.0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
