# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter-condense-mpi on one to four ranks against clatter-condense."""
import os
import signal
import subprocess
import time
import unittest

import h5py
import interrupted_test
import numpy as np
import ranks
import stages

# Figures of the certificate that are rounding errors, and the ratio of pivots, which depends on the order within a
# front: below their limits, but not the same.
ROUNDING = {"eigen_residual_max", "K_ii_probe_residual", "modal_mass_error", "mass_error", "mass_error_elements",
            "rigid_shape_error", "rigid_stiffness_residue", "K_ii_rcond"}
FREE_PART = [("[[support]]\nsurface = \"x_min\"\n", "")]


class OfRanks(stages.PipelineTest):
    @staticmethod
    def commands():
        return [command for command in stages.PipelineTest.commands() if command[0] in ("mesh", "assembly", "condense")]

    def condense(self, program="condense", count=0, output="beam.rom.h5"):
        arguments = ["beam.fe.h5", "-c", "beam.rom.toml", "-o", output]
        if count == 0:
            return stages.run_stage(program, *arguments, folder=self.folder)
        return ranks.run(program, count, *arguments, folder=self.folder)

    def both(self, counts=(1, 2, 3, 4)):
        """Models by one process and by some ranks."""
        done = self.condense()
        self.assertEqual(done.returncode, 0, done.stderr)
        one = ranks.read(self.folder / "beam.rom.h5")
        for count in counts:
            output = f"of_{count}.rom.h5"
            done = self.condense(count=count, output=output)
            self.assertEqual(done.returncode, 0, done.stderr)
            yield one, ranks.with_signs_of(ranks.read(self.folder / output), one), done

    def assert_same(self, one, other):
        # Residual modes are corrections of 1e-6 of a mode and less: their directions amplify rounding.
        size = len(one["M_rr"]) - int(one["certificate"]["residual_modes"])
        self.assertEqual(other["M_rr"].shape, one["M_rr"].shape)
        modes = size - one["boundary"]
        if modes:
            found, expected = (model["fixed_interface_hz"][:modes] for model in (other, one))
            self.assertLess(np.abs(found / expected - 1.0).max(), 1e-9)
        for name in ("K_rr", "M_rr"):
            self.assertLess(ranks.largest_difference(other[name][:size, :size], one[name][:size, :size]), 1e-9, name)
        self.assertLess(ranks.largest_difference(other["T"][:, :size], one["T"][:, :size]), 1e-8)
        for name, load in one["loads"].items():
            self.assertLess(ranks.largest_difference(other["loads"][name][:size], load[:size]), 1e-8, name)
        elastic = slice(int(one["certificate"]["rigid_modes"]), int(one["certificate"]["rigid_modes"]) + 8)
        found, expected = (ranks.frequencies(model)[elastic] for model in (other, one))
        # With the residual modes; eigh's own rounding is that of the highest of them, 3000 times the first.
        self.assertLess(np.abs(found / expected - 1.0).max(), 1e-6)
        self.assertEqual(set(one["certificate"]), set(other["certificate"]))
        for name, value in one["certificate"].items():
            if name not in ROUNDING:
                self.assertAlmostEqual(other["certificate"][name], value, delta=1e-4 * abs(value) + 1e-9, msg=name)


class Condense(OfRanks):
    def test_any_number_of_ranks_gives_the_model_of_one_process(self):
        for one, other, done in self.both():
            self.assert_same(one, other)
            self.assertEqual(other["certificate"]["count_proved"], 1.0)
            self.assertEqual(sorted(other["order"]), sorted(one["order"]))
            self.assertEqual(done.stdout.count("basis holds modes"), 1)  # rank 0 speaks for all

    def test_a_free_part_with_load_shapes(self):
        self.edit("beam.fe.toml", *FREE_PART[0])
        self.edit("beam.rom.toml", 'fmax_hz = 4000.0', 'count = 8\nload_shapes = ["weight"]')
        with (self.folder / "beam.fe.toml").open("a") as file:
            file.write('\n[[load]]\nname = "weight"\nkind = "gravity"\ndirection = [0.0, 0.0, -1.0]\n')
        done = stages.run_stage("assembly", *self.command("assembly"), folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        for one, other, _ in self.both((2, 3)):
            self.assert_same(one, other)
            self.assertEqual(other["certificate"]["rigid_modes"], 6.0)
            self.assertLess(other["certificate"]["mass_error"], 1e-9)

    def test_own_modes_and_guyan(self):
        for method, modes in (("craig-chang", "fmax_hz = 2000.0"), ("guyan", "")):
            self.edit("beam.rom.toml", (self.folder / "beam.rom.toml").read_text().splitlines()[2], f'method = "{method}"')
            self.edit("beam.rom.toml", (self.folder / "beam.rom.toml").read_text().splitlines()[4], modes)
            for one, other, _ in self.both((2,)):
                self.assert_same(one, other)


class Failures(OfRanks):
    def test_all_ranks_end_with_one_line_and_the_code_of_one_process(self):
        cases = [("beam.rom.toml", 'boundary = ["tip", "sensor_tip"]', 'boundary = ["nothing"]', 2, "nothing"),
                 ("beam.rom.toml", "fmax_hz = 4000.0", "fmax = 4000.0", 2, "fmax_hz"),
                 ("beam.rom.toml", "fmax_hz = 4000.0", "fmax_hz = 4000.0\ninertia_invariants = true", 2, "inertia_invariants")]
        for name, old, new, code, says in cases:
            with self.subTest(says):
                before = (self.folder / name).read_text()
                self.edit(name, old, new)
                done = self.condense(count=3, output="failed.rom.h5")
                (self.folder / name).write_text(before)
                errors = [line for line in done.stderr.splitlines() if "error:" in line]
                self.assertEqual((done.returncode, len(errors)), (code, 1), done.stderr)
                self.assertIn(says, errors[0])
                self.assertFalse((self.folder / "failed.rom.h5").exists())

    def test_memory_that_is_short_is_refused_before_the_work(self):
        done = ranks.run("condense", 2, "beam.fe.h5", "-c", "beam.rom.toml", "-o", "failed.rom.h5", "--memory-limit", "0.001",
                         folder=self.folder)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("use more ranks", done.stderr)
        self.assertFalse((self.folder / "failed.rom.h5").exists())

    def test_a_full_disk_on_the_rank_that_writes(self):
        small = interrupted_test.HardH2DiskFull.small_disk(self)
        target = small / "beam.rom.h5"
        target.write_bytes(b"the older artefact")
        free = os.statvfs(small)
        (small / "filler").write_bytes(b"\0" * max(0, free.f_bavail * free.f_frsize - 16384))
        done = self.condense(count=2, output=target)
        errors = [line for line in done.stderr.splitlines() if "error:" in line]
        self.assertEqual((done.returncode, len(errors)), (4, 1), done.stderr)
        self.assertEqual(target.read_bytes(), b"the older artefact")
        self.assertFalse((small / "beam.rom.h5.part").exists())

    def test_a_killed_rank_ends_all_and_leaves_nothing(self):
        process = subprocess.Popen(ranks.command("condense", 3, "beam.fe.h5", "-c", "beam.rom.toml", "-o", "killed.rom.h5"),
                                   cwd=self.folder, env=ranks.ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        children = []
        while len(children) < 3 and process.poll() is None:
            listed = subprocess.run(["pgrep", "-P", str(process.pid), "clatter"], capture_output=True, text=True)
            children = [int(word) for word in listed.stdout.split()]
        time.sleep(0.3)
        os.kill(children[-1], signal.SIGKILL)
        self.assertNotEqual(process.wait(timeout=60), 0)
        self.assertFalse((self.folder / "killed.rom.h5").exists())
        end = time.monotonic() + 20.0
        while any(os.path.exists(f"/proc/{child}") for child in children):
            self.assertLess(time.monotonic(), end, "a rank is left")
            time.sleep(0.1)

    def test_a_damaged_order_is_replaced(self):
        self.assertEqual(self.condense().returncode, 0)
        one = ranks.read(self.folder / "beam.rom.h5")
        with h5py.File(self.folder / "beam.rom.h5", "r+") as file:
            file["ordering/permutation"][0] = file["ordering/permutation"][1]
        self.assertEqual(self.condense(count=2).returncode, 0)
        self.assert_same(one, ranks.with_signs_of(ranks.read(self.folder / "beam.rom.h5"), one))


if __name__ == "__main__":
    unittest.main()
