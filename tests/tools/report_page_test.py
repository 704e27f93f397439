# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of `clatter report --html`: its numbers, without a browser."""
import base64
import json
import pathlib
import re
import tempfile
import unittest
import zlib

import h5py
import numpy as np
import synthetic
import synthetic_drive
import synthetic_page
from clatter_command import clatter
from clatter_tools import report_page
from clatter_tools.report_page import certificates, shapes, skin
from clatter_tools.report_page.pack import Pack, json_text

KINDS = {"f4": "<f4", "u1": "<u1", "i1": "<i1", "u2": "<u2", "i2": "<i2", "u4": "<u4"}


def numbers(texts, reference):
    """What the page's script makes of a reference."""
    block = zlib.decompress(base64.b64decode(texts[reference["block"]]))
    kind = np.dtype(KINDS[reference["kind"]])
    count = int(np.prod(reference["shape"]))
    planes = np.frombuffer(block, "u1", count * kind.itemsize, reference["at"]).reshape(kind.itemsize, count)
    values = np.ascontiguousarray(planes.T).view(kind).reshape(reference["shape"])
    return values * reference["scale"] + reference["offset"] if "scale" in reference else values


def rows(texts, packed):
    return numbers(texts, packed["numbers"]).astype(float).reshape(packed["count"], -1) * numbers(texts, packed["factor"])[:, None]


class Folder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def clatter(self, *arguments):
        return clatter("report", *arguments, folder=self.folder)

    def page(self):
        """(data, blocks, text) of the page of the folder."""
        text = report_page.write_page(self.folder).read_text(encoding="utf-8")
        data = json.loads(re.search(r'<script type="application/json" id="page-data">(.*?)</script>', text, re.S).group(1))
        blocks = dict(re.findall(r'<script type="text/plain" id="block-(\w+)">(.*?)</script>', text, re.S))
        return data, blocks, text


class Page(Folder):
    def test_it_has_each_section_of_which_the_folder_has_data_and_needs_nothing_else(self):
        synthetic_page.write_folder(self.folder)
        data, _, text = self.page()
        for name in ("summary", "surface", "radiation", "sound", "sensors", "mechanism", "film", "drive", "speeds", "models", "accuracy", "cost", "certificates"):
            self.assertTrue(data[name], name)
        found = re.search(r"""(?:src|href)=["']?(?:https?:|//)|@import|[^L]url\((?!#)|https?://(?!www\.w3\.org/2000/svg)""", text)
        self.assertIsNone(found and found.group())
        self.assertNotIn("<contact>", text.split('id="page-data"')[0])
        self.assertIn("dry <contact>", data["runs"][0]["label"])
        self.assertEqual(text.count("</script>"), len(re.findall("<script(?= type)", text)))
        self.assertFalse(list(self.folder.glob("*.part")))

    def test_a_folder_with_runs_only_has_a_page_without_the_other_sections(self):
        synthetic.write_run(self.folder / "slap.run.h5")
        data, _, _ = self.page()
        self.assertTrue(data["mechanism"])
        for name in ("surface", "radiation", "sound", "sensors", "film", "drive", "speeds", "models", "accuracy"):
            self.assertIsNone(data[name], name)

    def test_a_study_is_shown_with_its_pictures_verdicts_and_effects(self):
        synthetic_page.write_folder(self.folder)
        (self.folder / "study/proofs.csv").write_text("request,scene\nsound power 0.5,the study's\n")
        data, _, text = self.page()
        one, = data["accuracy"]
        self.assertEqual([own["name"] for own in one["quantities"]], ["sound power", "height <slap>"])
        self.assertEqual(base64.b64decode(one["quantities"][0]["picture"]), (self.folder / "study/sound-power.png").read_bytes())
        self.assertIsNone(one["quantities"][1]["picture"])
        self.assertEqual(one["quantities"][0]["sentences"], ["sound power: 7", "sound power: the budget is closed, sum over run 1.00", "cells, sound power: 2 % costs 3 s", "steps, sound power: no value changes it"])
        self.assertEqual((one["effects"][1][0], one["proofs"][1]), ("<friction>", ["sound power 0.5", "the study's"]))
        self.assertNotIn("<friction>", text)

    def test_levels_of_several_cycles_are_means_with_their_standard_error(self):
        synthetic_page.write_folder(self.folder)
        with h5py.File(self.folder / "dry.field.h5", "r+") as field:
            synthetic.add_mean(field, cycles=6, error=0.4)
            sound = field["analysis/mean/sound"].attrs["power_dba"]
        data, _, _ = self.page()
        label = {one["stem"]: number for number, one in enumerate(data["runs"])}
        means = {one["run"]: one["mean"] for one in data["sound"]}
        self.assertEqual({key: means[label["dry"]][key] for key in ("dba", "error", "cycles")}, {"dba": sound, "error": 0.4, "cycles": 6})
        self.assertIsNone(means[label["wet"]])
        self.assertTrue(any(f"{sound:.1f} ± 0.40" in cell for table in data["summary"]["tables"] for row in table["rows"] for cell in row))

    def test_what_it_says_is_what_the_files_say(self):
        synthetic_page.write_folder(self.folder)
        data, blocks, _ = self.page()
        label = {one["stem"]: number for number, one in enumerate(data["runs"])}
        with h5py.File(self.folder / "dry.field.h5") as field, h5py.File(self.folder / "dry.run.h5") as run:
            own = next(one for one in data["radiation"]["runs"] if one["run"] == label["dry"])
            panel = next(one for one in own["panels"] if one["name"] == "top")
            np.testing.assert_allclose(numbers(blocks, panel["measures"]["erp"]["lines"]), field["analysis/cycle/panels/top/erp"], rtol=1e-6)
            self.assertEqual(panel["measures"]["erp"]["dba"], field["analysis/cycle/panels/top"].attrs["erp_dba"])
            heard = next(one for one in data["sound"] if one["run"] == label["dry"])
            np.testing.assert_allclose(numbers(blocks, heard["power"]), field["analysis/cycle/sound/power"], rtol=1e-6)
            self.assertEqual((heard["dba"], heard["microphones"][0]["name"]), (field["analysis/cycle/sound"].attrs["power_dba"], "front"))
            contact = next(one for one in data["film"]["contacts"] if one["run"] == label["dry"])
            thrust = next(one for one in contact["pads"] if one["name"] == "thrust")
            self.assertEqual(set(thrust["maps"]), {"gap", "contact_pressure"})
            angle = numbers(blocks, contact["angle"])
            # The field at -360 deg is that of the end of the cycle before, of which the last one, at 360 deg, takes the place.
            order = 1 + np.argsort((run["film/crank_angle_deg"][1:] + 360.0) % 720.0 - 360.0, kind="stable")
            self.assertTrue((np.diff(angle) >= 0.0).all())
            # 16 bits over the range of the gap
            np.testing.assert_allclose(numbers(blocks, thrust["maps"]["gap"]), 1e6 * run["film/thrust/gap"][()][order], atol=2e-3)
        loudest = max(data["radiation"]["runs"], key=lambda one: one["panels"][1]["measures"]["erp"]["dba"])
        self.assertTrue(data["summary"]["sentences"][0].startswith(f"Loudest: {data['runs'][loudest['run']]['label']}"))
        self.assertIn("lines at 500", data["summary"]["sentences"][0])  # the peak of the power

    def test_the_first_screen_names_of_each_run_what_is_loudest_and_the_run_that_is_the_base(self):
        synthetic_page.write_folder(self.folder)
        data, _, _ = self.page()
        label = {one["stem"]: number for number, one in enumerate(data["runs"])}
        self.assertIsNone(data["summary"]["base"])  # no scene names another one
        own = next(one for one in data["summary"]["loudest"] if one["run"] == label["dry"])
        self.assertIn((own["run"], own["line"]), [(run["run"], run["loudest"]) for part in data["surface"]["parts"] for run in part["runs"]])
        with h5py.File(self.folder / "dry.field.h5") as field:
            at = field["analysis/cycle"]
            power = at["sound/power"][()]
            self.assertEqual(own["band"], at["third_octave/nominal"][int(np.argmax(at["sound/third_octave/power_dba"]))].decode())
            self.assertIn(own["line"], at["frequency_hz"][()][np.argsort(power)[-5:]])
            panels = {name: panel.attrs["erp_dba"] for name, panel in at["panels"].items() if name not in ("skin", "exposed")}
            self.assertEqual((own["part"], own["share"]), (max(panels, key=panels.get), None))
        with h5py.File(self.folder / "dry.field.h5", "r+") as field:
            quietest = min(panels, key=panels.get)
            for name in panels:
                field[f"analysis/cycle/panels/{name}"].attrs.update(sound_power_share=0.7 if name == quietest else -0.1, sound_power_dba=81.26)
            below_the_ear = field[f"analysis/cycle/panels/{max(panels, key=panels.get)}"].attrs  # it sends power, but takes it up A-weighted
            below_the_ear.update(sound_power_share=0.05, sound_power_dba=-999.0)
        with h5py.File(self.folder / "dry.run.h5", "r+") as run:
            run["inputs/path"], run["inputs/sha256"] = [b"dry.run.toml", b"wet.run.toml"], [b"0", b"0"]
        with h5py.File(self.folder / "wet.run.h5", "r+") as run:
            run["inputs/path"], run["inputs/sha256"] = [b"wet.run.toml"], [b"0"]
        data, _, _ = self.page()
        own = next(one for one in data["summary"]["loudest"] if one["run"] == label["dry"])
        self.assertEqual((own["part"], own["share"]), (quietest, 0.7))
        self.assertEqual(data["summary"]["base"], label["wet"])
        table = next(one for one in data["summary"]["tables"] if one["title"].startswith("Sound power that leaves through each panel"))
        self.assertEqual([row[0].rpartition(", ")[2] for row in table["rows"]][0], quietest.replace("_", " "))
        self.assertEqual([row[-2:] for row in table["rows"]], [["81.3", "70.0"], ["takes up", "5.0"]] + (len(panels) - 2) * [["takes up", "-10.0"]])
        printed = clatter("report", self.folder.name, folder=self.folder.parent)
        self.assertRegex(printed.stdout, r"dry, \S+ +\d\.\d+ +[\d.]+ +81\.3 +70\.0")

    def test_two_folders_are_one_page_with_the_change_of_their_levels(self):
        for name, louder in (("old", 0.0), ("new", 2.5)):
            (self.folder / name).mkdir()
            synthetic_page.write_folder(self.folder / name)
            with h5py.File(self.folder / name / "dry.field.h5", "r+") as field:
                level = field["analysis/cycle/sound"].attrs["power_dba"]
                field["analysis/cycle/sound"].attrs["power_dba"] = level + louder
        done = self.clatter("old", "new", "--html", "-o", "both.html")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "both.html").read_text(encoding="utf-8")
        self.assertIn(f"<td>dry</td><td>{level:.1f}</td><td>{level + 2.5:.1f}</td><td>+2.5</td>", text)
        self.assertIn("<td>+0.0</td>", text)  # of the wet run
        self.assertIn("<title>old beside new</title>", text)
        self.assertEqual(text.count("<iframe "), 2)
        for arguments in (("old", "new"), ("old", "new", "old", "--html")):
            done = self.clatter(*arguments)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)
            self.assertIn("expected one, or two with --html", done.stderr)

    def test_the_command_says_where_the_page_is_and_refuses_in_one_line(self):
        synthetic.write_run(self.folder / "slap.run.h5")
        done = self.clatter("--html")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"^report.html: \d+\.\d MB\n$")
        (self.folder / "report.html").unlink()
        (self.folder / "file").write_text("")
        for arguments, code, expected in ((("nowhere", "--html"), 2, "no artefacts"), (("-o", "a.html"), 2, "expected it with --html only"),
                                          (("--html", "-o", "file/a.html"), 4, "file/a.html: cannot be written")):
            done = self.clatter(*arguments)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (code, 1), done.stderr)
            self.assertIn(expected, done.stderr)
        self.assertFalse(list(self.folder.glob("*.html*")))


class Surface(Folder):
    def part(self):
        data, blocks, _ = self.page()
        return data["surface"]["parts"][0], data, blocks

    def check_lines(self, part, blocks, run, path):
        """Shapes times amounts are the velocities that the field file has in full."""
        own = rows(blocks, part["shapes"])
        corners, _ = synthetic_page.corners()
        hz = numbers(blocks, run["frequency"])
        amounts = rows(blocks, run["lines"][0]) + 1j * rows(blocks, run["lines"][1])
        with h5py.File(path) as field:
            for number, wanted in enumerate(field["lines/frequency_hz"]):
                line = int(np.argmin(np.abs(hz - wanted)))
                expected = (field[f"lines/velocity_re/{number:05d}"][()] + 1j * field[f"lines/velocity_im/{number:05d}"][()])[corners].ravel()
                # 16 bits of each amount and each shape, of which some cancel
                self.assertLess(np.linalg.norm(amounts[line] @ own - expected) / np.linalg.norm(expected), 2e-3)
                self.assertLess(numbers(blocks, run["line_error"])[line], 1e-2)

    def test_lines_of_a_reduced_model_are_those_of_its_field_file(self):
        synthetic_page.write_folder(self.folder)
        part, data, blocks = self.part()
        self.assertEqual((part["name"], part["shapes"]["count"], len(part["runs"])), ("block", 9, 3))  # 6 rigid, 3 elastic
        for run in part["runs"]:
            self.check_lines(part, blocks, run, self.folder / f"{data['runs'][run['run']]['stem']}.field.h5")
        np.testing.assert_allclose(part["modes"]["hz"], [200.0, 400.0, 800.0], rtol=1e-9)

    def test_instants_are_those_of_the_run(self):
        synthetic_page.write_folder(self.folder)
        part, _, blocks = self.part()
        corners, _ = synthetic_page.corners()
        nodes, _ = synthetic.box_skin()
        run = part["runs"][0]
        amounts, angle = rows(blocks, run["instants"]), numbers(blocks, run["angle"])
        self.assertEqual(len(angle), 720)
        with h5py.File(self.folder / "dry.run.h5") as file:
            expected = file["bodies/block/v"][137] @ synthetic_page.shapes(nodes).reshape(len(nodes), 3, -1)[corners].reshape(3 * len(corners), -1).T
        self.assertAlmostEqual(angle[137], -223.0, delta=1e-3)
        self.assertLess(np.linalg.norm(amounts[137] @ rows(blocks, part["shapes"]) - expected) / np.linalg.norm(expected), 2e-3)

    def test_a_field_without_its_model_shows_what_it_has_in_full(self):
        synthetic_page.write_folder(self.folder)
        (self.folder / "block.rom.h5").unlink()
        data, blocks, _ = self.page()
        self.assertEqual([len(part["runs"]) for part in data["surface"]["parts"]], [1, 1, 1])
        for part in data["surface"]["parts"]:
            run = part["runs"][0]
            self.assertEqual(run["instants"]["count"], 3)
            self.check_lines(part, blocks, run, self.folder / f"{data['runs'][run['run']]['stem']}.field.h5")

    def test_a_model_that_has_changed_is_not_used(self):
        synthetic_page.write_folder(self.folder)
        with h5py.File(self.folder / "block.rom.h5", "a") as file:
            file["skin/T"][...] *= 2.0
        data, blocks, _ = self.page()
        self.assertEqual([(part["name"], len(part["runs"])) for part in data["surface"]["parts"]],
                         [("block, dry", 1), ("block, fast", 1), ("block, wet", 1), ("block", 0)])
        self.check_lines(data["surface"]["parts"][0], blocks, data["surface"]["parts"][0]["runs"][0], self.folder / "dry.field.h5")
        self.assertIn("dry.field.h5 was made of another block.rom.h5", data["summary"]["stale"])

    def test_a_model_beside_the_folder_is_found(self):
        (self.folder / "sweep").mkdir()
        synthetic_page.write_folder(self.folder)
        for path in self.folder.glob("*.[rf]*.h5"):
            if not path.name.startswith("block"):
                path.rename(self.folder / "sweep" / path.name)
        self.folder = self.folder / "sweep"
        part, _, _ = self.part()
        self.assertEqual((part["name"], len(part["runs"])), ("block", 3))

    def test_mode_of_an_operating_shape_is_found_by_its_mac(self):
        synthetic_page.write_rom(self.folder / "block.rom.h5")
        synthetic_page.write_run(self.folder / "wet.run.h5", "wet")
        synthetic_page.write_field(self.folder / "wet.field.h5", "block.rom.h5")
        only = np.zeros((synthetic_page.SAMPLES + 1, 6))
        only[:, 4] = np.cos(2.0 * np.pi * synthetic_page.STRONG[1] * np.arange(len(only)) / synthetic_page.SAMPLES)
        with h5py.File(self.folder / "wet.run.h5", "a") as file:
            file["bodies/block/v"][...] = only + 1e-9
        part, _, _ = self.part()
        values = part["runs"][0]["mac"]["values"][1]
        self.assertEqual(int(np.argmax(values)), 1)
        self.assertAlmostEqual(values[1], 1.0, delta=1e-6)

    def test_the_outline_of_a_box_has_its_twelve_edges(self):
        lengths = (0.4, 0.2, 0.25)
        nodes, faces = synthetic.box_skin(lengths)
        ends = nodes[skin.sharp_edges(nodes, faces)].reshape(-1, 2, 3)
        self.assertAlmostEqual(np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum(), 4.0 * sum(lengths), delta=1e-9)

    def test_mid_side_nodes_lie_between_the_corners_that_move_them(self):
        nodes, faces = synthetic.box_skin()
        pack = Pack()
        found, corners = skin.geometry(pack, "b", nodes, faces, skin.smooth_normals(nodes, faces))
        texts = pack.texts()
        points = numbers(texts, found["points"]) * found["step"] + found["low"]
        ends = numbers(texts, found["ends"]).astype(int)
        self.assertLess(np.abs(points[:len(corners)] - nodes[corners]).max(), found["step"])
        self.assertLess(np.abs(points[len(corners):] - points[ends].mean(axis=1)).max(), 2.0 * found["step"])
        self.assertEqual(found["triangles"]["shape"], [4 * len(faces), 3])


class Parts(unittest.TestCase):
    def test_arrays_survive_packing(self):
        rng = np.random.default_rng(1)
        pack, given = Pack(), []
        for kind, values in (("<f4", rng.normal(size=(7, 3))), ("<i2", rng.integers(-32768, 32767, 11)), ("<u1", np.arange(5)), ("<u4", np.array([], int)),
                             ("<u2", np.array([0, 65535]))):
            given.append((pack.add("one", values, kind), np.asarray(values).astype(kind)))
        level = rng.normal(size=1000)
        given.append((pack.scaled("two", level, 8), level))
        texts = pack.texts()
        for reference, values in given[:-1]:
            np.testing.assert_array_equal(numbers(texts, reference), values)
        self.assertLess(np.abs(numbers(texts, given[-1][0]) - level).max(), 0.51 * np.ptp(level) / 255.0)

    def test_json_ends_no_script_and_has_no_number_that_is_none(self):
        self.assertEqual(json_text({"a": "</script>", "b": float("nan"), "c": np.float32(0.5), "d": np.arange(2)}), '{"a":"\\u003c/script>","b":null,"c":0.5,"d":[0,1]}')

    def test_few_shapes_hold_motion_of_few_dimensions_and_say_what_they_miss(self):
        rng = np.random.default_rng(2)
        points = rng.normal(size=(50, 3))
        expansion = rng.normal(size=(150, 12))
        lines = (rng.normal(size=(40, 3)) + 1j * rng.normal(size=(40, 3))) @ rng.normal(size=(3, 12))
        basis = shapes.Basis(points, expansion, [lines])
        self.assertEqual(len(basis.shapes), 6 + 3)
        amounts, error = basis.amounts(lines)
        self.assertLess(np.abs(amounts @ basis.shapes - lines @ expansion.T).max(), 1e-9)
        self.assertLess(error.max(), 1e-6)  # a square root of rounding
        other = rng.normal(size=(1, 12))
        amounts, error = basis.amounts(other)
        elastic = other @ expansion.T - amounts[:, :6] @ basis.shapes[:6]
        missed = np.linalg.norm(other @ expansion.T - amounts @ basis.shapes) / np.linalg.norm(elastic)
        self.assertAlmostEqual(error[0], missed, delta=1e-9)
        self.assertGreater(missed, 0.1)

    def test_certificates_that_are_bad_are_said_to_be(self):
        limits = {"energy_residue": (0.01, 0.5), "periodicity_block": (0.1, np.inf), "oil_residue": (0.01, np.inf), "verified_mac": (0.9, -np.inf)}
        for found, state in (({}, "bad"), ({"certified": 1.0, "count_proved": 1.0}, "good"), ({"certified": 1.0, "count_proved": 0.0}, "bad"),
                             ({"certified": 0.0, "count_proved": 1.0}, "bad")):
            self.assertEqual(certificates.worst(certificates.model_sentences(found, {})), state)
        for found, state, expected in (({"energy_residue": 0.6}, "bad", "closes to 6.0e-01"), ({"complete": 0.0}, "bad", "not complete"),
                                       ({"energy_residue": 0.2}, "note", "closes to 2.0e-01"), ({"energy_residue": 0.002}, "good", "closes to 2.0e-03"),
                                       ({"complete": 1.0, "oil_residue": 0.2}, "note", "oil_residue is 0.2, good up to 0.01"),
                                       ({"periodicity_block": 0.5}, "note", "block 50 %"), ({"periodicity_block": 0.01}, "good", "block 1 %"),
                                       ({"periodicity_lateral_c2": 3e-6}, "good", "piston c2 repeats its lateral position from cycle to cycle to 3 µm")):
            sentences = certificates.run_sentences(found, {name: limits[name] for name in found if name in limits})
            self.assertEqual(certificates.worst(sentences), state)
            self.assertIn(expected, " ".join(text for _, text in sentences))


class Models(Folder):
    def test_the_matrix_of_mac_has_full_modes_in_rows(self):
        synthetic_page.write_folder(self.folder)
        data, blocks, _ = self.page()
        (model,) = data["models"]
        self.assertEqual((model["mac"]["rows"], model["mac"]["columns"]), ([200.0, 400.0], [200.01, 400.1]))
        np.testing.assert_allclose(numbers(blocks, model["mac"]["values"]), [[0.999999, 0.02], [0.03, 0.9999]], rtol=1e-6)
        (self.folder / "block.mac.csv").unlink()
        self.assertIsNone(self.page()[0]["models"][0]["mac"])

    def test_a_file_that_is_no_such_matrix_is_refused(self):
        synthetic_page.write_folder(self.folder)
        for text in ("", "full_hz,1\n2,x\n", "full_hz,1,2\n2,0.5\n", "full_hz,1\n2,1.5\n"):
            (self.folder / "block.mac.csv").write_text(text)
            done = self.clatter("--html", ".")
            self.assertEqual((done.returncode, done.stderr), (2, "clatter: error: block.mac.csv: found no matrix of numbers from 0 to 1 under a row of "
                                                              "frequencies, expected that of clatter-modal compare --mac\n"))


class Speeds(Folder):
    def test_orders_are_collected_where_speeds_differ(self):
        for rpm, amplitude in ((1500.0, 2.0), (3000.0, 9.0), (4500.0, 5.0)):
            synthetic_drive.write_drive(self.folder / f"at_{rpm:.0f}.run.h5", rpm=rpm, amplitude=amplitude)
        synthetic_drive.write_drive(self.folder / "again.run.h5", rpm=3000.0, amplitude=9.0)
        data, blocks, _ = self.page()
        cam = next(one for one in data["speeds"] if one["name"] == "speed, cam")
        self.assertEqual([round(one["rpm"]) for one in cam["spectra"]], [1500, 3000, 4500])
        for one, amplitude in zip(cam["spectra"], (2.0, 9.0, 5.0)):
            self.assertAlmostEqual(numbers(blocks, one["rms"])[3], amplitude / np.sqrt(2.0), delta=1e-3 * amplitude)


    def test_sound_power_and_erp_are_among_the_signals_over_speed(self):
        synthetic_page.write_rom(self.folder / "block.rom.h5")
        for rpm, loudness in ((2000.0, 1.0), (3000.0, 2.0)):
            synthetic_page.write_field(self.folder / f"{rpm:.0f}.field.h5", "block.rom.h5", loudness, rpm)
        data, blocks, _ = self.page()
        for name, share in (("sound power", 0.25), ("ERP, exposed", 1.0)):
            signal = next(one for one in data["speeds"] if one["name"] == name)
            self.assertEqual((signal["unit"], signal["axis"]), ("W^0.5", "level [dB re 1 pW]"))
            for one, rpm, loudness in zip(signal["spectra"], (2000.0, 3000.0), (1.0, 2.0)):
                self.assertEqual(one["rpm"], rpm)
                hz = 0.5 * np.arange(synthetic_page.LINES) * rpm / 60.0
                power = share * 0.5 * loudness**2 * 1e-9 / (1.0 + ((hz - 500.0) / 20.0) ** 2)
                np.testing.assert_allclose(numbers(blocks, one["rms"]) ** 2, power, rtol=1e-5)
        self.assertEqual([round(one["rpm"]) for one in data["sound"]], [2000, 3000])


class Many(Folder):
    def test_of_many_runs_three_drives_are_animated_and_names_are_in_the_order_of_numbers(self):
        for rpm in (800, 1000, 1500, 2000, 2500, 3000, 3500, 4000, 12000):
            synthetic_drive.write_drive(self.folder / f"{rpm}.run.h5", rpm=float(rpm), shapes=30)
        data, _, _ = self.page()
        self.assertEqual([one["stem"] for one in data["runs"]][:3] + [data["runs"][-1]["stem"]], ["800", "1000", "1500", "12000"])
        self.assertTrue(data["many"])
        self.assertEqual({data["runs"][one["run"]]["stem"] for one in data["drive"]["chains"]} - {"800", "12000"} - {"1000"}, set())
        self.assertEqual(data["drive"]["left_out"] + len(data["drive"]["chains"]), 9)
        self.assertTrue(all("joints carry" not in sentence for sentence in data["summary"]["sentences"]))


class Spectrogram(Folder):
    def test_a_tone_is_in_its_row_at_its_time_with_its_level(self):
        synthetic_page.write_rom(self.folder / "block.rom.h5")
        synthetic_page.write_field(self.folder / "wet.field.h5", "block.rom.h5")
        with h5py.File(self.folder / "wet.field.h5", "a") as file:
            time = file["analysis/cycle/time"][()]
            burst = 5.0 * np.sin(2.0 * np.pi * 750.0 * time) * (np.abs(time - 10e-3) < 4e-3)
            file["analysis/cycle/sensors/sensor_liner/acceleration"][:, 1] = burst
        data, blocks, _ = self.page()
        channel = next(one for one in data["sensors"]["runs"][0]["channels"] if one["label"] == "sensor_liner.y")
        found = channel["spectrogram"]
        levels = numbers(blocks, found["levels"])
        column, row = np.unravel_index(np.argmax(levels), levels.shape)
        self.assertAlmostEqual(row * found["frequency_step"], 750.0, delta=found["frequency_step"])
        self.assertLess(abs((column / found["columns"] - 0.5) * 60.0 - 10.0), 4.0)
        self.assertAlmostEqual(levels.max(), 20.0 * np.log10(5.0 / np.sqrt(2.0) / 1e-6), delta=0.3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
