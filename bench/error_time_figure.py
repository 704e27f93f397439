# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of bench/error_time.py: error against seconds."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tools"))
from clatter_tools.plots import style  # noqa: E402

SERIES = {  # legend, marker, position of its numbers
    "guyan": ("no modes (Guyan)", "X", {"xytext": (-7, -3), "ha": "right"}),
    "fixed": ("fixed-interface modes alone", "o", {"xytext": (1, 4), "ha": "left", "rotation": 60}),
    "residual": ("with residual modes", "s", {"xytext": (-4, -10), "ha": "right"}),
    "interface": ("the sample, liner 4 by interface modes", "^", {"xytext": (4, -13), "ha": "left"}),
}


def draw(results, limit, path):
    style.apply()
    figure, axes = style.figure(1, 2, height=3.9)
    panels = ((f"largest frequency error below {limit / 1000:g} kHz", lambda r: r["frequency_error"]),
              (f"FRF error to {limit / 1000:g} kHz, larger of two forces", lambda r: max(r["frf_error"])))
    for axis, (title, error) in zip(axes[0], panels):
        for colour, series in zip(style.COLOURS, SERIES):
            draw_series(axis, sorted((r for r in results if r["series"] == series), key=lambda r: r["coordinates"]), series,
                        error, colour)
        axis.set(xscale="log", yscale="log", xlabel="processor seconds of clatter-condense", ylabel=f"{title} [-]")
        ticks = [tick for tick in (5, 10, 20, 50, 100, 200, 500) if axis.get_xlim()[0] <= tick <= axis.get_xlim()[1]]
        axis.set_xticks(ticks, [str(tick) for tick in ticks])
        axis.set_xticks([], minor=True)
        axis.margins(x=0.12, y=0.09)
    axes[0, 0].text(0.03, 0.04, "numbers: reduced coordinates", transform=axes[0, 0].transAxes, fontsize=8)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="upper left", ncol=4, columnspacing=1.2)
    figure.suptitle(" ")  # keeps room for the legend
    style.save(figure, path)


def draw_series(axis, points, series, error, colour):
    """A line through the points, each with its number of coordinates."""
    legend, marker, text_options = SERIES[series]
    axis.plot([r["processor_seconds"] for r in points], [error(r) for r in points], marker=marker, color=colour, label=legend,
              linestyle="-" if len(points) > 1 else "none")
    for r in points:
        axis.annotate(str(r["coordinates"]), (r["processor_seconds"], error(r)), textcoords="offset points", fontsize=8,
                      color=colour, **text_options)
