# SPDX-License-Identifier: GPL-3.0-or-later
"""The lines of docs/python.md and docs/matlab.md work on the beam's files, with the numbers that they show."""
import contextlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402

SHOWN = re.compile(r"^print\((.*)\) +# (-?[\d.]+)$", re.M)
READ = re.compile(r"h5read(att)?\('([\w.]+)', '([^']+)'(?:, '(\w+)')?\)")


def blocks(name, language):
    return re.findall(rf"^```{language}\n(.*?)^```", (stages.SOURCE / "docs" / name).read_text(), re.M | re.S)


class Documents(stages.PipelineTest):
    def run_python(self, code):
        """Runs code in the folder; returns what it prints for each line with a number, and the numbers."""
        os.chdir(self.folder)
        self.addCleanup(os.chdir, "/")
        values = []
        marked = SHOWN.sub(lambda one: f"_values.append(float({one[1]}))", code)
        with contextlib.redirect_stdout(io.StringIO()) as output:
            exec(compile(marked, "docs", "exec"), {"_values": values})
        return values, [float(number) for _, number in SHOWN.findall(code)], output.getvalue()

    def test_the_lines_of_the_page_run_and_give_its_numbers(self):
        code = "\n".join(blocks("python.md", "python"))
        found, expected, printed = self.run_python(code)
        self.assertGreaterEqual(len(expected), 8)
        # Meshes of other releases of gmsh differ: their numbers of DoFs by a few per cent, all others by less.
        np.testing.assert_allclose(found, expected, rtol=0.06)
        self.assertRegex(printed, r"beam.fe.toml:\d+: .*\n")
        self.assertRegex(printed, r"25.0 0.00074\d+\n50.0 0.00074\d+\n")

    def test_a_wrong_number_of_a_page_is_found(self):
        found, expected, _ = self.run_python("x = 2\nprint(x * 3)    # 6.5\nprint(x)")
        self.assertEqual((found, expected), ([6.0], [6.5]))

    def test_datasets_and_attributes_of_the_matlab_page_exist(self):
        read = READ.findall("\n".join(blocks("matlab.md", "matlab")))
        self.assertGreater(len(read), 15)
        for attribute, file, path, name in read:
            with self.subTest(file=file, path=path), h5py.File(self.folder / file) as artefact:
                self.assertIn(path, artefact)
                self.assertTrue(name in artefact[path].attrs if attribute else isinstance(artefact[path], h5py.Dataset), name)

    def test_the_matlab_page_runs_in_octave(self):
        octave = shutil.which("octave-cli")
        if octave is None:
            self.skipTest("octave is not installed")
        if subprocess.run([octave, "--quiet", "--eval", "exit(exist('h5read') == 0)"], check=False).returncode:
            self.skipTest("octave has no h5read: package octave-hdf5oct")
        code = "\n".join([*blocks("matlab.md", "matlab"), "printf('%.9g %.9g %.9g\\n', frequency_hz(1), deflection_m, max(tip_z));"])
        done = subprocess.run([octave, "--quiet", "--eval", code], cwd=self.folder, text=True, capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.folder / "beam.modes.h5") as modes:
            first = modes["frequency_hz"][0]
        np.testing.assert_allclose([float(word) for word in done.stdout.split()], [first, 3.795e-6, 7.43e-4], rtol=0.01)


if __name__ == "__main__":
    unittest.main(verbosity=2)
