# SPDX-License-Identifier: GPL-3.0-or-later
"""The same mesh written in other ways, for bench/stability.py: other numbers of nodes and cells, another position, a mirror image, another scale,
and as a deck in other units."""
import re
from dataclasses import dataclass, field

import h5py
import numpy as np

# Rotation of a tet10 and a tri6 that changes their orientation: two corners change places, and with them the edges' mid-side nodes.
MIRRORED = {"tet10": [0, 2, 1, 3, 6, 5, 4, 7, 9, 8], "tri6": [0, 2, 1, 5, 4, 3]}
ABAQUS_TET10 = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]
ABAQUS_FACES = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]


@dataclass
class Motion:
    """x' = scale R x + shift; det R = -1 mirrors. Time is scaled as lengths are: velocities, stresses and material stay."""
    R: np.ndarray = field(default_factory=lambda: np.eye(3))
    shift: np.ndarray = field(default_factory=lambda: np.zeros(3))
    scale: float = 1.0

    def of(self, points):
        """Points, rows of k x 3 [m]."""
        return self.scale * (points @ self.R.T) + self.shift

    def back(self, points):
        return ((points - self.shift) / self.scale) @ self.R

    def direction_back(self, vectors):
        """Directions, forces or velocities, rows of k x 3, in the axes of the unmoved model."""
        return vectors @ self.R


def rotation(axis, angle_deg):
    """Rodrigues' formula."""
    n = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    angle = np.radians(angle_deg)
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def permute(path, seed=1):
    """Renumbers the nodes of a mesh file at random, and shuffles the cells of each region, the faces of each surface and the nodes of each set."""
    random = np.random.default_rng(seed)
    with h5py.File(path, "r+") as mesh:
        number = random.permutation(len(mesh["nodes"]))  # new number of each node
        old = np.argsort(number)
        mesh["nodes"][...] = mesh["nodes"][()][old]
        for block in mesh["cells"].values():
            block["nodes"][...] = random.permutation(number[block["nodes"][()]])
        for surface in mesh["surfaces"].values():
            for faces in surface.values():
                faces[...] = random.permutation(number[faces[()]])
        for nodes in mesh["node_sets"].values():
            nodes[...] = np.sort(number[nodes[()]])


def move(path, motion):
    """Moves the nodes of a mesh file of tet10; a mirror image keeps its cells and faces right side out."""
    with h5py.File(path, "r+") as mesh:
        mesh["nodes"][...] = motion.of(mesh["nodes"][()])
        if np.linalg.det(motion.R) > 0:
            return
        for block in mesh["cells"].values():
            block["nodes"][...] = block["nodes"][()][:, MIRRORED["tet10"]]
        for surface in mesh["surfaces"].values():
            surface["tri6"][...] = surface["tri6"][()][:, MIRRORED["tri6"]]


def moved_text(text, points=(), directions=(), motion=Motion(), **factors):
    """A TOML text whose keys `points` and `directions` hold vectors (m) that follow the motion; numbers of the keys in `factors` are multiplied."""
    def vector(match):
        old = np.array([float(word) for word in match[2].split(",")])
        new = motion.of(old) if match[1] in points else motion.R @ old * factors.get(match[1], 1.0)
        return f"{match[1]} = [{', '.join(repr(float(v)) for v in new)}]"

    names = "|".join((*points, *directions))
    text = re.sub(rf"(?m)^({names}) = \[([^\]]*)\]", vector, text) if names else text
    for key, factor in factors.items():
        text = re.sub(rf"(?m)^({key}) = ([-+.\deE]+)", lambda match: f"{match[1]} = {float(match[2]) * factor!r}", text)
    return text


def deck(mesh_path, path, metre, newton, tip):
    """The beam as an Abaqus deck. `metre` and `newton`: units of the deck in SI (mm-t-s: 1e-3, 1); time in seconds. `tip`: position of its reference
    node [m]; returns its number."""
    with h5py.File(mesh_path) as mesh:
        nodes, cells = mesh["nodes"][()] / metre, mesh["cells/0/nodes"][()]
        sides = {name: mesh[f"surfaces/{name}/tri6"][()] for name in ("x_min", "x_max")}
    kilogram = newton / metre  # the deck's unit of mass: 1 s of time
    reference = len(nodes) + 1

    def point(number, x):
        return f"{number}, " + ", ".join(repr(float(value)) for value in x)

    face_of = {frozenset(cell[list(corners)]): f"{c + 1}, S{f + 1}" for c, cell in enumerate(cells) for f, corners in enumerate(ABAQUS_FACES)}
    lines = ["*HEADING", "beam", "*NODE"] + [point(k + 1, x) for k, x in enumerate(nodes)] + [point(reference, np.asarray(tip) / metre)]
    lines += ["*ELEMENT, TYPE=C3D10, ELSET=bar"]
    lines += [f"{c + 1}, " + ", ".join(str(n + 1) for n in cell[ABAQUS_TET10]) for c, cell in enumerate(cells)]
    lines += ["*NSET, NSET=x_min"] + [f"{n + 1}," for n in np.unique(sides["x_min"])]
    lines += ["*SURFACE, NAME=x_max, TYPE=ELEMENT"] + [face_of[frozenset(face[:3])] for face in sides["x_max"]]
    lines += ["*MATERIAL, NAME=steel", "*ELASTIC", f"{210e9 * metre**2 / newton!r}, 0.3", "*DENSITY", f"{7850 * metre**3 / kilogram!r}",
              "*SOLID SECTION, ELSET=bar, MATERIAL=steel", f"*COUPLING, CONSTRAINT NAME=tip, REF NODE={reference}, SURFACE=x_max",
              "*DISTRIBUTING", "1, 6", "*BOUNDARY", "x_min, 1, 3", "*STEP", "*STATIC", "*CLOAD", f"{reference}, 3, {1 / newton!r}", "*END STEP"]
    path.write_text("\n".join(lines) + "\n")
    return reference
