# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of the oil film between skirt and liner at some crank angles."""
import numpy as np

from clatter.artefact import BadArtefact, dataset
from clatter.films import contacts
from clatter.histories import angle_zero, centred, last_cycle_of_fields
from . import style

AT_DEG = (-20.0, 0.0, 10.0, 20.0, 90.0)
# Dataset, name, factor, unit, colours, and the share of the values that the scale holds: of the gap it is the narrower half.
QUANTITIES = [
    ("pressure", "film pressure", 1e-6, "MPa", "viridis", 1.0),
    ("fill", "filled share", 1.0, "1", "cividis", 1.0),
    ("gap", "gap", 1e6, "µm", "cividis_r", 0.5),
    ("contact_pressure", "contact pressure", 1e-6, "MPa", "viridis", 1.0),
]


def draw(files, at_deg=AT_DEG):
    """Maps of film pressure, filled share, gap and contact pressure of the first cylinder by crank angle (one run with film maps)."""
    run = style.open_one(files, "run")
    cylinder, contact = next(iter(contacts(run)), ("", None))
    if contact is None:
        raise BadArtefact(f"{run.filename}: film: found no maps, expected those of a scene with time.film_every_deg")
    pads = {name: contact[name] for name in sorted(contact, reverse=True) if "axial" in contact[name]}  # thrust before antithrust
    frames, angles = nearest_frames(dataset(run, "film/crank_angle_deg"), at_deg)
    shown = [one for one in QUANTITIES if any(one[0] in pad and pad[one[0]][frames].max() > 0.0 for pad in pads.values())]
    figure = style.plt.figure(figsize=(style.WIDTH, 1.9 * len(shown) + 1.3), constrained_layout=False)
    widths = ([1.0] * len(pads) + [0.25]) * len(frames) + [0.35]  # maps, a space after each crank angle, the scale
    grid = figure.add_gridspec(len(shown), len(widths), width_ratios=widths, left=0.085, right=0.9, wspace=0.12, hspace=0.08,
                               bottom=0.62 / figure.get_figheight(), top=1.0 - 0.62 / figure.get_figheight())
    for row, quantity in enumerate(shown):
        axes, image = draw_row(figure, grid, row, pads, quantity, frames)
        _, name, _, unit, _, held = quantity
        figure.colorbar(image, cax=figure.add_subplot(grid[row, -1]), label=f"{name} [{unit}]", extend="max" if held < 1.0 else "neither")
        if row == 0:
            for axis, angle in zip(axes[::len(pads)], angles):
                axis.set_title(angle_zero(run) if abs(angle) < 0.5 else f"{angle:+.0f} deg", loc="left", fontsize=10)
    label_pads(axes, pads)
    figure.text(0.49, 0.02, "angle around the piston [deg]: 0 thrust side, 180 antithrust side", ha="center", fontsize=10)
    figure.text(0.01, 0.5, "height above the pin [mm]", va="center", rotation=90, fontsize=10)
    style.headline(figure, f"Contact of skirt and liner by crank angle: {style.label(run, cylinder)}")
    return figure


def nearest_frames(recorded, wanted):
    """(rows of the last cycle, ascending; their crank angles from firing TDC) of the maps nearest to the wanted angles."""
    window = np.arange(len(recorded))[last_cycle_of_fields(recorded)]
    degrees, order = centred(recorded[window])
    chosen = sorted({int(np.argmin(np.abs(degrees - angle))) for angle in wanted})
    return [int(window[order[k]]) for k in chosen], [round(float(degrees[k]), 3) for k in chosen]


def draw_row(figure, grid, row, pads, quantity, frames):
    """One quantity at all crank angles, with one scale; returns its axes, those of an angle together, and the last image."""
    key, _, factor, _, colours, held = quantity
    values = {name: [factor * pad[key][frame] for frame in frames] for name, pad in pads.items() if key in pad}
    top = np.quantile(list(values.values()), held)
    axes = []
    for column in range(len(frames)):
        for k, (name, pad) in enumerate(pads.items()):
            axis = figure.add_subplot(grid[row, column * (len(pads) + 1) + k])
            image = axis.pcolormesh(edges(pad["angle_deg"][()]), 1e3 * edges(pad["axial"][()]), values[name][column].T, cmap=colours,
                                    vmin=0.0, vmax=top, rasterized=True)
            axis.grid(False)
            axis.tick_params(labelsize=9)
            axis.set_xticks([])
            if axes:
                axis.set_yticks([])
                axis.spines["left"].set_visible(False)
            axes.append(axis)
    return axes, image


def edges(centres):
    """Edges of cells about their centres."""
    middle = 0.5 * (centres[1:] + centres[:-1])
    return np.concatenate([[2 * centres[0] - middle[0]], middle, [2 * centres[-1] - middle[-1]]])


def label_pads(axes, pads):
    """The middle angle of each pad, or both sides of an entire skirt, below the lowest row."""
    for k, axis in enumerate(axes):
        angles = list(pads.values())[k % len(pads)]["angle_deg"][()]
        entire = angles[-1] - angles[0] > 180.0
        shown = [0.0, 180.0] if entire else [float(np.mean(angles))]
        axis.set_xticks(shown, [f"{angle:.0f}" for angle in shown])
