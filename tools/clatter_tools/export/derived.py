# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions made from others: displacement and acceleration of lines, steps that were selected, 6-node triangles split."""
import dataclasses

import numpy as np

from clatter.artefact import BadArtefact
from .surface import Surface

# The four triangles of a 6-node one, its mid-side nodes becoming corners; each keeps its direction.
QUARTERS = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]])


def with_time_derivatives(motion):
    """Lines with displacement v / (i w) and acceleration i w v; frames have what was stored."""
    if not motion.is_complex or "velocity" not in motion.quantities:
        return motion
    power = {"velocity": 0, "displacement": -1, "acceleration": 1}

    def read(quantity, step):
        if quantity not in power:
            return motion.read(quantity, step)
        if motion.at[step] <= 0 and power[quantity]:
            raise BadArtefact(f"{motion.origin.file}: {quantity}: found the frequency {motion.at[step]:g} Hz, expected one above 0")
        return motion.read("velocity", step) * (2j * np.pi * motion.at[step]) ** power[quantity]

    return dataclasses.replace(motion, quantities=(*motion.quantities, *(set(power) - set(motion.quantities))), read=read)


def bounds(text):
    """(low, high) of "low:high" or of one number; None for anything else."""
    try:
        numbers = [float(part) for part in text.split(":")]
    except ValueError:
        return None
    return (numbers[0], numbers[-1]) if len(numbers) in (1, 2) and np.isfinite(numbers).all() else None


def steps_of(motion, selection):
    """Step numbers of "100,200:400": a number selects the nearest step, within 1 % of a frequency or half the distance of
    instants; low:high all between."""
    name, unit = motion.axis
    found = []
    for part in selection.split(","):
        limits = bounds(part)
        if limits is None:
            raise BadArtefact(f"--at {selection}: found {part!r}, expected numbers [{unit}] or ranges low:high, joined by commas")
        low, high = limits
        if ":" in part:
            steps = np.flatnonzero((motion.at >= low) & (motion.at <= high))
        else:
            distance = np.diff(np.sort(motion.at)).min() / 2 if len(motion.at) > 1 else np.inf
            steps = [int(np.argmin(np.abs(motion.at - low)))]
            steps = [s for s in steps if abs(motion.at[s] - low) <= (0.01 * abs(low) if motion.is_complex else 1.001 * distance)]
        if len(steps) == 0:
            raise BadArtefact(f"--at {selection}: found no {name} at {part} {unit}, expected some of {present(motion)}")
        found += list(steps)
    return sorted(set(found))


def present(motion):
    """The steps of a motion for a message: all of a few, else the first, the last and their number."""
    names = [f"{value:.6g}" for value in motion.at]
    return (", ".join(names) if len(names) <= 12 else f"{names[0]} to {names[-1]} ({len(names)} values)") + f" {motion.axis[1]}"


def selected(motion, selection):
    """The motion with the selected steps only."""
    steps = steps_of(motion, selection)
    return dataclasses.replace(motion, at=motion.at[steps], read=lambda quantity, step: motion.read(quantity, steps[step]))


def split(surface, motion):
    """The surface and its motion with each 6-node triangle as four 3-node ones; 3-node surfaces as they are.

    All nodes remain, numbered as before; face 4 k + j is quarter j of face k. The normal velocity of a quarter is that of
    linear interpolation between its nodes plus one constant per parent, so that the four have exactly the parent's volume flow.
    """
    if not surface.is_quadratic:
        return surface, motion
    quarters = np.arange(4)
    panels = {name: (4 * np.asarray(rows, np.int64)[:, None] + quarters).ravel() for name, rows in surface.panels.items()}
    fine = Surface.flat(surface.nodes, surface.triangles[:, QUARTERS].reshape(-1, 3), panels)

    def flow_of_parents(values):
        return (fine.area * values).reshape(-1, 4).sum(axis=1)

    def read(quantity, step):
        values = motion.read(quantity, step)
        if quantity != "normal_velocity":
            return values
        velocity = motion.read("velocity", step)[fine.triangles].mean(axis=1)
        local = np.einsum("fc,fc->f", velocity, fine.normal)
        missing = surface.area * values - flow_of_parents(local)
        return local + np.repeat(missing / flow_of_parents(np.ones(len(local))), 4)

    return fine, dataclasses.replace(motion, read=read)
