# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter info: units of what runs and fields hold, those of docs/formats.md."""
import contextlib
import io
import pathlib
import re
import tempfile
import unittest

import h5py
import synthetic
import synthetic_drive
import synthetic_page
from clatter_tools import info


class Units(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def printed(self, path):
        """{name: last words} of the datasets in the contents."""
        with contextlib.redirect_stdout(io.StringIO()) as output:
            info.print_info(path)
        return re.findall(r"^ +(\S+) +(?:[\d x]+|scalar)  \S+(?:  (.*))?$", output.getvalue().partition("contents")[2], re.M)

    def test_motions_and_films_of_a_run_have_their_units(self):
        synthetic_page.write_run(self.folder / "slap.run.h5", "slap")
        found = dict(self.printed(self.folder / "slap.run.h5"))
        self.assertEqual({name: found[name] for name in ("v", "gap", "side_force")}, {"v": "m/s", "gap": "m", "side_force": "N"})

    def test_shapes_of_a_chain_have_their_units(self):
        synthetic_drive.write_drive(self.folder / "drive.run.h5")
        found = dict(self.printed(self.folder / "drive.run.h5"))
        self.assertEqual({name: found[name] for name in ("x", "angle", "tension", "outline")}, {"x": "m", "angle": "rad", "tension": "N", "outline": "m"})

    def test_a_unit_that_a_group_keeps_for_its_datasets_is_theirs_and_an_own_one_goes_before(self):
        with synthetic.new_file(self.folder / "slap.field.h5", "field") as file:
            file["frames/velocity/00000"] = file["frames/velocity/00001"] = [1.0]
            file["frames/velocity"].attrs["unit"], file["frames/velocity/00001"].attrs["unit"] = "m/s", "mm/s"
            file["frames/other"] = [1.0]
        found = dict(self.printed(self.folder / "slap.field.h5"))
        self.assertEqual((found["00000"], found["00001"], found["other"]), ("m/s", "mm/s", ""))

    def test_no_pattern_takes_the_place_of_an_attribute(self):
        synthetic_page.write_run(self.folder / "slap.run.h5", "slap")
        with h5py.File(self.folder / "slap.run.h5", "a") as file:
            file["bodies/block/v"].attrs["unit"] = "rad/s"
        self.assertIn(("v", "rad/s"), self.printed(self.folder / "slap.run.h5"))


if __name__ == "__main__":
    unittest.main()
