# SPDX-License-Identifier: GPL-3.0-or-later
"""Still pictures and findings by sound power: weighting, choice of the loudest line, equal scales, maps of the film, hidden faces."""
import io
import contextlib
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

import synthetic
import synthetic_page
from clatter import artefact, fields, histories
from clatter_tools import findings, orders, report, weighting
from clatter_tools.plots import accelerations, campbell, film, over_cycle, piston, radiation, raster, shape


def add_sound(path, power_at=600.0, dba=60.0):
    """Sound power in the cycle of a synthetic field: one peak, unlike the ERP's at 1800 Hz."""
    with h5py.File(path, "a") as file:
        at = "analysis/cycle"
        frequency = file[f"{at}/frequency_hz"][()]
        file[f"{at}/sound/power"] = 1e-9 / (1.0 + ((frequency - power_at) / 30.0) ** 2)
        file[f"{at}/sound/third_octave/power_dba"] = file[f"{at}/panels/exposed/third_octave/erp_dba"][()] - 20.0
        file[f"{at}/sound"].attrs.update({"power_dba": dba, "boundary_elements_to_hz": 2000.0})
        file.attrs["basis_valid_to_hz"] = 4900.0


class Weighting(unittest.TestCase):
    def test_a_weighting_is_that_of_the_standard(self):
        # IEC 61672-1, table 3, at exact mid-bands, rounded to 0.1 dB
        for exponent, expected in ((-15, -39.4), (-10, -19.1), (-3, -3.2), (0, 0.0), (4, 1.3), (10, -2.5)):
            self.assertAlmostEqual(10.0 * np.log10(weighting.a_weight(1000.0 * 10 ** (exponent / 10))), expected, delta=0.06)

    def test_the_loudest_peaks_are_those_of_the_weighted_power(self):
        # By power 63 Hz is highest; A-weighting takes 26 dB of it and 3 of 500 Hz. 550 Hz is no peak.
        hz = np.array([0.0, 50.0, 63.0, 80.0, 500.0, 550.0, 1000.0, 2000.0])
        power = np.array([0.0, 0.1, 20.0, 0.1, 3.0, 2.0, 1.0, 5.0])
        self.assertEqual(list(hz[weighting.loudest_peaks(hz, power, 3)]), [2000.0, 500.0, 63.0])

    def test_levels_of_orders_are_weighted_by_their_frequency(self):
        order = 0.5 * np.arange(61)
        speed, _, rms, unit = orders.a_weighted((2000.0, order, np.full(61, 1e-6), "W^0.5"))
        self.assertEqual((speed, orders.level_name(unit)), (2000.0, "level [dB(A) re 1 pW]"))
        self.assertAlmostEqual(orders.level(rms[60], unit), 0.0, delta=0.01)   # order 30: 1 kHz
        self.assertAlmostEqual(orders.level(rms[6], unit), -19.1, delta=0.06)  # order 3: 100 Hz
        with self.assertRaisesRegex(artefact.BadArtefact, "found a quantity in m/s2, expected a power"):
            orders.a_weighted((2000.0, order, rms, "m/s2"))


class FieldPictures(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.path = self.folder / "slap.field.h5"
        synthetic.write_field(self.path)

    def open(self):
        file = artefact.open_artefact(self.path, "field")
        self.addCleanup(file.close)
        return file

    def test_the_loudest_lines_are_in_the_band_of_the_levels(self):
        add_sound(self.path)
        for from_hz, end in ((20.0, "2000 Hz, lines at 600 Hz"), (700.0, "2000 Hz")):
            with h5py.File(self.path, "r+") as file:
                file.attrs["spectra_from_hz"] = from_hz
            with artefact.open_artefact(self.path, "field") as field:
                self.assertTrue(findings.loudness("slap", field)[1].endswith(end), from_hz)

    def test_findings_are_means_over_cycles_with_their_standard_error(self):
        add_sound(self.path)
        with h5py.File(self.path, "r+") as file:
            one = file["analysis/cycle/sound"].attrs["power_dba"]
            file["analysis/cycle/sound"].attrs["power_db"] = one + 2.0
            synthetic.add_mean(file, cycles=8, error=0.26, more_db=1.5)
        with self.open() as field:
            level, sentence = findings.loudness("slap", field)
            self.assertAlmostEqual(level, one + 1.5)
            self.assertIn(f"slap: {one + 1.5:.1f} ± 0.26 dB(A) of sound power re 1 pW (mean of 8 cycles); ", sentence)
            estimate = field["analysis/mean/panels/exposed"].attrs["erp_dba"]
            self.assertEqual(findings.field_row(field)[-2:], [f"{one + 1.5:.1f} ± 0.26", f"{estimate:.1f} ± 0.26"])
        with h5py.File(self.path, "r+") as file:  # segments that are not cycles are no mean over cycles
            file["analysis/mean"].attrs["periodic"] = "no"
        with self.open() as field:
            self.assertAlmostEqual(findings.loudness("slap", field)[0], one)

    def test_findings_are_by_sound_power_where_the_file_has_it(self):
        with self.open() as field:
            level, sentence = findings.loudness("slap", field)
            estimate = field["analysis/cycle/panels/exposed"].attrs["erp_dba"]
            self.assertAlmostEqual(level, estimate)
            self.assertIn("of ERP of panel “exposed”", sentence)
            self.assertIn("lines at 1800 Hz", sentence)
            self.assertEqual(findings.field_row(field)[-2:], ["-", f"{estimate:.1f}"])
        add_sound(self.path)
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            report.print_report(self.folder)
        self.assertIn("slap: 60.0 dB(A) of sound power re 1 pW; loudest are the third octave of 2000 Hz, lines at 600 Hz", out.getvalue())
        row = next(line for line in out.getvalue().splitlines() if line.startswith("  slap  "))
        self.assertEqual(row.split()[-2:], ["60.0", f"{estimate:.1f}"])

    def test_sound_power_and_erp_have_equal_scales_and_limits_are_marked(self):
        add_sound(self.path)
        figure = radiation.draw([self.path])
        sound, erp, lines = sorted(figure.axes, key=lambda axis: (-axis.get_position().y0 > -0.3, axis.get_position().x0))
        self.assertEqual(sound.get_ylim(), erp.get_ylim())
        self.assertIn("boundary elements\nto 2000 Hz", sound.get_title(loc="left"))
        self.assertEqual({text.get_text() for text in lines.texts}, {"ERP above", "limit of the basis"})
        self.assertAlmostEqual(np.ptp(lines.get_ylim()), radiation.RANGE_DB + 4.0)
        # 600 Hz has 1 nW: 30 dB; A-weighting takes 2.2 dB of it
        curve = lines.get_lines()[0].get_ydata()
        self.assertAlmostEqual(curve.max(), 27.8, delta=0.1)
        self.assertIn("sound power 60.0, ERP", figure.legends[0].texts[0].get_text())

    def test_without_sound_power_only_the_erp_is_drawn(self):
        figure = radiation.draw([self.path])
        self.assertEqual(len(figure.axes), 2)
        self.assertNotIn("sound power", figure.legends[0].texts[0].get_text())

    def test_the_order_axis_is_only_for_constant_speed(self):
        with h5py.File(self.path, "a") as file:
            cycle = file["analysis/cycle"]
            cycle["order"] = cycle["frequency_hz"][()] * 60.0 / 2000.0
            cycle["crank_angle_deg"] = 12000.0 * cycle["time"][()]
        with self.open() as field:
            self.assertAlmostEqual(fields.orders_per_hz(field, "analysis/cycle"), 0.03)
        with h5py.File(self.path, "a") as file:
            time = file["analysis/cycle/time"][()]
            file["analysis/cycle/crank_angle_deg"][...] = 12000.0 * time * (1.0 + time)  # 6 % faster at the end
        self.assertIsNone(fields.orders_per_hz(self.open(), "analysis/cycle"))

    def test_the_shape_is_that_of_the_loudest_line_by_sound_power(self):
        with self.open() as field:
            self.assertIn("Strongest line: 1800 Hz", shape.strongest_line(field)[0])
        add_sound(self.path)
        with self.open() as field:  # and the velocity is that of line 0
            title, velocity = shape.strongest_line(field)
            self.assertIn("Loudest line: 600 Hz,\n27.8 dB(A) of sound power", title)
            line = field["lines/velocity_re/00000"][()] + 1j * field["lines/velocity_im/00000"][()]
            elastic = shape.elastic_part(field, line)
        self.assertAlmostEqual(np.linalg.norm(velocity), np.linalg.norm(elastic), delta=1e-9)  # all nodes move in phase

    def test_liner_and_block_have_equal_scales_and_the_filter_is_named(self):
        figure = accelerations.draw([self.path])
        axes = np.array(figure.axes).reshape(3, 2)
        for liner, block in axes:
            self.assertEqual(liner.get_ylim(), block.get_ylim())
        self.assertIn("300 to 4983 Hz", figure._suptitle.get_text())
        with h5py.File(self.path, "a") as file:
            file.attrs["basis_valid_to_hz"] = 4985.0
        with self.open() as field:
            self.assertEqual(accelerations.band(field, "analysis/cycle"), "300 to 4983 Hz (limit of the basis)")
        self.assertEqual(axes[0, 1].get_title(loc="left"), "block: sensor_block.y")
        self.assertGreaterEqual(axes[2, 0].get_xlim()[0], np.log10(250.0))  # no bands of the shake on the mounts
        self.assertEqual(axes[1, 0].get_xlim(), accelerations.SHOWN_MS)


class RunPictures(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def test_maps_nearest_to_the_angles_of_the_last_cycle_are_taken_in_order(self):
        recorded = np.arange(-360.0, 1081.0, 30.0)  # two cycles: the last one from 360 on
        rows, angles = film.nearest_frames(recorded, (44.0, -20.0, 0.0, 1.0))
        self.assertEqual(angles, [-30.0, 0.0, 30.0])
        self.assertEqual(list(recorded[rows]), [690.0, 720.0, 750.0])
        # Fields are taken at the step after their instant: one of the cycle before is not one of the last cycle.
        recorded = np.concatenate([np.arange(-1080.0, -360.0, 10.0) + 0.3, np.arange(-360.0, 360.0, 10.0) + 0.1])
        self.assertEqual(histories.last_cycle_of_fields(recorded), slice(72, None))
        self.assertEqual(histories.last_cycle_of_fields(recorded[72:]), slice(0, None))

    def test_film_maps_have_one_scale_per_quantity_and_no_row_for_what_is_zero(self):
        path = self.folder / "wet.run.h5"
        synthetic_page.write_run(path, "wet")
        figure = film.draw([path], at_deg=(-90.0, 0.0, 180.0))
        maps = [axis for axis in figure.axes if len(axis.collections) == 1 and axis.get_label() != "<colorbar>"]
        self.assertEqual(len(maps), 3 * 3 * 2)  # no contact pressure; three angles; two pads
        for row in range(3):
            self.assertEqual(len({axis.collections[0].get_clim() for axis in maps[6 * row:6 * row + 6]}), 1)
        # Pressure 4 MPa cos(angle) on the thrust pad: at 0 deg its middle has almost 4 MPa, at 180 deg nothing.
        thrust = [maps[2 * k].collections[0].get_array().max() for k in range(3)]
        self.assertAlmostEqual(thrust[1], 4.0, delta=0.4)
        self.assertLess(thrust[2], 1e-9)
        self.assertEqual([axis.get_title(loc="left") for axis in maps[:6:2]], ["-90 deg", "firing TDC", "+180 deg"])

    def test_the_piston_has_a_row_per_history_and_a_zoom_around_firing_tdc(self):
        synthetic.write_run(self.folder / "wet.run.h5")
        synthetic.write_run(self.folder / "rigid.run.h5", film=False)
        for names, rows in ((("wet", "rigid"), 4), (("rigid",), 3)):
            axes = np.array(piston.draw([self.folder / f"{name}.run.h5" for name in names]).axes).reshape(rows, 2)
            self.assertEqual(axes[0, 1].get_xlim(), piston.AROUND_DEG)
            for whole, zoom in axes:
                self.assertEqual(whole.get_ylim(), zoom.get_ylim())

    def test_crank_angle_zero_is_called_what_the_scene_says(self):
        path = self.folder / "pump.run.h5"
        synthetic.write_run(path, film=False)
        for zero in ("firing TDC", "TDC", "the cycle's start"):
            with h5py.File(path, "a") as file:
                file.attrs["angle_zero"] = np.bytes_(zero.encode())
            axes = piston.draw([path]).axes
            self.assertEqual([axes[1].get_title(loc="left"), axes[-2].get_xlabel()], [f"around {zero}", f"crank angle [deg], 0 = {zero}"])
            with h5py.File(path) as file:
                self.assertEqual(over_cycle.LastCycle(file).label, f"crank angle [deg], 0 = {zero}")

    def test_a_campbell_diagram_fills_what_lies_below_the_first_half_order(self):
        spectra = [(speed, 0.5 * np.arange(61), np.full(61, 1e-4), "W^0.5") for speed in (1000.0, 2000.0)]
        figure = campbell.picture(spectra, [2.0], "orders", 1000.0)
        np.testing.assert_allclose(figure.axes[0].get_facecolor(), campbell.style.plt.get_cmap("viridis")(0.0), atol=2e-3)


class HiddenFaces(unittest.TestCase):
    def test_the_nearest_sample_of_each_pixel_remains(self):
        rng = np.random.default_rng(5)
        canvas = raster.Canvas(4, 5)
        best = {}
        for _ in range(3):
            index, depth = rng.integers(0, 20, 300), rng.integers(0, 40, 300).astype(np.float32)  # many pixels, many ties
            kept = canvas.nearest(index, depth, np.arange(300))
            self.assertEqual(len(set(index[kept])), len(kept))
            before = dict(best)
            for pixel, z in zip(index, depth):
                best[pixel] = max(best.get(pixel, -np.inf), z)
            self.assertEqual({pixel for pixel in best if best[pixel] > before.get(pixel, -np.inf)}, set(index[kept]))
            for sample in kept:
                self.assertEqual(depth[sample], best[index[sample]])
        self.assertEqual([canvas.depth[pixel] for pixel in sorted(best)], [best[pixel] for pixel in sorted(best)])


if __name__ == "__main__":
    unittest.main(verbosity=2)
