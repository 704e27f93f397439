# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of bench/integrators.py: error against seconds."""
import sys
from pathlib import Path

import numpy as np
from matplotlib.ticker import NullFormatter

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tools"))
from clatter_tools.plots import style  # noqa: E402

SERIES = {  # colour, marker, line
    "tr-bdf2": (0, "o", "-"),
    "sdirk2": (5, "s", "-"),
    "predictor-corrector": (2, "^", "-"),
    "generalised-alpha-0.8": (6, "<", "-."),
    "generalised-alpha-0.4": (6, "1", ":"),
    "exponential": (6, "P", "--"),
    "cvode": (4, "v", "--"),
    "cvode-2": (4, "2", ":"),
    "ida": (1, "D", "--"),
    "ida-2": (1, "2", ":"),
    "ida-displacements": (3, "X", "--"),
}
COLUMNS = 3


def draw(results, path):
    style.apply()
    rows = -(-len(results) // COLUMNS)
    figure, axes = style.figure(rows, COLUMNS, height=2.7)
    for axis, (scene, result) in zip(axes.ravel(), results.items()):
        for method, points in result["points"].items():
            colour, marker, line = SERIES[method]
            shown = [p for p in points if np.isfinite(p[0])]
            axis.plot([p[1] for p in shown], [p[0] for p in shown], color=style.COLOURS[colour], marker=marker, markersize=4,
                      linestyle=line, label=method)
        axis.set(xscale="log", yscale="log", title=scene, ylabel=f"error [{result['unit']}]", xlabel="CPU seconds")
        axis.xaxis.set_minor_formatter(NullFormatter())
        least, most = axis.get_xlim()
        if most < 10 * least:  # at least one decade, whose ends are labelled
            axis.set_xlim(10 ** np.floor(np.log10(least)), 10 ** np.ceil(np.log10(most)))
    for axis in axes.ravel()[len(results):]:
        axis.remove()
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="upper left", ncol=4, columnspacing=1.2)
    figure.suptitle(" \n \n ")  # keeps room for the legend
    style.save(figure, path)
