# SPDX-License-Identifier: GPL-3.0-or-later
"""Pressure and travel of hydraulic tensioners."""
from clatter.artefact import BadArtefact
from clatter.histories import has
from . import style
from .over_cycle import LastCycle, named

ROWS = (("pressure", "Pa", 1e-5, "chamber pressure\n[bar, absolute]"), ("travel", "m", 1e3, "travel [mm]"), ("force", "N", 1.0, "force [N]"))


def tensioners(run):
    """Names of histories of tensioners without their ends."""
    return [name.removesuffix("_pressure") for name in named(run, "tensioner", "_pressure")
            if has(run, name.removesuffix("_pressure") + "_travel")]


def draw(files):
    """Pressure, travel and force of hydraulic tensioners over the last cycle (run files with [[tensioner]])."""
    found = [(run, name) for run in style.open_all(files, "run") for name in tensioners(run)]
    if not found:
        raise BadArtefact("tensioner: none of these runs has one (history tensioner_<name>_pressure)")
    figure, axes = style.figure(len(ROWS), height=1.8, sharex=True)
    for run, name in found:
        cycle = LastCycle(run)
        for axis, (what, unit, scale, text) in zip(axes[:, 0], ROWS):
            axis.plot(cycle.x, scale * cycle.history(f"{name}_{what}", unit), label=title(run, name, found))
            axis.set_ylabel(text)
    for axis in axes[::2, 0]:
        axis.set_ylim(bottom=min(0.0, axis.get_ylim()[0]))
    cycle.finish(axes[-1, 0])
    style.headline(figure, "Hydraulic tensioner")
    style.legend(axes[0, 0])
    return figure


def title(run, name, found):
    """Of a line: the run, with the tensioner's name where a run has several."""
    several = sum(other is run for other, _ in found) > 1
    return style.label(run, name.removeprefix("tensioner_") if several else "")
