# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter export`: choices, tables, invalid input, and files that are complete or absent."""
import csv
import pathlib
import resource
import shutil
import tempfile
import unittest

import h5py
import numpy as np
import synthetic_surface as ball
from clatter_tools.export import derived, field_source


def table(path):
    """(comment lines, names, rows as numbers) of a CSV file."""
    lines = path.read_text().splitlines()
    comments = [line for line in lines if line.startswith("#")]
    rows = list(csv.reader(lines[len(comments):]))
    return comments, rows[0], np.array(rows[1:], float)


class Command(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        ball.write(self.folder / "ball.field.h5")
        self.nodes, self.triangles = ball.sphere()

    def refused(self, *arguments):
        """The message of a refused call, which must leave nothing behind."""
        before = sorted(path.name for path in self.folder.iterdir())
        out, message = ball.export(self.folder, *arguments, code=2)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), before)
        self.assertEqual((out, message.count("\n")), ("", 1))
        return message.removeprefix("clatter: error: ").rstrip("\n")

    def changed(self, change):
        """The field file after a change by h5py."""
        with h5py.File(self.folder / "ball.field.h5", "r+") as file:
            change(file)

    def test_lines_that_the_field_file_left_out_are_counted(self):
        def refine(file):
            del file["analysis/cycle/frequency_hz"]
            file["analysis/cycle/frequency_hz"] = 50.0 * np.arange(30)

        self.changed(refine)
        said, _ = ball.export(self.folder, "-o", "a.csv", "--at", "90:300")
        self.assertIn("a.csv: 2 lines (of 4 in this range: [lines] from_hz, to_hz in field.toml store them all) of ", said)
        said, _ = ball.export(self.folder, "-o", "b.csv", "--at", "100,250")
        self.assertIn("b.csv: 2 lines of ", said)

    def test_a_table_has_a_row_per_node_and_line(self):
        ball.export(self.folder, "-o", "a.csv", "--at", "250,1033", "--quantity", "displacement")
        comments, names, rows = table(self.folder / "a.csv")
        self.assertIn("peak amplitudes, x(t) = Re( X exp(+i 2 pi f t) )", comments[1])
        self.assertEqual(names[:6], ["frequency_hz", "node", "x_m", "y_m", "z_m", "displacement_x_re_m"])
        self.assertEqual(sorted(set(rows[:, 0])), [250.0, 1033.25])
        np.testing.assert_array_equal(rows[:len(self.nodes), 1], np.arange(1, len(self.nodes) + 1))
        np.testing.assert_allclose(rows[:len(self.nodes), 2:5], self.nodes, atol=1e-9)
        for k, step in enumerate((1, 2)):
            own = rows[k * len(self.nodes):(k + 1) * len(self.nodes), 5:]
            wanted = ball.line_velocity(self.nodes, step) / (2j * np.pi * ball.FREQUENCIES[step])
            np.testing.assert_allclose(own[:, ::2] + 1j * own[:, 1::2], wanted, atol=1e-8 * np.abs(wanted).max())

    def test_a_table_of_normal_velocities_has_centres_normals_and_areas(self):
        ball.export(self.folder, "-o", "n.csv", "--frames", "--at", "0", "--quantity", "normal_velocity")
        _, names, rows = table(self.folder / "n.csv")
        self.assertEqual(names, ["time_s", "face", "x_m", "y_m", "z_m", "normal_x", "normal_y", "normal_z", "area_m2", "normal_velocity_m_s"])
        area, vector, flow = ball.integrals(self.nodes, self.triangles, ball.frame_velocity(self.nodes, 1))
        np.testing.assert_allclose(rows[:, 8], area, rtol=1e-8)
        np.testing.assert_allclose(rows[:, 5:8], vector / np.linalg.norm(vector, axis=1)[:, None], atol=1e-8)
        np.testing.assert_allclose(rows[:, 9] * area, flow, atol=1e-6 * np.abs(flow).max())

    def test_a_table_of_sensors_has_a_column_per_channel(self):
        ball.export(self.folder, "-o", "s.csv", "--sensors")
        _, names, rows = table(self.folder / "s.csv")
        self.assertEqual(names[1:3], ["sensor_a.x velocity_re_m_s", "sensor_a.x velocity_im_m_s"])
        self.assertEqual(names[-1], "sensor_b.t velocity_im_rad_s")
        np.testing.assert_allclose(rows[:, 0], ball.SENSOR_HZ)
        np.testing.assert_allclose(rows[:, 1] + 1j * rows[:, 2], ball.sensor_spectrum("velocity", 0), rtol=1e-11)

    def test_a_table_of_histories_has_the_instants(self):
        said, _ = ball.export(self.folder, "-o", "t.csv", "--sensors", "--histories", "--quantity", "displacement")
        self.assertIn("5 histories of displacement, 31 instants each", said)
        comments, names, rows = table(self.folder / "t.csv")
        self.assertIn("real values, time from crank angle 0", comments[1])
        self.assertEqual((names[:2], names[-1]), (["time_s", "sensor_a.x displacement_m"], "sensor_b.t displacement_rad"))
        np.testing.assert_allclose(rows[:, 0], ball.SENSOR_TIME, rtol=1e-11)
        for channel in range(5):
            np.testing.assert_allclose(rows[:, channel + 1], ball.sensor_history("displacement", channel), rtol=1e-11)

    def test_uneven_histories_are_refused(self):
        self.changed(lambda file: file["analysis/cycle/time"].__setitem__(3, -0.01962))
        self.assertEqual(self.refused("-o", "x.unv", "--sensors", "--histories"),
                         "ball.field.h5: analysis/cycle/time: found uneven or less than two values, expected even ones")

    def test_frames_are_the_default_without_lines(self):
        ball.write(self.folder / "ball.field.h5", lines=False)
        self.assertIn("4 frames of velocity", ball.export(self.folder, "-o", "f.csv")[0])
        self.assertEqual(self.refused("-o", "x.csv", "--lines"),
                         "ball.field.h5: lines: found none, expected lines; set them in the field.toml of clatter-recover")

    def test_quarters_keep_the_volume_flow_of_each_curved_face(self):
        with h5py.File(self.folder / "ball.field.h5", "r") as file:
            surface = field_source.read_surface(file)
            for kind in ("lines", "frames"):
                motion = field_source.read_motion(file, kind, surface)
                fine, split = derived.split(surface, motion)
                own = split.read("normal_velocity", 1)
                flow = surface.area * motion.read("normal_velocity", 1)
                np.testing.assert_allclose((fine.area * own).reshape(-1, 4).sum(axis=1), flow, atol=1e-14)
                nodal = np.einsum("fc,fc->f", motion.read("velocity", 1)[fine.triangles].mean(axis=1), fine.normal)
                self.assertLess(np.abs(own - nodal).max(), 0.15 * np.abs(nodal).max())
                np.testing.assert_array_equal(split.read("velocity", 1), motion.read("velocity", 1))
        self.assertEqual(fine.area.shape, (4 * len(self.triangles),))
        np.testing.assert_array_equal(fine.panels["upper"] // 4, np.repeat(surface.panels["upper"], 4))
        again, same = derived.split(fine, split)
        self.assertTrue(again is fine and same is split)

    def test_what_cannot_be_chosen_is_refused(self):
        for arguments, message in (
                (["-o", "x.docx"], "x.docx: found the ending '.docx', expected .unv, .pvd, .cfs, .msh, .pch, .csv, or --format numcalc"),
                (["-o", "x"], "x: found no ending, expected .unv, .pvd, .cfs, .msh, .pch, .csv, or --format numcalc"),
                (["-o", "x.unv", "--format", "msh"], "x.unv: found the ending '.unv', expected .msh for --format msh"),
                (["-o", "x.pch", "--quantity", "normal_velocity"],
                 "--quantity normal_velocity: found 'normal_velocity', expected velocity, displacement, acceleration for pch"),
                (["-o", "x.csv", "--quantity", "velocity,displacement"],
                 "x.csv: found the quantities velocity, displacement, expected one in a CSV file"),
                (["-o", "x.csv", "--frames", "--quantity", "acceleration"],
                 "ball.field.h5: frames/acceleration: missing; frames have velocity, normal_velocity"),
                (["-o", "x.csv", "--at", "500"], "--at 500: found no frequency at 500 Hz, expected some of 100, 250, 1033.25 Hz"),
                (["-o", "x.csv", "--at", "2,3:x"], "--at 2,3:x: found no frequency at 2 Hz, expected some of 100, 250, 1033.25 Hz"),
                (["-o", "x.csv", "--at", "3:x"],
                 "--at 3:x: found '3:x', expected numbers [Hz] or ranges low:high, joined by commas"),
                (["-o", "x.msh", "--sensors"], "--sensors: found the format msh, expected .unv or .csv"),
                (["-o", "x.csv", "--sensors", "--at", "3"], "--sensors: found --at, --linear or --skin, which are for the surface"),
                (["-o", "x.csv", "--histories"], "--histories needs --sensors")):
            with self.subTest(message):
                self.assertEqual(self.refused(*arguments), message)

    def test_damaged_and_other_files_are_refused_in_one_line(self):
        source = self.folder / "good.h5"
        shutil.copy(self.folder / "ball.field.h5", source)

        def put(name, value):
            def change(file):
                shape, dtype = file[name].shape, file[name].dtype
                del file[name]
                file[name] = np.full(shape, value, dtype) if np.isscalar(value) else value
            return change

        for change, message in (
                (put("lines/velocity_im/00001", np.nan), "ball.field.h5: lines/velocity_im/00001: found values that are not finite"),
                (put("lines/velocity_re/00002", np.zeros((3, 3))),
                 f"ball.field.h5: lines/velocity_re/00002: found shape (3, 3), expected ({len(self.nodes)}, 3)"),
                (put("skin/triangles", len(self.nodes)),
                 f"ball.field.h5: skin/triangles: found node {len(self.nodes)}, expected 0 to {len(self.nodes) - 1}"),
                (put("panels/upper/faces", -1), f"ball.field.h5: panels/upper/faces: found faces outside of 0 to {len(self.triangles) - 1}"),
                (lambda file: file.attrs.__delitem__("phase"), "ball.field.h5: attribute phase: missing"),
                (lambda file: file.__delitem__("skin"), "ball.field.h5: skin: missing, expected nodes and triangles"),
                (lambda file: file.attrs.__setitem__("schema", "clatter/run/1"),
                 "ball.field.h5: schema: found clatter/run/1, expected clatter/field/1")):
            with self.subTest(message):
                shutil.copy(source, self.folder / "ball.field.h5")
                self.changed(change)
                for name in ("x.unv", "x.pvd", "x.cfs"):
                    self.assertEqual(self.refused("-o", name), message)

    def test_a_displacement_at_zero_frequency_is_refused(self):
        self.changed(lambda file: file["lines/frequency_hz"].__setitem__(0, 0.0))
        self.assertEqual(self.refused("-o", "x.csv", "--quantity", "displacement"),
                         "ball.field.h5: displacement: found the frequency 0 Hz, expected one above 0")

    def test_a_failed_export_does_not_change_the_older_one(self):
        ball.export(self.folder, "-o", "a.pvd")
        before = {path.name: path.read_bytes() for path in self.folder.glob("a*")}
        self.changed(lambda file: file["lines/velocity_re/00002"].__setitem__((0, 0), np.inf))
        self.refused("-o", "a.pvd")
        self.assertEqual({path.name: path.read_bytes() for path in self.folder.glob("a*")}, before)

    def test_a_folder_that_is_missing_is_a_file_error(self):
        _, message = ball.export(self.folder, "-o", "no/where/a.unv", code=4)
        self.assertEqual(message, "clatter: error: no/where/a.unv: cannot be written: No such file or directory\n")

    def test_a_full_disk_is_reported_in_one_line_and_leaves_nothing(self):
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        self.addCleanup(resource.setrlimit, resource.RLIMIT_FSIZE, before)
        for arguments in (["-o", "x.unv"], ["-o", "x.pvd"], ["-o", "x.cfs"], ["-o", "x.pch"], ["-o", "x", "--format", "numcalc"]):
            resource.setrlimit(resource.RLIMIT_FSIZE, (5000, before[1]))
            _, message = ball.export(self.folder, *arguments, code=4)
            self.assertRegex(message, r"^clatter: error: x\S*: cannot be written: File too large\n$")
            self.assertEqual([path.name for path in self.folder.iterdir()], ["ball.field.h5"])


if __name__ == "__main__":
    unittest.main()
