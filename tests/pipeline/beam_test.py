# SPDX-License-Identifier: GPL-3.0-or-later
"""samples/beam through make: results, what is rebuilt, bit-identical repetition."""
import os
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import stages  # noqa: E402


class Beam(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = stages.copy_sample(cls, "beam")
        cls.first = cls.make()

    @classmethod
    def make(cls, *arguments):
        """Runs make; returns (output, artefacts that were written)."""
        before = {path: path.stat().st_mtime_ns for path in cls.folder.glob("*.h5")}
        output = stages.make(cls.folder, *arguments)
        made = {path.name for path in cls.folder.glob("*.h5") if before.get(path) != path.stat().st_mtime_ns}
        return output, made

    def touch(self, name):
        os.utime(self.folder / name)

    def test_1_all_six_stages_run_and_the_answer_agrees_with_beam_theory(self):
        output, made = self.first
        self.assertEqual(made, {"beam.mesh.h5", "beam.fe.h5", "beam.modes.h5", "beam.rom.h5", "step.run.h5",
                                "step.field.h5"})
        self.assertIn("Timoshenko", output)
        print(output[output.index("  "):], file=sys.stderr)

    def test_1_report_sums_up_a_folder_without_an_engine(self):
        done = subprocess.run([stages.SOURCE / "tools/clatter", "report", self.folder], text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.folder / "beam.fe.h5") as model:
            dofs = str(model["K"].attrs["shape"][0])
        for expected in ("beam", dofs, "step", "total"):
            self.assertIn(expected, done.stdout)

    def test_2_a_second_make_redoes_nothing(self):
        self.assertEqual(self.make()[1], set())

    def test_3_a_newer_toml_redoes_only_what_depends_on_it(self):
        self.touch("step.field.toml")
        self.assertEqual(self.make()[1], {"step.field.h5"})
        self.touch("step.run.toml")
        self.assertEqual(self.make()[1], {"step.run.h5", "step.field.h5"})
        self.touch("beam.modes.toml")
        self.assertEqual(self.make()[1], {"beam.modes.h5"})
        self.touch("beam.fe.toml")
        self.assertEqual(self.make("-j2")[1], {"beam.fe.h5", "beam.modes.h5", "beam.rom.h5", "step.run.h5", "step.field.h5"})

    def test_4_an_interrupted_run_resumes(self):
        for name in ("beam.rom.h5", "step.run.h5", "step.field.h5"):
            (self.folder / name).unlink()
        self.assertEqual(self.make()[1], {"beam.rom.h5", "step.run.h5", "step.field.h5"})

    def test_5_the_same_input_gives_the_same_numbers(self):
        import h5py
        import numpy as np

        def numbers():
            found = {}
            for name in ("beam.mesh.h5", "beam.fe.h5", "beam.modes.h5", "beam.rom.h5", "step.run.h5", "step.field.h5"):
                with h5py.File(self.folder / name) as file:
                    file.visititems(lambda key, item: found.__setitem__(f"{name}:{key}", item[()])
                                    if isinstance(item, h5py.Dataset) and item.dtype.kind in "fi"
                                    and not key.startswith(("timing", "effects")) else None)
            return found

        before = numbers()
        for path in self.folder.glob("*.h5"):
            path.unlink()
        self.make()
        after = numbers()
        self.assertEqual(before.keys(), after.keys())
        different = [key for key in before if not np.array_equal(before[key], after[key])]
        self.assertEqual(different, [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
