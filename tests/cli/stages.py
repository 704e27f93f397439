# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the stages for tests: a small pipeline made once, and checks of a stage's errors."""
import hashlib
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from observed import observed  # noqa: E402

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("CLATTER_BIN", SOURCE / "build/release/bin"))
STAGES = ("mesh", "assembly", "modal", "condense", "dynamics", "recover")


def run_stage(stage, *arguments, folder, **options):
    """Runs clatter-<stage> in `folder`; returns the finished process with its output."""
    return subprocess.run([BIN / f"clatter-{stage}", *map(str, arguments)], cwd=folder, text=True,
                          capture_output=True, timeout=300, **options)


def run_all(folder, *commands):
    """Runs stages in `folder`, each a list that begins with its name; returns the last one's process. AssertionError for one that fails."""
    for stage, *arguments in commands:
        done = run_stage(stage, *arguments, folder=folder)
        if done.returncode:
            raise AssertionError(f"{stage}: {done.stderr}")
    return done


def fingerprint(path):
    """Properties that must not change: content, inode and time stamp of a file."""
    state = path.stat()
    return hashlib.sha256(path.read_bytes()).hexdigest(), state.st_ino, state.st_mtime_ns


def require_stages():
    """Skips the test class where the executables are not built."""
    missing = [stage for stage in STAGES if not (BIN / f"clatter-{stage}").exists()]
    if missing:
        raise unittest.SkipTest(f"not built: {', '.join(missing)}")


def copy_sample(test_class, name):
    """A sample's source files in a scratch tree together with the tools; returns its folder."""
    root = pathlib.Path(tempfile.mkdtemp(prefix=f"clatter-{name}-"))
    test_class.addClassCleanup(shutil.rmtree, root)
    (root / "tools").symlink_to(SOURCE / "tools")
    return shutil.copytree(SOURCE / "samples" / name, root / "samples" / name,
                           ignore=shutil.ignore_patterns("*.h5", "*.d", "*.xdmf", "*.png", "*.txt", "*.checkpoint", "study"))


def make(folder, *arguments):
    """Runs make there with these executables; returns its output, AssertionError when it fails."""
    done = subprocess.run(["make", f"CLATTER_BIN={BIN}", "CLATTER_FLAGS=--quiet", *arguments], cwd=folder, text=True,
                          capture_output=True, env={**os.environ, "MAKEFLAGS": ""})
    if done.returncode:
        raise AssertionError(done.stdout + done.stderr)
    return done.stdout


class PipelineTest(unittest.TestCase):
    """Tests in a fresh copy of a folder in which the beam sample has run through all stages."""

    @classmethod
    def setUpClass(cls):
        require_stages()
        cls.master = pathlib.Path(tempfile.mkdtemp(prefix="clatter-cli-"))
        cls.addClassCleanup(shutil.rmtree, cls.master)
        for path in (SOURCE / "samples/beam").glob("*.toml"):
            shutil.copy(path, cls.master)
        for stage, arguments in cls.commands():
            done = run_stage(stage, *arguments, folder=cls.master)
            if done.returncode != 0:
                raise RuntimeError(f"clatter-{stage} {arguments}: {done.stderr}")

    @staticmethod
    def commands():
        """Stages of the beam sample: (stage, arguments)."""
        return [("mesh", ["beam.mesh.toml", "-o", "beam.mesh.h5"]),
                ("assembly", ["beam.mesh.h5", "-c", "beam.fe.toml", "-o", "beam.fe.h5"]),
                ("modal", ["beam.fe.h5", "-c", "beam.modes.toml", "-o", "beam.modes.h5"]),
                ("condense", ["beam.fe.h5", "-c", "beam.rom.toml", "-o", "beam.rom.h5"]),
                ("dynamics", ["step.run.toml", "-o", "step.run.h5"]),
                ("recover", ["step.run.h5", "-c", "step.field.toml", "-o", "step.field.h5"])]

    @classmethod
    def command(cls, stage):
        return list(dict(cls.commands())[stage])

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="clatter-cli-")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        shutil.copytree(self.master, self.folder, dirs_exist_ok=True)

    def edit(self, name, old, new):
        """Replaces a text in a file; the test fails if it is missing."""
        path = self.folder / name
        before = path.read_text()
        self.assertIn(old, before, f"{name} has changed, adapt this test")
        path.write_text(before.replace(old, new, 1))

    def assert_refused(self, stage, arguments=None, code=2, says=(), program=None, **options):
        """The stage ends with `code` and one line that says all of `says`; its older artefact is unchanged."""
        arguments = arguments or self.command(stage)
        output = self.folder / arguments[-1]
        before = fingerprint(output) if output.exists() else None
        done = run_stage(stage, *arguments, "--quiet", folder=self.folder, **options)
        self.assertEqual(done.returncode, code, f"clatter-{stage}: {done.stderr}")
        lines = done.stderr.strip().splitlines()
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertTrue(lines[0].startswith(f"clatter-{stage}: error: "), lines[0])
        for text in says:
            self.assertIn(text, lines[0])
        self.assertEqual(before, fingerprint(output) if output.exists() else None, "the older artefact was touched")
        self.assertFalse((self.folder / (arguments[-1] + ".part")).exists(), "a part file is left")
        self.show_refusal(lines[0])

    def show_refusal(self, line):
        """The first refusal of a test, for the page of `make hard`."""
        if not getattr(self, "shown", False):
            observed(f"refused: {line.partition('error: ')[2]}")
        self.shown = True
