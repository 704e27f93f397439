# SPDX-License-Identifier: GPL-3.0-or-later
"""The oil film between skirt and liner."""
from . import style
from ..artefact import BadArtefact
from ..histories import centred, crank_angle, cylinders, history, last_cycle, of


def draw(files):
    """Smallest film thickness over crank angle (run files with a piston-liner contact)."""
    contacts = [(run, name) for run in style.open_all(files, "run") for name in cylinders(run, "film_min")]
    if not contacts:
        raise BadArtefact("film: none of these runs has a piston-liner contact (history film_min)")
    figure, axes = style.figure(height=3.4)
    axis = axes[0, 0]
    lowest = 0.0  # in a dry contact asperities overlap: a gap below 0
    for run, cylinder in contacts:
        angle = crank_angle(run)
        window = last_cycle(angle)
        degrees, order = centred(angle[window])
        gap = history(run, of(cylinder, "film_min"), "m")[window][order] * 1e6
        lowest = min(lowest, 2.0 * gap.min())
        axis.plot(degrees, gap, label=style.label(run, cylinder))
    style.mark_firing(axis)
    style.crank_axis(axis, degrees)
    axis.set_ylim(bottom=lowest)
    axis.set_ylabel("smallest gap [µm]")
    style.headline(figure, "Smallest gap between skirt and liner")
    style.legend(axis)
    return figure
