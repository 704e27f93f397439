# SPDX-License-Identifier: GPL-3.0-or-later
"""A full disk and a killed stage: no partial file under the final name, the older artefact intact."""
import os
import pathlib
import random
import shutil
import signal
import subprocess
import time
import unittest

import h5py
import stages
from observed import expect_at_least, observed


class HardH1KilledHalfWay(stages.PipelineTest):
    def test_kill_at_random_times_leaves_the_older_artefact_or_a_complete_one(self):
        draw = random.Random(7)
        for stage in ("mesh", "assembly", "condense", "dynamics", "recover"):
            arguments = self.command(stage)
            output = self.folder / arguments[-1]
            begin = time.monotonic()
            stages.run_stage(stage, *arguments, folder=self.folder)
            duration = time.monotonic() - begin
            for _ in range(4):
                with self.subTest(stage=stage):
                    self.kill_once(stage, arguments, output, draw.uniform(0.0, 1.1 * duration))
        observed("five stages killed four times each: the older artefact or a complete one, and a later run removes what is left")

    def kill_once(self, stage, arguments, output, delay):
        before = stages.fingerprint(output)
        process = subprocess.Popen([stages.BIN / f"clatter-{stage}", *arguments], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(delay)
        process.kill()
        process.wait()
        if stages.fingerprint(output) != before:  # it was faster than the kill: then it must be complete
            with h5py.File(output) as file:
                self.assertIn("timing", file)
        again = stages.run_stage(stage, *arguments, folder=self.folder)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertFalse(pathlib.Path(f"{output}.part").exists(), "a later run removes what the killed one left")


class HardN11Terminated(stages.PipelineTest):
    def send(self, number, after, wait=0.0):
        """The signal, so many seconds after a line that contains `after`; returns (exit code, messages)."""
        process = subprocess.Popen([stages.BIN / "clatter-dynamics", *self.command("dynamics")], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        for line in process.stderr:
            if after in line:
                break
        time.sleep(wait)
        process.send_signal(number)
        messages = process.communicate()[1]
        self.assertEqual(list(self.folder.glob("*.part")), [], "a part file is left")
        return process.returncode, messages

    def test_both_signals_end_a_run_at_a_step_with_what_there_is(self):
        self.edit("step.run.toml", "end_s = 0.06", "end_s = 600.0")
        self.edit("step.run.toml", "output_step_us = 50.0", "output_step_us = 5000.0")
        interrupted = self.folder / "step.run.interrupted.h5"
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=number.name):
                code, messages = self.send(number, "effects:", wait=1.0)
                self.assertEqual(code, 3, messages)
                self.assertIn("step.run.interrupted.h5", messages)
                with h5py.File(interrupted) as run:
                    self.assertEqual(run.attrs["complete"], 0)
                    self.assertEqual(len(run["output/time"]), len(run["bodies/beam/q"]))
                    self.assertEqual(len(run["history/time"]), len(run["energy/kinetic"]))
                    expect_at_least(self, f"samples that {number.name} keeps", len(run["output/time"]), 1)
                interrupted.unlink()

    def test_a_killed_run_without_a_checkpoint_starts_again_and_says_so(self):
        (self.folder / "step.run.h5.part").write_bytes(b"of a killed run")
        done = stages.run_stage("dynamics", "step.run.toml", "-o", "step.run.h5", "--resume", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("step.run.h5: nothing to resume, there is no checkpoint (one is written after each cycle, without cycles every 60 s): "
                      "the run starts at its beginning\n", done.stderr)

    def test_an_interval_of_checkpoints_that_is_none_is_refused(self):
        for seconds in ("-1", "nan"):
            done = stages.run_stage("dynamics", "step.run.toml", "-o", "step.run.h5", f"--checkpoint-seconds={seconds}", folder=self.folder)
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"error: --checkpoint-seconds: found {seconds}, expected 0 or more\n", done.stderr)

    def test_both_signals_before_the_first_step_end_it_with_the_same_code(self):
        # Before, the signal killed the program until its first step.
        self.edit("step.run.toml", "end_s = 0.06", "end_s = 600.0")
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=number.name):
                code, messages = self.send(number, "effects:")
                self.assertEqual(code, 3, messages)
                self.assertIn("interrupted", messages)

    def test_a_signal_while_the_results_are_written_lets_them_be_complete(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=number.name):
                code, messages = self.send(number, "cycle 1 of 1")
                self.assertEqual(code, 0, messages)
                with h5py.File(self.folder / "step.run.h5") as run:
                    self.assertEqual(run.attrs["complete"], 1)
                    self.assertIn("timing", run)


class HardH2DiskFull(stages.PipelineTest):
    def test_a_full_disk_is_reported_in_one_line_and_damages_nothing(self):
        small = self.small_disk()
        for stage in ("mesh", "assembly", "condense", "dynamics", "recover"):
            name = self.command(stage)[-1]
            target = small / name
            target.write_bytes(b"the older artefact")
            filler = small / "filler"
            free = os.statvfs(small)
            filler.write_bytes(b"\0" * max(0, free.f_bavail * free.f_frsize - 16384))
            with self.subTest(stage=stage):
                self.assert_refused(stage, [*self.command(stage)[:-1], str(target)], code=4, says=[name])
                self.assertEqual(target.read_bytes(), b"the older artefact")
            filler.unlink()
            target.unlink()

    def test_a_disk_that_fills_while_a_run_goes_is_reported_in_one_line(self):
        small = self.small_disk()
        # The samples fit, 0.7 MB; the histories of 120 000 steps do not.
        self.edit("step.run.toml", "largest_step_us = 50.0", "largest_step_us = 0.5")
        target = small / "step.run.h5"
        target.write_bytes(b"the older artefact")
        self.assert_refused("dynamics", ["step.run.toml", "-o", str(target)], code=4, says=["step.run.h5: ", "disk full"])
        self.assertEqual([path.name for path in small.iterdir()], ["step.run.h5"])

    def small_disk(self):
        """A file system of 1 MB in the test's folder; the test is skipped where none can be mounted."""
        mount_point = self.folder / "small"
        mount_point.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", mount_point], capture_output=True,
                                 text=True) if shutil.which("mount") else None
        if mounted is None or mounted.returncode != 0:
            self.skipTest("a 1 MB file system cannot be mounted here: needs root")
        self.addCleanup(subprocess.run, ["umount", mount_point], check=True)
        return mount_point

    def test_a_folder_that_does_not_exist(self):
        for stage in stages.STAGES:
            with self.subTest(stage=stage):
                arguments = [*self.command(stage)[:-1], "nowhere/out.h5"]
                self.assert_refused(stage, arguments, code=4, says=["nowhere/out.h5"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
