# SPDX-License-Identifier: GPL-3.0-or-later
"""The common style: sizes, colours, labels, and saving of pictures."""
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker  # noqa: E402

from clatter.artefact import BadArtefact, open_artefact, stem, text  # noqa: E402
from ..whole_file import whole_file  # noqa: E402

# Colour-blind safe (Okabe and Ito 2008); a run keeps its colour in all pictures of one call.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
WIDTH = 8.0  # inches


def apply():
    plt.rcParams.update({
        "figure.dpi": 110, "savefig.dpi": 110, "font.size": 10, "axes.titlesize": 11, "axes.titleweight": "bold",
        "axes.grid": True, "grid.color": "#dddddd", "grid.linewidth": 0.6, "axes.spines.top": False,
        "axes.spines.right": False, "axes.prop_cycle": matplotlib.cycler(color=COLOURS), "lines.linewidth": 1.4,
        "legend.framealpha": 0.85, "legend.edgecolor": "none", "legend.fontsize": 8, "figure.constrained_layout.use": True, "axes.axisbelow": True,
    })


def figure(rows=1, columns=1, height=2.6, sharex=False, **options):
    """A figure of `rows` x `columns` axes, `height` inches per row; axes always as a 2-D array."""
    return plt.subplots(rows, columns, figsize=(WIDTH, height * rows + 0.6), sharex=sharex, squeeze=False, **options)


def save(figure_, output):
    """Writes a PNG, or an SVG by the name of the file; it appears only when it is complete."""
    with whole_file(output) as part:
        part.parent.mkdir(parents=True, exist_ok=True)
        figure_.savefig(part, format="svg" if pathlib.Path(output).suffix.lower() == ".svg" else "png")
    plt.close(figure_)


def open_all(paths, kind):
    """Opened artefacts of one kind; at least one."""
    if not paths:
        raise BadArtefact(f"this picture needs at least one .{kind}.h5 file")
    return [open_artefact(path, kind) for path in paths]


def open_one(paths, kind):
    """The opened artefact of a picture that shows one."""
    if len(paths) != 1:
        raise BadArtefact(f"this picture needs one .{kind}.h5 file")
    return open_artefact(paths[0], kind)


def label(file, cylinder=""):
    """Name of a run in a legend: its scene's title, also for its field file; else the file's stem; with the cylinder's name."""
    if cylinder:
        return f"{label(file)}, {cylinder}"
    if "title" in file.attrs:
        return text(file.attrs["title"])
    own = pathlib.Path(file.filename)
    for name in file["inputs/path"][()] if "inputs/path" in file else []:
        run = own.parent / pathlib.Path(text(name)).name
        if run.name.endswith(".run.h5") and run.exists():
            return label(open_artefact(run, "run"))
    return stem(own).replace("_", " ")


def legend(axis, columns=2):
    """A legend above the axes, so that it covers no curve."""
    axis.legend(loc="lower left", bbox_to_anchor=(-0.01, 1.0), ncol=columns, borderaxespad=0.2)


def legend_above(figure_, handles, labels, title=""):
    """A legend, a line per entry, above all axes of a figure, under its title."""
    entries = [plt.Line2D([], [], color=handle.get_edgecolor() if hasattr(handle, "get_edgecolor") else handle.get_color(),
                          linewidth=2) for handle in handles]
    figure_.suptitle("\n".join([title] + [" "] * len(labels)) if title else "\n".join([" "] * len(labels)), x=0.01, ha="left",
                     fontsize=11, fontweight="bold")
    top = 1.0 - (0.24 if title else 0.02) / figure_.get_figheight()
    figure_.legend(entries, labels, loc="upper left", bbox_to_anchor=(0.0, top), ncol=1, fontsize=9, borderaxespad=0.0)


def headline(figure_, title):
    """A title above all axes, smaller where it is wider than the figure."""
    text = figure_.suptitle(title, x=0.01, ha="left", fontsize=11, fontweight="bold")
    share = text.get_window_extent().width / figure_.bbox.width
    text.set_fontsize(11 / max(1.0, share / 0.98))


def nice_ticks(low, high, count=6):
    """Round values from `low` to `high`."""
    return matplotlib.ticker.MaxNLocator(count).tick_values(low, high)


def order_axis(axis, orders_per_hz):
    """A second axis above one in Hz, in engine orders."""
    above = axis.secondary_xaxis("top", functions=(lambda hz: hz * orders_per_hz, lambda order: order / orders_per_hz))
    above.set_xlabel("engine order", fontsize=9)
    above.tick_params(labelsize=9)


def mark_limit(axis, position, words, shade=False):
    """A line at a limit of an axis, its name beside it, and a grey area beyond it."""
    axis.axvline(position, color="#555555", linewidth=0.9, linestyle="--")
    if shade:
        axis.axvspan(position, axis.get_xlim()[1], color="#e6e6e6", zorder=0)
    axis.annotate(words, (position, 0.98), xycoords=("data", "axes fraction"), xytext=(-2, 0), textcoords="offset points",
                  rotation=90, ha="right", va="top", fontsize=8, color="#555555")


def mark_zero(axis, position=0.0):
    """A thin line at crank angle 0."""
    axis.axvline(position, color="#888888", linewidth=0.8, linestyle=":")


def crank_axis(axis, angle, zero, step=90):
    """Ticks every `step` degrees over a complete cycle, else the default ones; `zero`: what crank angle 0 is."""
    axis.set_xlim(angle[0], angle[-1])
    if angle[-1] - angle[0] > 300:
        first, last = (int(round(end / step)) * step for end in (angle[0], angle[-1]))
        axis.set_xlim(first, last)
        axis.set_xticks(range(first, last + 1, step))
    axis.set_xlabel(f"crank angle [deg], 0 = {zero}")
