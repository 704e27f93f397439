# SPDX-License-Identifier: GPL-3.0-or-later
"""Radiated power, A-weighted: sound power by boundary elements beside the equivalent radiated power (ERP)."""
from clatter import fields
from clatter.artefact import dataset
from . import octaves, style
from ..weighting import level_dba

RANGE_DB = 50.0  # of the levels in a picture


def draw(files):
    """A-weighted sound power beside ERP in third octaves and lines; of fields without sound the ERP alone (field files)."""
    runs = [(run, fields.piece(run, "cycle", *fields.pieces(run))) for run in style.open_all(files, "field")]
    sounding = all(fields.sound_power(*one) for one in runs)
    names = ["sound", "erp"] if sounding else ["erp"]
    figure, axes = style.plt.subplot_mosaic([names, ["lines"] * len(names)], figsize=(style.WIDTH, 6.8))
    levels = draw_bands(axes["erp"], runs, fields.radiated_estimate)
    axes["erp"].set_title(fields.radiated_estimate(*runs[0]).name + (":\nan upper estimate" if sounding else ""), loc="left", fontsize=10)
    if sounding:
        levels += draw_bands(axes["sound"], runs, fields.sound_power)
        axes["sound"].set_title("Sound power: boundary elements\n"
                                f"to {min(fields.sound_limit(*one) for one in runs):g} Hz, ERP above", loc="left", fontsize=10)
    for name in names:
        octaves.finish(axes[name], *runs[0], levels, range_db=RANGE_DB)  # equal scales
        axes[name].set_ylabel("third octave [dB(A) re 1 pW]")
    draw_lines(axes["lines"], runs, fields.sound_power if sounding else fields.radiated_estimate)
    style.legend_above(figure, axes["erp"].get_legend_handles_labels()[0], [totals(*one) for one in runs])
    return figure


def totals(run, at):
    """Name of a run and its levels: "film: sound power 88.0, ERP 92.7 dB(A)"."""
    sound, estimate = fields.sound_power(run, at), fields.radiated_estimate(run, at)
    return f"{style.label(run)}: " + (f"sound power {sound.dba:.1f}, " if sound else "") + f"ERP {estimate.dba:.1f} dB(A)"


def draw_bands(axis, runs, kind):
    """Stairs of one kind of power; returns the levels."""
    drawn = []
    for number, (run, at) in enumerate(runs):
        drawn.append(dataset(run, kind(run, at).bands))
        octaves.draw_stairs(axis, run, at, drawn[-1], color=style.COLOURS[number % len(style.COLOURS)], label=style.label(run))
    return drawn


def draw_lines(axis, runs, kind):
    highest = []
    for number, (run, at) in enumerate(runs):
        frequency = dataset(run, f"{at}/frequency_hz")
        levels = level_dba(frequency, dataset(run, kind(run, at).power))
        axis.plot(frequency, levels, linewidth=0.9, color=style.COLOURS[number % len(style.COLOURS)], zorder=3 - 0.1 * number)
        highest.append(levels.max())
    run, at = runs[0]
    axis.set_xlim(0, 1.04 * frequency[-1])
    axis.set_ylim(max(highest) - RANGE_DB, max(highest) + 4)
    axis.set_xlabel("frequency [Hz]")
    axis.set_ylabel("line [dB(A) re 1 pW]")
    name = kind(run, at).name
    axis.set_title(f"{name[0].upper()}{name[1:]}, lines {run[at].attrs['line_spacing_hz']:.1f} Hz apart", loc="left", fontsize=10)
    orders = fields.orders_per_hz(run, at)
    if orders:
        style.order_axis(axis, orders)
    if fields.sound_power(run, at):
        style.mark_limit(axis, fields.sound_limit(run, at), "ERP above")
    if 0.0 < fields.basis_limit(run) <= axis.get_xlim()[1]:
        style.mark_limit(axis, fields.basis_limit(run), "limit of the basis", shade=True)
