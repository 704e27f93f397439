# SPDX-License-Identifier: GPL-3.0-or-later
"""Named coordinates of a model or a field, and properties that full and reduced models share."""
import typing

import numpy as np

from .artefact import dataset, text
from .errors import BadArtefact


class Set(typing.NamedTuple):
    """Coordinates with one name, c of them: displacements [m] along, or rotations [rad] about a direction at a position."""

    kind: str                # node, bearing, mount, sensor, contact_grid, mean, bolt
    labels: list             # c names, "tip.z"
    position: np.ndarray     # c x 3 [m]
    direction: np.ndarray    # c x 3, unit vectors [1]
    is_rotation: np.ndarray  # c [bool]


class MassProperties(typing.NamedTuple):
    """Of the full model, with the masses of its points."""

    mass: float          # [kg]
    centre: np.ndarray   # 3 [m]
    inertia: np.ndarray  # 3 x 3 about the centre [kg m2]


def read_set(file, path):
    """The Set of a group."""
    position, direction, turns = (dataset(file, f"{path}/{name}") for name in ("position", "direction", "is_rotation"))
    labels = [text(one) for one in dataset(file, f"{path}/labels")]
    return Set(text(file[path].attrs.get("kind", "")), labels, position, direction, turns != 0)


def read_sets(file, path="sets"):
    """{name: Set} of the groups at a path."""
    return {name: read_set(file, f"{path}/{name}") for name in file.get(path, ())}


def pick(file, sets, name, path="sets"):
    """(set, indices within it) of a set's name or of one label; BadArtefact with what there is."""
    if name in sets:
        return name, list(range(len(sets[name].labels)))
    for one, own in sets.items():
        if name in own.labels:
            return one, [own.labels.index(name)]
    known = ", ".join(label for own in sets.values() for label in own.labels[:6]) or "nothing"
    raise BadArtefact(f"{file.filename}: {path}: found no {name}, expected one of {', '.join(sets) or 'no sets'}, or {known}")


def mass_properties(file):
    """MassProperties of a model's file."""
    return MassProperties(float(file["mass"].attrs["mass"]), dataset(file, "mass/centre"), dataset(file, "mass/inertia"))
