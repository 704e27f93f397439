# SPDX-License-Identifier: GPL-3.0-or-later
"""Tension around the loop of a chain."""
import numpy as np

from clatter import chains
from . import drive, style


def draw(files):
    """Tension along the loop of a chain at one instant, and its lowest, mean and highest over the last cycle (one run file)."""
    run = style.open_one(files, "run")
    chain = chains.read_chain(run)
    return picture(chain, drive.instant_of_largest_tension(chain), *drive.titled(run))


def around(chain, loop, window):
    """(places [m], lowest, mean, highest tension [N]) of all instants of the window, in parts of a pitch: each
    has one joint at any time, so that all phases of the teeth count alike."""
    parts = chain.links.shape[1]
    part = np.concatenate([loop.place(chain.pins(k)) for k in window]) * (parts / loop.length)
    part = np.minimum(part.astype(int), parts - 1)
    tension = chain.tension[window].ravel()
    count = np.bincount(part, minlength=parts)
    low, high = np.full(parts, np.inf), np.full(parts, -np.inf)
    np.minimum.at(low, part, tension)
    np.maximum.at(high, part, tension)
    met = count > 0
    mean = np.bincount(part, tension, parts)[met] / count[met]
    return ((np.arange(parts) + 0.5) * (loop.length / parts))[met], low[met], mean, high[met]


def picture(chain, instant, title, rpm):
    loop = chains.Loop(chain, instant)
    window = chain.last_cycle()
    at, low, mean, high = around(chain, loop, window)
    figure, axes = style.figure(height=3.8)
    axis = axes[0, 0]
    for name, begin, end in loop.zones:
        axis.axvspan(begin * 1e3, end * 1e3, color="#eef0f3", zorder=0, linewidth=0)
        axis.annotate(name, (500.0 * (begin + end), 1.0), xycoords=("data", "axes fraction"), xytext=(0, 3),
                      textcoords="offset points", ha="center", va="bottom", fontsize=9)
    whole = "cycle" if len(window) < len(chain.time) or covers_a_cycle(chain) else "run"
    axis.fill_between(at * 1e3, low, high, color=style.COLOURS[5], alpha=0.35, linewidth=0, label=f"lowest to highest of the {whole}")
    axis.plot(at * 1e3, mean, color=style.COLOURS[0], label=f"mean of the {whole}")
    place = loop.place(chain.pins(instant))
    order = np.argsort(place)
    axis.plot(place[order] * 1e3, chain.tension[instant][order], color=style.COLOURS[1], marker="o", markersize=2.2,
              linewidth=0.9, label=f"at {drive.caption(chain, instant, 0.0)}")
    axis.set(xlim=(0.0, loop.length * 1e3), xlabel=f"place along the loop in running direction, from where it leaves {chain.over[0].name} [mm]",
             ylabel="tension of a joint [N]")
    axis.set_ylim(min(0.0, 1.05 * low.min()), 1.08 * high.max())
    axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncol=3)
    style.headline(figure, f"Tension along the chain: {title}, {rpm:.0f} rpm" if rpm > 0.0 else f"Tension along the chain: {title}")
    return figure


def covers_a_cycle(chain):
    return not np.isnan(chain.angle).any() and chain.angle[-1] - chain.angle[0] > 0.99 * chains.CYCLE_DEG
