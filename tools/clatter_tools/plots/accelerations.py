# SPDX-License-Identifier: GPL-3.0-or-later
"""Acceleration of liner and block around firing TDC, as in figures 9 and 10 of the paper."""
from clatter import fields
from clatter.artefact import BadArtefact, dataset
from clatter.histories import angle_zero
from .. import slap
from . import octaves, style

SENSORS = ("liner", "block")
SHOWN_MS = (-1.0, 5.0)


def draw(files):
    """Liner beside block at equal scales: acceleration over the cycle, around firing TDC, and in third octaves (field files)."""
    runs = [(run, fields.piece(run, "cycle")) for run in style.open_all(files, "field")]
    sensors = [part for part in SENSORS if all(fields.pick_sensor(run, at, part) for run, at in runs)]
    if not sensors:
        raise BadArtefact(f"{files[0]}: found no sensor whose name contains liner or block")
    figure, axes = style.figure(3, len(sensors), height=2.5, sharey="row")
    for column, part in zip(axes.T, sensors):
        signals = [slap.band_limited(run, fields.pick_sensor(run, at, part), at) for run, at in runs]
        draw_cycle(column[0], runs, signals)
        draw_zoom(column[1], runs, signals)
        sensor = fields.pick_sensor(*runs[0], part)
        column[0].set_title(f"{part}: {fields.channel_name(runs[0][0], sensor, fields.channel(runs[0][0], sensor))}", loc="left")
    draw_bands(axes[2], runs, sensors)
    for axis in axes[:2, 0]:
        axis.set_ylabel("acceleration [m/s²]")
    style.legend_above(figure, axes[0, 0].get_lines()[:len(runs)], [style.label(run) for run, _ in runs],
                       f"Acceleration toward the thrust side, {band(*runs[0])}")
    return figure


def band(run, at):
    """The band of the signals in words: "300 to 6000 Hz (limit of the basis)"."""
    top = dataset(run, f"{at}/frequency_hz")[-1]
    limited = abs(top - fields.basis_limit(run)) < 1e-3 * top
    return f"{slap.FROM_HZ:g} to {top:.0f} Hz{' (limit of the basis)' if limited else ''}"


def colour(number):
    """Colour and order of drawing of a run: the first one on top."""
    return {"color": style.COLOURS[number % len(style.COLOURS)], "zorder": 3 - 0.1 * number}


def draw_cycle(axis, runs, signals):
    """Over the crank angle where the file has it."""
    for number, ((run, at), (time, values)) in enumerate(zip(runs, signals)):
        turned = f"{at}/crank_angle_deg" in run
        x = dataset(run, f"{at}/crank_angle_deg") if turned else 1e3 * time
        axis.plot(x, values, linewidth=0.6, **colour(number))
    if turned:
        style.crank_axis(axis, x, angle_zero(runs[0][0]), 180)
    else:
        axis.set_xlabel(f"time after {angle_zero(runs[0][0])} [ms]")
    style.mark_zero(axis)


def draw_zoom(axis, runs, signals):
    for number, (time, values) in enumerate(signals):
        window = (time * 1e3 >= SHOWN_MS[0]) & (time * 1e3 <= SHOWN_MS[1])
        axis.plot(time[window] * 1e3, values[window], linewidth=1.2, **colour(number))
    style.mark_zero(axis)
    axis.set_xlim(*SHOWN_MS)
    axis.set_xlabel(f"time after {angle_zero(runs[0][0])} [ms]")


def draw_bands(axes, runs, sensors):
    drawn = []
    for axis, part in zip(axes, sensors):
        for number, (run, at) in enumerate(runs):
            levels, reference = fields.acceleration_bands(run, fields.pick_sensor(run, at, part))
            octaves.draw_stairs(axis, run, at, levels, **colour(number))
            drawn.append(levels)
    for axis in axes:
        octaves.finish(axis, *runs[0], drawn, from_hz=slap.FROM_HZ)
    axes[0].set_ylabel(f"third octave\n[dB re {reference}]")
