# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of bench/timing.py: error against seconds, and cost by the number of links."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tools"))
from clatter_tools.plots import style  # noqa: E402

SERIES = {  # colour, marker, line
    "tr-bdf2": (0, "o", "-"),
    "sdirk2": (5, "s", "-"),
    "predictor-corrector": (2, "^", "-"),
    "cvode": (4, "v", "--"),
    "cvode-2": (4, "2", ":"),
    "cvode-roots": (1, "D", "--"),
    "cvode-2-roots": (1, "2", ":"),
}


def draw(results, path):
    style.apply()
    figure, axes = style.figure(1, 2, height=3.4)
    left, right = axes.ravel()
    for method, rows in results["methods"]["points"].items():
        colour, marker, line = SERIES[method]
        left.plot([r["seconds"] for r in rows], [100 * r["worst"] for r in rows], color=style.COLOURS[colour], marker=marker, markersize=4,
                  linestyle=line, label=method)
    left.set(xscale="log", yscale="log", xlabel="CPU seconds per second of engine time", ylabel="largest error of a joint's peak [%]")
    left.legend(fontsize="small")
    links = [int(n) for n in results["links"]]
    right.plot(links, [r["microseconds"] for r in results["links"].values()], color=style.COLOURS[0], marker="o", markersize=4, label="measured")
    each = max(r["microseconds"] / int(n) for n, r in results["links"].items())
    right.plot(links, [each * n for n in links], color=style.COLOURS[1], linestyle=":", label="proportional")
    right.set(xscale="log", yscale="log", xlabel="links", ylabel="CPU time of a step [us]")
    times = [100, 200, 500, 1000]
    right.set_xticks(links, [str(n) for n in links])
    right.set_yticks(times, [str(t) for t in times])
    right.minorticks_off()
    right.legend(fontsize="small")
    style.save(figure, path)
