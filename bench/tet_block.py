# SPDX-License-Identifier: GPL-3.0-or-later
"""A block of n x n x n cubes, six tet10 or one hex8 each, as arrays and as decks; n = 30 has 227 000 nodes of tet10, n = 50 a
million."""
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


def hex_block(n):
    """The nodes of n x n x n cubes, and the hex8 of each, nodes from 1."""
    side = n + 1
    z, y, x = np.meshgrid(*[np.arange(side)] * 3, indexing="ij")
    nodes = np.column_stack([x.ravel(), y.ravel(), z.ravel()]) * (0.1 / n)
    k, j, i = (a.ravel() for a in np.meshgrid(*[np.arange(n)] * 3, indexing="ij"))
    ring = [(0, 0), (1, 0), (1, 1), (0, 1)]
    return nodes, np.column_stack([i + a + side * (j + b) + side**2 * (k + c) + 1 for c in (0, 1) for a, b in ring])


ABAQUS = {10: "C3D10", 8: "C3D8"}
NASTRAN = {10: "CTETRA", 8: "CHEXA"}


def write_abaqus(path, nodes, cells):
    with open(path, "w") as file:
        file.write("*NODE, NSET=NALL\n")
        np.savetxt(file, np.column_stack([np.arange(1, len(nodes) + 1), nodes]), "%d, %.12e, %.12e, %.12e")
        file.write(f"*ELEMENT, TYPE={ABAQUS[cells.shape[1]]}, ELSET=EALL\n")
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
                   f"{NASTRAN[cells.shape[1]]:<8}" + 8 * "%8d" + "+\n+       " + (cells.shape[1] - 6) * "%8d")
        file.write("ENDDATA\n")


def make(write, deck, cubes, block=tet_block):
    """Writes the deck of a block in a separate process."""
    apart(lambda: write(deck, *block(cubes)))
