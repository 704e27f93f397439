# SPDX-License-Identifier: GPL-3.0-or-later
"""The beam's numbers do not depend on threads, numbers of nodes, position, orientation, units and kernels of BLAS (bench/stability.py)."""
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
import stability_beam as beam  # noqa: E402
import stability_models as models  # noqa: E402
import stages  # noqa: E402
from observed import expect_at_least, expect_at_most  # noqa: E402

# Rounding of K may change its lowest eigenvalue by 1.1e-16 |K| x.x / (x.K x), which is 5e-7 for this beam; measured are 1e-9 in all variants.
FREQUENCY, STATIC = 2e-8, 2e-8
RESPONSE = 1e-6     # next to a resonance with a loss factor of 0.02 a frequency's error is multiplied by 1 / 0.02
DISPLACEMENT = 2e-7  # after four periods of the first mode
MASS = 1e-9          # inertia about the centre of a beam that is ten lengths away: 1000 times smaller than about the origin
BANDS_DB = 2e-4  # of bands 40 dB below the loudest, where 1e-7 of the response is 1e-5; no taper fades the start of the step


class Stability(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        scratch = tempfile.TemporaryDirectory(prefix="clatter-stability-")
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        cls.base = beam.run_beam(cls.folder / "base", stages.BIN, beam.Variant("base"))

    def check(self, variant, changed=True):
        mesh = self.folder / "base/beam.mesh.h5" if changed else None
        found = beam.run_beam(self.folder / "variant", stages.BIN, variant, mesh)
        by = beam.beam_differences(found, self.base)
        self.assertTrue(by["counts"], variant.name)
        for name, limit in (("mass", MASS), ("full_hz", FREQUENCY), ("reduced_hz", FREQUENCY), ("static", STATIC), ("response", RESPONSE),
                            ("tip", DISPLACEMENT), ("erp", DISPLACEMENT), ("bands_db", BANDS_DB), ("residue", 1e-9)):
            expect_at_most(self, f"{variant.name}: {name}", by[name], limit)
        return found, by

    def same_bits(self, found):
        return [name for name, a, b in zip(beam.ARTEFACTS, found["bits"], self.base["bits"]) if a == b]

    def test_mesh_and_matrices_have_the_same_bits_with_any_number_of_threads(self):
        for variant in beam.threads():
            found, _ = self.check(variant, changed=False)
            self.assertEqual(self.same_bits(found)[:2], ["mesh", "fe"])

    def test_renumbered_rotated_shifted_and_mirrored(self):
        found, _ = self.check(beam.motions()[-1])  # all at once
        self.assertEqual(self.same_bits(found), [])

    def test_units_of_a_deck(self):
        for variant in beam.units()[1:]:
            self.check(variant)

    def test_a_thousand_times_as_large(self):
        self.check(beam.scales()[0])

    def test_an_old_kernel_of_blas(self):
        found, _ = self.check(beam.kernel("Prescott"), changed=False)
        self.assertEqual(self.same_bits(found)[:2], ["mesh", "fe"])

    def test_a_real_change_is_seen(self):
        """The differences do not vanish because something is left out: a rotation of the mesh alone, without force and sensor."""
        turned = models.Motion(models.rotation((1.0, 2.0, 3.0), 37.0))
        folder = self.folder / "half"
        found = beam.run_beam(folder, stages.BIN, beam.Variant("rotated", motion=turned), self.folder / "base/beam.mesh.h5")
        unturned = beam.beam_numbers(folder, "tip_force", models.Motion())
        by = beam.beam_differences({**found, **unturned}, self.base)
        expect_at_least(self, "static displacement in other axes", by["static"], 0.1)
        expect_at_least(self, "inertia in other axes", by["mass"], 0.1)
        self.assertLess(by["full_hz"], FREQUENCY)


class Models(unittest.TestCase):
    def test_a_motion_and_its_inverse(self):
        mirrored = models.rotation((3.0, -1.0, 0.5), 71.0) @ np.diag([1.0, -1.0, 1.0])
        motion = models.Motion(mirrored, np.array([1.0, -2.0, 5.0]), 1000.0)
        points = np.arange(12.0).reshape(4, 3)
        np.testing.assert_allclose(motion.back(motion.of(points)), points, atol=1e-13)
        self.assertAlmostEqual(np.linalg.det(mirrored), -1.0, places=14)

    def test_a_rotation_by_90_degrees_about_z_turns_x_into_y(self):
        np.testing.assert_allclose(models.rotation((0, 0, 2), 90.0) @ [1, 0, 0], [0, 1, 0], atol=1e-15)

    def test_texts_are_moved_by_key(self):
        quarter = models.Motion(models.rotation((0, 0, 1), 90.0), np.array([10.0, 0.0, 0.0]), 2.0)
        text = models.moved_text("near = [1.0, 0.0, 0.0]\nforce = [0.0, 1.0, 0.0]\nend_s = 0.5  # s\nto_s = 1.0\n", ("near",), ("force",), quarter, end_s=2.0)
        lines = text.splitlines()
        for line, expected in zip(lines, ([10.0, 2.0, 0.0], [-1.0, 0.0, 0.0])):
            np.testing.assert_allclose([float(word) for word in line.split("[")[1][:-1].split(",")], expected, atol=1e-15)
        self.assertEqual(lines[2:], ["end_s = 1.0  # s", "to_s = 1.0"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
