# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a chain drive, `clatter drive`, `clatter orders` and what a report says, on a drive of known shape and tensions."""
import base64
import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree

import matplotlib

matplotlib.use("Agg")
import matplotlib.image  # noqa: E402
import numpy as np  # noqa: E402

import synthetic  # noqa: E402
import synthetic_drive  # noqa: E402
from clatter_command import clatter  # noqa: E402
from clatter import artefact, chains  # noqa: E402
from clatter_tools.plots import campbell, drive, drive_film, loop, over_cycle, speed, style, valves  # noqa: E402
from synthetic_drive import LINKS, PITCH, RADIUS, SLACK, SPAN, SWING, TIGHT  # noqa: E402



class Folder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def chain(self, **options):
        synthetic_drive.write_drive(self.folder / "oval.run.h5", **options)
        with artefact.open_artefact(self.folder / "oval.run.h5", "run") as run:
            return chains.read_chain(run)


class Shapes(Folder):
    def test_joints_are_on_the_loop_with_their_tensions(self):
        chain = self.chain()
        pins = chain.pins(5)
        place, tension = synthetic_drive.on_oval(np.arange(LINKS) * PITCH)
        self.assertAlmostEqual(np.linalg.norm(np.diff(place, axis=0), axis=1).max(), PITCH, delta=1e-9)
        gap = [np.linalg.norm(synthetic_drive.on_oval(np.linspace(0.0, LINKS * PITCH, 60001))[0] - pin, axis=1).min() for pin in pins]
        self.assertLess(max(gap), 5e-5)  # links on the arcs are chords, their ends are on the loop
        self.assertEqual([one.name for one in chain.over], ["crank", "cam", "guide"])
        self.assertAlmostEqual(chain.angle[-1], 720.0 * synthetic_drive.CYCLES, delta=1e-6)
        self.assertAlmostEqual(chain.angle[chain.last_cycle()[0]], 1440.0, delta=720.0 * 3 / 89)

    def test_a_drive_is_seen_from_where_it_runs_clockwise(self):
        front, behind = self.chain(), self.chain(mirrored=True)
        self.assertLess(np.abs(front.pins() - behind.pins()).max(), 1e-7)
        for one, other in zip(front.over, behind.over):
            self.assertLess(np.abs(one.at(7) - other.at(7))[len(one.outline) // 2].max() if not one.teeth else
                            abs(np.abs(one.at(7)).max() - np.abs(other.at(7)).max()), 1e-6)
            self.assertEqual(one.turn, other.turn)

    def test_places_along_the_loop_begin_where_it_leaves_the_first_sprocket(self):
        chain = self.chain()
        around = chains.Loop(chain, 0)
        self.assertAlmostEqual(around.length, LINKS * PITCH, delta=1e-3)
        self.assertEqual([zone[0] for zone in around.zones], ["cam", "guide", "crank"])
        half = np.array([[-RADIUS, 0.5 * SPAN * PITCH], [RADIUS, 0.5 * SPAN * PITCH], [0.0, -RADIUS], [0.0, SPAN * PITCH + RADIUS]])
        slack, tight, crank, cam = around.place(half)
        for place, s in ((slack, 0.5 * SPAN), (cam, SPAN + 5.0), (tight, 1.5 * SPAN + 10.0), (crank, 2.0 * SPAN + 15.0)):
            self.assertAlmostEqual(place, s * PITCH, delta=1.5 * PITCH)  # from a joint, not from the tangent's point
        self.assertEqual(around.where(slack), "between crank and cam")
        self.assertEqual(around.where(tight), "on guide")
        self.assertEqual(around.where(crank), "on crank")

    def test_lowest_mean_and_highest_tension_of_each_place(self):
        chain = self.chain(shapes=400)
        around = chains.Loop(chain, 0)
        at, low, mean, high = loop.around(chain, around, chain.last_cycle())
        slack = np.abs(at - 0.5 * SPAN * PITCH) < 5.0 * PITCH
        tight = np.abs(at - (1.5 * SPAN + 10.0) * PITCH) < 5.0 * PITCH
        for found, expected in ((low[slack], SLACK), (high[slack], SLACK), (low[tight], TIGHT - SWING), (high[tight], TIGHT + SWING)):
            # of 133 instants of a cycle some miss the swing's ends by 1.5 x 2.7 deg at most, 1 - cos 4 deg of 50 N; and the
            # tight span has 0.1 N less 5 pitches from its middle
            self.assertLess(np.abs(found - expected).max(), 0.25)
        self.assertLess(np.abs(mean[tight] - TIGHT).max(), 1.5)


class Pictures(Folder):
    def test_a_still_has_each_link_in_the_colour_of_its_tension(self):
        chain = self.chain()
        instant = drive.instant_of_largest_tension(chain)
        picture = drive.Picture(chain, "oval", 3000.0)
        picture.show(instant)
        for inner, links in picture.links.items():
            self.assertEqual(len(links.get_paths()), LINKS // 2)
            expected = drive.link_tension(chain, instant)[chain.inner == inner]
            np.testing.assert_array_equal(links.get_array(), expected)
            centres = np.array([path.vertices[:-1].mean(axis=0) for path in links.get_paths()])
            self.assertLess(np.abs(centres - chain.links[instant, chain.inner == inner, :2]).max(), 1e-6)
        texts = [text.get_text() for text in picture.axis.texts]
        self.assertTrue({"crank", "cam", "guide"} <= set(texts))
        self.assertRegex(texts[0], r"^3000 rpm, crank angle \d+\.\d°; joints 100 to 3[45]\d N$")
        style.plt.close(picture.figure)

    def test_curves_are_those_of_the_last_cycle(self):
        self.chain(amplitude=4.0)
        figure = speed.draw([self.folder / "oval.run.h5"])
        lines = {line.get_label(): line for line in figure.axes[0].lines}
        self.assertEqual(set(lines), {"cam", "crank × 20/20"})
        angle, value = lines["cam"].get_data()
        self.assertLess(abs(angle[0]) + abs(angle[-1] - 720.0), 1.0)
        expected = 4.0 * np.sin(np.radians(1.5 * angle)) + 0.4 * np.cos(np.radians(20.0 * angle))
        self.assertLess(np.abs(value - expected).max(), 3e-2)  # the mean is that of uneven steps
        self.assertLess(np.abs(lines["crank × 20/20"].get_ydata()).max(), 1e-9)
        train = valves.draw([self.folder / "oval.run.h5"])
        lift, gap = (axis.lines[0] for axis in train.axes)  # that of the tensioner's check valve is no valve lift
        self.assertEqual((lift.get_label(), gap.get_label()), ("intake 1", "intake 1"))
        self.assertAlmostEqual(lift.get_ydata().max(), 7.5, delta=1e-3)
        self.assertAlmostEqual(gap.get_ydata().max(), 0.2, delta=1e-6)
        style.plt.close(train)
        with artefact.open_artefact(self.folder / "oval.run.h5", "run") as run:
            pressure = over_cycle.LastCycle(run).history("tensioner_t_pressure", "Pa")
        self.assertAlmostEqual(pressure.max() * 1e-5, 19.0, delta=1e-3)
        style.plt.close(figure)

    def test_levels_of_a_campbell_diagram_are_at_speed_and_frequency(self):
        orders = 0.5 * np.arange(100)
        spectra = []
        for rpm, height in ((3000.0, 1.0), (1000.0, 2.0), (2000.0, 4.0)):
            rms = np.full(100, 1e-3)
            rms[3] = height
            spectra.append((rpm, orders, rms, "m/s2"))
        figure = campbell.picture(spectra, [1.5, 20.0], "oval")
        meshes = figure.axes[0].collections
        self.assertEqual(len(meshes), 3)
        for mesh, rpm, height in zip(meshes, (1000.0, 2000.0, 3000.0), (2.0, 4.0, 1.0)):
            levels = mesh.get_array()
            corners = mesh._coordinates[np.argmax(levels)]
            self.assertAlmostEqual(levels.max(), 20.0 * np.log10(height / 1e-6), delta=1e-9)
            self.assertAlmostEqual(corners[0, 1], 1.25 * rpm / 60.0, delta=1e-9)
            self.assertAlmostEqual(corners[0, 0], rpm - 500.0, delta=1e-9)
        cut = next(line for line in figure.axes[1].lines if line.get_label() == "order 1.5")
        np.testing.assert_allclose(cut.get_ydata(), 20.0 * np.log10(np.array([2.0, 4.0, 1.0]) / 1e-6))
        self.assertEqual(figure.axes[1].get_ylabel(), "level [dB re 1e-06 m/s², RMS]")
        style.plt.close(figure)


class Film(Folder):
    def data(self, page):
        return json.loads(re.search(r"^const data = (.*);$", page, re.M).group(1))

    def test_the_page_has_all_poses_and_tensions_and_needs_nothing_else(self):
        chain = self.chain()
        page = drive_film.page(chain, "oval <drive>", 3000.0)
        data, window = self.data(page), chain.last_cycle()
        numbers = lambda key: np.frombuffer(base64.b64decode(data[key]), "<i2").astype(float)  # noqa: E731
        pose = numbers("pose").reshape(len(window), LINKS, 3) * [data["step"], data["step"], 1e-4]
        self.assertLess(np.abs(pose[..., :2] * drive_film.UNIT - chain.links[window][..., :2] * [1.0, -1.0]).max(), 1e-5)
        self.assertLess(np.abs(np.remainder(pose[..., 2] + chain.links[window][..., 2] + 3.0, 2.0 * np.pi) - 3.0).max(), 1e-4)
        tension = numbers("tension").reshape(len(window), LINKS) * data["newton"]
        self.assertLess(np.abs(tension - [drive.link_tension(chain, k) for k in window]).max(), 0.02)
        self.assertEqual(page.count('class="link"'), LINKS)
        self.assertEqual(page.count('class="part"'), 3)
        self.assertEqual(len(data["caption"]), data["frames"])
        self.assertNotRegex(page, r'(src|href)=|https?://(?!www\.w3\.org/2000/svg)')
        self.assertNotIn("<drive>", page)  # texts are escaped
        for part in ("drive", "scale"):
            xml.etree.ElementTree.fromstring(re.search(rf'<svg id="{part}".*?</svg>', page, re.S).group())

    @unittest.skipUnless(shutil.which("node"), "node is not installed")
    def test_the_script_moves_links_and_parts(self):
        chain = self.chain()
        page = drive_film.page(chain, "oval", 3000.0)
        (self.folder / "page.html").write_text(page, encoding="utf-8")
        (self.folder / "run.js").write_text(STAND_IN, encoding="utf-8")
        done = subprocess.run(["node", "run.js", "page.html"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        window = chain.last_cycle()
        for frame, shown in zip((0, 9), found["frames"]):
            for link, (transform, colour) in enumerate(shown["links"]):
                x, y, angle = map(float, re.fullmatch(r"translate\((\S+) (\S+)\) rotate\((\S+)\)", transform).groups())
                expected = chain.links[window[frame], link]
                self.assertLess(abs(x * drive_film.UNIT - expected[0]) + abs(y * drive_film.UNIT + expected[1]), 2e-5)
                self.assertAlmostEqual((angle + np.degrees(expected[2]) + 180.0) % 360.0, 180.0, delta=0.02)
                low, high = drive.tension_range(chain)
                share = (drive.link_tension(chain, window[frame])[link] - low) / (high - low)
                self.assertLessEqual(abs(drive_film.colours().index(colour) - share * (drive_film.COLOURS - 1)), 0.51)
            self.assertIn("crank angle", shown["caption"])
        self.assertEqual(found["label"], "play", "moving the slider stops the film")

    def test_frames_are_numbered_and_have_even_sizes(self):
        chain = self.chain()
        self.assertEqual(drive_film.write_frames(chain, "oval", 3000.0, self.folder / "frames", 3), 3)
        names = sorted(path.name for path in (self.folder / "frames").iterdir())
        self.assertEqual(names, ["frame_0001.png", "frame_0002.png", "frame_0003.png"])
        images = [matplotlib.image.imread(self.folder / "frames" / name) for name in names]
        self.assertEqual([size % 2 for size in images[0].shape[:2]], [0, 0])
        self.assertGreater(np.abs(images[0] - images[1]).max(), 0.3)


class Commands(Folder):
    def test_one_command_draws_all_that_a_run_has(self):
        self.chain()
        done = clatter("drive", "oval.run.h5", "-o", "out", "--frames", "2", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        expected = {"drive.svg", "loop.svg", "speed.svg", "tensioner.svg", "valves.svg", "drive.html", "frames"}
        self.assertEqual({path.name for path in (self.folder / "out").iterdir()}, expected)
        for name in expected - {"frames", "drive.html"}:
            tree = xml.etree.ElementTree.parse(self.folder / "out" / name)
            self.assertGreater(len(list(tree.iter("{http://www.w3.org/2000/svg}path"))), 20)
        done = clatter("drive", "oval.run.h5", "--format", "png", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        for kind in ("drive", "loop", "speed", "tensioner", "valves"):
            image = matplotlib.image.imread(self.folder / "oval" / f"{kind}.png")
            self.assertGreater(image[..., :3].std(), 0.05)

    def speeds(self):
        for rpm, amplitude in ((1500, 2.0), (3000, 9.0), (4500, 5.0)):
            synthetic_drive.write_drive(self.folder / f"at_{rpm}.run.h5", rpm=float(rpm), amplitude=amplitude)
        return [f"at_{rpm}.run.h5" for rpm in (4500, 1500, 3000)]

    def test_orders_prints_levels_by_speed_and_where_they_are_largest(self):
        done = clatter("orders", *self.speeds(), "--history", "chain_cam_speed", "--orders", "1.5,20", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [line.split() for line in done.stdout.splitlines()]
        self.assertEqual([row[0] for row in rows[2:5]], ["1500", "3000", "4500"])
        for row, amplitude in zip(rows[2:5], (2.0, 9.0, 5.0)):
            self.assertAlmostEqual(float(row[2]), amplitude / np.sqrt(2.0), delta=1e-3 * amplitude)
            self.assertAlmostEqual(float(row[3]), 0.1 * amplitude / np.sqrt(2.0), delta=1e-3 * amplitude)
        # the parabola through 2, 9, 5 at -1, 0, 1 steps of 1500 rpm: 3000 + 1500 (5 - 2) / (2 (2 9 - 2 - 5))
        self.assertIn(f"order 1.5 is largest at {3000.0 + 1500.0 * 3.0 / 22.0:.0f} rpm", done.stdout)
        self.assertTrue((self.folder / "campbell.svg").exists())

    def test_a_report_tells_what_a_drive_did(self):
        self.speeds()
        synthetic_drive.write_drive(self.folder / "jumped.run.h5", rpm=2000.0, jump=True, turns=1.5)
        done = clatter("report", ".", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        for expected in ("chain drive of at_3000, 3000 rpm", "the joints carry 50 to 350 N; the largest force is on guide, at",
                         "500 N on crank, 1000 N on cam, 1500 N on guide", "no link jumped a tooth",
                         "its largest order is 1.5, amplitude 9.00 rad/s",
                         "JUMPED on the teeth, counted 2 times, first at 22.5", "orders are not known",
                         "cam: order 1.5 is largest at about 3205 rpm, 9.10 rad/s (3 speeds, 1500 to 4500 rpm)"):
            self.assertIn(expected, done.stdout)

    def test_a_single_run_has_its_orders_as_bars_and_a_table(self):
        synthetic_drive.write_drive(self.folder / "one.run.h5", rpm=2400.0)
        done = clatter("orders", "one.run.h5", "--history", "bracket_acceleration", "--orders", "1.5,20", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"2400 +123\.\d* +123 +111")  # peaks of 2 and 0.5 m/s2
        self.assertNotIn("is largest at", done.stdout)
        self.assertIn("order, multiple of 40 Hz", (self.folder / "campbell.svg").read_text())

    def test_what_cannot_be_drawn_is_refused_in_one_line(self):
        self.chain()
        synthetic.write_run(self.folder / "slap.run.h5")
        synthetic_drive.write_drive(self.folder / "short.run.h5", turns=1.0)
        run = "oval.run.h5"
        for arguments, expected in ((("drive", "slap.run.h5"), "found no shapes of a chain, expected a scene with [[chain]]"),
                                    (("drive", run, "--frames", "-1"), "--frames: found -1"),
                                    (("plot", "loop", run, run), "this picture needs one .run.h5 file"),
                                    (("plot", "tensioner", "slap.run.h5"), "none of these runs has one"),
                                    (("plot", "valves", "slap.run.h5"), "found no <valve>_coil_gap"),
                                    (("plot", "speed", "slap.run.h5"), "found no shapes of a chain"),
                                    (("orders", run, "--history", "nothing"), "history/nothing: missing"),
                                    (("orders", run, run, "--history", "chain_cam_speed"), "found runs at 3000, 3000 rpm, expected different speeds"),
                                    (("orders", run, "--history", "chain_cam_speed", "--to-hz", "1"), "found no half order up to 1 Hz"),
                                    (("orders", run, "--history", "chain_cam_speed", "--orders", "1.3"), "expected multiples of 0.5"),
                                    (("orders", run, "--history", "chain_cam_speed", "--cycles", "0"), "--cycles: found 0"),
                                    (("orders", "short.run.h5", "--history", "chain_cam_speed"), "found 0.5 cycles of 720 deg")):
            with self.subTest(arguments=arguments):
                done = clatter(*arguments, folder=self.folder)
                self.assertEqual(done.returncode, 2)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertIn(expected, done.stderr)
        self.assertFalse((self.folder / "campbell.svg").exists())


# Runs the script of a page with a stand-in for the browser; shows frame 0, then moves the slider to frame 9.
STAND_IN = r"""
const page = require("fs").readFileSync(process.argv[2], "utf8");
const make = () => ({ attributes: {}, dataset: {}, value: 20, textContent: "", setAttribute(k, v) { this.attributes[k] = v; } });
const links = [...page.matchAll(/data-link="(\d+)"/g)].map(m => Object.assign(make(), { dataset: { link: m[1] }, firstElementChild: make() }));
const parts = [...page.matchAll(/class="part"/g)].map(make);
const named = {};
global.document = { querySelectorAll: s => s === ".link" ? links : parts, getElementById: id => named[id] ??= make() };
global.requestAnimationFrame = () => {};
eval(page.match(/<script>([\s\S]*?)<\/script>/)[1]);
const shown = () => ({
  links: links.slice().sort((a, b) => a.dataset.link - b.dataset.link).map(g => [g.attributes.transform, g.firstElementChild.attributes.fill]),
  caption: named.caption.textContent });
const frames = [shown()];
named.frame.value = "9";
named.frame.oninput();
frames.push(shown());
console.log(JSON.stringify({ frames, label: named.play.textContent }));
"""

if __name__ == "__main__":
    unittest.main(verbosity=2)
