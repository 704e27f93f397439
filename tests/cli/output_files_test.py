# SPDX-License-Identifier: GPL-3.0-or-later
"""Outputs never overwrite inputs, and an output that cannot be written is an error before any work
(hard cases N18, N11)."""
import os
import shutil
import subprocess
import unittest

import stages

# Every program with its inputs given by options or position, and the options that name an output.
COMMANDS = {
    "mesh": (["beam.mesh.toml"], ["-o", "--write-step", "--export", "--recipe", "--depfile"]),
    "assembly": (["beam.mesh.h5", "-c", "beam.fe.toml"], ["-o", "--depfile"]),
    "modal": (["beam.fe.h5", "-c", "beam.modes.toml"], ["-o", "--depfile"]),
    "condense": (["beam.fe.h5", "-c", "beam.rom.toml"], ["-o", "--depfile"]),
    "dynamics": (["step.run.toml"], ["-o", "--depfile"]),
    "recover": (["step.run.h5", "-c", "step.field.toml"], ["-o", "--depfile"]),
}


class OutputTest(stages.PipelineTest):
    def listing(self):
        """All files and link targets, with the properties that must not change."""
        return {str(path.relative_to(self.folder)): os.readlink(path) if path.is_symlink() else stages.fingerprint(path)
                for path in self.folder.rglob("*") if path.is_symlink() or path.is_file()}

    def refuse(self, stage, arguments, says, code=2):
        """The stage ends with `code` and one line that says all of `says`; no file is changed, made or lost."""
        before = self.listing()
        done = stages.run_stage(stage, *arguments, "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, code, f"clatter-{stage} {arguments}: {done.stderr}")
        lines = done.stderr.strip().splitlines()
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertTrue(lines[0].startswith(f"clatter-{stage}: error: "), lines[0])
        for text in says:
            self.assertIn(text, lines[0])
        self.assertEqual(self.listing(), before)
        self.show_refusal(lines[0])

    def with_output(self, stage, option, name, inputs=None):
        """A command line of the stage whose `option` names this file; -o is given in any case."""
        rest = [] if option == "-o" else ["-o", "fresh.h5"]
        return [*(inputs or COMMANDS[stage][0]), *rest, option, name]


class HardN18OutputEqualsInput(OutputTest):
    def spellings(self, name):
        """Names of one file: itself, other spellings, links of both kinds, by way of a linked folder."""
        for link in ("link", "twin"):
            (self.folder / link).unlink(missing_ok=True)
        (self.folder / "link").symlink_to(name)
        os.link(self.folder / name, self.folder / "twin")
        if not (self.folder / "here").exists():
            (self.folder / "here").symlink_to(".")
        return [f"./{name}", name, f"here/../{self.folder.name}/{name}", str(self.folder / name), "link", "twin",
                f"here/{name}"]

    def test_every_output_of_every_program_against_every_input(self):
        for stage, (command, outputs) in COMMANDS.items():
            for name in (word for word in command if not word.startswith("-")):
                for option in outputs:
                    for spelling in self.spellings(name)[:None if option == "-o" else 1]:
                        with self.subTest(stage=stage, input=name, option=option, spelling=spelling):
                            self.refuse(stage, self.with_output(stage, option, spelling),
                                        [f" {spelling} would overwrite the input {name}"])

    def test_the_part_file_of_an_output_is_an_output(self):
        for stage, (command, _) in COMMANDS.items():
            (self.folder / "x.h5.part").write_bytes((self.folder / command[0]).read_bytes())
            with self.subTest(stage=stage):
                self.refuse(stage, ["x.h5.part", *command[1:], "-o", "x.h5"], ["x.h5.part", "would overwrite"])

    def test_two_outputs_that_are_one_file(self):
        for stage in COMMANDS:
            with self.subTest(stage=stage):
                self.refuse(stage, self.with_output(stage, "--depfile", "./fresh.h5"), ["are the same file", "--depfile"])
        self.refuse("mesh", ["beam.mesh.toml", "-o", "a.h5", "--export", "b.vtu", "--export", "./b.vtu"], ["are the same file"])

    def test_the_reduced_part_of_add_rows_and_of_exports(self):
        self.refuse("condense", ["add-rows", "beam.fe.h5", "--of", "beam.rom.h5", "--set", "sensor_tip", "-o", "beam.rom.h5"],
                    ["would overwrite the input beam.rom.h5"])
        for output, written in (("a.mtx", "a.K.mtx"), ("a.mtx", "a.dofs.tsv"), ("a.inp", "a.M.txt"), ("a.fem", "a.fem")):
            os.link(self.folder / "beam.rom.h5", self.folder / written)
            with self.subTest(written=written):
                self.refuse("condense", ["export", "beam.rom.h5", output], [f"{written} would overwrite the input"])
            (self.folder / written).unlink()

    def test_files_that_a_run_leaves_beside_its_output(self):
        for name in ("x.run.h5.checkpoint", "x.run.failed.h5", "x.run.interrupted.h5", "x.run.refused.h5"):
            os.link(self.folder / "step.run.toml", self.folder / name)
            with self.subTest(name=name):
                self.refuse("dynamics", ["step.run.toml", "-o", "x.run.h5"], [f"{name} would overwrite the input"])
            (self.folder / name).unlink()
        shutil.copy(self.folder / "step.run.toml", self.folder / "scene.h5")
        self.refuse("dynamics", ["scene.h5"], ["would overwrite the input scene.h5"])
        for name in ("x.field.xdmf", "x.field.lines.xdmf"):
            os.link(self.folder / "step.run.h5", self.folder / name)
            with self.subTest(name=name):
                self.refuse("recover", ["step.run.h5", "-o", "x.field.h5"], [f"{name} would overwrite the input"])
            (self.folder / name).unlink()


class HardN18InputsNamedInFiles(OutputTest):
    """Inputs named in a TOML file, a deck or a run are checked once that is read, before any work."""

    def refuse_named(self, stage, inputs, output, named_in, option="--depfile"):
        self.refuse(stage, self.with_output(stage, option, f"./{output}", inputs), ["would overwrite the input", output, named_in])

    def test_geometry_and_decks(self):
        done = stages.run_stage("mesh", "beam.mesh.toml", "-o", "b.mesh.h5", "--write-step", "b.step", "--export", "b.inp",
                                "--export", "b.bdf", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        (self.folder / "cad.toml").write_text('name = "b"\nkind = "cad"\n[cad]\nsource = "b.step"\n[mesh]\nelement_size_mm = 15\n')
        (self.folder / "deck.toml").write_text('name = "b"\nkind = "deck"\n[deck]\nsource = "b.inp"\nunits = "m-kg-s"\n')
        for option in ("--write-step", "-o"):  # --export knows no such extension
            self.refuse_named("mesh", ["cad.toml"], "b.step", "cad.toml:4: source", option)
        for option in ("--export", "-o", "--recipe"):
            self.refuse_named("mesh", ["deck.toml"], "b.inp", "deck.toml:4: source", option)
        (self.folder / "top.inp").write_text("*INCLUDE, INPUT=b.inp\n")
        (self.folder / "top.bdf").write_text("INCLUDE 'b.bdf'\n")
        for top, part in (("top.inp", "b.inp"), ("top.bdf", "b.bdf")):
            self.refuse_named("mesh", [top, "--units", "m-kg-s"], part, "command line", "--export")

    def test_matrices_of_other_programs(self):
        stages.run_stage("condense", "export", "beam.rom.h5", "b.mtx", folder=self.folder)
        (self.folder / "m.toml").write_text('[matrices]\nK = "b.K.mtx"\nM = "b.M.mtx"\ndofs = "b.dofs.tsv"\n')
        for line, name, key in ((2, "b.K.mtx", "K"), (3, "b.M.mtx", "M"), (4, "b.dofs.tsv", "dofs")):
            self.refuse_named("assembly", ["-c", "m.toml"], name, f"m.toml:{line}: {key}", "-o")

    def test_models_tables_and_bases_of_a_scene(self):
        self.edit("step.run.toml", "value = 100.0", 'table = "force.csv"')
        (self.folder / "force.csv").write_text("time [s], force [N]\n0, 1\n1, 1\n")
        (self.folder / "over.run.toml").write_text('base = "step.run.toml"\n')
        for name, named_in in (("beam.rom.h5", "rom"), ("force.csv", "table"), ("step.run.toml", "command line")):
            for option in ("-o", "--depfile"):
                with self.subTest(name=name, option=option):
                    self.refuse_named("dynamics", ["over.run.toml"], name, named_in, option)

    def test_the_reduced_model_that_a_run_names(self):
        for option in ("-o", "--depfile"):
            self.refuse_named("recover", ["step.run.h5"], "beam.rom.h5", "step.run.h5: bodies/beam: rom", option)


class HardN11OutputPlaces(OutputTest):
    """The input does not exist in any of these: the error names the output, so it is checked before any reading."""

    def refuse_place(self, name, says):
        for stage, (command, outputs) in COMMANDS.items():
            for option in outputs:
                with self.subTest(stage=stage, option=option, name=name):
                    self.refuse(stage, self.with_output(stage, option, name, ["absent.file", *command[1:]]),
                                [f"{name}: cannot be written", *says], code=4)

    def test_a_missing_folder(self):
        self.refuse_place("nowhere/out.vtu", ["nowhere: No such file or directory"])

    def test_a_file_instead_of_a_folder(self):
        self.refuse_place("beam.fe.toml/out.vtu", ["beam.fe.toml"])

    def test_a_folder_instead_of_the_file(self):
        (self.folder / "deep.vtu").mkdir()
        self.refuse_place("deep.vtu", ["is a folder"])

    def test_a_device(self):
        self.refuse_place("/dev/null", ["device"])

    def test_a_folder_without_permission(self):
        folder = self.folder / "locked"
        folder.mkdir()
        if os.geteuid() == 0:  # root may write everywhere but on a file system that is read-only
            mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "ro,size=1m", "tmpfs", folder], capture_output=True)
            if mounted.returncode != 0:
                self.skipTest("root, and no read-only file system can be mounted here")
            self.addCleanup(subprocess.run, ["umount", folder], check=True)
        else:
            folder.chmod(0o555)
        self.refuse_place("locked/out.vtu", ["Read-only file system" if os.geteuid() == 0 else "Permission denied"])

    @unittest.skipIf(os.geteuid() == 0, "root may overwrite every file")
    def test_a_file_that_may_not_be_overwritten(self):
        (self.folder / "kept.vtu").write_text("kept")
        (self.folder / "kept.vtu").chmod(0o444)
        self.refuse_place("kept.vtu", ["Permission denied"])

    def test_files_beside_the_output(self):
        for stage, output, beside in (("dynamics", "x.run.h5", "x.run.h5.checkpoint"), ("recover", "x.field.h5", "x.field.xdmf")):
            (self.folder / beside).mkdir()
            with self.subTest(stage=stage):
                self.refuse(stage, self.with_output(stage, "-o", output, ["absent.file"]), [beside, "is a folder"], code=4)
        (self.folder / "x.K.mtx").mkdir()
        self.refuse("condense", ["export", "absent.file", "x.mtx"], ["x.K.mtx", "is a folder"], code=4)

    def test_an_export_of_unknown_kind(self):
        self.refuse("condense", ["export", "absent.file", "x.foo"], ["x.foo", ".mtx"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
