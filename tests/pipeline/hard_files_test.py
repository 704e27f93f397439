# SPDX-License-Identifier: GPL-3.0-or-later
"""Damaged, foreign and odd files anywhere in the pipeline: refused in one line or read rightly (hard cases P1, P4, P6, P7, P9, P10)."""
import os
import random
import shutil
import subprocess
import unittest

import h5py
import hard_pipeline
import numpy as np
import stages
from observed import expect_at_least, observed


def setUpModule():
    hard_pipeline.make_master()


class HardP1CutArtefacts(hard_pipeline.HardPipeline):
    """Cuts and changed bytes: the reader refuses the file, or what was hit is not read and the result is the same."""
    READERS = {"beam.mesh.h5": ("assembly", ["beam.mesh.h5", "-c", "beam.fe.toml"]),
               "beam.fe.h5": ("modal", ["beam.fe.h5", "--count", "1"]),
               "piston.rom.h5": ("condense", ["export", "piston.rom.h5"]),
               "beam.rom.h5": ("dynamics", ["step.run.toml"]),
               "step.run.h5": ("recover", ["step.run.h5", "-c", "step.field.toml"])}

    def run_reader(self, stage, arguments):
        output = self.folder / ("out.inp" if arguments[0] == "export" else "out.h5")
        output.unlink(missing_ok=True)
        done = stages.run_stage(stage, *arguments, *([] if arguments[0] == "export" else ["-o"]), output.name, "--quiet", folder=self.folder)
        if done.returncode:
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertFalse(output.exists())
        return done.returncode, output

    def damages(self, good, draw):
        """Cut files and files with a changed byte: half of the bytes in the first 4 KiB, where the structure is."""
        cuts = [0, 1, len(good) - 1, *(draw.randrange(len(good)) for _ in range(7))]
        for cut in cuts:
            yield f"cut at {cut}", good[:cut], True
        for turn in range(10):
            at = draw.randrange(min(4096, len(good)) if turn % 2 else len(good))
            changed = bytearray(good)
            changed[at] ^= draw.randrange(1, 256)
            yield f"byte {at}", bytes(changed), False

    def test_every_reader_refuses_them_or_gives_the_same_result(self):
        draw, refused, tried = random.Random(11), 0, 0
        for name, (stage, arguments) in self.READERS.items():
            path = self.folder / name
            good = path.read_bytes()
            _, output = self.run_reader(stage, arguments)
            read = hard_pipeline.numbers if output.suffix == ".h5" else lambda path: {"text": path.read_bytes()}
            expected = read(output)
            for what, data, cut in self.damages(good, draw):
                with self.subTest(file=name, damage=what):
                    path.write_bytes(data)
                    code, output = self.run_reader(stage, arguments)
                    tried += 1
                    refused += code == 2
                    if cut:
                        self.assertEqual(code, 2)
                    elif code == 0:
                        found = read(output)
                        self.assertEqual(sorted(found), sorted(expected))
                        for key, value in expected.items():
                            np.testing.assert_array_equal(found[key], value, err_msg=key)
            path.write_bytes(good)
        expect_at_least(self, "damaged artefacts that were refused, of the share that must be", refused / tried, 0.5)


class HardP4CutToml(hard_pipeline.HardPipeline):
    COMMANDS = {"mesh": ["beam.mesh.toml"], "assembly": ["beam.mesh.h5", "-c", "beam.fe.toml"],
                "modal": ["beam.fe.h5", "-c", "beam.modes.toml"], "condense": ["beam.fe.h5", "-c", "beam.rom.toml"],
                "dynamics": ["cycles.run.toml"], "recover": ["step.run.h5", "-c", "step.field.toml"]}

    def test_every_file_that_is_cut_is_refused_with_its_line_or_is_valid(self):
        draw, refused, valid = random.Random(12), 0, 0
        for stage, arguments in self.COMMANDS.items():
            path = self.folder / arguments[-1]
            good = path.read_bytes()
            for cut in sorted(draw.sample(range(len(good)), 14)):
                with self.subTest(stage=stage, cut=cut):
                    path.write_bytes(good[:cut])
                    done = stages.run_stage(stage, *arguments, "-o", "cut.h5", "--quiet", folder=self.folder)
                    if done.returncode == 0:
                        valid += 1  # the end of a line, and what is left is complete
                        continue
                    refused += 1
                    errors = [line for line in done.stderr.splitlines() if "error: " in line]
                    self.assertEqual((done.returncode, len(errors)), (2, 1), done.stderr)
                    self.assertIn(path.name, errors[0])
                    self.assertFalse((self.folder / "cut.h5").exists() and not valid)
            path.write_bytes(good)
        observed(f"{refused} of {refused + valid} cut TOML files refused with file and key, the others are complete without what was cut")
        self.assertGreater(refused, 40)


class HardP6Names(hard_pipeline.HardPipeline):
    NAMES = ("it's a (b) & $HOME folder", 'quo"te <b>&amp;', "Kurbelgehäuse №1", "-leading", "semi;colon#hash%25")

    def test_folders_of_any_name_go_through_make(self):
        for name in self.NAMES:
            with self.subTest(name=name):
                folder = self.folder / name
                folder.mkdir()
                for file in ("beam.mesh.toml", "beam.fe.toml", "Makefile"):
                    shutil.copy(self.folder / file, folder)
                stages.make(folder, "beam.fe.h5")
                self.assertIn("up to date", stages.make(folder, "beam.fe.h5"))
                self.assert_same_numbers(folder / "beam.fe.h5", self.folder / "beam.fe.h5")
        observed(f"made in folders named {', '.join(self.NAMES)}")

    def test_programs_in_a_folder_with_blanks_and_quotes(self):
        programs = self.folder / "it's my bin"
        programs.symlink_to(stages.BIN)
        (self.folder / "beam.fe.h5").unlink()
        stages.make(self.folder, f"CLATTER_BIN={programs}", "beam.fe.h5")  # the later of the two counts
        self.assertIn("up to date", stages.make(self.folder, f"CLATTER_BIN={programs}", "beam.fe.h5"))

    def test_make_words_of_a_dependency_file_are_quoted(self):
        odd = "a b#c$d%e.mesh.toml"
        shutil.copy(self.folder / "beam.mesh.toml", self.folder / odd)
        done = stages.run_stage("mesh", odd, "-o", "x y.mesh.h5", "--depfile", "x.d", "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        (self.folder / "names.mk").write_text("include x.d\nx\\ y.mesh.h5: ; @echo remade '$@' of '$<'\n")
        shown = subprocess.run(["make", "--no-print-directory", "-f", "names.mk", "-W", odd, "x y.mesh.h5"], cwd=self.folder, capture_output=True, text=True,
                               env={**os.environ, "MAKEFLAGS": ""})
        self.assertEqual(shown.stdout, f"remade x y.mesh.h5 of {odd}\n", shown.stderr)
        observed(f"make reads the dependency file of '{odd}'")

    def test_a_line_end_in_a_name_is_refused_where_make_cannot_write_it(self):
        shutil.copy(self.folder / "beam.mesh.toml", self.folder / "a\nb.toml")
        done = stages.run_stage("mesh", "a\nb.toml", "-o", "x.h5", "--depfile", "x.d", "--quiet", folder=self.folder)
        self.assertIn("no make rule can name", done.stderr)
        self.assertFalse((self.folder / "x.d").exists())

    def test_the_report_shows_names_as_text(self):
        name = '<img src=x onerror="alert(1)">&'
        shutil.copy(self.folder / "step.run.h5", self.folder / f"{name}.run.h5")
        done = subprocess.run([stages.SOURCE / "tools/clatter", "report", "--html", self.folder], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("<img src=x", (self.folder / "report.html").read_text().partition("<body")[2])


class HardP7Tables(hard_pipeline.HardPipeline):
    """The gas pressure of the scene as other programs write it."""

    def run_table(self, data, code=0):
        (self.folder / "gas.csv").write_bytes(data)
        if code:
            return self.refusal("dynamics", ["cycles.run.toml", "-o", "table.h5"], code)
        done = stages.run_stage("dynamics", "cycles.run.toml", "-o", "table.h5", "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.assert_same_numbers(self.folder / "table.h5", self.folder / "cycles.run.h5")

    def test_line_ends_and_a_byte_order_mark_change_nothing(self):
        good = hard_pipeline.FILES["gas.csv"]
        equal = self.run_table(b"\xef\xbb\xbf" + good.replace("\n", "\r\n").rstrip("\r\n").encode())
        expect_at_least(self, "datasets equal to the bit", equal, 5)

    def test_numbers_of_other_countries_and_not_numbers_are_refused_with_their_line(self):
        rows = hard_pipeline.FILES["gas.csv"].splitlines()
        self.assertTrue(rows[10].startswith("-270, "))
        for cell in ("-270, nan", "-270, inf", "-270, 1.234,5", "-270, 1 234", "-270, 2e400", "-270, 20 bar", "-270", "-270,5, 20", "-270, 0x14",
                     "-270, ²", "-270, 1'234"):
            with self.subTest(cell=cell):
                said = self.run_table("\n".join([*rows[:10], cell, *rows[11:]]).encode(), 2)
                self.assertIn("gas.csv:11", said)
        observed(f"refused: {said}")

    def test_utf_16_and_binary_files_are_refused(self):
        for data in (hard_pipeline.FILES["gas.csv"].encode("utf-16"), b"\0" * 100, b""):
            self.assertIn("gas.csv", self.run_table(data, 2))


class HardP9Folders(hard_pipeline.HardPipeline):
    def test_an_output_that_is_a_link_becomes_a_file_and_its_target_stays(self):
        target = self.folder / "other.h5"
        target.write_bytes(b"another file")
        link = self.folder / "linked.h5"
        link.symlink_to(target.name)
        done = stages.run_stage("assembly", "beam.mesh.h5", "-c", "beam.fe.toml", "-o", link.name, "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(target.read_bytes(), b"another file")
        self.assertFalse(link.is_symlink())
        expect_at_least(self, "datasets equal to the bit", self.assert_same_numbers(link, self.folder / "beam.fe.h5"), 5)

    def test_a_working_folder_that_was_removed(self):
        gone = self.folder / "gone"
        gone.mkdir()
        script = f'cd "{gone}" && rmdir "{gone}" && exec "$@"'
        model = self.folder / "beam.mesh.h5"
        config = self.folder / "beam.fe.toml"
        for output, code in (("x.h5", 4), (str(self.folder / "x.h5"), 0)):
            with self.subTest(output=output):
                done = subprocess.run(["/bin/sh", "-c", script, "sh", stages.BIN / "clatter-assembly", model, "-c", config, "-o", output, "--quiet"],
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertEqual(done.stderr.count("error: "), 1 if code else 0)
            gone.mkdir(exist_ok=True)


class HardP10OtherVersions(hard_pipeline.HardPipeline):
    def test_a_newer_schema_and_another_kind_are_refused_by_every_reader(self):
        for name, (stage, arguments) in HardP1CutArtefacts.READERS.items():
            for schema in ("clatter/mesh/99", "clatter/rom/1000000", "other/rom/1", ""):
                with self.subTest(file=name, schema=schema):
                    shutil.copy(hard_pipeline.master / name, self.folder / name)
                    with h5py.File(self.folder / name, "r+") as file:
                        file.attrs["schema"] = schema
                    output = ["out.inp"] if arguments[0] == "export" else ["-o", "out.h5"]
                    said = self.refusal(stage, [*arguments, *output])
                    self.assertIn("schema", said)
            shutil.copy(hard_pipeline.master / name, self.folder / name)
        observed(f"refused: {said}")

    def test_an_addition_of_a_later_version_is_read_over(self):
        with h5py.File(self.folder / "beam.fe.h5", "r+") as file:
            file["later/addition"] = np.arange(3.0)
            file.attrs["version"] = "99.0.0"
        done = stages.run_stage("modal", "beam.fe.h5", "-c", "beam.modes.toml", "-o", "x.h5", "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same_numbers(self.folder / "x.h5", self.folder / "beam.modes.h5")


if __name__ == "__main__":
    unittest.main(verbosity=2)
