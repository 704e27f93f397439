# SPDX-License-Identifier: GPL-3.0-or-later
"""Structured meshes of the NAFEMS benchmarks as Abaqus decks.

A grid of bricks on the unit cube is cut into cells and mapped to the part. Every node has three integers: its indices in
a grid twice as fine, where corners are even and a mid-side node is the mean of the ends of its edge.
"""
import itertools

import numpy as np

BRICK = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])
HEX_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
WEDGE_EDGES = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]
TET_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
TET_FACES = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]  # Abaqus' P1 ... P4


def tetrahedra():
    """Six about the diagonal of a brick, all with positive volume."""
    cells = []
    for order in itertools.permutations(range(3)):
        corners = [np.zeros(3, int)]
        for axis in order:
            corners.append(corners[-1] + np.eye(3, dtype=int)[axis])
        if np.linalg.det(np.diff(corners, axis=0)) < 0:
            corners[1], corners[2] = corners[2], corners[1]
        cells.append(np.array(corners))
    return cells


# Cells of a brick, edges with mid-side nodes.
SHAPES = {
    "C3D8": ([BRICK], []),
    "C3D8I": ([BRICK], []),
    "C3D20": ([BRICK], HEX_EDGES),
    "C3D20R": ([BRICK], HEX_EDGES),
    "C3D15": ([BRICK[[0, 1, 2, 4, 5, 6]], BRICK[[0, 2, 3, 4, 6, 7]]], WEDGE_EDGES),
    "C3D10": (tetrahedra(), TET_EDGES),
}


class Grid:
    """nodes: {indices in the fine grid: number}; cells: lists of such indices, in Abaqus' order."""

    def __init__(self, kind, bricks, to_part):
        self.kind, self.to_part = kind, to_part
        self.fine = 2 * np.array(bricks)
        parts, edges = SHAPES[kind]
        self.cells, self.nodes = [], {}
        for first in itertools.product(*map(range, bricks)):
            for part in parts:
                corners = 2 * (np.array(first) + part)
                mid_side_nodes = [(corners[a] + corners[b]) // 2 for a, b in edges]
                cell = [tuple(map(int, place)) for place in (*corners, *mid_side_nodes)]
                self.cells.append(cell)
                for indices in cell:
                    self.nodes.setdefault(indices, len(self.nodes) + 1)

    def where(self, holds):
        """Numbers of the nodes whose indices (i, j, k) in the fine grid fulfil holds(indices, last)."""
        return [number for indices, number in self.nodes.items() if holds(indices, self.fine)]

    def upper_faces(self):
        """(cell number, face label) of the faces on the upper side of the grid."""
        faces = []
        for number, cell in enumerate(self.cells, 1):
            above = [indices[2] == self.fine[2] for indices in cell]
            if self.kind == "C3D10":
                faces += [(number, f"P{f}") for f, face in enumerate(TET_FACES, 1) if all(above[i] for i in face)]
            elif above[7 if self.kind != "C3D15" else 3]:
                faces.append((number, "P2"))
        return faces

    def deck(self, youngs, density, held, pressure=0.0):
        """An Abaqus deck. `held`: (node numbers, first direction, last direction) of each support."""
        lines = ["*NODE"]
        for indices, number in self.nodes.items():
            x, y, z = self.to_part(*(np.array(indices) / self.fine))
            lines.append(f"{number}, {x:.15g}, {y:.15g}, {z:.15g}")
        lines.append(f"*ELEMENT, TYPE={self.kind}, ELSET=BODY")
        for number, cell in enumerate(self.cells, 1):
            words = [number, *(self.nodes[indices] for indices in cell)]
            lines += [", ".join(map(str, words[i:i + 10])) + ("," if i + 10 < len(words) else "")
                      for i in range(0, len(words), 10)]
        lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{youngs}, 0.3", "*DENSITY", f"{density}",
                  "*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL", "*BOUNDARY"]
        lines += [f"{node}, {first}, {last}" for nodes, first, last in held for node in nodes]
        if pressure:
            lines += ["*STEP", "*STATIC", "*DLOAD"]
            lines += [f"{cell}, {face}, {pressure}" for cell, face in self.upper_faces()]
            lines.append("*END STEP")
        return "\n".join(lines) + "\n"


def plate(kind, bricks):
    """FV52: a plate of 10 x 10 x 1 m, u_z = 0 on the four edges of its lower face."""
    grid = Grid(kind, bricks, lambda x, y, z: (10 * x, 10 * y, z))
    edges = grid.where(lambda p, last: p[2] == 0 and (p[0] in (0, last[0]) or p[1] in (0, last[1])))
    return grid.deck(200e9, 8000, [(edges, 3, 3)])


def hard_plate(kind, bricks):
    """The plate of FV52 with sides that hold u_z and their own tangential direction: what plate theory calls hard simple
    support, and what has exact solutions."""
    grid = Grid(kind, bricks, lambda x, y, z: (10 * x, 10 * y, z))
    x_sides = grid.where(lambda p, last: p[0] in (0, last[0]))
    y_sides = grid.where(lambda p, last: p[1] in (0, last[1]))
    return grid.deck(200e9, 8000, [(x_sides, 2, 3), (y_sides, 1, 1), (y_sides, 3, 3)])


def membrane(kind, bricks):
    """FV32: 10 m long, 5 m wide at the held root, 1 m at the tip, 0.05 m thick. One face is held in its plane and the other
    is free, so that stress across the thickness is zero: half of a plate that moves only in its plane."""
    grid = Grid(kind, bricks, lambda x, y, z: (10 * x, (y - 0.5) * (5 - 4 * x), 0.05 * z))
    root = grid.where(lambda p, last: p[0] == 0)
    face = grid.where(lambda p, last: p[2] == 0)
    return grid.deck(200e9, 8000, [(root, 1, 2), (face, 3, 3)])


def toward_zero(t):
    """The unit interval with its points moved toward 0: spacing 1/3 there, 5/3 at 1."""
    return t * (1 + 2 * t) / 3


def ellipse(kind, bricks):
    """LE10: a quarter of an elliptic plate with an elliptic hole, 0.6 m thick, 1 MPa on its upper face. Bricks from the
    hole outward, along the ellipse, through the thickness, all finer toward D = (2, 0, 0.6)."""
    def to_part(r, s, z):
        r, angle = toward_zero(r), 0.5 * np.pi * toward_zero(s)
        from_middle = 2 * z - 1
        height = np.sign(from_middle) * (1 - toward_zero(1 - abs(from_middle)))
        # To a nanometre, so that the deck is the same on machines whose sine differs in the last digit.
        return np.round([(2 + 1.25 * r) * np.cos(angle), (1 + 1.75 * r) * np.sin(angle), 0.3 * (1 + height)], 9)
    grid = Grid(kind, bricks, to_part)
    return grid.deck(210e9, 7800, [
        (grid.where(lambda p, last: p[1] == 0), 2, 2),  # DC
        (grid.where(lambda p, last: p[1] == last[1]), 1, 1),  # AB
        (grid.where(lambda p, last: p[0] == last[0]), 1, 2),  # BC
        (grid.where(lambda p, last: p[0] == last[0] and 2 * p[2] == last[2]), 3, 3),  # the middle of BC
    ], pressure=1e6)
