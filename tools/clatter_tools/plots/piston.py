# SPDX-License-Identifier: GPL-3.0-or-later
"""The piston's secondary motion over crank angle."""
from clatter.artefact import BadArtefact
from clatter.histories import angle_zero, centred, crank_angle, cylinders, has, history, last_cycle, of
from . import style

# History, unit, factor, name. The last ones are of a contact with the liner.
CURVES = [("piston_lateral", "m", 1e6, "lateral position\nof the pin [µm]"), ("piston_tilt", "rad", 1e3, "tilt [mrad]"),
          ("side_force", "N", 1e-3, "side force [kN]"), ("film_min", "m", 1e6, "smallest gap\nto the liner [µm]")]
AROUND_DEG = (-30, 60)


def draw(files):
    """Lateral position, tilt, side force and smallest gap of the piston over the last cycle and around firing TDC (run files)."""
    pistons = [(run, name) for run in style.open_all(files, "run") for name in cylinders(run, "piston_lateral")]
    if not pistons:
        raise BadArtefact("piston: none of these runs has a piston (history piston_lateral)")
    curves = [one for k, one in enumerate(CURVES) if k < 2 or any(has(run, of(name, one[0])) for run, name in pistons)]
    figure, axes = style.figure(len(curves), 2, height=1.75, sharex="col", sharey="row", gridspec_kw={"width_ratios": [1.5, 1]})
    for row, (name, unit, factor, words) in zip(axes, curves):
        for number, (run, cylinder) in enumerate(pistons):
            if has(run, of(cylinder, name)):
                draw_history(row, run, of(cylinder, name), unit, factor, number)
        row[0].set_ylabel(words)
    for axis in axes.flat:
        style.mark_zero(axis)
    zero = angle_zero(pistons[0][0])
    style.crank_axis(axes[-1, 0], [-360, 360], zero)
    axes[-1, 1].set_xlim(AROUND_DEG)
    axes[-1, 1].set_xticks(range(AROUND_DEG[0], AROUND_DEG[1] + 1, 15))
    axes[-1, 1].set_xlabel("crank angle [deg]")
    axes[0, 1].set_title(f"around {zero}", loc="left", fontsize=10)
    style.legend_above(figure, axes[0, 0].get_lines()[:len(pistons)], [style.label(*one) for one in pistons],
                       "Secondary motion of the piston, positive toward the thrust side")
    return figure


def draw_history(row, run, name, unit, factor, number):
    """One curve over the cycle, and the same around firing TDC."""
    angle = crank_angle(run)
    window = last_cycle(angle)
    degrees, order = centred(angle[window])
    values = factor * history(run, name, unit)[window][order]
    for axis in row:
        axis.plot(degrees, values, linewidth=1.2, color=style.COLOURS[number % len(style.COLOURS)], zorder=3 - 0.1 * number)
