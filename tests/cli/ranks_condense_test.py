# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter-condense-mpi on one to four ranks against clatter-condense."""
import fcntl
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
        self.assertEqual(set(one["inertia"]), set(other["inertia"]))
        for name, values in one["inertia"].items():
            rows = slice(0, size if name.startswith("product") else None)
            columns = slice(0, size if name != "place" else None)
            self.assertLess(ranks.largest_difference(other["inertia"][name][rows, columns], values[rows, columns]), 1e-8, name)
        self.assertEqual(set(one["certificate"]), set(other["certificate"]))
        for name, value in one["certificate"].items():
            if name not in ROUNDING:
                self.assertAlmostEqual(other["certificate"][name], value, delta=1e-4 * abs(value) + 1e-9, msg=name)


class Condense(OfRanks):
    def test_any_number_of_ranks_gives_the_model_of_one_process(self):
        for one, other, done in self.both():
            self.assert_same(one, other)
            self.assertEqual(other["certificate"]["count_proved"], 1.0)
            self.assertIn("acceleration 2", other["loads"])  # it has supports
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
            (self.folder / "beam.rom.toml").write_text(f'method = "{method}"\nboundary = ["tip", "sensor_tip"]\n{modes}\n')
            for one, other, _ in self.both((2,)):
                self.assert_same(one, other)


    def test_inertia_invariants_of_a_free_part(self):
        # They are proved against M_rr and the rigid motions, or refused.
        self.edit("beam.fe.toml", *FREE_PART[0])
        self.edit("beam.rom.toml", "fmax_hz = 4000.0", "count = 8\ninertia_invariants = true")
        done = stages.run_stage("assembly", *self.command("assembly"), folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        for one, other, _ in self.both():
            self.assertEqual(len(other["inertia"]), 9)
            self.assert_same(one, other)

    def test_inertia_invariants_of_a_lumped_mass_of_a_clamped_part(self):
        self.edit("beam.rom.toml", "fmax_hz = 4000.0", "count = 4\ninertia_invariants = true")
        text = (self.folder / "beam.fe.toml").read_text()
        (self.folder / "beam.fe.toml").write_text(text + "\n[mass]\nlumping = \"hrz\"\n")
        done = stages.run_stage("assembly", *self.command("assembly"), folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        for one, other, _ in self.both((3,)):
            self.assert_same(one, other)

    def test_arpack(self):
        self.edit("beam.rom.toml", "fmax_hz = 4000.0", 'fmax_hz = 4000.0\neigen_solver = "arpack"')
        for one, other, _ in self.both((3,)):
            self.assert_same(one, other)
            self.assertEqual(other["certificate"]["count_proved"], 1.0)
            self.assertIn("acceleration 2", other["loads"])  # it has supports

    def test_verification_by_the_full_model(self):
        arguments = ["beam.fe.h5", "-c", "beam.rom.toml", "--verify", "0", "-o"]
        self.assertEqual(stages.run_stage("condense", *arguments, "beam.rom.h5", folder=self.folder).returncode, 0)
        one = ranks.read(self.folder / "beam.rom.h5")["certificate"]
        done = ranks.run("condense", 3, *arguments, "shared.rom.h5", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        shared = ranks.read(self.folder / "shared.rom.h5")["certificate"]
        for name, tolerance in (("verified_to_hz", 1e-3), ("verified_modes", 0.0), ("verified_frequency_error", 1e-8),
                                ("verified_mac", 1e-8)):
            self.assertAlmostEqual(shared[name], one[name], delta=tolerance, msg=name)
        self.assertIn("smallest MAC", done.stdout)

    def test_static_matrices_by_a_complex_step(self):
        # The programs solve real systems for Psi; this takes both matrices from one complex factorisation.
        self.assertEqual(self.condense(count=2, output="shared.rom.h5").returncode, 0)
        for count in (1, 3):
            words = [*ranks.MPIRUN, "-n", str(count), str(stages.BIN.parent / "tests/complex_step"), "beam.fe.h5", "shared.rom.h5",
                     "tip", "sensor_tip"]
            done = ranks.finish(words, self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            K, M = map(float, done.stdout.split())
            self.assertLess(K, 1e-9)
            self.assertLess(M, 1e-9)
            print(f"    {count} ranks: K_rr {K:.1e}, M_rr {M:.1e} of their largest entries")


class Failures(OfRanks):
    def test_all_ranks_end_with_one_line_and_the_code_of_one_process(self):
        cases = [("beam.rom.toml", 'boundary = ["tip", "sensor_tip"]', 'boundary = ["nothing"]', 2, "nothing"),
                 ("beam.rom.toml", "fmax_hz = 4000.0", "fmax = 4000.0", 2, "fmax_hz"),
                 ("beam.rom.toml", "fmax_hz = 4000.0", 'fmax_hz = 4000.0\neigen_solver = "amls"', 2,
                  'eigen_solver: found "amls", which one process computes')]
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
        children = ranks.ranks_of(process, 3)
        time.sleep(0.3)
        os.kill(children[-1], signal.SIGKILL)
        self.assertNotEqual(process.wait(timeout=60), 0)
        self.assertFalse((self.folder / "killed.rom.h5").exists())
        ranks.wait_until(lambda: not any(os.path.exists(f"/proc/{child}") for child in children), "a rank is left")

    def test_a_wrong_order_is_replaced(self):
        self.assertEqual(self.condense().returncode, 0)
        one = ranks.read(self.folder / "beam.rom.h5")
        self.assertIn("stored order", self.condense(count=2).stderr)

        def repeat_an_unknown(order):
            order["permutation"][0] = order["permutation"][1]

        def of_fewer_unknowns(order):
            kept = order["permutation"][:-3]
            del order["permutation"]
            order["permutation"] = kept

        for wrong in (repeat_an_unknown, of_fewer_unknowns):
            with self.subTest(wrong.__name__):
                with h5py.File(self.folder / "beam.rom.h5", "r+") as file:
                    wrong(file["ordering"])
                done = self.condense(count=2)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertNotIn("stored order", done.stderr)
                self.assert_same(one, ranks.with_signs_of(ranks.read(self.folder / "beam.rom.h5"), one))


class OnDisk(OfRanks):
    """A factor that does not fit into the memory of a rank: 106 MiB, of which 36 MiB stay in memory."""
    LIMIT = ["--memory-limit", "0.21"]  # 60 MiB are left

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        toml = cls.master / "beam.mesh.toml"
        toml.write_text(toml.read_text().replace("element_size_mm = 15.0", "element_size_mm = 7.5"))
        for stage in ("mesh", "assembly"):
            stages.run_stage(stage, *cls.command(stage), folder=cls.master).check_returncode()

    def setUp(self):
        super().setUp()
        self.scratch = self.folder / "scratch"
        self.scratch.mkdir()

    def arguments(self, output="beam.rom.h5"):
        return ["beam.fe.h5", "-c", "beam.rom.toml", "-o", output, *self.LIMIT]

    def folders(self, place=None):
        return sorted((place or self.scratch).glob("clatter-factor-*"))

    def test_the_same_model_and_what_killed_programs_left_is_removed(self):
        left, used = (self.scratch / f"clatter-factor-{name}" for name in ("left", "used"))
        for folder in (left, used):
            folder.mkdir()
            (folder / "lock").touch()
            (folder / "factor").write_bytes(b"part of a factor")
        done = self.condense(count=2, output="memory.rom.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("on disk", done.stderr)
        with (used / "lock").open() as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            done = ranks.run("condense", 2, *self.arguments(), folder=self.folder, TMPDIR=str(self.scratch))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("it is kept on disk", done.stderr)
        self.assertEqual(self.folders(), [used])
        one = ranks.read(self.folder / "memory.rom.h5")
        self.assert_same(one, ranks.with_signs_of(ranks.read(self.folder / "beam.rom.h5"), one))

    def test_a_killed_rank_leaves_no_factor(self):
        process = subprocess.Popen(ranks.command("condense", 2, *self.arguments("killed.rom.h5")), cwd=self.folder,
                                   env={**ranks.ENVIRONMENT, "TMPDIR": str(self.scratch)}, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        children = ranks.ranks_of(process, 2)
        ranks.wait_until(lambda: len(list(self.scratch.glob("clatter-factor-*/factor_*"))) >= 2, "no factor on disk", 120.0)
        os.kill(children[-1], signal.SIGKILL)
        self.assertNotEqual(process.wait(timeout=60), 0)
        self.assertFalse((self.folder / "killed.rom.h5").exists())
        ranks.wait_until(lambda: not any(os.path.exists(f"/proc/{child}") for child in children), "a rank is left")
        ranks.wait_until(lambda: not self.folders(), f"left: {self.folders()}")

    def test_a_full_disk_on_one_rank(self):
        small = interrupted_test.HardH2DiskFull.small_disk(self)
        program = [*ranks.program("condense"), *self.arguments("full.rom.h5"), "--threads", "1"]
        words = [*ranks.MPIRUN, "-n", "1", "-x", f"TMPDIR={self.scratch}", *program, ":", "-n", "1", "-x", f"TMPDIR={small}",
                 *program]
        done = ranks.finish(words, self.folder)
        errors = [line for line in done.stderr.splitlines() if "error:" in line]
        self.assertEqual((done.returncode, len(errors)), (4, 1), done.stderr)
        self.assertIn("could not write its factor to disk", errors[0])
        self.assertIn("TMPDIR", errors[0])
        self.assertFalse((self.folder / "full.rom.h5").exists())
        ranks.wait_until(lambda: not self.folders() and not self.folders(small), "a factor is left")


if __name__ == "__main__":
    unittest.main()
