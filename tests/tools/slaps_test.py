# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter sweep --parameters`, and what `clatter slaps` says about its runs."""
import csv
import pathlib
import tempfile
import tomllib
import unittest

import h5py

import synthetic
from clatter_command import clatter
from clatter.artefact import BadArtefact
from clatter_tools import collect, parameters, slaps

PARAMETERS = """
[[parameter]]
name = "pin offset"
unit = "mm"
base = 0
values = [-0.5, 0.5]
keys = { "engine.pin_offset_mm" = "{}", "piston.rom" = "../piston{}.rom.h5" }
field = "own{}.toml"
[[parameter]]
name = "lubrication"
values = ["none"]
base = "film"
keys = { "contact.lubrication" = "{}" }
"""
# Sound power [dB(A)] and amplitude of the slap [m/s2] of each scene.
RUNS = {"base": (80.0, 40.0), "pin-offset_-0.5": (77.0, 20.0), "pin-offset_0.5": (84.0, 60.0), "lubrication_none": (82.0, 50.0)}


class Study(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "slap.run.toml").write_text("")
        (self.folder / "parameters.toml").write_text(PARAMETERS)

    def run_command(self, *arguments, code=0):
        done = clatter(*arguments, folder=self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def sweep(self):
        return self.run_command("sweep", "slap.run.toml", "time.cycles=2", "--parameters", "parameters.toml", "-o", "all", "--field", "f.toml")

    def write_runs(self, with_sound=True):
        for name, (dba, amplitude) in RUNS.items():
            synthetic.write_run(self.folder / f"all/{name}.run.h5")
            path = self.folder / f"all/{name}.field.h5"
            synthetic.write_field(path, amplitude=amplitude)
            with h5py.File(path, "a") as field:
                at = field["analysis/cycle"]
                at.attrs["speed_rpm"] = 2000.0
                if with_sound:
                    at["sound/power"] = at["panels/exposed/erp"][()]
                of = at["sound"].attrs if with_sound else at["panels/exposed"].attrs
                of["power_db" if with_sound else "erp_db"], of["power_dba" if with_sound else "erp_dba"] = dba + 1.0, dba
                count = len(at["panels/exposed/erp"])
                at["order"] = [0.5 * k for k in range(1, count + 1)]
                for sensor in at["sensors"].values():
                    for part in ("re", "im"):
                        sensor[f"spectrum/acceleration_{part}"] = [[0.0] * len(sensor["labels"])] * count

    def test_scenes_are_the_base_and_each_value_with_all_keys_that_go_with_it(self):
        self.assertIn("all: 4 scenes", self.sweep().stdout)
        scenes = {path.name: tomllib.loads(path.read_text()) for path in (self.folder / "all").glob("*.run.toml")}
        self.assertEqual(sorted(scenes), sorted(f"{name}.run.toml" for name in RUNS))
        self.assertEqual(scenes["base.run.toml"], {"base": "../slap.run.toml", "title": "base", "time": {"cycles": 2}})
        self.assertEqual(scenes["pin-offset_-0.5.run.toml"]["piston"], {"rom": "../piston-0.5.rom.h5"})
        self.assertEqual(scenes["pin-offset_-0.5.run.toml"]["engine"], {"pin_offset_mm": -0.5})
        self.assertEqual(scenes["lubrication_none.run.toml"]["contact"], {"lubrication": "none"})
        rules = (self.folder / "all/sweep.mk").read_text()
        self.assertIn("all/pin-offset_0.5.field.h5: all/%.field.h5: all/%.run.h5 own0.5.toml $(clatter_recover)", rules)
        self.assertIn("all/base.field.h5 all/lubrication_none.field.h5: all/%.field.h5: all/%.run.h5 f.toml $(clatter_recover)", rules)

    def test_parameters_are_ranked_by_what_they_change_with_the_base_between_their_values(self):
        self.sweep()
        self.write_runs()
        self.run_command("collect", "all")
        done = self.run_command("slaps", "all/sweep.h5", "--parameters", "parameters.toml", "--picture", "p.png", "--csv", "p.csv")
        lines = done.stdout.splitlines()
        order = [line.split("  ")[0] for line in lines[2:7]]
        self.assertEqual(order, ["pin offset [mm] -0.5", "pin offset [mm] 0 (base)", "pin offset [mm] 0.5", "lubrication none",
                                 "lubrication film (base)"])
        self.assertEqual([line.split()[-1] for line in lines if line.startswith(("pin offset [mm]  ", "lubrication  "))], ["7.0", "2.0"])
        self.assertGreater((self.folder / "p.png").stat().st_size, 10_000)
        with open(self.folder / "p.csv", newline="") as stream:
            rows = {row["name"]: row for row in csv.DictReader(stream)}
        self.assertAlmostEqual(float(rows["pin-offset_0.5"]["liner peak [m/s2]"]) / float(rows["pin-offset_-0.5"]["liner peak [m/s2]"]), 3.0, delta=1e-3)
        self.assertEqual(float(rows["base"]["sound power [dB(A) re 1 pW]"]), 80.0)

    def test_without_parameters_the_quietest_run_is_first(self):
        self.sweep()
        self.write_runs()
        self.run_command("collect", "all")
        lines = self.run_command("slaps", "all/sweep.h5").stdout.splitlines()
        self.assertEqual([line.split("  ")[0] for line in lines[2:6]], ["pin offset -0.5 mm", "base", "lubrication none", "pin offset 0.5 mm"])
        self.assertIn("third octaves of the acceleration of the block over the cycle", "\n".join(lines))
        # 1.5 times the amplitude is 3.5 dB in all bands.
        rows = {row.name: row for row in slaps.rows_of(self.folder / "all/sweep.h5")}
        loud, base = (rows[name].bands["liner"] for name in ("pin-offset_0.5", "base"))
        self.assertAlmostEqual((loud - base).mean(), 3.52, delta=0.02)

    def test_without_a_sound_file_runs_are_ranked_by_their_erp(self):
        self.sweep()
        self.write_runs(with_sound=False)
        self.run_command("collect", "all", "-o", "erp.h5")
        lines = self.run_command("slaps", "erp.h5").stdout.splitlines()
        self.assertEqual([line.split("  ")[0] for line in lines[2:6]], ["pin offset -0.5 mm", "base", "lubrication none", "pin offset 0.5 mm"])
        self.assertIn("runs by ERP, the quietest first", lines[0])
        self.assertIn("ERP [dB(A) re 1 pW]", lines[1])
        self.assertEqual(lines[3].split()[1], "80.0")
        self.write_runs()
        self.run_command("collect", "all")
        self.assertIn("found some with sound power and some with ERP alone", self.run_command("slaps", "erp.h5", "all/sweep.h5", code=2).stderr)

    def test_wrong_parameters_are_refused(self):
        def refused(text, said):
            (self.folder / "wrong.toml").write_text(text)
            with self.assertRaisesRegex(BadArtefact, said):
                parameters.read(self.folder / "wrong.toml")

        refused("[[parameter]]\nname = 'a'\n", r"parameter\[0\].values: found nothing, expected a list")
        refused("[[parameter]]\nname = 'a'\nvalue = [1]\n", r"parameter\[0\].value: unknown key, did you mean values\?")
        refused("[[parameter]]\nname = 'a'\nvalues = [true]\nkeys = {a = '{}'}\n", r"values: found \[True\], expected 1 to 1000 numbers or texts")
        refused("[[parameter]]\nname = 'a'\nvalues = [1, 1]\nkeys = {a = '{}'}\n", "found two scenes a_1")
        refused("[[parameter]]\nname = 'a'\nvalues = [1]\nkeys = {a = 1}\n", r"keys: found \{.a.: 1\}, expected texts by name")
        refused("a = 1\n", r"wrong.toml: a: unknown key, did you mean parameter")
        self.assertIn("several values and --parameters exclude each other", self.run_command("sweep", "slap.run.toml", "a.b=1,2", "--parameters", "parameters.toml", code=2).stderr)
        self.assertIn("give key=values or --parameters", self.run_command("sweep", "slap.run.toml", code=2).stderr)
        self.sweep()
        collect.write(collect.Sweep(self.folder / "all"), self.folder / "empty.h5")
        self.assertIn("empty.h5: found no slap, expected fields with sensors of liner and block", self.run_command("slaps", "empty.h5", code=2).stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
