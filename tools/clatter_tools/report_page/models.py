# SPDX-License-Identifier: GPL-3.0-or-later
"""Reduced against full models, mode by mode, as clatter-modal compared them (*.compare.txt), with the MAC of all pairs (*.mac.csv)."""
import re

import numpy as np

from clatter.artefact import BadArtefact, stem

ROW = re.compile(r"^\s*(\d+)\s+([\d.eE+-]+)\s+([\d.eE+-]+)\s+([\d.eE+-]+)\s+([\d.eE+-]+)\s*$", re.M)


def collect(folder, pack):
    """Tables (mode, full [Hz], reduced [Hz], error [%], MAC) with the conclusion of each comparison, and the matrix where it was written."""
    found = []
    for path in sorted(folder.path.glob("*.compare.txt")):
        lines = path.read_text().strip()
        rows = [[float(cell) for cell in row] for row in ROW.findall(lines)]
        if rows:
            found.append({"name": stem(path), "rows": rows, "conclusion": lines.splitlines()[-1],
                          "mac": matrix(path.with_name(f"{stem(path)}.mac.csv"), pack)})
    return found or None


def matrix(path, pack):
    """Frequencies of rows (full model) and columns (reduced model), and the MAC of each pair; None without the file."""
    if not path.exists():
        return None
    lines = [line.split(",") for line in path.read_text().splitlines() if line and not line.startswith("#")]
    try:
        columns, values = np.array(lines[0][1:], float), np.array(lines[1:], float)
        if len(columns) == 0 or values.shape[1:] != (len(columns) + 1,) or not ((values[:, 1:] >= 0.0) & (values[:, 1:] <= 1.0)).all():
            raise ValueError
    except (ValueError, IndexError):
        raise BadArtefact(f"{path}: found no matrix of numbers from 0 to 1 under a row of frequencies, expected that of clatter-modal compare "
                          "--mac") from None
    return {"rows": values[:, 0], "columns": columns, "values": pack.add("curves", values[:, 1:])}
