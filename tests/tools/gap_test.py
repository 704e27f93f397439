# SPDX-License-Identifier: GPL-3.0-or-later
"""The surfaces of skirt and liner that a run's scene gives, and their picture."""
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

import synthetic
from clatter_command import clatter
from clatter.artefact import BadArtefact, open_artefact
from clatter_tools.warm_surfaces import Surfaces

CONFIG = """engine.stroke_mm = 120
engine.pin_offset_mm = 0
rod.length_mm = 210
contact.bore_mm = 100
contact.minimum_warm_clearance_um = 5
contact.skirt_bottom_mm = -40
contact.skirt_top_mm = 20
contact.pad_span_deg = 80
contact.barrel_apex_mm = 0
contact.barrel_top_um = 40
contact.barrel_bottom_um = 20
contact.ovality_um = 60
contact.bore_shape[0].file = "bore.shape.h5"
contact.bore_shape[0].case = "thermal"
contact.bore_shape[0].factor = 0.5
contact.skirt_shape[0].order = 0
contact.skirt_shape[0].height_mm = [-40, 20]
contact.skirt_shape[0].amplitude_um = [30, 42]
"""


class Gap(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.write_run(CONFIG)
        path = self.folder / "bore.shape.h5"
        synthetic.write_shape(path)
        with h5py.File(path, "a") as file:
            file["axis_point"], file["axis"], file["zero_angle"] = np.array([0.2, 0.0, 0.05]), np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])

    def write_run(self, config):
        path = self.folder / "a.run.h5"
        path.unlink(missing_ok=True)
        synthetic.write_run(path)
        with h5py.File(path, "a") as file:
            file.attrs["config"] = np.bytes_(config)
            file["effects/name"] = np.array([b"friction", b"minimum warm clearance"])
            file["effects/why"] = np.array([b"x", b"contact.minimum_warm_clearance_um: 31.5 um of clearance between the cold surfaces, smallest"])

    def surfaces(self):
        return Surfaces(open_artefact(self.folder / "a.run.h5", "run"))

    def test_the_gap_is_relief_minus_skirt_plus_bore_with_their_factors(self):
        surfaces = self.surfaces()
        self.assertEqual(surfaces.dead_centres, (0.15, 0.27))
        self.assertEqual(surfaces.clearance(open_artefact(self.folder / "a.run.h5", "run")), 31.5e-6)
        angle = np.radians([0.0, 30.0])
        gap = surfaces.without_clearance(0.2, angle)
        for height in (-40, -20, 10, 20):
            j = int(np.argmin(np.abs(surfaces.z - 1e-3 * height)))
            for i in range(2):
                barrel = 40.0 * (height / 20.0) ** 2 if height > 0 else 20.0 * (height / 40.0) ** 2
                relief = barrel + 60.0 * np.sin(angle[i]) ** 2
                skirt = 36.0 + 0.2 * (height + 10)
                # The shape's heights, 0.1 to 0.3 m, are from its axis point at 50 mm.
                bore = 0.5 * (50.0 * (0.2 + 1e-3 * height - 0.05 - 0.1) + 20.0 * np.cos(2 * angle[i]))
                self.assertAlmostEqual(1e6 * gap[i, j], relief - skirt + bore, delta=0.25 if height in (-20, 10) else 1e-9)

    def test_the_picture_is_drawn_and_other_shapes_and_runs_are_refused(self):
        def plot(code):
            done = clatter("plot", "gap", "a.run.h5", "-o", "g.png", folder=self.folder)
            self.assertEqual(done.returncode, code, done.stderr)
            return done.stderr

        plot(0)
        self.assertGreater((self.folder / "g.png").stat().st_size, 20_000)
        self.write_run(CONFIG.replace('bore_shape[0].file = "bore.shape.h5"', 'bore_shape[0].table = "bore.csv"'))
        self.assertIn("found a shape of bore.csv, expected shapes of files or orders", plot(2))
        self.write_run("time.cycles = 2\n")
        self.assertIn("found no [contact], expected a run of one cylinder with it", plot(2))
        self.write_run(CONFIG.replace("bore.shape.h5", "gone.shape.h5"))
        with self.assertRaisesRegex(BadArtefact, "gone.shape.h5: no such file"):
            self.surfaces()


if __name__ == "__main__":
    unittest.main(verbosity=2)
