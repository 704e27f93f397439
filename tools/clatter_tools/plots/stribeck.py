# SPDX-License-Identifier: GPL-3.0-or-later
"""Stribeck curve of a skirt: friction coefficient over viscosity times speed over load."""
import dataclasses

import numpy as np

from clatter import artefact
from clatter.artefact import BadArtefact
from clatter.histories import crank_angle, history, last_cycle
from . import style


@dataclasses.dataclass
class Point:
    """Means of one run over its last cycle, by crank angle."""
    hersey: float       # viscosity times mean piston speed over the side force on the length of a bore [1]
    coefficient: float  # mean |friction| over mean |side force| [1]
    share: float        # of the asperities in the load, weighted by the side force [1]


def number(run, key):
    """A number of the resolved configuration."""
    for line in artefact.configuration(run).splitlines():
        name, _, value = line.partition(" = ")
        if name == key:
            return float(value)
    raise BadArtefact(f"{run.filename}: config: found no {key}, expected a run of [engine] and [contact]")


def point(run):
    """The Point of a run; BadArtefact where its viscosity is no single number or it has no contact."""
    angle = crank_angle(run)
    window = last_cycle(angle)
    friction, side = (np.abs(history(run, name, "N")[window]) for name in ("friction_force", "side_force"))
    share = history(run, "asperity_share", "1")[window]
    angle = angle[window]

    def mean(values):
        return np.sum(0.5 * (values[1:] + values[:-1]) * np.diff(angle)) / (angle[-1] - angle[0])

    laws = {line for line in artefact.configuration(run).splitlines() if line.startswith("contact.oil.law = ")}
    if laws - {'contact.oil.law = "constant"'}:
        raise BadArtefact(f"{run.filename}: contact.oil.law: found a law over temperature, expected one viscosity")
    speed = 2.0 * number(run, "engine.stroke_mm") * 1e-3 * number(run, "engine.speed_rpm") / 60.0
    load = mean(side)
    if not load > 0.0:
        raise BadArtefact(f"{run.filename}: history/side_force: found no load, expected a piston in contact")
    return Point(number(run, "contact.viscosity_pa_s") * speed * number(run, "contact.bore_mm") * 1e-3 / load,
                 mean(friction) / load, mean(share * side) / load)


def draw(files):
    """Friction coefficient and asperity share over viscosity, speed and load (run files, one a point)."""
    runs = style.open_all(files, "run")
    for run in runs:
        if "history/friction_force" not in run or "history/side_force" not in run:
            raise BadArtefact(f"{run.filename}: history: found no friction_force, expected a piston in its liner")
    points = sorted((point(run) for run in runs), key=lambda one: one.hersey)
    if len(points) < 2:
        raise BadArtefact("stribeck: found one run, expected at least two, as of `clatter sweep`")
    hersey = [one.hersey for one in points]
    figure, axes = style.figure(2, height=2.3, sharex=True)
    axes = axes[:, 0]
    axes[0].loglog(hersey, [one.coefficient for one in points], marker="o", markersize=4)
    least = min(points, key=lambda one: one.coefficient)
    axes[0].annotate(f"{least.coefficient:.4f}", (least.hersey, least.coefficient), textcoords="offset points", xytext=(0, 6), ha="center",
                     fontsize=8)
    axes[0].set_ylabel("friction coefficient\n|friction| / |side force|")
    axes[1].semilogx(hersey, [100.0 * one.share for one in points], marker="o", markersize=4, color=style.COLOURS[1])
    axes[1].set_ylabel("asperities' share\nof the load [%]")
    axes[1].set_xlabel("viscosity × mean piston speed × bore / mean side force")
    style.headline(figure, "Stribeck curve of the skirt")
    return figure
