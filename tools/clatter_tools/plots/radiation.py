# SPDX-License-Identifier: GPL-3.0-or-later
"""Equivalent radiated power (ERP) of the skin."""
import numpy as np

from ..artefact import dataset
from .. import fields
from . import octaves, style

PANELS = ("exposed", "skin")  # the exposed panel if the file has it


def draw(files):
    """Equivalent radiated power: third octaves A-weighted and plain, and lines (field files)."""
    runs = style.open_all(files, "field")
    figure, axes = style.figure(2, 1, height=2.9)
    draw_bands(axes[0, 0], runs)
    draw_lines(axes[1, 0], runs)
    return figure


def draw_bands(axis, runs):
    drawn = []
    for number, run in enumerate(runs):
        at = fields.piece(run, "cycle", "ftdc")
        where = fields.panel(run, at, *PANELS)
        levels = run[f"{where}/third_octave/erp_db"]
        colour = style.COLOURS[number % len(style.COLOURS)]
        total = f"{style.label(run)}: {run[where].attrs['erp_dba']:.1f} dB(A)"
        octaves.draw_stairs(axis, run, at, levels[()], color=colour, label=total)
        drawn.append(levels[()])
    octaves.finish(axis, run, at, drawn)
    axis.set_ylabel(f"ERP [dB re {levels.attrs['reference'] * 1e12:g} pW]")
    style.headline(axis.figure, f"Equivalent radiated power, panel “{where.rpartition('/')[2]}”")
    style.legend(axis)


def draw_lines(axis, runs):
    for number, run in enumerate(runs):
        at = fields.piece(run, "cycle", "ftdc")
        power = dataset(run, f"{fields.panel(run, at, *PANELS)}/erp")
        frequency = dataset(run, f"{at}/frequency_hz")
        shown = (frequency > 0) & (power > 0)
        axis.plot(frequency[shown], 10 * np.log10(power[shown] / 1e-12), linewidth=0.7,
                  color=style.COLOURS[number % len(style.COLOURS)], zorder=3 - 0.1 * number)
    axis.set_xlim(0, frequency[-1])
    low, high = axis.get_ylim()
    axis.set_ylim(max(low, high - octaves.FLOOR_DB - 20), high)
    axis.set_xlabel("frequency [Hz]")
    axis.set_ylabel("ERP per line [dB re 1 pW]")
    axis.set_title(f"Lines {run[at].attrs['line_spacing_hz']:.1f} Hz apart", loc="left")
