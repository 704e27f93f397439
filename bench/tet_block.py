# SPDX-License-Identifier: GPL-3.0-or-later
"""A block of n x n x n cubes, six tet10 each, as arrays and as decks; n = 30 has 227 000 nodes, n = 50 a million."""
import itertools

import numpy as np

from measured import apart

EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]


def tet_block(n):
    """Nodes on half the cubes' pitch, and the tet10 of each cube along its diagonal, nodes from 1."""
    side = 2 * n + 1
    z, y, x = np.meshgrid(*[np.arange(side)] * 3, indexing="ij")
    nodes = np.column_stack([x.ravel(), y.ravel(), z.ravel()]) * (0.1 / (2 * n))
    cube = np.stack([a.ravel() * 2 for a in np.meshgrid(*[np.arange(n)] * 3, indexing="ij")[::-1]])
    cells = []
    for order in itertools.permutations(range(3)):
        corners = [np.zeros(3, int)]
        for axis in order:
            corners.append(corners[-1] + 2 * np.eye(3, dtype=int)[axis])
        if np.linalg.det(np.array(corners[1:])) < 0:
            corners[1], corners[2] = corners[2], corners[1]
        points = corners + [(corners[a] + corners[b]) // 2 for a, b in EDGES]
        cells.append(np.column_stack([(cube + p[:, None]).T @ [1, side, side**2] + 1 for p in points]))
    return nodes, np.vstack(cells)


def write_abaqus(path, nodes, cells):
    with open(path, "w") as file:
        file.write("*NODE, NSET=NALL\n")
        np.savetxt(file, np.column_stack([np.arange(1, len(nodes) + 1), nodes]), "%d, %.12e, %.12e, %.12e")
        file.write("*ELEMENT, TYPE=C3D10, ELSET=EALL\n")
        np.savetxt(file, np.column_stack([np.arange(1, len(cells) + 1), cells]), "%d", ", ")
        file.write("*MATERIAL, NAME=M\n*ELASTIC\n2.1E11, .3\n*DENSITY\n7800.\n"
                   "*SOLID SECTION, ELSET=EALL, MATERIAL=M\n*STEP\n*NO ANALYSIS\n*END STEP\n")


def write_nastran(path, nodes, cells):
    """Nodes in large fields, cells in small ones: two lines each."""
    with open(path, "w") as file:
        file.write("BEGIN BULK\nPSOLID  1       1\nMAT1    1       2.1+11          .3      7800.\n")
        np.savetxt(file, np.column_stack([np.arange(1, len(nodes) + 1), nodes]),
                   "GRID*   %-16d                %16.9e%16.9e*\n*       %16.9e")
        np.savetxt(file, np.column_stack([np.arange(1, len(cells) + 1), np.ones(len(cells), int), cells]),
                   "CTETRA  " + 8 * "%8d" + "+\n+       " + 4 * "%8d")
        file.write("ENDDATA\n")


def make(write, deck, cubes):
    """Writes the deck in a separate process."""
    apart(lambda: write(deck, *tet_block(cubes)))
