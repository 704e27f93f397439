# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter doctor: what is there, what is missing, and the command that installs it."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from clatter_command import TOOLS, clatter
from clatter_tools import doctor

STAGES = doctor.STAGES
INSTALLED = "#!/bin/sh\nfor p; do case $p in -*|*status*|%s) ;; *) echo \"$p installed\";; esac; done\n"


class Doctor(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="clatter-doctor-")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.bin = self.folder / "bin"
        self.bin.mkdir()
        for stage in STAGES:
            self.script(f"clatter-{stage}", f"#!/bin/sh\necho clatter-{stage} 1.2.3\n")
        self.script("dpkg-query", INSTALLED % "none")
        self.environment = {"CLATTER_BIN": str(self.bin), "PATH": f"{self.bin}{os.pathsep}{os.environ['PATH']}"}

    def script(self, name, text):
        (self.bin / name).write_text(text)
        (self.bin / name).chmod(0o755)

    def doctor(self, *arguments, code=0, **environment):
        done = clatter("doctor", "--json", *arguments, folder=self.folder, environment={**self.environment, **environment})
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        answer = json.loads(done.stdout)
        self.assertEqual(answer["ok"], code == 0)
        return {check["name"]: check for check in answer["checks"]}

    def test_without_packages_of_python_the_command_names_them_and_the_doctor_works(self):
        bare = [sys.executable, "-S", str(TOOLS / "clatter")]  # without site-packages
        done = subprocess.run([*bare, "--help"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, r"\Aclatter: error: .* has no (numpy|h5py): apt-get install python3-\1; without it .*\n\Z")
        done = subprocess.run([*bare, "doctor"], capture_output=True, text=True, cwd=self.folder, env={**os.environ, **self.environment})
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("missing  Python    numpy, h5py, scipy, matplotlib: apt-get install python3-numpy", done.stdout)

    def test_each_check_has_a_line_that_begins_with_its_status(self):
        done = clatter("doctor", folder=self.folder, environment=self.environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for line in done.stdout.splitlines():
            self.assertRegex(line, r"^(ok|warning|missing) +\S")
        self.assertEqual(len(done.stdout.splitlines()), len(self.doctor()))
        self.assertIn("six of version 1.2.3", done.stdout)

    def test_missing_packages_are_named_with_the_command_that_installs_them(self):
        self.script("dpkg-query", INSTALLED % "python3-h5py|libgmsh-dev")
        found = self.doctor(code=1)["packages"]
        self.assertEqual((found["status"], found["remedy"]), ("missing", "apt-get install libgmsh-dev python3-h5py"))

    def test_a_program_that_fails_is_missing_and_another_version_is_a_warning(self):
        self.script("clatter-recover", "#!/bin/sh\necho clatter-recover 1.2.4\n")
        self.assertEqual(self.doctor()["programs"]["status"], "warning")
        self.script("clatter-recover", "#!/bin/sh\nexit 127\n")
        found = self.doctor(code=1)["programs"]
        self.assertEqual((found["status"], found["text"]), ("missing", "clatter-recover"))

    def test_a_folder_that_cannot_be_written_is_missing_and_one_that_is_not_there_is_refused(self):
        found = self.doctor("/proc", code=1)["folder"]
        self.assertIn("/proc cannot be written", found["text"])
        self.assertEqual(clatter("doctor", "nowhere", folder=self.folder).returncode, 2)

    def test_a_blas_that_is_not_openblas_is_a_warning(self):
        self.assertEqual(self.doctor()["BLAS"]["status"], "warning")  # a script is linked with none

    def test_the_packages_are_those_of_tools_setup(self):
        self.assertIn("libopenblas-dev", doctor.listed(["build"]))
        self.assertNotIn("libopenblas-dev", doctor.listed(["demo"]))
        self.assertIn("python3-h5py", doctor.listed(["demo"]))


if __name__ == "__main__":
    unittest.main(verbosity=2)
