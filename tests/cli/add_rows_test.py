# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of T that are added to a condensed part later, and the stored elimination permutation."""
import json
import sys
import unittest

import h5py
import numpy as np
import stages
from observed import observed

# The beam's second sensor and a surface that the file does not have at first; `skin` is its outer surface.
SENSOR = '\n[[sensor]]\nname = "sensor_side"\nsurface = "y_max"\nnear = [0.3, 0.04, 0.015]\n'
# Two solves of one basis; rows at once and later differ only in the order of sums.
SAME = 1e-9


class RowsTest(stages.PipelineTest):
    def run_stage(self, stage, *arguments):
        done = stages.run_stage(stage, *arguments, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def setUp(self):
        super().setUp()
        (self.folder / "beam.fe.toml").write_text((self.folder / "beam.fe.toml").read_text() + SENSOR)
        self.run_stage("assembly", "beam.mesh.h5", "-c", "beam.fe.toml", "-o", "beam.fe.h5")
        self.condense("beam.rom.h5", 'skin = ["z_max"]')

    def condense(self, output, *lines):
        """The beam with these lines added to its request."""
        request = self.folder / f"{output}.toml"
        text = (self.folder / "beam.rom.toml").read_text()
        request.write_text("\n".join((*lines, text)))
        return self.run_stage("condense", "beam.fe.h5", "-c", request.name, "-o", output)

    def add(self, *arguments, source="beam.rom.h5", output="more.rom.h5"):
        return self.run_stage("condense", "add-rows", "beam.fe.h5", "--of", source, *arguments, "-o", output)

    def assert_same_rows(self, found, expected):
        with h5py.File(self.folder / found) as a, h5py.File(self.folder / expected) as b:
            self.assertEqual(list(a["sets"]), list(b["sets"]))
            for name in b["sets"]:
                np.testing.assert_array_equal(a[f"sets/{name}/dofs"], b[f"sets/{name}/dofs"])
            for name in ("skin/nodes", "skin/triangles", "skin/T", "combined", "M_rr", "K_rr"):
                self.assertEqual(name in a, name in b, name)
                if name in b:
                    x, y = a[name][()], b[name][()]
                    np.testing.assert_allclose(x, y, rtol=0, atol=SAME * np.abs(y).max(), err_msg=name)


class AddRows(RowsTest):
    def test_a_sensor_that_a_reduction_loses_is_named(self):
        lost = "warning: sensors of the part that are neither in boundary nor in rows are lost: sensor_side (clatter-condense add-rows"
        self.assertIn(lost, self.condense("without.rom.h5").stderr)
        self.assertNotIn("are lost", self.condense("with.rom.h5", 'rows = ["sensor_side"]').stderr)
        self.assertNotIn("are lost", self.add("--set", "sensor_side").stderr)

    def test_rows_added_later_are_those_requested_at_once(self):
        self.condense("once.rom.h5", 'skin = ["z_max", "y_max"]', 'rows = ["sensor_side"]')
        done = self.add("--surface", "y_max", "--set", "sensor_side", "--json")
        self.assertLessEqual(json.loads(done.stdout)["rows_added_error"], SAME)
        self.assert_same_rows("more.rom.h5", "once.rom.h5")

    def test_one_after_the_other_is_the_same_as_both_and_what_is_there_stays(self):
        self.condense("once.rom.h5", 'skin = ["z_max", "y_max"]', 'rows = ["sensor_side"]')
        self.add("--set", "sensor_side", output="first.rom.h5")
        self.add("--surface", "y_max", "--surface", "z_max", "--set", "sensor_tip", source="first.rom.h5")
        self.assert_same_rows("more.rom.h5", "once.rom.h5")

    def test_rows_are_added_after_an_interface_reduction(self):
        interface = '[interface]\nsets = ["tip"]\nmodes = 3\n'
        text = (self.folder / "beam.rom.toml").read_text()
        (self.folder / "beam.rom.toml").write_text(text + interface)
        self.condense("beam.rom.h5", 'skin = ["z_max"]')
        self.condense("once.rom.h5", 'skin = ["z_max", "y_max"]', 'rows = ["sensor_side"]')
        self.add("--surface", "y_max", "--set", "sensor_side")
        self.assert_same_rows("more.rom.h5", "once.rom.h5")

    def test_a_shape_whose_sign_is_the_other_in_the_file_gives_rows_of_that_sign(self):
        with h5py.File(self.folder / "beam.rom.h5", "r+") as rom:
            n_b, r = rom.attrs["n_boundary"], rom["M_rr"].shape[0]
            sign = np.ones(r)
            sign[n_b:] = (-1.0) ** np.arange(r - n_b)
            for name in ("M_rr", "K_rr"):
                rom[name][...] = sign[:, None] * rom[name][()] * sign
            rom["skin/T"][...] = rom["skin/T"][()] * sign
            for load in rom["loads"].values():
                load[...] = sign * load[()]
        self.condense("once.rom.h5", 'skin = ["z_max", "y_max"]')
        self.add("--surface", "y_max")
        with h5py.File(self.folder / "more.rom.h5") as a, h5py.File(self.folder / "once.rom.h5") as b:
            T = b["skin/T"][()]
            np.testing.assert_allclose(a["skin/T"][()], T * sign, rtol=0, atol=SAME * np.abs(T).max())

    def test_dynamics_and_exports_read_a_part_with_added_rows(self):
        self.add("--set", "sensor_side")
        (self.folder / "more.rom.h5").replace(self.folder / "beam.rom.h5")
        self.run_stage("dynamics", "step.run.toml", "-o", "step.run.h5")
        self.run_stage("condense", "export", "beam.rom.h5", "part.mtx")

    def test_another_model_is_refused(self):
        self.edit("beam.fe.toml", "7850.0", "7800.0")
        self.run_stage("assembly", "beam.mesh.h5", "-c", "beam.fe.toml", "-o", "beam.fe.h5")
        self.refuse(["--surface", "y_max"], says=["beam.fe.h5", "sha256", "another"])

    def refuse(self, arguments, **options):
        self.assert_refused(
            "condense", ["add-rows", "beam.fe.h5", "--of", "beam.rom.h5", *arguments, "-o", "more.rom.h5"], **options)

    def test_unknown_names_and_wrong_command_lines_are_refused(self):
        self.refuse(["--surface", "roof"], says=["roof", "y_max"])
        self.refuse(["--set", "nowhere"], says=["nowhere", "sensor_side"])
        self.refuse([], says=["--surface"])
        self.assert_refused("condense", ["beam.fe.h5", "--set", "sensor_side", "-o", "x.rom.h5"], says=["--config is required"])
        self.edit("beam.rom.toml", "method", 'rows = ["tip"]\nmethod')
        self.assert_refused("condense", says=["rows", "tip", "boundary"])

    def test_a_basis_that_is_not_found_again_is_refused(self):
        with h5py.File(self.folder / "beam.rom.h5", "r+") as rom:
            rom["M_rr"][...] = rom["M_rr"][()] * (1.0 + 1e-5)
        self.refuse(["--surface", "y_max"], code=3, says=["differs"])

    def test_a_file_without_its_request_is_refused(self):
        with h5py.File(self.folder / "beam.rom.h5", "r+") as rom:
            del rom["request"]
        self.refuse(["--surface", "y_max"], says=["request"])


class HardC7StoredOrder(RowsTest):
    """Hard case C7: the permutation is computed once, stored in the file and reused."""

    def ordering(self):
        with h5py.File(self.folder / "beam.rom.h5") as rom:
            group = rom["ordering"]
            return group.attrs["method"].decode(), group.attrs["factor_entries"], group["permutation"][()]

    def test_the_second_run_uses_the_stored_permutation_with_the_same_fill(self):
        (self.folder / "beam.rom.h5").unlink()
        self.condense("beam.rom.h5")
        method, entries, permutation = self.ordering()
        self.assertNotEqual(method, "given")
        self.assertEqual(sorted(permutation), list(range(len(permutation))))
        self.assertIn("stored order", self.condense("beam.rom.h5").stderr)
        again, entries_again, permutation_again = self.ordering()
        self.assertEqual(again, "given")
        self.assertEqual(entries_again, entries)
        observed(f"the stored permutation gives the same fill: {entries} entries of the factor")
        np.testing.assert_array_equal(permutation_again, permutation)

    def test_rows_are_added_with_the_stored_permutation(self):
        self.assertIn("stored order", self.add("--surface", "y_max").stderr)

    def test_another_boundary_does_not_use_it(self):
        self.edit("beam.rom.toml", '["tip", "sensor_tip"]', '["tip"]')
        self.assertNotIn("stored order", self.condense("beam.rom.h5").stderr)

    def test_what_is_no_permutation_is_not_used(self):
        with h5py.File(self.folder / "beam.rom.h5", "r+") as rom:
            rom["ordering/permutation"][0] = rom["ordering/permutation"][1]
        self.assertNotIn("stored order", self.condense("beam.rom.h5").stderr)


if __name__ == "__main__":
    sys.exit(unittest.main())
