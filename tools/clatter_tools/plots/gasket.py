# SPDX-License-Identifier: GPL-3.0-or-later
"""Pressure of gaskets in static results."""
import matplotlib.collections
import numpy as np

from clatter.artefact import BadArtefact, dataset, text
from . import style

OPEN = "#e2e2e2"


def draw(files):
    """Pressure at the points of all gaskets with curves, each case, open parts grey (.static.h5)."""
    file = style.open_one(files, "static")
    if "gaskets" not in file:
        raise BadArtefact(f"{file.filename}: gaskets: found none, expected a [[gasket]] with closure_um and pressure_mpa")
    names, cases = list(file["gaskets"]), list(file["cases"])
    points = np.concatenate([dataset(file, f"gaskets/{name}/points") for name in names])
    area = np.concatenate([dataset(file, f"gaskets/{name}/area") for name in names])
    place, labels = in_plane(points)
    width, height = np.ptp(place, axis=0)
    figure, axes = style.figure(len(cases), 1, height=min(max(7.0 * height / width, 1.6), 6.0) + 0.6)
    for axis, case in zip(axes[:, 0], cases):
        pressure = np.concatenate([dataset(file, f"cases/{case}/gaskets/{name}/pressure") for name in names]) / 1e6
        shown = axis.add_collection(squares(place, np.sqrt(area), pressure))
        figure.colorbar(shown, ax=axis, label="pressure [MPa]", fraction=0.03, pad=0.01)
        axis.autoscale_view()
        axis.set(aspect="equal", xlabel=labels[0], ylabel=labels[1])
        axis.grid(False)
        force, closed = (area * pressure).sum() * 1e3, area[pressure > 0.0].sum() / area.sum()
        axis.set_title(f"{text(file.attrs['name'])}, {case}: {force:.0f} kN, pressed on {closed:.0%}, at most {pressure.max():.1f} MPa",
                       loc="left")
    return figure


def in_plane(points):
    """(positions in the plane of the points [mm], labels of the two axes): the frame's axes where these lie in it."""
    low, high = points.min(axis=0), points.max(axis=0)
    flat = int(np.argmin(high - low))
    first, second = [axis for axis in range(3) if axis != flat]
    return points[:, [first, second]] * 1e3, [f"{'xyz'[axis]} [mm]" for axis in (first, second)]


def squares(place, size, pressure):
    """A square of its area at each point, coloured by the pressure; grey where it is open."""
    half = 0.5e3 * size[:, None, None] * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    collection = matplotlib.collections.PolyCollection(place[:, None, :] + half, array=np.ma.masked_less_equal(pressure, 0.0),
                                                       cmap=style.plt.get_cmap("viridis").with_extremes(bad=OPEN), edgecolors="face",
                                                       linewidths=0.3)
    collection.set_clim(0.0, pressure.max() or 1.0)
    return collection
