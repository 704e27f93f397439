# SPDX-License-Identifier: GPL-3.0-or-later
"""Output streams of each program: results on stdout, progress and warnings on stderr, one line of JSON instead."""
import json
import unittest

import stages

RESULT = {"mesh": "degrees of freedom", "assembly": "mass ", "modal": " Hz  residual", "condense": "basis holds modes",
          "dynamics": "steps: ", "recover": "ERP"}
UNITS = [("rho = 7850.0", "rho = 7.85e-9", "density 7.85e-09 kg/m3: did you mean 7850 (7.85e-09 t/mm3)?"),
         ("E_gpa = 210.0", "E = 210000.0", "Young's modulus 210000 Pa: did you mean 2.1e+11 (210000 MPa)?"),
         ("E_gpa = 210.0", "E_gpa = 210000.0", "Young's modulus 2.1e+14 Pa: did you mean 2.1e+11 (MPa, not GPa)?")]


class Output(stages.PipelineTest):
    def run_stage(self, stage, *more):
        done = stages.run_stage(stage, *self.command(stage), *more, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_results_are_on_stdout_and_stay_there_when_quiet(self):
        for stage, text in RESULT.items():
            with self.subTest(stage):
                done = self.run_stage(stage)
                self.assertIn(text, done.stdout)
                self.assertNotIn(text, done.stderr)
                self.assertIn("peak ", done.stderr)  # a step's seconds and memory
                self.assertNotIn("peak 0.", done.stdout)
                quiet = self.run_stage(stage, "--quiet")
                self.assertIn(text, quiet.stdout)
                self.assertEqual([line for line in quiet.stderr.splitlines() if not line.startswith("warning: ")], [])

    def test_json_is_one_line_on_stdout_and_the_rest_stays_readable(self):
        for stage, text in RESULT.items():
            with self.subTest(stage):
                done = self.run_stage(stage, "--json")
                self.assertEqual(len(done.stdout.splitlines()), 1)
                self.assertIsInstance(json.loads(done.stdout), dict)
                self.assertIn(text, done.stderr)

    # (stage, arguments after --json, members of "error" in addition to program and message, words of the message)
    ERRORS = [("mesh", ["none.mesh.toml", "-o", "x.mesh.h5"], {"file": "none.mesh.toml", "exit_code": 2}, "no such file"),
              ("assembly", ["beam.mesh.h5", "-c", "wrong.fe.toml", "-o", "x.fe.h5"],
               {"file": "wrong.fe.toml", "line": 9, "place": "material.steel.rhoo", "exit_code": 2}, "did you mean rho?"),
              ("modal", ["beam.mesh.h5", "-o", "x.modes.h5"], {"file": "beam.mesh.h5", "place": "schema", "exit_code": 2},
               "found clatter/mesh/"),
              ("condense", ["beam.fe.h5", "--nonsense"], {"exit_code": 2}, "(see clatter-condense --help)"),
              ("dynamics", ["step.run.toml", "-o", "none/x.run.h5"], {"file": "none/x.run.h5", "exit_code": 4},
               "cannot be written"),
              ("recover", ["a \"b\".run.h5", "-o", "x.field.h5"], {"file": "a \"b\".run.h5", "exit_code": 2},
               "no such file")]

    def test_an_error_is_json_too_and_says_the_same_as_the_plain_line(self):
        right = (self.folder / "beam.fe.toml").read_text().splitlines()
        after = next(i for i, line in enumerate(right) if line.startswith("rho")) + 1
        (self.folder / "wrong.fe.toml").write_text("\n".join(right[:after] + ["rhoo = 1.0"] + right[after:]))
        for stage, arguments, members, words in self.ERRORS:
            with self.subTest(stage):
                done = stages.run_stage(stage, *arguments, "--json", "--quiet", folder=self.folder)
                error = json.loads(done.stdout)["error"]
                self.assertEqual(done.stderr, f"{error['program']}: error: {error['message']}\n")
                self.assertIn(words, error.pop("message"))
                self.assertEqual(error, {"program": f"clatter-{stage}", **members})
                self.assertEqual(done.returncode, members["exit_code"])
                plain = stages.run_stage(stage, *arguments, "--quiet", folder=self.folder)
                self.assertEqual((plain.stdout, plain.stderr), ("", done.stderr))

    def test_implausible_units_give_one_warning_and_no_error(self):
        for old, new, expected in UNITS:
            with self.subTest(new):
                self.setUp()
                self.edit("beam.fe.toml", old, new)
                done = self.run_stage("assembly")
                self.assertEqual([line for line in done.stderr.splitlines() if line.startswith("warning: ")],
                                 [f"warning: beam.fe.toml: {expected}"])
        self.assertNotIn("did you mean", stages.run_stage("assembly", *self.command("assembly"),
                                                          folder=self.master).stderr)

    def test_a_box_of_metres_and_a_frequency_of_megahertz_give_a_warning(self):
        self.edit("beam.mesh.toml", 'length_unit = "mm"', 'length_unit = "m"')
        self.edit("beam.mesh.toml", "element_size_mm = 15.0", "element_size_mm = 15000.0")
        done = self.run_stage("mesh")
        self.assertIn("m long: did you mean", done.stderr)
        self.assertEqual(done.stderr.count("did you mean"), 1)
        self.setUp()
        self.edit("beam.fe.toml", "rho = 7850.0", "rho = 7.85e-9")  # frequencies a million times too high
        self.run_stage("assembly")
        self.assertIn("one system of units", self.run_stage("modal").stderr)


class Commands(stages.PipelineTest):
    """`clatter-modal statics ...`: what a program does besides its usual job."""
    COMMANDS = {"mesh": ["faces", "export", "keys"], "assembly": ["keys"], "modal": ["statics", "shape", "compare", "export", "keys"],
                "condense": ["export", "add-rows", "predict", "keys"],
                "recover": ["sound", "listen", "keys"], "dynamics": ["response"]}
    # Options that became commands: (stage, arguments, words of the error).
    OLD = [("mesh", ["--faces", "beam.step"], "--faces is now a command: clatter-mesh faces PART"),
           ("modal", ["beam.fe.h5", "--static", "-o", "x.static.h5"], "--static is now a command: clatter-modal statics MODEL"),
           ("modal", ["--compare", "beam.fe.h5", "beam.rom.h5"], "--compare is now a command: clatter-modal compare FULL REDUCED"),
           ("condense", ["beam.rom.h5", "--export", "x.mtx"], "--export is now a command: clatter-condense export REDUCED FILE"),
           ("condense", ["beam.fe.h5", "--add-rows", "beam.rom.h5", "--set", "sensor_tip", "-o", "x.rom.h5"],
            "--add-rows is now a command: clatter-condense add-rows MODEL --of REDUCED"),
           ("dynamics", ["--write-motored-cycle", "x.csv"], "--write-motored-cycle is now a command: clatter motored-cycle")]

    def test_each_has_a_help_of_its_own_that_the_program_lists(self):
        for stage in stages.STAGES:
            program = stages.run_stage(stage, "--help", folder=self.folder).stdout
            self.assertEqual("Commands (each has --help):" in program, stage in self.COMMANDS)
            for name in self.COMMANDS.get(stage, []):
                with self.subTest(stage=stage, command=name):
                    self.assertRegex(program, rf"\n  {name} ")
                    own = stages.run_stage(stage, name, "--help", folder=self.folder)
                    self.assertEqual(own.returncode, 0, own.stderr)
                    self.assertIn(f"Usage: clatter-{stage} {name} ", own.stdout)
                    for text in ("--threads", "--quiet", "--json", "--depfile", f"clatter-{stage} {name} "):
                        self.assertIn(text, own.stdout)

    def test_an_option_that_is_a_command_now_is_named(self):
        for stage, arguments, says in self.OLD:
            with self.subTest(stage=stage, arguments=arguments):
                self.assert_refused(stage, arguments, says=[says])

    def test_a_command_refuses_the_options_of_the_others(self):
        self.assert_refused("modal", ["statics", "beam.fe.h5", "--count", "3", "-o", "x.static.h5"],
                            says=["--count", "clatter-modal statics --help"])
        self.assert_refused("condense", ["add-rows", "beam.fe.h5", "--set", "sensor_tip", "-o", "x.rom.h5"],
                            says=["--of is required", "clatter-condense add-rows --help"])

    def test_a_file_may_have_the_name_of_a_command(self):
        for name in ("compare", "statics"):
            (self.folder / name).write_bytes((self.folder / "beam.fe.h5").read_bytes())
        self.assertEqual(stages.run_stage("modal", "./compare", "--count", 8, "-o", "export", folder=self.folder).returncode, 0)
        done = stages.run_stage("modal", "statics", "statics", "-o", "x.static.h5", "--depfile", "x.d", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "x.d").read_text(), "x.static.h5: statics\nstatics:\n")

    def test_exports_name_the_files_and_what_they_were_made_from(self):
        for stage, source, files in (("mesh", "beam.mesh.h5", ["a.vtu", "a.med"]), ("modal", "beam.modes.h5", ["b.vtu"]),
                                     ("condense", "beam.rom.h5", ["c.pch", "c.fem"])):
            with self.subTest(stage=stage):
                done = stages.run_stage(stage, "export", source, *files, "--json", "--depfile", "e.d", folder=self.folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(json.loads(done.stdout), {"files": files})
                self.assertEqual((self.folder / "e.d").read_text(), f"{files[0]}: {source}\n{source}:\n")


if __name__ == "__main__":
    unittest.main(verbosity=2)
