# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `clatter`: information, report, pictures, on small synthetic artefacts."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.image  # noqa: E402
import numpy as np  # noqa: E402

import synthetic  # noqa: E402
from clatter_command import clatter  # noqa: E402
from clatter_tools import slap  # noqa: E402
from clatter_tools.plots import raster  # noqa: E402

CLATTER = pathlib.Path(__file__).resolve().parents[2] / "tools/clatter"


class Command(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        synthetic.write_mesh(self.folder / "block.mesh.h5")
        synthetic.write_run(self.folder / "slap.run.h5")
        synthetic.write_run(self.folder / "slap_dry.run.h5", film=False)
        synthetic.write_field(self.folder / "slap.field.h5")
        synthetic.write_shape(self.folder / "bore.shape.h5")
        synthetic.write_shape(self.folder / "skirt.shape.h5", cases=["thermal"], covered=False)

    def test_the_version_is_that_of_the_stages(self):
        done = clatter("--version", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"^clatter \d+\.\d+\.\d+\n$")

    def test_info_names_schema_cost_and_contents(self):
        done = clatter("info", "slap.run.h5", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        for expected in ("clatter/run/1", "energy_residue", "solve", "history/", "piston_lateral"):
            self.assertIn(expected, done.stdout)

    def test_report_prints_each_run_and_the_cost_of_each_stage(self):
        done = clatter("report", ".", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        # The synthetic slap starts 0.3 ms after firing TDC with 40 m/s2 on the liner.
        for expected in ("slap_dry", "block.mesh.h5", "total", "2.00", "0.44", "417", "12.5"):
            self.assertIn(expected, done.stdout)

    def test_a_damaged_file_is_left_out_of_the_report_with_a_warning(self):
        (self.folder / "broken.run.h5").write_bytes(b"no HDF5")
        done = clatter("report", ".", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"\Aclatter: warning: .*broken\.run\.h5: .*: left out\n\Z")
        alone = self.folder / "alone"
        alone.mkdir()
        (self.folder / "broken.run.h5").rename(alone / "broken.run.h5")
        done = clatter("report", "alone", folder=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("broken.run.h5", done.stderr)

    def test_named_cylinders_have_lines_and_rows_of_their_own(self):
        synthetic.write_run(self.folder / "four.run.h5", cylinder="c1")
        with h5py.File(self.folder / "four.run.h5", "a") as file:
            for name in list(file["history"]):
                if name.startswith("c1_"):
                    file.copy(f"history/{name}", f"history/{name.replace('c1_', 'c3_')}")
            file["certificate"].attrs["periodicity_lateral_c3"] = 3.3e-7
        done = clatter("report", ".", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = {line.split()[1]: line for line in done.stdout.splitlines() if line.split()[:1] == ["four"]}
        self.assertEqual(sorted(rows), ["c1", "c3"])
        self.assertIn("-19.9 .. 19.9", rows["c1"])
        self.assertEqual(rows["c3"].split()[-1], "0.33")
        done = clatter("plot", "piston", "four.run.h5", "-o", "piston.png", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_each_picture_is_drawn_and_is_not_blank(self):
        runs = ["slap.run.h5", "slap_dry.run.h5"]
        fields = ["slap.field.h5"]
        for kind, files in (("piston", runs), ("mesh", ["block.mesh.h5"]),
                            ("quality", ["block.mesh.h5"]), ("acceleration", fields),
                            ("power", fields), ("shape", fields), ("distortion", ["bore.shape.h5", "skirt.shape.h5"])):
            with self.subTest(kind=kind):
                done = clatter("plot", kind, *files, "-o", f"{kind}.png", folder=self.folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                image = matplotlib.image.imread(self.folder / f"{kind}.png")
                self.assertGreater(image[..., :3].std(), 0.05)  # a blank page has 0

    def test_a_wrong_file_gets_one_line_and_exit_code_2(self):
        (self.folder / "broken.run.h5").write_bytes(b"not HDF5")
        synthetic.new_file(self.folder / "no_piston.run.h5", "run").close()
        synthetic.write_shape(self.folder / "empty.shape.h5", cases=[])
        for arguments, expected in ((("info", "absent.h5"), "no such file"),
                                    (("info", "broken.run.h5"), "not a readable HDF5 file"),
                                    (("plot", "piston", "block.mesh.h5"), "expected clatter/run/1"),
                                    (("plot", "piston", "no_piston.run.h5"), "none of these runs has a piston"),
                                    (("plot", "distortion", "empty.shape.h5"), "cases: found none"),
                                    (("plot", "poem", "slap.run.h5"), "no picture named poem"),
                                    (("plot", "film", "slap.run.h5"), "film: found no maps"),
                                    (("plot", "film", "slap.run.h5", "--at=0,x"), "--at: found 0,x, expected crank angles"),
                                    (("plot", "piston", "slap.run.h5", "--at=0"), "expected it for film only"),
                                    (("report", "nowhere"), "no artefacts"),
                                    (("run", "."), "no Makefile")):
            with self.subTest(arguments=arguments):
                done = clatter(*arguments, folder=self.folder)
                self.assertEqual(done.returncode, 2)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertIn(expected, done.stderr)

    def test_sigterm_ends_the_stages_that_run_started(self):
        # Before, the command ended at once and the stages went on without it.
        (self.folder / "stage.py").write_text(
            "import pathlib, signal, sys, time\n"
            "signal.signal(signal.SIGTERM, lambda *_: (pathlib.Path('ended').touch(), sys.exit(3)))\n"
            "print('started', flush=True)\n"
            "time.sleep(60)\n")
        (self.folder / "Makefile").write_text(f"all:\n\t@{sys.executable} stage.py\n")
        run = subprocess.Popen([CLATTER, "run"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.assertEqual(run.stdout.readline(), "started\n")
        run.terminate()
        run.communicate(timeout=30)
        self.assertNotEqual(run.returncode, 0)
        self.assertTrue((self.folder / "ended").exists(), "the stage was told, and the command waited for it")


class Slap(unittest.TestCase):
    def test_a_ringing_impact_is_timed_and_slow_shaking_is_excluded(self):
        with tempfile.TemporaryDirectory() as scratch:
            path = pathlib.Path(scratch) / "slap.field.h5"
            synthetic.write_field(path, amplitude=40.0, ring_hz=1800.0)
            with h5py.File(path, "a") as field:
                at, sensor = "analysis/cycle", "analysis/cycle/sensors/sensor_liner"
                times = field[f"{at}/time"][()]
                field[f"{sensor}/acceleration"][...] += 400.0 * np.cos(2 * np.pi * 50 * times)[:, None]
                time, values = slap.band_limited(field, sensor, at)
                when, height = slap.peak(time, values)
                # the first crest of exp(-t / .9 ms) sin(w t) comes a quarter of a period after .3 ms
                self.assertAlmostEqual(when * 1e3, 0.3 + 0.25 / 1.8, delta=0.04)
                self.assertAlmostEqual(height, 40.0 * np.exp(-0.139 / 0.9), delta=3.0)
                # a quarter of the peak: .9 ms ln 4 after it; the window of the rms adds at most its length
                self.assertAlmostEqual(slap.rung_out(time, values) * 1e3, 0.5 + 0.9 * np.log(4), delta=0.35)
                # the tail of a decaying 1.8 kHz line above 2 kHz: some of its 40 m/s2, not all
                self.assertTrue(0.5 < slap.high_rms(field, sensor, at) < 6.0)


class Renderer(unittest.TestCase):
    def test_the_nearer_of_two_faces_is_seen(self):
        square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
        points = np.vstack([square, square * [0.5, 0.5, 0] + [0, 0, 1]])
        triangles = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
        colour = np.array([[1, 0, 0]] * 2 + [[0, 0, 1]] * 2, float)
        image = raster.render(points, triangles, colour, azimuth=-90, elevation=90, size=(100, 100))
        self.assertGreater(image[50, 50, 2], 0.5)
        self.assertEqual(image[50, 50, 0], 0)
        self.assertGreater(image[50, 15, 0], 0.5)

    def test_clipping_keeps_the_area_below_the_plane(self):
        points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
        cut, parts, _ = raster.clip(points, np.array([[0, 1, 2]]), (1, 0, 0), 0.5)
        corners = cut[parts]
        area = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        self.assertAlmostEqual(area.sum(), 0.5 - 0.125, delta=1e-12)  # a triangle of 1/2 x 1/2 / 2 is cut off


if __name__ == "__main__":
    unittest.main(verbosity=2)
