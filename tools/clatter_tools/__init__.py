# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads clatter's artefacts: information, reports and pictures."""
import pathlib
import sys

PACKAGE = pathlib.Path(__file__).resolve().parents[2] / "python"  # of the source tree; an installation has it beside this folder
if (PACKAGE / "clatter").is_dir():
    sys.path.insert(0, str(PACKAGE))
