# SPDX-License-Identifier: GPL-3.0-or-later
"""Level and liner peak over each parameter of a sweep."""
from .. import parameters
from . import style

COLUMNS = 4


def picture(found):
    """`found`: influences of slaps.py, the strongest first; two rows of axes for each line of parameters, the base as a ring."""
    lines = -(-len(found) // COLUMNS)
    figure, axes = style.figure(2 * lines, COLUMNS, height=1.7)
    for axis in axes.flat:
        axis.set_visible(False)
    level = found[0].rows[0].level
    levels = [row.dba for one in found for row in one.rows]
    peaks = [row.slap["peak"] for one in found for row in one.rows]
    for k, one in enumerate(found):
        above, below = (axes[2 * (k // COLUMNS) + j, k % COLUMNS] for j in (0, 1))
        above.set_visible(True)
        below.set_visible(True)
        draw(above, one, [row.dba for row in one.rows], style.COLOURS[0])
        draw(below, one, [row.slap["peak"] for row in one.rows], style.COLOURS[1])
        above.set_title(one.parameter.name, fontsize=9)
        above.tick_params(labelbottom=False)
        above.set_ylim(min(levels) - 1.0, max(levels) + 1.0)
        below.set_yscale("log")
        below.set_ylim(0.8 * min(peaks), 1.25 * max(peaks))
        below.yaxis.set_major_locator(style.matplotlib.ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
        below.yaxis.set_major_formatter(style.matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}"))
        below.yaxis.set_minor_formatter(style.matplotlib.ticker.NullFormatter())
        below.set_xlabel(one.parameter.unit or one.parameter.name, fontsize=8)
        for axis in (above, below):
            axis.tick_params(labelsize=8)
        if k % COLUMNS == 0:
            above.set_ylabel(f"{level}\n[dB(A) re 1 pW]", fontsize=8)
            below.set_ylabel("liner peak\n[m/s²]", fontsize=8)
        else:
            above.tick_params(labelleft=False)
            below.tick_params(labelleft=False, which="both")
    style.headline(figure, f"One parameter at a time, by the change of {level}; ring: the base")
    return figure


def draw(axis, one, values, colour):
    """A curve over the values, or over their names, with the base marked."""
    numbers = all(isinstance(value, (int, float)) for value in one.values)
    x = one.values if numbers else range(len(one.values))
    axis.plot(x, values, marker="o", markersize=4, color=colour)
    for position, value, row in zip(x, values, one.rows):
        if row.name == parameters.BASE:
            axis.plot([position], [value], marker="o", markersize=9, markerfacecolor="none", color=colour)
    if not numbers:
        axis.set_xticks(list(x), [str(value) for value in one.values])
