# SPDX-License-Identifier: GPL-3.0-or-later
"""Reduced against full models, mode by mode, as clatter-modal compared them (*.compare.txt)."""
import re

from ..report import stem

ROW = re.compile(r"^\s*(\d+)\s+([\d.eE+-]+)\s+([\d.eE+-]+)\s+([\d.eE+-]+)\s+([\d.eE+-]+)\s*$", re.M)


def collect(folder):
    """Tables (mode, full [Hz], reduced [Hz], error [%], MAC) with the conclusion of each comparison."""
    found = []
    for path in sorted(folder.path.glob("*.compare.txt")):
        lines = path.read_text().strip()
        rows = [[float(cell) for cell in row] for row in ROW.findall(lines)]
        if rows:
            found.append({"name": stem(path), "rows": rows, "conclusion": lines.splitlines()[-1]})
    return found or None
