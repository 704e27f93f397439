# SPDX-License-Identifier: GPL-3.0-or-later
"""Sessions in which the programs of the pipeline run: languages, limits of memory and of time, file systems without locks (hard cases H3, P13, P14, P15)."""
import json
import os
import pathlib
import resource
import shutil
import subprocess
import tempfile
import unittest

import h5py
import hard_pipeline
import stages
from observed import expect_at_least, expect_at_most, observed

BUILD = pathlib.Path(os.environ.get("CLATTER_BUILD", stages.SOURCE / "build/release"))
# Command lines of the six stages, for outputs of other names than the finished ones.
COMMANDS = {"mesh": ["beam.mesh.toml"], "assembly": ["beam.mesh.h5", "-c", "beam.fe.toml"], "modal": ["beam.fe.h5", "-c", "beam.modes.toml"],
            "condense": ["beam.fe.h5", "-c", "beam.rom.toml"], "dynamics": ["cycles.run.toml"],
            "recover": ["step.run.h5", "-c", "step.field.toml"]}
EQUAL = {"mesh": "beam.mesh.h5", "assembly": "beam.fe.h5", "modal": "beam.modes.h5", "condense": "beam.rom.h5", "dynamics": "cycles.run.h5",
         "recover": "step.field.h5"}


def setUpModule():
    hard_pipeline.make_master()


class HardP13DecimalComma(hard_pipeline.HardPipeline):
    """In German 1.5 is written 1,5. A library may take the language of the session for its own, and so may an application that uses
    ours: the shim does so in every process."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        locales = tempfile.mkdtemp(prefix="clatter-locale-")
        cls.addClassCleanup(shutil.rmtree, locales)
        subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", f"{locales}/de_DE.UTF-8"], check=True, capture_output=True)
        cls.language = {**os.environ, "LOCPATH": locales, "LC_ALL": "de_DE.UTF-8"}
        cls.shim = {**cls.language, "LD_PRELOAD": str(BUILD / "tests/pipeline/libspeaks_german.so"), "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":verify_asan_link_order=0"}

    def test_the_language_of_these_tests_has_a_decimal_comma(self):
        shown = subprocess.run(["/usr/bin/printf", "%.1f", "1,5"], env=self.language, capture_output=True, text=True)
        self.assertEqual(shown.stdout, "1,5")
        point = "import locale; print(locale.localeconv()['decimal_point'])"  # of a program that does not ask for a language
        shown = subprocess.run(["/usr/bin/python3", "-c", point], env=self.shim, capture_output=True, text=True)
        self.assertEqual((shown.stdout, shown.stderr), (",\n", ""))

    def run_in(self, environment, stage, *arguments):
        done = stages.run_stage(stage, *arguments, folder=self.folder, env=environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_all_stages_give_the_same_bits_and_json(self):
        equal = 0
        for environment in (self.language, self.shim):
            for stage, arguments in COMMANDS.items():
                with self.subTest(stage=stage):
                    output = self.folder / f"{stage}.h5"
                    said = json.loads(self.run_in(environment, stage, *arguments, "-o", output.name, "--json", "--quiet").stdout)
                    self.assertEqual(said["output"], output.name)
                    equal += self.assert_same_numbers(output, self.folder / EQUAL[stage])
        self.assertEqual((self.folder / "recover.xdmf").read_text().replace("recover.h5", "step.field.h5"),
                         (self.folder / "step.field.xdmf").read_text())
        expect_at_least(self, "datasets equal to the bit", equal, 200)

    def test_files_of_other_programs_have_points(self):
        texts = ["b.inp", "b.bdf", "b.unv", "b.vtu", "b.msh", "b.step"]
        export = [word for name in texts[:-1] for word in ("--export", name)]
        for environment in (os.environ, self.language, self.shim):
            self.run_in(environment, "mesh", "beam.mesh.toml", "-o", "b.mesh.h5", "--write-step", "b.step", *export)
            self.run_in(environment, "condense", "export", "beam.rom.h5", "r.mtx", "r.inp", "r.pch", "r.fem")
            found = {path.name: path.read_text(errors="replace") for path in self.folder.iterdir()
                     if path.name in texts or path.name.startswith("r.")}
            found["b.step"] = "".join(line for line in found["b.step"].splitlines() if "FILE_NAME" not in line)
            if environment is os.environ:
                expected = found
            self.assertEqual(found.keys(), expected.keys())
            for name, text in expected.items():
                self.assertTrue(found[name] == text, f"{name} differs")
        observed(f"the same text: {', '.join(sorted(expected))}")

    def test_files_of_other_programs_are_read_with_points(self):
        self.run_in(os.environ, "mesh", "beam.mesh.toml", "-o", "b.mesh.h5", "--write-step", "b.step", "--export", "b.inp", "--export", "b.bdf",
                    "--export", "b.msh")
        deck = (self.folder / "b.inp").read_text()
        self.assertIn(", .03\n", deck)
        (self.folder / "b.inp").write_text(deck.replace(", .03\n", ", 3.D-2\n"))  # as Fortran programs write
        for name, unit in (("b.inp", ["--units", "m-kg-s"]), ("b.bdf", ["--units", "m-kg-s"]), ("b.msh", ["--units", "m-kg-s"]), ("b.step", [])):
            with self.subTest(file=name):
                self.run_in(os.environ, "mesh", name, *unit, "-o", "point.mesh.h5", "--quiet")
                for environment in (self.language, self.shim):
                    self.run_in(environment, "mesh", name, *unit, "-o", "comma.mesh.h5", "--quiet")
                    self.assert_same_numbers(self.folder / "comma.mesh.h5", self.folder / "point.mesh.h5")
        observed("decks, Gmsh's files and STEP are read as with points")


@unittest.skipIf("CLATTER_SANITIZE:BOOL=ON" in (BUILD / "CMakeCache.txt").read_text(),
                 "the address sanitizer needs terabytes of address space, ulimit -v forbids them")
class HardP14AddressSpace(hard_pipeline.HardPipeline):
    def test_every_limit_gives_the_result_or_one_line_and_no_stage_waits_for_memory(self):
        ended = {}
        for stage, arguments in COMMANDS.items():
            for mib in (100, 140, 200, 240, 280, 340, 400, 600):
                with self.subTest(stage=stage, mib=mib):
                    done = stages.run_stage(stage, *arguments, "-o", "short.h5", "--quiet", folder=self.folder,
                                            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (mib << 20, mib << 20)))
                    ended[done.returncode] = ended.get(done.returncode, 0) + 1
                    if done.returncode:
                        self.assertIn(done.returncode, (3, 4, 127), done.stderr)  # 127: the loader could not map a library
                        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
                        self.assertEqual(list(self.folder.glob("short.h5*")), [])
                    else:  # with another number of threads of BLAS sums may round differently
                        found, expected = (hard_pipeline.numbers(self.folder / name) for name in ("short.h5", EQUAL[stage]))
                        self.assertEqual(sorted(found), sorted(expected))
                        for path in self.folder.glob("short.*"):
                            path.unlink()
                        break
            else:
                self.fail(f"{stage} has no result with {mib} MiB")
        observed("exit codes " + ", ".join(f"{code}: {count} times" for code, count in sorted(ended.items())))
        expect_at_most(self, "runs that ended by a signal", sum(count for code, count in ended.items() if code < 0), 0)
        self.assertGreater(ended.get(3, 0), 0)


class HardP15ProcessorTime(hard_pipeline.HardPipeline):
    def test_a_run_whose_time_is_up_keeps_its_results(self):
        scene = self.folder / "step.run.toml"
        scene.write_text(scene.read_text().replace("end_s = 0.06", "end_s = 600.0").replace("output_step_us = 50.0", "output_step_us = 5000.0"))
        done = stages.run_stage("dynamics", scene.name, "-o", "one.run.h5", "--quiet", folder=self.folder,
                                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (1, 20)))
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("one.run.interrupted.h5", done.stderr)
        with h5py.File(self.folder / "one.run.interrupted.h5") as run:
            self.assertEqual(run.attrs["complete"], 0)
            expect_at_least(self, "samples that are kept", len(run["output/time"]), 1)
        self.assertEqual(list(self.folder.glob("*.part")), [])


class HardH3FileSystemWithoutLocks(hard_pipeline.HardPipeline):
    def test_all_stages_read_and_write_there(self):
        environment = {**os.environ, "LD_PRELOAD": str(BUILD / "tests/pipeline/libno_locks.so"), "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":verify_asan_link_order=0"}
        equal = 0
        for stage, arguments in COMMANDS.items():
            with self.subTest(stage=stage):
                done = stages.run_stage(stage, *arguments, "-o", f"{stage}.h5", "--quiet", folder=self.folder, env=environment)
                self.assertEqual(done.returncode, 0, done.stderr)
                equal += self.assert_same_numbers(self.folder / f"{stage}.h5", self.folder / EQUAL[stage])
        expect_at_least(self, "datasets equal to the bit", equal, 100)


if __name__ == "__main__":
    unittest.main(verbosity=2)
