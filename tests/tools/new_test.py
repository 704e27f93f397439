# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter new: folders of samples, of a CAD file and of a deck, which make brings to a certified reduced model."""
import fnmatch
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402
from clatter_command import clatter  # noqa: E402
from clatter_tools.new import cad_faces, command, part  # noqa: E402

TUBE = """name = "tube"
kind = "cylinder"
[cylinder]
radius = 53.5
inner_radius = 46.5
length = 100
[mesh]
element_size_mm = 20
"""

BAR = """*NODE
1, 0, 0, 0
2, 10, 0, 0
3, 10, 10, 0
4, 0, 10, 0
5, 0, 0, 100
6, 10, 0, 100
7, 10, 10, 100
8, 0, 10, 100
9, 0, 0, 50
10, 10, 0, 50
11, 10, 10, 50
12, 0, 10, 50
*NSET, NSET=FOOT
1, 2, 3, 4
*ELEMENT, TYPE=C3D8, ELSET=BAR
1, 1, 2, 3, 4, 9, 10, 11, 12
2, 9, 10, 11, 12, 5, 6, 7, 8
*MATERIAL, NAME=STEEL
*ELASTIC
210000, 0.3
*DENSITY
7.85E-9
*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL
"""
HELD = "*BOUNDARY\nFOOT, 1, 3\n"


class Folder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="clatter-new-")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def new(self, *arguments):
        done = clatter("new", *arguments, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def make(self, name, *targets):
        """Runs make as in an installation, where clatter is in PATH."""
        path = f"{stages.SOURCE / 'tools'}{os.pathsep}{os.environ['PATH']}"
        done = subprocess.run(["make", f"CLATTER_BIN={stages.BIN}", "CLATTER_FLAGS=--quiet", *targets], cwd=self.folder / name, text=True,
                              capture_output=True, env={**os.environ, "MAKEFLAGS": "", "PATH": path})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def certificate(self, path):
        with h5py.File(self.folder / path) as file:
            return dict(file["certificate"].attrs)


class Samples(Folder):
    def test_each_kind_is_its_sample_with_the_rules_of_this_installation(self):
        for kind, (sample, patterns) in command.SAMPLES.items():
            with self.subTest(kind=kind):
                start = [line for line in self.new(kind, "--kind", kind).splitlines() if line.startswith("start with ")]
                self.assertEqual(len(start), 1)
                for pattern in re.findall(r"[\w.*]+\.toml", start[0]):
                    self.assertTrue(list((self.folder / kind).glob(pattern)), pattern)
                tracked = subprocess.run(["git", "ls-files", f"samples/{sample}"], cwd=stages.SOURCE, capture_output=True, text=True)
                if tracked.returncode == 0:
                    names = {name.rpartition("/")[2] for name in tracked.stdout.split()}
                    self.assertEqual({path.name for path in (self.folder / kind).iterdir()},
                                     {name for name in names if any(fnmatch.fnmatch(name, one) for one in patterns)} | {"Makefile"})
                self.assertIn("\ninclude $(shell clatter rules)\n", (self.folder / kind / "Makefile").read_text())
                for path in (self.folder / kind).iterdir():
                    self.assertNotIn("../..", path.read_text(), path)

    def test_slap_has_what_its_makefile_uses_and_nothing_else(self):
        stages.require_stages()
        self.new("slap", "--kind", "slap")
        planned = self.make("slap", "-n", "all", "check")
        for path in (self.folder / "slap").iterdir():
            # The scene names its table; the field.toml is of all scenes.
            used = "motored.csv" in (self.folder / "slap/slap.run.toml").read_text() if path.name == "motored.csv" else path.name in planned
            self.assertTrue(used or path.name == "Makefile", path.name)
        for name in ("slap.field.h5", "slap_dry.field.h5", "liner_4.shape.h5", "liner_4_bolted.shape.h5", "skirt.shape.h5", "block.compare.txt"):
            self.assertIn(name, planned)
        self.assertLess(len(list((self.folder / "slap").iterdir())), 20)

    def test_the_beam_is_an_exact_copy_where_its_makefile_finds_the_rules(self):
        stages.require_stages()
        self.new("bar")
        self.assertIn("Timoshenko", self.make("bar"))
        shutil.copytree(stages.SOURCE / "samples/beam", self.folder / "plain", ignore=shutil.ignore_patterns("*.h5", "*.d", "study"))
        self.assertIn("beam.mesh.h5", self.make("plain", "-n"))  # the sample itself can be copied too

    def test_a_wrong_request_is_refused_in_one_line_and_leaves_nothing(self):
        (self.folder / "there").mkdir()
        (self.folder / "x.step").write_text("ISO-10303-21;\n")
        (self.folder / "x.inp").write_text("*NODE\n1, 0, 0, 0\n")
        before = sorted(self.folder.iterdir())
        for arguments, expected in ((("there",), "exists; give a name"),
                                    (("no/folder",), "no: no such folder"),
                                    (("n", "--part", "none.step"), "none.step: no such file"),
                                    (("n", "--part", "x.step", "--kind", "slap"), "--part needs --kind part"),
                                    (("n", "--units", "mm-t-s"), "--units needs --part"),
                                    (("n", "--part", "x.inp"), "x.inp: give --units"),
                                    (("n", "--part", "x.step", "--units", "mm-t-s"), "is CAD, which names its unit"),
                                    (("n", "--part", "x.step"), "x.step"),
                                    (("n", "--part", "x.inp", "--units", "furlongs"), "furlongs")):
            with self.subTest(arguments=arguments):
                done = clatter("new", *arguments, folder=self.folder)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertTrue(done.stderr.startswith("clatter: error: "), done.stderr)
                self.assertIn(expected, done.stderr)
                self.assertEqual(sorted(self.folder.iterdir()), before)


class Cad(Folder):
    def test_bores_planes_and_size_are_found_and_make_ends_with_a_certificate(self):
        stages.require_stages()
        (self.folder / "tube.mesh.toml").write_text(TUBE)
        done = stages.run_stage("mesh", "tube.mesh.toml", "-o", "tube.mesh.h5", "--write-step", "my tube.step", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        said = self.new("t", "--part", "my tube.step")
        self.assertRegex(said, r"bore_1 +radius 46.5 mm, length 100 mm")
        self.assertIn("written in mm, 107 x 107 x 100 mm", said)
        text = (self.folder / "t/my_tube.mesh.toml").read_text()
        self.assertIn('source = "../my tube.step"', text)
        self.assertIn("element_size_mm = 4.0 ", text)  # as clatter-mesh for CAD alone: LongDefaultSize
        self.assertEqual(re.findall(r"^\[surface\.(\w+)\]", text, re.M), ["bore_1", "plane_1", "plane_2"])
        # The names that a CAD program gave to faces are those of surfaces.
        step = (self.folder / "my tube.step").read_text().replace("ADVANCED_FACE('", "ADVANCED_FACE('Flange top", 1)
        (self.folder / "named.step").write_text(step)
        self.assertIn("a face of this name in the file", self.new("n", "--part", "named.step"))
        text_of_named = (self.folder / "n/named.mesh.toml").read_text()
        self.assertIn('\nnamed = "Flange top"\n', text_of_named)
        self.assertIn("[surface.Flange_top]", text_of_named)
        done = stages.run_stage("mesh", "n/named.mesh.toml", "-o", "named.mesh.h5", "--element-size-mm", "20", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        (self.folder / "t/my_tube.mesh.toml").write_text(text.replace("element_size_mm = 4.0", "element_size_mm = 20"))
        self.make("t")
        found = self.certificate("t/my_tube.rom.h5")
        self.assertEqual((found["certified"], found["rigid_modes"], found["count_proved"]), (1, 6, 1))
        with h5py.File(self.folder / "t/hit.field.h5") as field:
            self.assertGreater(field["analysis/hit/panels/exposed"].attrs["erp_dba"], 0)


class Deck(Folder):
    def test_a_free_deck_and_a_held_one_end_with_a_certificate(self):
        stages.require_stages()
        for name, text, rigid in (("free", BAR, 6), ("held", BAR + HELD, 0)):
            with self.subTest(deck=name):
                (self.folder / f"{name}.inp").write_text(text)
                said = self.new(f"{name}-folder", "--part", f"{name}.inp", "--units", "mm-t-s")
                self.assertIn("STEEL; no supports: the part is free" if rigid else "STEEL; 1 supports", said)
                self.make(f"{name}-folder")
                found = self.certificate(f"{name}-folder/{name}.rom.h5")
                self.assertEqual((found["certified"], found["rigid_modes"]), (1, rigid))


class Faces(unittest.TestCase):
    def face(self, low, high, area, radius=10.0, concave=True, place=(0, 0, 0)):
        return {"kind": "cylinder", "concave": concave, "radius": radius, "direction": [0, 0, 1], "place": list(place), "area": area,
                "box": [list(low), list(high)], "number": 1}

    def test_halves_of_a_bore_are_one_and_fillets_are_none(self):
        half = np.pi * 10 * 20
        halves = [self.face((-10, 0, 0), (10, 10, 20), half), self.face((-10, -10, 0), (10, 0, 20), half)]
        fillet = self.face((30, 30, 0), (40, 40, 20), half / 2, place=(30, 30, 0))
        pin = self.face((50, 50, 0), (70, 70, 20), 2 * half, concave=False, place=(60, 60, 0))
        second = self.face((-10, -10, 100), (10, 10, 110), half)  # on the same axis, further on: a bore of its own
        found = cad_faces.bores([*halves, fillet, pin, second])
        self.assertEqual([(round(area), round(long)) for area, _, _, long in found], [(round(2 * half), 20), (round(half), 10)])

    def test_the_three_sensors_are_not_in_line(self):
        nodes = np.random.default_rng(7).uniform(size=(50, 3)) * [1.0, 1e-3, 1e-3]
        a, b, c = part.corners(nodes)
        self.assertGreater(np.linalg.norm(np.cross(b - a, c - a)), 1e-4)


if __name__ == "__main__":
    unittest.main(verbosity=2)
