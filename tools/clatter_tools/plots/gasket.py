# SPDX-License-Identifier: GPL-3.0-or-later
"""Pressure of gaskets in static results."""
import matplotlib.tri
import numpy as np

from clatter.artefact import BadArtefact, dataset, text
from . import style

COLOURS = style.plt.get_cmap("viridis").with_extremes(bad="#e2e2e2")
ACROSS = 4.0


def draw(files):
    """Pressure at the points of all gaskets with curves, each case, open parts grey (.static.h5)."""
    file = style.open_one(files, "static")
    if "gaskets" not in file:
        raise BadArtefact(f"{file.filename}: gaskets: found none, expected a [[gasket]] with closure_um and pressure_mpa")
    names, cases = list(file["gaskets"]), list(file["cases"])
    points = {name: dataset(file, f"gaskets/{name}/points") for name in names}
    area = {name: dataset(file, f"gaskets/{name}/area") for name in names}
    axes_of, labels = plane_of(np.concatenate(list(points.values())))
    layers = {name: layer(points[name][:, axes_of] * 1e3, np.sqrt(area[name]) * 1e3) for name in names}
    width, height = np.ptp(np.concatenate([points[name][:, axes_of] for name in names]), axis=0)
    figure, axes = style.figure(len(cases), 1, height=min(max(7.0 * height / width, 1.6), 6.0) + 0.6)
    for axis, case in zip(axes[:, 0], cases):
        pressure = {name: dataset(file, f"cases/{case}/gaskets/{name}/pressure") / 1e6 for name in names}
        most = max(values.max() for values in pressure.values())
        for name in names:
            shown = axis.tripcolor(layers[name], facecolors=of_triangles(layers[name], pressure[name]), cmap=COLOURS, vmin=0.0,
                                   vmax=most or 1.0)
        figure.colorbar(shown, ax=axis, label="pressure [MPa]", fraction=0.03, pad=0.01)
        axis.set(aspect="equal", xlabel=labels[0], ylabel=labels[1])
        axis.grid(False)
        force = 1e3 * sum(area[name] @ pressure[name] for name in names)
        closed = sum(area[name][pressure[name] > 0.0].sum() for name in names) / sum(values.sum() for values in area.values())
        axis.set_title(f"{text(file.attrs['name'])}, {case}: {force:.0f} kN, pressed on {100.0 * closed:.1f} %, at most {most:.1f} MPa",
                       loc="left")
    return figure


def plane_of(points):
    """(the two axes along which the points extend most, their labels)."""
    flat = int(np.argmin(np.ptp(points, axis=0)))
    kept = [axis for axis in range(3) if axis != flat]
    return kept, [f"{'xyz'[axis]} [mm]" for axis in kept]


def layer(place, size):
    """The points as triangles, without those across holes: with a side of many times the size of a point's area."""
    triangles = matplotlib.tri.Triangulation(*place.T)
    corners = place[triangles.triangles]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    triangles.set_mask(longest > ACROSS * size[triangles.triangles].max(axis=1))
    return triangles


def of_triangles(triangles, pressure):
    """Mean of the corners; none where all of them are open."""
    corners = pressure[triangles.triangles]
    return np.ma.masked_array(corners.mean(axis=1), (corners <= 0.0).all(axis=1))
