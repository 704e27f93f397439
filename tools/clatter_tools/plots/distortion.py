# SPDX-License-Identifier: GPL-3.0-or-later
"""The radial shape of bores and skirts: around at several heights, and along."""
import numpy as np

from clatter.artefact import BadArtefact, dataset, text
from . import style

HEIGHTS = 4      # outlines in a polar picture
SHOWN = 0.35     # largest deviation in a polar picture, of the radius
SIDES = ((0.0, "0°"), (90.0, "90°"), (180.0, "180°"), (270.0, "270°"))


def draw(files):
    """Bores and skirts under each load beside each other, around and along, with the unloaded surface (shape files): a row for each surface."""
    shapes = style.open_all(files, "shape")
    for shape, path in zip(shapes, files):
        if not list(shape.get("cases", ())):
            raise BadArtefact(f"{path}: cases: found none, expected at least one")
    rows = {}
    for shape in shapes:
        rows.setdefault(text(shape.attrs["surface"]), []).extend((shape, name) for name in shape["cases"])
    columns = max(len(cases) for cases in rows.values())
    figure = style.plt.figure(figsize=(max(style.WIDTH, 2.6 * columns), 6.0 * len(rows)))
    grids = figure.add_gridspec(4 * len(rows), columns, height_ratios=[1.0, 0.1, 1.1, 0.16] * len(rows))
    for k, (surface, cases) in enumerate(rows.items()):
        draw_surface(figure, grids[4 * k:4 * k + 4, :], surface, sorted(cases, key=largest_deviation))
    return figure


def largest_deviation(case):
    """Cases by it: what acts alone comes before sums, as a rule."""
    shape, name = case
    return np.abs(dataset(shape, f"cases/{name}/deviation")).max()


def draw_surface(figure, place, surface, cases):
    """One surface in four rows: outlines, their legend, curves over the height, their legend."""
    grids = place.get_gridspec()
    row = place.rowspan.start
    along = None
    for column, (shape, name) in enumerate(cases):
        height, angle = 1e3 * dataset(shape, "height"), dataset(shape, "angle")
        covered = dataset(shape, "covered") > 0
        rows = np.unique(np.linspace(0, len(height) - 1, HEIGHTS).round().astype(int))
        deviation = 1e6 * dataset(shape, f"cases/{name}/deviation")
        around = figure.add_subplot(grids[row, column], projection="polar")
        draw_around(around, angle, deviation, covered, rows, height)
        around.set_title(f"{surface}: {name}", loc="center", fontsize=10, pad=14)
        along = figure.add_subplot(grids[row + 2, column], sharey=along)
        draw_along(along, angle, deviation, covered, height)
        if column:
            along.tick_params(labelleft=False)
        else:
            along.set_ylabel("height [mm]")
            legend_row(figure, grids[row + 1, :], around, "around, at a height of")
            legend_row(figure, grids[row + 3, :], along, "along:")


def legend_row(figure, place, drawn, title):
    """The legend of an axis in a row of its own; the title is its first entry."""
    axis = figure.add_subplot(place)
    axis.set_axis_off()
    handles, labels = drawn.get_legend_handles_labels()
    nothing = style.plt.Line2D([], [], linestyle="")
    axis.legend([nothing, *handles], [title, *labels], loc="center left", ncol=len(labels) + 1, borderaxespad=0.0)


def draw_around(axis, angle, deviation, covered, rows, height):
    """Outlines about the unloaded circle, the variation around enlarged."""
    closed = np.append(angle, 2.0 * np.pi)
    largest = max(np.abs(deviation[rows]).max(), 1e-12)
    scale = SHOWN / largest
    axis.plot(np.linspace(0, 2 * np.pi, 181), np.ones(181), color="#888888", linewidth=0.8, linestyle=":")
    for number, i in enumerate(rows):
        radius = 1.0 + scale * np.append(deviation[i], deviation[i, 0])
        on_face = np.append(covered[i], covered[i, 0])
        colour = style.COLOURS[number]
        axis.plot(closed, radius, color=colour, linewidth=0.7, linestyle="--", alpha=0.6)
        axis.plot(closed, np.where(on_face, radius, np.nan), color=colour, label=f"{height[i]:.0f} mm")
    axis.set(ylim=(0, 1 + SHOWN), theta_zero_location="N")
    axis.set_rgrids([1.0], [""])
    axis.text(0.0, 0.0, f"dotted: 0\nrim: {largest:.3g} µm", ha="center", va="center", fontsize=7)
    axis.set_thetagrids([0, 90, 180, 270], [label for _, label in SIDES], fontsize=7)


def draw_along(axis, angle, deviation, covered, height):
    axis.axvline(0.0, color="#888888", linewidth=0.8, linestyle=":")
    axis.plot(deviation.mean(1), height, color="black", linewidth=1.8, label="mean")
    for number, (degrees, label) in enumerate(SIDES):
        j = int(np.argmin(np.abs(np.degrees(angle) - degrees)))
        values = np.where(covered[:, j], deviation[:, j], np.nan)
        if np.isfinite(values).any():
            axis.plot(values, height, color=style.COLOURS[number], linewidth=1.2, linestyle=("-", "--")[number // 2], label=label)
    axis.set_xlabel("outward [µm]")
