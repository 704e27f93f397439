# SPDX-License-Identifier: GPL-3.0-or-later
"""Acceleration of liner and block around firing TDC, as in figures 9 and 10 of the paper."""
import numpy as np

from ..artefact import BadArtefact
from .. import fields, slap
from . import octaves, style

SENSORS = ("liner", "block")
SHOWN_MS = (-0.5, 5.0)


def draw(files):
    """Liner and block acceleration around firing TDC, in time and in third octaves (field files)."""
    runs = style.open_all(files, "field")
    sensors = [part for part in SENSORS
               if all(fields.pick_sensor(run, fields.piece(run, "cycle"), part) for run in runs)]
    if not sensors:
        raise BadArtefact(f"{files[0]}: found no sensor whose name contains liner or block")
    figure, axes = style.figure(len(sensors), 2, height=2.7, gridspec_kw={"width_ratios": [1.25, 1]})
    for row, part in zip(axes, sensors):
        draw_time(row[0], runs, part)
        draw_bands(row[1], runs, part)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="upper left", ncol=2)
    figure.suptitle(" ")  # reserves space for the legend
    axes[-1, 0].set_xlabel("time after firing TDC [ms]")
    for axis in axes[:-1, 1]:
        axis.set_xlabel("")
    return figure


def draw_time(axis, runs, part):
    for number, run in enumerate(runs):
        at = fields.piece(run, "cycle")
        time, values = slap.band_limited(run, fields.pick_sensor(run, at, part), at)
        window = (time * 1e3 >= SHOWN_MS[0]) & (time * 1e3 <= SHOWN_MS[1])
        axis.plot(time[window] * 1e3, values[window], label=style.label(run), zorder=3 - 0.1 * number, linewidth=1.1)
    style.mark_firing(axis)
    axis.set_xlim(*SHOWN_MS)
    axis.set_ylabel("acceleration [m/s²]")
    sensor = fields.pick_sensor(run, at, part)
    axis.set_title(f"{part}: {fields.channel_name(run, sensor, fields.channel(run, sensor))}, above {slap.FROM_HZ:g} Hz", loc="left")


def draw_bands(axis, runs, part):
    drawn = []
    for number, run in enumerate(runs):
        at = fields.piece(run, "cycle")
        levels, reference = fields.acceleration_bands(run, fields.pick_sensor(run, at, part))
        octaves.draw_stairs(axis, run, at, levels, color=style.COLOURS[number % len(style.COLOURS)])
        drawn.append(levels)
    octaves.finish(axis, run, at, drawn)
    axis.set_ylabel(f"level [dB re {reference}]")
    axis.set_title("over the cycle", loc="left")
