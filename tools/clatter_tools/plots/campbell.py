# SPDX-License-Identifier: GPL-3.0-or-later
"""Campbell diagram and order cuts over the speed of several runs, as in figure 6 of the paper; the orders of one run."""
import numpy as np
from matplotlib.colors import LogNorm, Normalize

from clatter.artefact import BadArtefact
from .. import orders
from . import style

SHOWN_DB = 60.0   # range of colours
SHOWN_RATIO = 1e3


def picture(spectra, cuts, title, to_hz=None):
    """`spectra`: (speed [1/min], orders, RMS, unit) of runs of different speeds; `cuts`: orders; `to_hz`: top of the diagram,
    without it somewhat above the highest of them."""
    spectra = sorted(spectra, key=lambda one: one[0])
    speeds, unit = np.array([one[0] for one in spectra]), spectra[0][3]
    if len(speeds) == 1:
        return one_run(spectra[0], cuts, title, to_hz or 1.15 * max(cuts) * speeds[0] / 60.0)
    if np.diff(speeds).min() < 1.0:
        raise BadArtefact(f"orders: found runs at {', '.join(f'{speed:.0f}' for speed in speeds)} rpm, expected different speeds")
    if any(one[3] != unit for one in spectra):
        raise BadArtefact(f"orders: found units {', '.join(sorted({one[3] for one in spectra}))}, expected one")
    figure, axes = style.figure(2, height=3.6, gridspec_kw={"height_ratios": [1.25, 1]})
    mesh = draw_map(axes[0, 0], spectra, speeds, unit, cuts, to_hz or 1.15 * max(cuts) * speeds[-1] / 60.0)
    bar = figure.colorbar(mesh, ax=list(axes[:, 0]), anchor=(0.0, 1.0), shrink=0.5, pad=0.05, aspect=22,
                          label=f"half order, {orders.level_name(unit)}")
    bar.outline.set_visible(False)
    draw_cuts(axes[1, 0], spectra, speeds, unit, cuts)
    limits = (speeds[0] - 0.5 * (speeds[1] - speeds[0]), speeds[-1] + 0.5 * (speeds[-1] - speeds[-2]))
    for axis in axes[:, 0]:
        axis.set_xlim(limits)
    style.headline(figure, title)
    return figure


def one_run(spectrum, cuts, title, to_hz):
    """Levels of the half orders of a single run up to a frequency."""
    speed, order, rms, unit = spectrum
    figure, axes = style.figure(1, height=3.6)
    axis = axes[0, 0]
    shown = (order > 0.0) & (order * speed / 60.0 <= to_hz)
    if not shown.any():
        raise BadArtefact(f"orders: found no half order up to {to_hz:g} Hz at {speed:.0f} rpm, expected a higher --to-hz")
    values = orders.level(rms[shown], unit)
    low = values.max() - SHOWN_DB if unit in orders.REFERENCE else 0.0
    values = np.maximum(values, low)
    axis.bar(order[shown], values - low, bottom=low, width=0.4, color=style.COLOURS[0])
    for cut in cuts:
        if cut * speed / 60.0 <= to_hz:
            axis.axvline(cut, color="#777777", linewidth=0.7, linestyle=(0, (6, 4)), zorder=0)
    axis.set(xlabel=f"order, multiple of {speed / 60.0:.4g} Hz", ylabel=f"half order, {orders.level_name(unit)}")
    style.headline(figure, f"{title}, {speed:.0f} rpm")
    return figure


def colours(spectra, unit):
    """The scale of the colours: of dB the upper 60, else the upper three decades."""
    top = max(orders.level(one[2][1:].max(), unit) for one in spectra)
    if unit in orders.REFERENCE:
        return Normalize(top - SHOWN_DB, top)
    top = max(top, 1e-300)
    return LogNorm(top / SHOWN_RATIO, top)


def draw_map(axis, spectra, speeds, unit, cuts, top):
    edges = np.concatenate([[1.5 * speeds[0] - 0.5 * speeds[1]], 0.5 * (speeds[1:] + speeds[:-1]), [1.5 * speeds[-1] - 0.5 * speeds[-2]]])
    norm = colours(spectra, unit)
    cmap = style.plt.get_cmap("viridis").with_extremes(bad="#440154")
    axis.set_facecolor("#440154")
    for k, (speed, order, rms, _) in enumerate(spectra):
        frequency = (np.append(order[1:], order[-1] + 0.5) - 0.25) * speed / 60.0
        values = np.maximum(orders.level(rms[1:], unit), norm.vmin)
        mesh = axis.pcolormesh(edges[k:k + 2], frequency, values[:, None], cmap=cmap, norm=norm, rasterized=True)
    ends = edges[[0, -1]]
    for cut in cuts:
        axis.plot(ends, cut * ends / 60.0, color="white", linewidth=0.7, linestyle=(0, (6, 4)), alpha=0.8)
        axis.annotate(f"{cut:g}", (ends[1], cut * ends[1] / 60.0), xytext=(3, 0), textcoords="offset points", va="center", fontsize=9)
    axis.annotate("order", (1.0, 1.0), xycoords="axes fraction", xytext=(3, 2), textcoords="offset points", fontsize=9)
    axis.grid(False)
    axis.set(ylim=(0.0, top), ylabel="frequency [Hz]", xlabel="crank speed [rpm]")
    return mesh


def draw_cuts(axis, spectra, speeds, unit, cuts):
    whole = [orders.level(orders.fluctuation(rms), unit) for _, _, rms, _ in spectra]
    axis.plot(speeds, whole, color="black", linewidth=1.8, label="all orders")
    for number, cut in enumerate(cuts):
        values = [orders.level(orders.of_order(order, rms, cut), unit) for _, order, rms, _ in spectra]
        axis.plot(speeds, values, marker="o", markersize=3.5, color=style.COLOURS[number % (len(style.COLOURS) - 1)],
                  linestyle="-" if number < len(style.COLOURS) - 1 else "--", label=f"order {cut:g}")
    axis.set(xlabel="crank speed [rpm]", ylabel=orders.level_name(unit))
    if unit in orders.REFERENCE:
        axis.set_ylim(bottom=max(axis.get_ylim()[0], max(whole) - 70.0))
    else:
        axis.set_yscale("log")
        axis.set_ylim(bottom=max(axis.get_ylim()[0], max(whole) / SHOWN_RATIO**2))
    axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncol=len(cuts) + 1)
