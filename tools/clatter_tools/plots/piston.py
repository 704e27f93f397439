# SPDX-License-Identifier: GPL-3.0-or-later
"""The piston's secondary motion over crank angle."""
from . import style
from ..histories import centred, crank_angle, has, history, last_cycle


def draw(files):
    """Lateral position and tilt of the piston, and the side force, over the last cycle (run files)."""
    runs = style.open_all(files, "run")
    with_force = all(has(run, "side_force") for run in runs)
    figure, axes = style.figure(3 if with_force else 2, height=2.1, sharex=True)
    axes = axes[:, 0]
    for run in runs:
        angle = crank_angle(run)
        window = last_cycle(angle)
        degrees, order = centred(angle[window])
        take = lambda name, unit: history(run, name, unit)[window][order]  # noqa: E731
        axes[0].plot(degrees, take("piston_lateral", "m") * 1e6, label=style.label(run))
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
