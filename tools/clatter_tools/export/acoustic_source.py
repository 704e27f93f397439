# SPDX-License-Identifier: GPL-3.0-or-later
"""The acoustic skin and its motion from a field file (clatter/field/1) of a run with a sound file: lines only."""
import dataclasses

import numpy as np

from clatter.artefact import BadArtefact, dataset
from .field_source import checked, read_origin
from .surface import Motion, Surface

STORED = "acoustic_normal_velocity"


def read_surface(file):
    """The closed surface of flat triangles around the body."""
    if "acoustic" not in file:
        raise BadArtefact(f"{file.filename}: acoustic: missing, expected the acoustic skin; it needs lines and sound = \"part.sound.h5\" in "
                          "the field.toml, and a sound file of this version of clatter")
    nodes, triangles = dataset(file, "acoustic/nodes"), dataset(file, "acoustic/triangles")
    nodes, triangles = checked(file, "acoustic/nodes", (len(nodes), 3)), checked(file, "acoustic/triangles", (len(triangles), 3))
    if len(triangles) == 0 or triangles.min() < 0 or triangles.max() >= len(nodes):
        raise BadArtefact(f"{file.filename}: acoustic/triangles: found nodes outside of 0 to {len(nodes) - 1}")
    return Surface.flat(nodes, triangles, {})


def nodal_velocity(surface, normal_velocity):
    """n x 3 at the nodes: mean of v_n n over the triangles around each, weighed by their areas, plus one constant along the mean
    normals, so that linear interpolation has the volume flow of the triangles."""
    def at_nodes(vectors):
        return np.stack([np.bincount(surface.triangles.ravel(), np.repeat(vectors[:, axis], 3), len(surface.nodes)) for axis in range(3)], axis=1)

    def flow(velocity):
        return np.einsum("f,fc,fc->", surface.area, surface.normal, velocity[surface.triangles].mean(axis=1))

    area = np.bincount(surface.triangles.ravel(), np.repeat(surface.area, 3), len(surface.nodes))
    vectors = (surface.area * normal_velocity)[:, None] * surface.normal
    parts = [at_nodes(part) / area[:, None] for part in (vectors.real, vectors.imag)]
    velocity = parts[0] + 1j * parts[1]
    normal = at_nodes(surface.area[:, None] * surface.normal) / area[:, None]
    return velocity + (np.sum(surface.area * normal_velocity) - flow(velocity)) / flow(normal) * normal


def read_motion(file, surface):
    """The lines of an open field file; the normal velocity is stored, the velocity at nodes made from it."""
    at = dataset(file, "lines/frequency_hz")

    def read(quantity, step):
        real, imag = (checked(file, f"lines/{STORED}_{part}/{step:05d}", (len(surface.triangles),)) for part in ("re", "im"))
        values = real + 1j * imag
        return values if quantity == "normal_velocity" else nodal_velocity(surface, values)

    origin = read_origin(file)
    return Motion("lines", checked(file, "lines/frequency_hz", at.shape), ("normal_velocity", "velocity"), read,
                  dataclasses.replace(origin, body=f"acoustic skin of {origin.body}"))
