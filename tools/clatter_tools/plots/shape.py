# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and deflection shapes, rendered."""
import re

import numpy as np

from clatter.artefact import BadArtefact, dataset, text
from clatter.histories import angle_zero
from . import raster, style
from ..weighting import a_weight, level_dba

METAL = np.array([0.80, 0.82, 0.84])
SECTION = np.array([0.55, 0.36, 0.33])  # cut material

# Columns of each face type that make its triangles. Corners replace missing mid-side nodes: then one of the
# four parts that are drawn has the entire area, and the diagonal of a square is no edge.
AS_TRIANGLES = {
    "tri3": ([0, 1, 2, 1, 2, 2],),
    "tri6": ([0, 1, 2, 3, 4, 5],),
    "quad4": ([1, 2, 0, 2, 0, 0], [3, 0, 2, 0, 2, 2]),
    "quad8": ([0, 1, 2, 4, 5, 0], [0, 2, 3, 0, 6, 7]),
}


def rgb(hexadecimal):
    return np.array([int(hexadecimal[i:i + 2], 16) / 255 for i in (1, 3, 5)])


def surface(mesh, name):
    """Faces of a named surface as quadratic triangles, (f, 6)."""
    group = mesh["surfaces"][name]
    parts = [faces[:, columns] for kind in AS_TRIANGLES if kind in group
             for faces in [group[kind][()]] for columns in AS_TRIANGLES[kind]]
    return np.concatenate(parts) if parts else np.zeros((0, 6), np.int32)


def draw_mesh(files):
    """The surface mesh of each part, complete and cut open, its named surfaces in colour (mesh files)."""
    meshes = style.open_all(files, "mesh")
    figure, axes = style.figure(len(meshes), 2, height=3.4)
    for row, mesh in zip(axes, meshes):
        draw_part(row, mesh)
    return figure


def draw_part(axes, mesh):
    points = dataset(mesh, "nodes")
    quadratic, face_colour, legend = coloured_faces(mesh)
    triangles, edges = raster.split_quadratic(quadratic)
    face_colour = np.tile(face_colour, (4, 1))
    show(axes[0], raster.render(points, triangles, face_colour, edges, azimuth=40.0), mesh, "complete")
    cut, parts, source = raster.clip(points, triangles, (1, 0, 0), cut_position(points))
    show(axes[1], raster.render(cut, parts, face_colour[source], inner=SECTION, azimuth=25.0), mesh,
         f"cut at x = {cut_position(points) * 1e3:.0f} mm")
    axes[0].text(0, -0.02, f"{len(points)} nodes, {cell_count(mesh)} cells", transform=axes[0].transAxes, va="top")
    if legend:
        handles = [style.plt.Line2D([], [], marker="s", linestyle="", color=colour, label=name)
                   for name, colour in legend]
        axes[1].legend(handles=handles, loc="upper left", bbox_to_anchor=(0, 0.0), ncol=4,
                       handletextpad=0.1, columnspacing=0.8)


def show(axis, image, mesh, title):
    axis.imshow(cropped(image))
    axis.set_axis_off()
    axis.set_title(f"{text(mesh.attrs.get('name', 'part'))}, {title}", loc="left")


def cropped(image):
    """The image without its empty margins."""
    rows, columns = (np.flatnonzero(image[..., 3].any(axis=axis)) for axis in (1, 0))
    return image[rows[0]:rows[-1] + 1, columns[0]:columns[-1] + 1]


def cut_position(points):
    """Position of the cut across the crankshaft [m]: off the middle, so that it hits no wall between two bores."""
    low, high = points[:, 0].min(), points[:, 0].max()
    return low + 0.625 * (high - low)


def cell_count(mesh):
    return sum(len(block["nodes"]) for block in mesh["cells"].values())


def coloured_faces(mesh, limit=7):
    """(tri6, colour of each face, [(name, colour)]): the skin in grey, up to `limit` families of surfaces in colour."""
    families = {}
    for name in mesh["surfaces"]:
        if name != "skin":
            families.setdefault(re.sub(r"_?\d+", "", name), []).append(name)
    faces = surface(mesh, "skin")
    colour = np.tile(METAL, (len(faces), 1))
    corner_key = {tuple(sorted(face[:3])): i for i, face in enumerate(faces)}
    ids = {family: [corner_key[key] for name in names for key in map(tuple, np.sort(surface(mesh, name)[:, :3]))
                    if key in corner_key] for family, names in families.items()}
    # Surfaces that cover much of the skin are not coloured; small surfaces are drawn over large ones.
    chosen = sorted((family for family in ids if 0 < len(ids[family]) < 0.35 * len(faces)),
                    key=lambda family: -len(ids[family]))[:limit]
    legend = list(zip(chosen, style.COLOURS))
    for family, hexadecimal in legend:
        colour[ids[family]] = 0.25 * METAL + 0.75 * rgb(hexadecimal)
    return faces, colour, legend


def draw_deflection(files):
    """The skin at its largest motion, and its deflection shape at the loudest line of the sound power (one field file)."""
    field = style.open_all(files, "field")[0]
    points, quadratic = dataset(field, "skin/nodes"), dataset(field, "skin/triangles")
    triangles, _ = raster.split_quadratic(quadratic)
    figure, axes = style.figure(1, 2, height=4.2)
    for axis, (title, velocity) in zip(axes[0], (strongest_instant(field), strongest_line(field))):
        normal = np.einsum("ij,ij->i", velocity, dataset(field, "skin/node_normal")) * 1e3
        limit = np.percentile(np.abs(normal), 99.5) or 1.0
        scale = 0.04 * np.ptp(points, axis=0).max() / np.abs(velocity).max()
        colours = style.plt.cm.RdBu_r(0.5 + 0.5 * np.clip(normal / limit, -1, 1))[:, :3]
        axis.imshow(cropped(raster.render(points + scale * velocity, triangles, colours, azimuth=40.0, size=(900, 760))))
        axis.set_axis_off()
        axis.set_title(title, loc="left", fontsize=10)
        bar = style.matplotlib.cm.ScalarMappable(style.matplotlib.colors.Normalize(-limit, limit), "RdBu_r")
        figure.colorbar(bar, ax=axis, orientation="horizontal", shrink=0.8, pad=0.01,
                        label="normal velocity [mm/s], outward positive")
    style.headline(figure, f"{style.label(field)}: without rigid motion, deflection enlarged")
    return figure


def strongest_instant(field):
    """(title, nodal velocity [m/s]) of the frame with the largest mean square velocity without rigid motion."""
    names = sorted(field["frames/velocity"])
    moved = [elastic_part(field, field[f"frames/velocity/{name}"][()].astype(float)) for name in names]
    best = int(np.argmax([mean_square(field, velocity) for velocity in moved]))
    time = f"{dataset(field, 'frames/time')[best] * 1e3:.2f} ms"
    when = f"{time} after {angle_zero(field)}" if "frames/crank_angle_deg" in field else f"After {time}"
    return f"{when},\nthe strongest of {len(names)} frames", moved[best]


def strongest_line(field):
    """(title, nodal velocity [m/s] at the phase where it is largest) of the complex line with the largest A-weighted power."""
    names = sorted(field["lines/velocity_re"])
    if not names:
        raise BadArtefact(f"{field.filename}: lines: found no complex lines")
    frequency = dataset(field, "lines/frequency_hz")

    def read(name):
        return elastic_part(field, field[f"lines/velocity_re/{name}"][()] + 1j * field[f"lines/velocity_im/{name}"][()])

    levels = sound_levels(field, frequency)
    if levels is None:
        best = int(np.argmax([mean_square(field, read(name)) * a_weight(f) for name, f in zip(names, frequency)]))
        title = f"Strongest line: {frequency[best]:.0f} Hz,\nby its A-weighted velocity"
    else:
        best = int(np.argmax(levels))
        title = f"Loudest line: {frequency[best]:.0f} Hz,\n{levels[best]:.1f} dB(A) of sound power"
    # The phase at which the real part is largest: half the angle of sum v^2.
    line = read(names[best])
    velocity = (line * np.exp(-0.5j * np.angle(np.sum(line ** 2)))).real
    return title, velocity


def sound_levels(field, frequency):
    """Sound power of the lines of a field file [dB(A) re 1 pW]; None where it has none."""
    at = f"analysis/{text(field['lines'].attrs.get('analysis', 'cycle'))}"
    if f"{at}/sound" not in field:
        return None
    of_all = dataset(field, f"{at}/frequency_hz")
    rows = [int(np.argmin(np.abs(of_all - hz))) for hz in frequency]
    return level_dba(frequency, dataset(field, f"{at}/sound/power")[rows])


def mean_square(field, velocity):
    """Sum over the skin of |normal velocity|^2, weighted by the nodes' areas if the file has them."""
    normal = np.einsum("ij,ij->i", velocity, dataset(field, "skin/node_normal"))
    share = dataset(field, "skin/node_area") if "skin/node_area" in field else 1.0
    return float(np.sum(share * np.abs(normal) ** 2))


def elastic_part(field, velocity):
    """Velocity without its best-fit rigid motion (three translations, three rotations)."""
    points = dataset(field, "skin/nodes")
    x, y, z = (points - points.mean(axis=0)).T
    zero, one = np.zeros_like(x), np.ones_like(x)
    motions = [(one, zero, zero), (zero, one, zero), (zero, zero, one), (zero, -z, y), (z, zero, -x), (-y, x, zero)]
    rigid = np.stack([np.column_stack(motion).ravel() for motion in motions], axis=1)
    amount = np.linalg.lstsq(rigid, velocity.ravel(), rcond=None)[0]
    return velocity - (rigid @ amount).reshape(velocity.shape)
