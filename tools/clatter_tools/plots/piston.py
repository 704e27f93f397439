# SPDX-License-Identifier: GPL-3.0-or-later
"""The piston's secondary motion over crank angle."""
from . import style
from ..artefact import BadArtefact
from ..histories import centred, crank_angle, cylinders, has, history, last_cycle, of


def draw(files):
    """Lateral position and tilt of the piston, and the side force, over the last cycle (run files)."""
    pistons = [(run, name) for run in style.open_all(files, "run") for name in cylinders(run, "piston_lateral")]
    if not pistons:
        raise BadArtefact("piston: none of these runs has a piston (history piston_lateral)")
    with_force = all(has(run, of(name, "side_force")) for run, name in pistons)
    figure, axes = style.figure(3 if with_force else 2, height=2.1, sharex=True)
    axes = axes[:, 0]
    for run, cylinder in pistons:
        angle = crank_angle(run)
        window = last_cycle(angle)
        degrees, order = centred(angle[window])
        take = lambda name, unit: history(run, of(cylinder, name), unit)[window][order]  # noqa: E731
        axes[0].plot(degrees, take("piston_lateral", "m") * 1e6, label=style.label(run, cylinder))
        axes[1].plot(degrees, take("piston_tilt", "rad") * 1e3)
        if with_force:
            axes[2].plot(degrees, take("side_force", "N") / 1e3)
    axes[0].set_ylabel("lateral position\nof the pin [µm]")
    axes[1].set_ylabel("tilt [mrad]")
    style.headline(figure, "Secondary motion of the piston (positive: toward the thrust side)")
    if with_force:
        axes[2].set_ylabel("side force [kN]")
    for axis in axes:
        style.mark_firing(axis)
    style.crank_axis(axes[-1], degrees)
    style.legend(axes[0])
    return figure
