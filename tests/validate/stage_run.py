# SPDX-License-Identifier: GPL-3.0-or-later
"""The executables of clatter, one call each."""
import os
import pathlib
import subprocess

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("CLATTER_BIN", SOURCE / "build/release/bin"))


def run(stage, *arguments, folder):
    """Runs clatter-<stage> quietly in `folder`; RuntimeError with its message when it fails."""
    done = subprocess.run([BIN / f"clatter-{stage}", *map(str, arguments), "--quiet"], cwd=folder, text=True,
                          capture_output=True, timeout=600)
    if done.returncode:
        raise RuntimeError(f"clatter-{stage}: {done.stderr.strip()}")
