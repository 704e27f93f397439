# SPDX-License-Identifier: GPL-3.0-or-later
"""The common style: sizes, colours, labels, and saving of pictures."""
import os
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker  # noqa: E402

from ..artefact import BadArtefact, open_artefact, text  # noqa: E402

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
    output = pathlib.Path(output)
    output.parent.mkdir(parents=True, exist_ok=True)
    part = output.with_name(output.name + ".part")
    figure_.savefig(part, format="svg" if output.suffix.lower() == ".svg" else "png")
    plt.close(figure_)
    os.replace(part, output)


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
    return own.name.split(".")[0].replace("_", " ")


def legend(axis, columns=2):
    """A legend above the axes, so that it covers no curve."""
    axis.legend(loc="lower left", bbox_to_anchor=(-0.01, 1.0), ncol=columns, borderaxespad=0.2)


def headline(figure_, title):
    figure_.suptitle(title, x=0.01, ha="left", fontsize=11, fontweight="bold")


def nice_ticks(low, high, count=6):
    """Round values from `low` to `high`."""
    return matplotlib.ticker.MaxNLocator(count).tick_values(low, high)


def mark_firing(axis, position=0.0):
    """A thin line at firing top dead centre."""
    axis.axvline(position, color="#888888", linewidth=0.8, linestyle=":")


def crank_axis(axis, angle):
    """Ticks every 90 degrees over a complete cycle, else the default ones."""
    axis.set_xlim(angle[0], angle[-1])
    if angle[-1] - angle[0] > 300:
        first, last = (int(round(end / 90)) * 90 for end in (angle[0], angle[-1]))
        axis.set_xlim(first, last)
        axis.set_xticks(range(first, last + 1, 90))
    axis.set_xlabel("crank angle [deg], 0 = firing TDC")
