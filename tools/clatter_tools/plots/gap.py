# SPDX-License-Identifier: GPL-3.0-or-later
"""The warm gap between skirt and liner, and the shapes that make it."""
import numpy as np

from ..warm_surfaces import Surfaces, of_file, shape_path
from . import style

POSITIONS = ("bottom dead centre", "mid stroke", "top dead centre")


def draw(files):
    """Machined skirt, shapes by temperature, bolts and gas beside each other, along and around, and the warm gap that results (a run)."""
    run = style.open_one(files, "run")
    surfaces = Surfaces(run)
    columns = columns_of(run, surfaces)
    figure, axes = style.figure(2, len(columns) + 1, height=3.0, sharey="row")
    figure.set_figwidth(max(style.WIDTH, 2.1 * (len(columns) + 1)))
    top = surfaces.dead_centres[1]
    for axis, (title, skirt, bore) in zip(axes.T, columns):
        draw_along(axis[0], surfaces, top, skirt, bore)
        draw_around(axis[1], surfaces, top, skirt, bore)
        axis[0].set_title(title, fontsize=9)
    clearance = surfaces.clearance(run)
    draw_gap(axes[0, -1], axes[1, -1], surfaces, clearance)
    axes[0, 0].set_ylabel("height on the skirt\nat top dead centre [mm]")
    axes[1, 0].set_ylabel("outward [µm], around")
    handles = [style.plt.Line2D([], [], color=style.COLOURS[k]) for k in (0, 1)]
    style.legend_above(figure, handles, ["skirt, thrust side (dashed: anti-thrust)", "liner"], f"{style.label(run)}: {1e6 * clearance:.4g} µm of clearance between the cold surfaces")
    return figure


def columns_of(run, surfaces):
    """[(title, function of angles giving the skirt's deviation over its heights, function of (pin, angles) of the liner's)]."""
    nothing = lambda angle: np.zeros((len(angle), len(surfaces.z)))  # noqa: E731
    columns = [("machined", lambda angle: -surfaces.relief(angle), lambda pin, angle: nothing(angle))]
    for name in dict.fromkeys(shape.name for _, shape in [*surfaces.skirt, *surfaces.bore]):
        skirt = [(factor, shape) for factor, shape in surfaces.skirt if shape.name == name]
        bore = [(factor, shape) for factor, shape in surfaces.bore if shape.name == name]
        factors = sorted({factor for factor, _ in [*skirt, *bore]} - {1.0})
        title = name + (f", times {factors[0]:g}" if factors else "")
        columns.append((title, lambda angle, skirt=skirt: sum((f * s.at(angle, surfaces.z) for f, s in skirt), nothing(angle)),
                        lambda pin, angle, bore=bore: sum((f * s.at(angle, pin + surfaces.z) for f, s in bore), nothing(angle))))
    gas = [next((of_file(path, "gas") for path in files_of(run, surfaces, kind) if has_gas(path)), None) for kind in ("skirt_shape", "bore_shape")]
    if all(gas):
        skirt, bore = gas
        columns.append(("gas, not added:\nthe parts are elastic", lambda angle: skirt.at(angle, surfaces.z),
                        lambda pin, angle: bore.at(angle, pin + surfaces.z)))
    return columns


def files_of(run, surfaces, kind):
    return [shape_path(run, entry["file"]) for entry in surfaces.contact.get(kind, []) if "file" in entry]


def has_gas(path):
    with style.open_artefact(path, "shape") as file:
        return "cases/gas" in file


def draw_along(axis, surfaces, pin, skirt, bore):
    sides = np.array([0.0, np.pi])
    for values, colour in ((skirt(sides), style.COLOURS[0]), (bore(pin, sides), style.COLOURS[1])):
        for side, line in zip(values, ("-", "--")):
            axis.plot(1e6 * side, 1e3 * surfaces.z, line, color=colour, linewidth=1.3)
    axis.set_xlabel("outward [µm]", fontsize=8)
    axis.tick_params(labelsize=8)


def draw_around(axis, surfaces, pin, skirt, bore):
    """At the height of the barrel's apex, pads of the skirt and the entire liner."""
    row = int(np.argmin(surfaces.relief(np.zeros(1))[0]))
    all_around = np.radians(np.arange(-90.0, 271.0, 3.0))
    axis.plot(np.degrees(all_around), 1e6 * bore(pin, all_around)[:, row], color=style.COLOURS[1])
    for centre in (0.0, np.pi):
        angle = surfaces.angle + centre
        axis.plot(np.degrees(angle), 1e6 * skirt(angle)[:, row], color=style.COLOURS[0])
    axis.set_xticks([-90, 0, 90, 180, 270])
    axis.set_xlabel("angle from the thrust side [deg]", fontsize=8)
    axis.tick_params(labelsize=8)


def draw_gap(along, around, surfaces, clearance):
    """The gap of the centred piston on the thrust side along the skirt, and around at the height of its smallest value."""
    low, high = surfaces.dead_centres
    for number, (pin, name) in enumerate(zip((low, 0.5 * (low + high), high), POSITIONS)):
        gap = 1e6 * (clearance + surfaces.without_clearance(pin, surfaces.angle))
        look = {"color": style.COLOURS[2 + number], "linewidth": 1.3}
        middle = len(surfaces.angle) // 2
        along.plot(np.where(surfaces.inside(pin), gap[middle], np.nan), 1e3 * surfaces.z, **look)
        around.plot(np.degrees(surfaces.angle), gap[:, int(np.argmin(gap[middle]))], label=name, **look)
    along.set_title("warm gap", fontsize=9)
    along.set_xlabel("gap [µm]", fontsize=8)
    around.set_xlabel("angle from the thrust side [deg]", fontsize=8)
    around.legend(fontsize=7, loc="upper center")
    along.set_xlim(left=0.0)
    for axis in (along, around):
        axis.tick_params(labelsize=8)
