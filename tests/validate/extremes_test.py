# SPDX-License-Identifier: GPL-3.0-or-later
"""Hard case T12 with the elastic models of samples/truck_diesel: right, or refused in one line. Takes minutes; `make validate`."""
import pathlib
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import stages  # noqa: E402

RADIUS, STROKE, ROD, ROUGHNESS = 0.0535, 0.13, 0.21, 0.54e-6  # [m]
GAP = "piston_liner: gap below the film's minimum"


class HardT12Sample(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = stages.copy_sample(cls, "truck_diesel")
        stages.make(cls.folder, "block.rom.h5", "piston.rom.h5", "liner_4.shape.h5", "liner_4_bolted.shape.h5", "skirt.shape.h5")

    def simulated(self, name, changes, time=""):
        """The completed process of one cycle."""
        text = f'base = "slap.run.toml"\n[time]\ncycles = 1\n{time}\n{changes}'
        (self.folder / f"{name}.run.toml").write_text(text)
        return stages.run_stage("dynamics", f"{name}.run.toml", "-o", f"{name}.run.h5", "--quiet", folder=self.folder)

    def history(self, name, changes, time=""):
        """Histories of a run that ends well: finite, energy balanced, no deeper than the roughness."""
        done = self.simulated(name, changes, time)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.folder / f"{name}.run.h5") as file:
            self.assertLess(file["certificate"].attrs["energy_residue"], 3e-4)
            found = {key: values[()] for key, values in file["history"].items()}
            self.assertTrue(all(np.isfinite(file[f"bodies/{body}/v"][()]).all() for body in ("block", "piston")))
        self.assertTrue(all(np.isfinite(values).all() for values in found.values()))
        self.assertGreater(found["film_min"].min(), -4.0 * ROUGHNESS)
        return found

    def refusal(self, name, changes):
        done = self.simulated(name, changes)
        self.assertEqual(done.returncode, 3, done.stderr)
        error = [line for line in done.stderr.splitlines() if "error:" in line]
        self.assertEqual(len(error), 1)
        for part in ("time ", GAP, "pad at ", "mm from the pin", f"{name}.run.failed.h5"):
            self.assertIn(part, error[0])
        # And why, and what helps.
        self.assertRegex(done.stderr, r"above 0\.3 GPa, .* under a side force of .*: reduce the loads on the piston, the speed or the clearance\n")

    def test_12000_rpm_loads_the_crank_pin_by_the_inertia_of_piston_and_rod(self):
        run = self.history("fast", "[engine]\nspeed_rpm = 12000.0\n")
        one_kilogram = 0.5 * STROKE * (12000.0 * np.pi / 30.0) ** 2
        pin = np.abs(run["crank_pin_force_z"]).max()  # 5.05 kg at the pin are reached
        self.assertTrue(3.0 * one_kilogram < pin < 8.0 * one_kilogram, pin)
        self.assertLess(np.abs(run["side_force"]).max(), 0.4 * pin)

    def test_1_rpm_is_quasi_static(self):
        # Stiff mounts: the gas force does not turn with the block.
        run = self.history("slow", "[engine]\nspeed_rpm = 1.0\n[accuracy]\ntolerance = 1e-3\n[[mount]]\nbody = \"block\"\n"
                           "sets = [\"mount_1\", \"mount_2\", \"mount_3\", \"mount_4\"]\n"
                           "stiffness_n_m = [1e9, 1e9, 1e9]\ndamping_n_s_m = [1e4, 1e4, 1e4]\n", "output_step_us = 20000.0")
        sine = 0.5 * STROKE / ROD * np.sin(np.radians(run["crank_angle_deg"]))
        expected = -(run["gas_pressure"] - 1e5) * np.pi * RADIUS ** 2 * sine / np.sqrt(1.0 - sine ** 2)
        resting = (run["crank_angle_deg"] > 60.0) & (run["crank_angle_deg"] < 100.0)
        self.assertAlmostEqual(np.median(run["side_force"][resting] / expected[resting]), 1.0, delta=0.05)

    def test_without_oil_asperities_carry_everything(self):
        thin = self.history("thin", "[contact]\noil_thickness_um = 0.001\n")
        none = self.history("none", "[contact]\ninitial_fill = 0.0\nsupply_fill = 0.0\n")
        for run in (thin, none):
            self.assertEqual(run["film_pressure_max"].max(), 0.0)
        self.assertLess(none["film_fill"].max(), 1e-6)  # rounding: 8e-11
        self.assertAlmostEqual(np.abs(thin["side_force"]).max() / np.abs(none["side_force"]).max(), 1.0, delta=1e-6)

    def test_a_starved_inlet_ends_dry(self):
        # What is in the gap at the start is gone after half of a cycle.
        run = self.history("starved", "[contact]\nsupply_fill = 0.0\n")
        late = run["crank_angle_deg"] > 0.0
        self.assertGreater(run["film_pressure_max"][~late].max(), 1e6)
        self.assertLess(run["film_fill"][late].max(), 0.01)
        self.assertEqual(run["asperity_share"][-1], 1.0)

    def test_a_layer_of_thickness_0_is_refused(self):
        done = self.simulated("zero", "[contact]\noil_thickness_um = 0.0\n")
        self.assertEqual(done.returncode, 2)
        self.assertIn("contact.oil_thickness_um: found 0.0, expected a number at least 0.001", done.stderr)

    def test_clearance_of_a_nanometre_is_like_none(self):
        none, nanometre = self.history("tight", ""), self.history("nanometre", "[contact]\nminimum_warm_clearance_um = 0.001\n")
        for key in ("piston_lateral", "side_force", "film_min"):
            self.assertAlmostEqual(nanometre[key].min() / none[key].min(), 1.0, delta=0.01)

    def test_loads_that_no_surface_bears_are_refused(self):
        self.refusal("push", '[[load]]\nbody = "piston"\nset = "pin"\ncomponent = "y"\nvalue = 1e6\n')
        self.refusal("loose", "[contact]\nminimum_warm_clearance_um = 1000.0\n")

    def test_friction_grows_with_viscosity(self):
        def mean_friction(run):
            return np.trapz(np.abs(run["friction_force"]), run["time"]) / np.ptp(run["time"])

        hot = mean_friction(self.history("hot", "[contact]\nviscosity_pa_s = 0.001\n"))
        cold = mean_friction(self.history("cold", "[contact]\nviscosity_pa_s = 1.0\n"))
        # 1000 times the viscosity, thicker films: 2.1 and 1389 N are reached.
        self.assertTrue(100.0 < cold / hot < 1000.0, (cold, hot))


if __name__ == "__main__":
    unittest.main(verbosity=2)
