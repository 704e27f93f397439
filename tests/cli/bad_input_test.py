# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input: one clear line, the right exit code, older artefacts untouched."""
import unittest

import h5py
import numpy as np
import stages


class WrongFiles(stages.PipelineTest):
    def test_a_missing_file(self):
        for stage in stages.STAGES:
            with self.subTest(stage=stage):
                arguments = ["absent.file", *self.command(stage)[1:]]
                self.assert_refused(stage, arguments, says=["absent.file", "no such file"])

    def test_a_file_of_another_schema(self):
        wrong = {"assembly": "beam.rom.h5", "modal": "beam.mesh.h5", "condense": "beam.mesh.h5", "recover": "beam.fe.h5"}
        for stage, file in wrong.items():
            with self.subTest(stage=stage):
                arguments = [file, *self.command(stage)[1:]]
                self.assert_refused(stage, arguments, says=[file, "schema", "expected clatter/"])

    def test_a_truncated_artefact(self):
        for stage in ("assembly", "modal", "condense", "recover"):
            path = self.folder / self.command(stage)[0]
            complete = path.read_bytes()
            for part in (0.9, 0.5, 0.01):
                with self.subTest(stage=stage, part=part):
                    path.write_bytes(complete[:int(part * len(complete))])
                    self.assert_refused(stage, says=[path.name])
            path.write_bytes(complete)

    def test_a_file_that_is_not_hdf5(self):
        for stage in ("assembly", "modal", "condense", "recover"):
            with self.subTest(stage=stage):
                (self.folder / self.command(stage)[0]).write_text("not HDF5\n" * 100)
                self.assert_refused(stage, says=[self.command(stage)[0], "HDF5"])

    def test_a_file_that_is_not_toml(self):
        for stage, file in (("mesh", "beam.mesh.toml"), ("assembly", "beam.fe.toml"), ("modal", "beam.modes.toml"),
                            ("condense", "beam.rom.toml"), ("dynamics", "step.run.toml"),
                            ("recover", "step.field.toml")):
            with self.subTest(stage=stage):
                (self.folder / file).write_text("this is = = no TOML\n")
                self.assert_refused(stage, says=[f"{file}:1"])

    def test_an_unknown_key_is_named_with_the_nearest_known_one(self):
        self.edit("beam.mesh.toml", "element_size_mm", "elementsize_mm")
        self.assert_refused("mesh", says=["elementsize_mm", "element_size_mm", "beam.mesh.toml:"])
        self.edit("beam.fe.toml", "E_gpa = 210.0", "E_gpa = 210.0\nE_gpaa = 1.0")
        self.assert_refused("assembly", says=["E_gpaa", "E_gpa", "beam.fe.toml:"])
        for stage, file in (("modal", "beam.modes.toml"), ("condense", "beam.rom.toml"), ("dynamics", "step.run.toml"),
                            ("recover", "step.field.toml")):
            with self.subTest(stage=stage):
                path = self.folder / file
                path.write_text("nobody_knows_this = 1\n" + path.read_text())
                self.assert_refused(stage, says=["nobody_knows_this", f"{file}:1"])

    def test_a_wrong_command_line(self):
        for stage in stages.STAGES:
            with self.subTest(stage=stage):
                done = stages.run_stage(stage, "--no-such-option", folder=self.folder)
                self.assertEqual(done.returncode, 2)
                self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)


class WrongContent(stages.PipelineTest):
    def test_a_mesh_with_an_inverted_element(self):
        with h5py.File(self.folder / "beam.mesh.h5", "r+") as mesh:
            cells = mesh["cells/0/nodes"][()]
            cells[5, [0, 1]] = cells[5, [1, 0]]
            mesh["cells/0/nodes"][...] = cells
        self.assert_refused("assembly", says=["beam.mesh.h5", "inverted"])

    def test_a_mesh_with_a_node_that_does_not_exist(self):
        with h5py.File(self.folder / "beam.mesh.h5", "r+") as mesh:
            mesh["cells/0/nodes"][3, 2] = len(mesh["nodes"]) + 7
        self.assert_refused("assembly", says=["beam.mesh.h5", "cells/0"])

    def test_a_coordinate_that_is_not_a_number(self):
        with h5py.File(self.folder / "beam.mesh.h5", "r+") as mesh:
            mesh["nodes"][10, 1] = np.nan
        self.assert_refused("assembly", says=["beam.mesh.h5", "nodes"])

    def test_a_matrix_with_an_index_out_of_range(self):
        with h5py.File(self.folder / "beam.fe.h5", "r+") as model:
            model["K/indices"][4] = 10**9
        for stage in ("modal", "condense"):
            with self.subTest(stage=stage):
                self.assert_refused(stage, says=["beam.fe.h5", "K"])

    def test_a_set_that_selects_nothing(self):
        self.edit("beam.fe.toml", 'surface = "x_max"', 'surface = "x_mox"')
        self.assert_refused("assembly", says=["beam.fe.toml:", "x_mox", "x_max"])

    def test_a_named_surface_that_selects_no_face(self):
        path = self.folder / "beam.mesh.toml"
        path.write_text(path.read_text() + '\n[surface.ghost]\nplane = {normal = [1, 0, 0], height = 5000}\n')
        self.assert_refused("mesh", says=["ghost", "no face"])

    def test_a_negative_length(self):
        self.edit("beam.mesh.toml", "size = [600.0,", "size = [-600.0,")
        self.assert_refused("mesh", says=["beam.mesh.toml:", "size"])

    def test_a_wall_thinner_than_its_elements_can_follow(self):
        (self.folder / "beam.mesh.toml").write_text(
            'name = "tube"\nkind = "cylinder"\nlength_unit = "mm"\n[cylinder]\nradius = 10.0\ninner_radius = 9.9\n'
            "length = 30.0\n[mesh]\nelement_size_mm = 20.0\n")
        self.assert_refused("mesh", code=3, says=["mesh", "element_size_mm = 2.9", "smallest features"])

    def test_a_region_without_material(self):
        self.edit("beam.fe.toml", 'regions = ["bar"]', "regions = []")
        self.assert_refused("assembly", says=["beam.fe.toml", "bar"])

    def test_a_frequency_above_what_the_basis_holds(self):
        self.edit("step.field.toml", "to_hz = 3000.0", "to_hz = 30000.0")
        self.assert_refused("recover", says=["step.field.toml: spectrum.to_hz", "30000", "4000"])

    def test_a_run_whose_reduced_model_has_changed_since(self):
        with h5py.File(self.folder / "beam.rom.h5", "r+") as model:
            model["K_rr"][0, 0] *= 1.01
        self.assert_refused("recover", says=["beam.rom.h5"])

    def test_a_reduced_model_with_a_value_that_is_not_finite(self):
        with h5py.File(self.folder / "beam.rom.h5", "r+") as model:
            model["M_rr"][2, 2] = np.inf
        self.assert_refused("dynamics", says=["beam.rom.h5", "M_rr"])

    def test_a_load_or_a_body_that_does_not_exist(self):
        self.edit("step.run.toml", 'load = "tip_force"', 'load = "top_force"')
        self.assert_refused("dynamics", says=["top_force", "tip_force"])


# An engine whose piston is the beam: enough of a scene to reach its tables and contact.
ENGINE = """
[engine]
speed_rpm = 2000.0
stroke_mm = 130.0
[rod]
length_mm = 210.0
mass_kg = 2.0
inertia_kg_m2 = 0.02
centre_mm = 60.0
[time]
cycles = 1
[piston]
rom = "beam.rom.h5"
pin = "tip"
gas_load = "tip_force"
[gas]
table = "cycle.csv"
"""


class WrongScenes(stages.PipelineTest):
    def setUp(self):
        super().setUp()
        (self.folder / "step.run.toml").write_text(ENGINE)
        self.rows = [f"{angle}, {1.0 + 30 * np.exp(-(angle / 40) ** 2):.4f}" for angle in range(-360, 361, 2)]

    def refuse_table(self, rows, says):
        (self.folder / "cycle.csv").write_text("crank_angle [deg], pressure [bar]\n" + "\n".join(rows) + "\n")
        self.assert_refused("dynamics", says=["cycle.csv:", *says])

    def test_a_table_with_a_gap(self):
        self.refuse_table(self.rows[:100] + self.rows[150:], ["gap"])

    def test_a_table_that_does_not_cover_a_cycle(self):
        self.refuse_table(self.rows[:300], ["720"])

    def test_a_table_with_nan(self):
        self.rows[40] = "-280, nan"
        self.refuse_table(self.rows, ["cycle.csv:42", "nan"])

    def test_a_table_with_a_missing_cell(self):
        self.rows[40] = "-280"
        self.refuse_table(self.rows, ["cycle.csv:42"])

    def test_a_table_that_does_not_ascend(self):
        self.rows[40], self.rows[41] = self.rows[41], self.rows[40]
        self.refuse_table(self.rows, ["cycle.csv:43"])

    def test_a_table_in_an_unknown_unit(self):
        (self.folder / "cycle.csv").write_text("crank_angle [deg], pressure [psi]\n" + "\n".join(self.rows) + "\n")
        self.assert_refused("dynamics", says=["cycle.csv:1", "psi"])

    def test_a_table_that_is_missing(self):
        self.assert_refused("dynamics", says=["cycle.csv"])

    def test_a_negative_clearance(self):
        path = self.folder / "step.run.toml"
        path.write_text(ENGINE + "[contact]\nbore_mm = 107.0\nclearance_um = -5.0\n")
        self.assert_refused("dynamics", says=["step.run.toml:", "clearance_um", "-5"])

    def test_a_negative_speed(self):
        self.edit("step.run.toml", "speed_rpm = 2000.0", "speed_rpm = -2000.0")
        self.assert_refused("dynamics", says=["step.run.toml:", "speed_rpm"])

    def test_a_rod_shorter_than_the_crank(self):
        self.edit("step.run.toml", "length_mm = 210.0", "length_mm = 61.0")
        self.assert_refused("dynamics", says=["rod"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
