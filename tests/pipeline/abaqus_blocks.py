# SPDX-License-Identifier: GPL-3.0-or-later
"""The bar of abaqus_dialects.py in cells of every type, as blocks of a deck.

Node 1 + i + 3 j + 9 k is at (5 i, 5 j, 5 k) mm: corners of 32 cells of 5 mm for linear hexahedra, corners and middles of
edges and faces of 4 cells of 10 mm for all other types.
"""
import itertools

from abaqus_dialects import LAYER, corners, nodes

LINES = 16  # numbers in a line of a set


def number(i, j, k):
    return 1 + i + 3 * j + LAYER * k


def middle(a, b):
    """The node between two nodes."""
    return (a + b) // 2


def large_corners(layer):
    """Corners of a cell of 10 mm."""
    ring = [(0, 0), (2, 0), (2, 2), (0, 2)]
    return [number(i, j, 2 * layer + k) for k in (0, 2) for i, j in ring]


def hexahedra():
    edges = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
    return [c + [middle(c[a], c[b]) for a, b in edges] for c in map(large_corners, range(4))]


def wedges():
    edges = ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5))
    halves = [[c[k] for k in half] for c in map(large_corners, range(4)) for half in ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))]
    return [half + [middle(half[a], half[b]) for a, b in edges] for half in halves]


def tetrahedra():
    """Six of each cell, along its diagonal."""
    found = []
    for layer in range(4):
        for order in itertools.permutations(range(3)):
            at = [0, 0, 2 * layer]
            path = [number(*at)]
            for axis in order:
                at[axis] += 2
                path.append(number(*at))
            if order in ((0, 2, 1), (1, 0, 2), (2, 1, 0)):
                path[1], path[2] = path[2], path[1]
            edges = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
            found.append(path + [middle(path[a], path[b]) for a, b in edges])
    return found


def elements(kind):
    """Nodes of each element of a type."""
    if kind.startswith("C3D8"):
        return [corners(c) for c in range(1, 33)]
    of, count = {"C3D20": (hexahedra, 20), "C3D20R": (hexahedra, 20), "C3D6": (wedges, 6), "C3D15": (wedges, 15),
                 "C3D4": (tetrahedra, 4), "C3D10": (tetrahedra, 10), "C3D10M": (tetrahedra, 10)}[kind]
    return [one[:count] for one in of()]


def listed(numbers, width=LINES):
    """Numbers in lines of a deck."""
    numbers = list(numbers)
    rows = [numbers[k:k + width] for k in range(0, len(numbers), width)]
    return "".join(", ".join(map(str, row)) + "\n" for row in rows)


def element_lines(kind, first=1, width=LINES, shift=0, of=None):
    """Data of *ELEMENT; long ones go on in the next line."""
    out = ""
    for row, one in enumerate(elements(kind) if of is None else of):
        words = [str(first + row), *(str(n + shift) for n in one)]
        lines = [", ".join(words[k:k + width]) for k in range(0, len(words), width)]
        out += ",\n".join(lines) + "\n"
    return out


def used(kind):
    return sorted({n for one in elements(kind) for n in one})


def mesh_of(kind, elset="BAR", nset="NALL"):
    """Plain *NODE and *ELEMENT."""
    return f"*NODE, NSET={nset}\n{nodes(used(kind))}*ELEMENT, TYPE={kind}, ELSET={elset}\n{element_lines(kind)}"


def at_z(kind, layer):
    """Nodes of a layer of 9, 0 to 8."""
    return [n for n in used(kind) if (n - 1) // LAYER == layer]


# Corners of the faces of an element type in Abaqus's order, counted from 0.
FACES = {
    "C3D8": ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)),
    "C3D6": ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    "C3D4": ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)),
}
FACES |= {"C3D20": FACES["C3D8"], "C3D20R": FACES["C3D8"], "C3D15": FACES["C3D6"], "C3D10": FACES["C3D4"],
          "C3D10M": FACES["C3D4"], "C3D8R": FACES["C3D8"], "C3D8I": FACES["C3D8"]}


def faces_on(kind, numbers):
    """(element, face from 1) of all faces whose corners are all among these nodes."""
    inside = set(numbers)
    return [(row + 1, face + 1) for row, one in enumerate(elements(kind))
            for face, places in enumerate(FACES[kind]) if all(one[p] in inside for p in places)]


def on_side(kind):
    """Nodes with x = 0."""
    return [n for n in used(kind) if (n - 1) % 3 == 0]
