# SPDX-License-Identifier: GPL-3.0-or-later
"""Processes that are killed, run twice, starved or cut off from their streams, over the whole pipeline (hard cases P2, P3, P5, P8, P11, P12)."""
import fcntl
import os
import random
import resource
import signal
import subprocess
import threading
import time
import unittest

import h5py
import hard_pipeline
import stages
from observed import expect_at_least, expect_at_most, observed

# Command lines of the six stages, for outputs of other names than the finished ones.
COMMANDS = {"mesh": ["beam.mesh.toml"], "assembly": ["beam.mesh.h5", "-c", "beam.fe.toml"], "modal": ["beam.fe.h5", "-c", "beam.modes.toml"],
            "condense": ["beam.fe.h5", "-c", "beam.rom.toml"], "dynamics": ["cycles.run.toml"],
            "recover": ["step.run.h5", "-c", "step.field.toml"]}
EQUAL = {"mesh": "beam.mesh.h5", "assembly": "beam.fe.h5", "modal": "beam.modes.h5", "condense": "beam.rom.h5", "dynamics": "cycles.run.h5",
         "recover": "step.field.h5"}
MAKE = ["make", f"CLATTER_BIN={stages.BIN}", "CLATTER_FLAGS=--quiet"]
WITHOUT_MAKE = {**os.environ, "MAKEFLAGS": ""}


def text_of(value):
    """An attribute of text, which h5py gives as bytes where it has a fixed length."""
    return value.decode() if isinstance(value, bytes) else value


def setUpModule():
    hard_pipeline.make_master()


class HardP2Killed(hard_pipeline.HardPipeline):
    def test_make_that_is_killed_twenty_times_ends_with_the_same_bits(self):
        for name in hard_pipeline.ARTEFACTS:
            (self.folder / name).unlink()
        draw, killed = random.Random(13), 0
        begin = time.monotonic()
        for turn in range(20):
            process = subprocess.Popen([*MAKE, "-j2"], cwd=self.folder, env=WITHOUT_MAKE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                       start_new_session=True)
            try:  # a pause grows while nothing is finished, so that a slow machine gets on as well
                process.wait(timeout=draw.uniform(0.02, 0.25) * (1 + turn / 4))
            except subprocess.TimeoutExpired:
                killed += 1
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            process.wait()
        stages.make(self.folder)
        equal = sum(self.assert_same_numbers(self.folder / name, hard_pipeline.master / name) for name in hard_pipeline.ARTEFACTS)
        left = [path.name for path in self.folder.iterdir() if path.name.endswith((".part", ".checkpoint"))]
        self.assertEqual(left, [])
        observed(f"killed {killed} times in {time.monotonic() - begin:.0f} s, then finished: {equal} datasets equal to the bit, no file left over")
        self.assertGreater(killed, 5)

    def test_a_run_that_is_killed_between_checkpoints_is_resumed_to_the_same_bits(self):
        output = self.folder / "again.run.h5"
        draw, resumed = random.Random(14), 0
        for _ in range(8):
            process = subprocess.Popen([stages.BIN / "clatter-dynamics", "cycles.run.toml", "-o", output.name, "--resume"], cwd=self.folder,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            lines = []
            for line in process.stderr:  # as far as the end of the first cycle that this process takes
                lines.append(line)
                if "cycle " in line and " of 3" in line:
                    break
            time.sleep(draw.uniform(0.0, 0.05))
            process.kill()
            process.communicate()
            resumed += any("resum" in line for line in lines)
            if output.exists():
                break
        done = stages.run_stage("dynamics", "cycles.run.toml", "-o", output.name, "--resume", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same_numbers(output, self.folder / "cycles.run.h5")
        expect_at_least(self, "runs that went on from a checkpoint", resumed + ("resum" in done.stderr), 1)


    def test_a_run_without_cycles_that_is_killed_anywhere_is_resumed_to_the_same_bits(self):
        scene, output = self.folder / "long.run.toml", self.folder / "again.run.h5"
        text = (self.folder / "step.run.toml").read_text()
        scene.write_text(text.replace("end_s = 0.06", "end_s = 6.0").replace("output_step_us = 50.0", "output_step_us = 700.0"))
        done = stages.run_stage("dynamics", scene.name, "-o", "whole.run.h5", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        command = [stages.BIN / "clatter-dynamics", scene.name, "-o", output.name, "--resume", "--checkpoint-seconds", "0"]
        draw, said, checkpoint = random.Random(16), [], self.folder / "again.run.h5.checkpoint"
        for _ in range(6):
            before = checkpoint.stat().st_ino if checkpoint.exists() else None
            process = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            while process.poll() is None and (checkpoint.stat().st_ino if checkpoint.exists() else None) == before:
                time.sleep(0.002)
            time.sleep(draw.uniform(0.0, 0.05))
            process.kill()
            said += process.communicate()[1].splitlines()
            if output.exists():
                break
        done = stages.run_stage("dynamics", scene.name, "-o", output.name, "--resume", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        equal = self.assert_same_numbers(output, self.folder / "whole.run.h5")
        began = [float(line.split()[2]) for line in said + done.stderr.splitlines() if line.startswith("resuming at ")]
        self.assertEqual(sum("nothing to resume" in line for line in said), 1)
        self.assertEqual(began, sorted(began))
        self.assertFalse(checkpoint.exists())
        observed(f"went on at {', '.join(f'{at:.3g}' for at in began)} s; {equal} datasets equal to the bit")
        expect_at_least(self, "runs that went on from a checkpoint", len(began), 1)


class HardP3TwoWriters(hard_pipeline.HardPipeline):
    def test_two_makes_in_one_folder_leave_right_results(self):
        for name in hard_pipeline.ARTEFACTS:
            (self.folder / name).unlink()
        both = [subprocess.Popen(MAKE, cwd=self.folder, env=WITHOUT_MAKE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                for _ in range(2)]
        said = [process.communicate()[1] for process in both]
        self.assertIn(0, [process.returncode for process in both], said)
        for process, lines in zip(both, said):
            if process.returncode:
                self.assertEqual(lines.count(": error: "), 1, lines)
        stages.make(self.folder)
        equal = sum(self.assert_same_numbers(self.folder / name, hard_pipeline.master / name) for name in hard_pipeline.ARTEFACTS)
        observed(f"exit codes {', '.join(str(process.returncode) for process in both)}; {equal} datasets equal to the bit")

    def test_the_second_run_to_one_output_is_refused_and_the_first_keeps_its_results(self):
        scene = self.folder / "step.run.toml"
        scene.write_text(scene.read_text().replace("end_s = 0.06", "end_s = 600.0").replace("output_step_us = 50.0", "output_step_us = 5000.0"))
        part = self.folder / "one.h5.part"
        first = subprocess.Popen([stages.BIN / "clatter-dynamics", scene.name, "-o", "one.h5"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                 stderr=subprocess.PIPE, text=True)
        try:
            end = time.monotonic() + 60.0
            while not part.exists() or part.stat().st_size == 0:
                self.assertLess(time.monotonic(), end)
                time.sleep(0.01)
            before = part.stat().st_ino
            said = self.refusal("dynamics", [scene.name, "-o", "one.h5"], code=4)
            self.assertIn("one.h5.part: another program is writing this file", said)
            self.assertEqual(part.stat().st_ino, before)
            first.send_signal(signal.SIGTERM)
            messages = first.communicate(timeout=60)[1]
            self.assertEqual(first.returncode, 3, messages)
        finally:
            first.kill()
            first.communicate()
        with h5py.File(self.folder / "one.interrupted.h5") as file:
            self.assertEqual(len(file["history/time"]), len(file["energy/kinetic"]))
        observed(f"refused: {said}")

    def test_a_writer_waits_for_the_other_one_to_end(self):
        with open(self.folder / "x.h5.part", "w") as part:
            fcntl.flock(part, fcntl.LOCK_EX)
            release = threading.Timer(1.0, lambda: (os.unlink(self.folder / "x.h5.part"), fcntl.flock(part, fcntl.LOCK_UN)))
            release.start()
            done = stages.run_stage("assembly", *COMMANDS["assembly"], "-o", "x.h5", "--quiet", folder=self.folder)
            release.join()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same_numbers(self.folder / "x.h5", self.folder / "beam.fe.h5")


class HardP5ReplacedInputs(hard_pipeline.HardPipeline):
    def test_an_input_that_is_edited_during_a_run_is_no_longer_claimed_and_make_remakes(self):
        scene = self.folder / "step.run.toml"
        scene.write_text(scene.read_text().replace("end_s = 0.06", "end_s = 2.0"))
        before = scene.read_text()
        process = subprocess.Popen([stages.BIN / "clatter-dynamics", scene.name, "-o", "step.run.h5"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        for line in process.stderr:
            if "effects" in line:  # the scene was read
                break
        scene.write_text(before.replace("end_s = 2.0", "end_s = 0.05"))
        said = process.communicate()[1]
        self.assertEqual(process.returncode, 0, said)
        self.assertIn("step.run.toml changed while it was in use: step.run.h5 is of its older content", said)
        with h5py.File(self.folder / "step.run.h5") as file:
            hashes = dict(zip((path.decode() for path in file["inputs/path"][()]), (text.decode() for text in file["inputs/sha256"][()])))
            self.assertRegex(text_of(file.attrs["config"]), r"end_s = 2(\.0)?\b")
        self.assertEqual(hashes["step.run.toml"], "changed while it was in use")
        self.assertEqual(len(hashes["beam.rom.h5"]), 64)
        self.assertLess((self.folder / "step.run.h5").stat().st_mtime_ns, scene.stat().st_mtime_ns)
        shown = subprocess.run([*MAKE, "-n", "step.run.h5"], cwd=self.folder, env=WITHOUT_MAKE, capture_output=True, text=True)
        self.assertIn("clatter-dynamics", shown.stdout)
        observed(f"said: {next(line for line in said.splitlines() if 'changed while' in line)}")

    def test_inputs_that_stay_are_claimed_by_their_hash(self):
        with h5py.File(self.folder / "cycles.run.h5") as file:
            self.assertEqual({len(text) for text in file["inputs/sha256"][()]}, {64})


class HardP8StandardStreams(hard_pipeline.HardPipeline):
    def run_in_shell(self, stage, redirection):
        """Exit code and output of the stage with --json, its result in stage.h5."""
        words = " ".join(f"'{word}'" for word in [stages.BIN / f"clatter-{stage}", *COMMANDS[stage], "-o", f"{stage}.h5", "--json"])
        done = subprocess.run(["/bin/bash", "-c", f"set -o pipefail; {words} {redirection}"], cwd=self.folder, capture_output=True, text=True)
        return done.returncode, done.stderr

    def test_streams_that_are_closed_or_not_read_change_no_artefact(self):
        equal = 0
        for stage in COMMANDS:
            for redirection in ("<&- >&- 2>&-", "2>&1 | true"):
                with self.subTest(stage=stage, redirection=redirection):
                    (self.folder / f"{stage}.h5").unlink(missing_ok=True)
                    code, said = self.run_in_shell(stage, redirection)
                    self.assertEqual(code, 0, said)
                    equal += self.assert_same_numbers(self.folder / f"{stage}.h5", self.folder / EQUAL[stage])
        expect_at_least(self, "datasets equal to the bit", equal, 100)

    def test_a_result_that_standard_output_cannot_take_is_an_error(self):
        for stage in ("modal", "assembly"):
            code, said = self.run_in_shell(stage, ">/dev/full")
            self.assertEqual(code, 4, said)
            self.assertIn("error: standard output: cannot be written: No space left on device", said)
        observed(f"refused: {said.splitlines()[-1].partition('error: ')[2]}")


class HardP11FullDisk(hard_pipeline.HardPipeline):
    """A limit of the size of files fails every write beyond it, wherever the file is and whoever the user is."""

    def test_every_stage_says_so_and_leaves_nothing(self):
        draw = random.Random(15)
        for stage, arguments in COMMANDS.items():
            size = (self.folder / EQUAL[stage]).stat().st_size
            for limit in (0, draw.randrange(1, size), size - 2048):
                with self.subTest(stage=stage, limit=limit):
                    before = {path.name for path in self.folder.iterdir()}
                    said = self.refusal(stage, [*arguments, "-o", "full.h5"], code=4,
                                        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
                    self.assertIn("full.h5", said)
                    left = {path.name for path in self.folder.iterdir()} - before
                    self.assertLessEqual(left, {"full.h5.checkpoint"} if stage == "dynamics" else set())  # of use to --resume
                    (self.folder / "full.h5.checkpoint").unlink(missing_ok=True)
        observed(f"refused: {said}")

    def test_a_run_whose_disk_fills_is_finished_later_to_the_same_bits(self):
        size = (self.folder / "cycles.run.h5").stat().st_size
        self.refusal("dynamics", ["cycles.run.toml", "-o", "full.h5"], code=4,
                     preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size - 2048, size - 2048)))
        done = stages.run_stage("dynamics", "cycles.run.toml", "-o", "full.h5", "--resume", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same_numbers(self.folder / "full.h5", self.folder / "cycles.run.h5")


class HardP12Limits(hard_pipeline.HardPipeline):
    def test_few_file_descriptors_give_the_result_or_one_line(self):
        ended = {}
        for stage, arguments in COMMANDS.items():
            for files in (4, 5, 7, 12):
                with self.subTest(stage=stage, files=files):
                    (self.folder / "few.h5").unlink(missing_ok=True)
                    done = stages.run_stage(stage, *arguments, "-o", "few.h5", "--quiet", folder=self.folder,
                                            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (files, files)))
                    ended[done.returncode] = ended.get(done.returncode, 0) + 1
                    if done.returncode:
                        self.assertIn(done.returncode, (2, 3, 4, 127), done.stderr)  # 127: the loader could not open a library
                        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
                        self.assertFalse((self.folder / "few.h5").exists())
                    else:
                        self.assert_same_numbers(self.folder / "few.h5", self.folder / EQUAL[stage])
        observed("exit codes " + ", ".join(f"{code}: {count} times" for code, count in sorted(ended.items())))
        expect_at_most(self, "runs that ended by a signal", sum(count for code, count in ended.items() if code < 0), 0)
        self.assertGreater(ended.get(0, 0), 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
