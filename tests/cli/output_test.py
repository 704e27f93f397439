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
               {"file": "wrong.fe.toml", "line": 8, "place": "material.steel.rhoo", "exit_code": 2}, "did you mean rho?"),
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


if __name__ == "__main__":
    unittest.main(verbosity=2)
