# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter.pipeline: the programs run from Python, with their results and their refusals."""
import os
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import clatter  # noqa: E402
import stages  # noqa: E402
from clatter import pipeline  # noqa: E402


class Programs(stages.PipelineTest):
    def test_a_stage_returns_its_results(self):
        found = pipeline.run("modal", "beam.rom.h5", folder=self.folder, output="reduced.modes.h5", count=3)
        with clatter.open(self.folder / "reduced.modes.h5") as modes:
            self.assertEqual(found["frequency_hz"], list(modes.frequency_hz))
            self.assertEqual(modes.inputs, [("beam.rom.h5", "unchanged")])
            self.assertGreater(modes.seconds, 0.0)
        found = pipeline.run("condense", "beam.fe.h5", folder=self.folder, config="beam.rom.toml", output="plain.rom.h5",
                             no_certificate=True)
        self.assertEqual(found["certified"], 0)
        with clatter.open(self.folder / "plain.rom.h5") as rom:
            self.assertIn("fmax_hz = 4000", rom.configuration)
            self.assertEqual(rom.certificate["certified"], 0.0)

    def test_what_a_program_refuses_is_an_exception_with_its_line(self):
        self.edit("beam.fe.toml", "rho = 7850.0", "rhoo = 7850.0")
        with self.assertRaisesRegex(clatter.Refused, r"^beam.fe.toml:\d+: material.steel.rhoo: unknown key, did you mean rho\?$"):
            pipeline.run("assembly", "beam.mesh.h5", folder=self.folder, config="beam.fe.toml", output="beam.fe.h5")
        with self.assertRaises(clatter.CannotWrite):
            pipeline.run("modal", "beam.rom.h5", folder=self.folder, output="gone/x.modes.h5")

    def test_the_exception_goes_by_the_exit_code(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "clatter-modal"
            path.write_text('#!/bin/sh\necho "clatter-modal: error: $CODE reasons" >&2\nexit $CODE\n')
            path.chmod(0o755)
            for code, expected in ((2, clatter.Refused), (3, clatter.Failed), (4, clatter.CannotWrite)):
                self.addCleanup(os.environ.update, {"CLATTER_BIN": os.environ.get("CLATTER_BIN", str(stages.BIN))})
                os.environ.update(CLATTER_BIN=folder, CODE=str(code))
                with self.assertRaisesRegex(expected, f"^{code} reasons$"):
                    pipeline.run("modal")

    def test_a_sweep_runs_all_combinations_and_repeats_nothing(self):
        # A Makefile whose rules make the reduced model; that of the sample includes the rules of the source tree.
        (self.folder / "Makefile").write_text(f"include {stages.SOURCE / 'tools/clatter.mk'}\nstep.run.h5: beam.rom.h5\n")
        (self.folder / "short.field.toml").write_text('body = "beam"\ncycle = false\n[[window]]\nname = "all"\nfrom_s = 0\nto_s = 2e-3\n')
        values = {"time.end_s": [0.002, 0.004]}
        found = pipeline.sweep("step.run.toml", values, folder=self.folder, field="short.field.toml")
        self.assertEqual(sorted(found), ["0.002", "0.004"])
        ends = []
        for path in found.values():
            with clatter.open(path) as run:
                ends.append(run.time[-1])
            self.assertTrue(path.with_name(path.name.replace(".run.", ".field.")).exists())
        self.assertEqual([round(end, 6) for end in ends], [0.002, 0.004])
        before = [path.stat().st_mtime_ns for path in found.values()]
        again = pipeline.sweep("step.run.toml", values, folder=self.folder, field="short.field.toml")
        self.assertEqual(before, [path.stat().st_mtime_ns for path in again.values()])

    def test_a_scene_of_a_sweep_that_is_refused_is_named(self):
        with self.assertRaisesRegex(clatter.Refused, r"step_sweep/1e9.run.toml:\d+: time.output_step_us: found 1e\+09"):
            pipeline.sweep("step.run.toml", {"time.output_step_us": "1e9"}, folder=self.folder)
        with self.assertRaisesRegex(clatter.Refused, r"time.emd_s: unknown key emd_s, did you mean end_s\?"):
            pipeline.sweep("step.run.toml", {"time.emd_s": 1}, folder=self.folder)
        with self.assertRaisesRegex(clatter.Refused, "gone.run.toml: no such file"):
            pipeline.sweep("gone.run.toml", {"time.end_s": 1}, folder=self.folder)
        with self.assertRaisesRegex(clatter.Refused, "no Makefile; write one"):
            pipeline.make("beam.rom.h5", folder=self.folder)

    def test_make_brings_a_folder_up_to_date(self):
        shutil.copytree(stages.SOURCE / "tools", self.folder / "a/tools", symlinks=True, ignore=shutil.ignore_patterns("__pycache__"))
        sample = self.folder / "a/samples/beam"
        shutil.copytree(stages.SOURCE / "samples/beam", sample, ignore=shutil.ignore_patterns("*.h5", "*.d", "study"))
        self.edit("a/samples/beam/beam.mesh.toml", "element_size_mm = 15.0", "element_size_mm = 40.0")
        pipeline.make("beam.fe.h5", folder=sample)
        with clatter.open(sample / "beam.fe.h5") as full:
            self.assertGreater(full.K.shape[0], 0)
        self.edit("a/samples/beam/beam.fe.toml", 'surface = "x_min"', 'surface = "left"')
        with self.assertRaisesRegex(clatter.Refused, "^beam.fe.toml.*left"):
            pipeline.make("beam.fe.h5", folder=sample)


if __name__ == "__main__":
    unittest.main(verbosity=2)
