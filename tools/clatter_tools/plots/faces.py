# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces of a part with their numbers, for selecting them."""
import os
import pathlib
import shutil
import subprocess
import tempfile

import numpy as np

from clatter.artefact import BadArtefact, dataset, open_artefact, text
from . import raster, style

# Azimuth, elevation [deg], direction along which the half beyond the middle is removed.
VIEWS = [(40, 25, None), (220, 25, None), (130, -30, None), (310, -30, None), (40, 25, (1, 0, 0)), (100, 25, (0, 1, 0))]
KINDS = {"plane": "#c8ccd0", "cylinder": "#56B4E9", "cone": "#E69F00", "torus": "#009E73", "sphere": "#CC79A7",
         "revolved": "#F0E442", "spline": "#D9A48F", "other": "#9A86C9"}
SIZE = (900, 700)  # pixels of a view
LISTED = 20  # of the faces that are visible in no view
SMALLEST = 40  # visible pixels that a face needs for its number


def draw(files):
    """The faces of a part by kind, each with its number where most of it is visible (.faces.h5, CAD or part.mesh.toml)."""
    if len(files) != 1:
        raise BadArtefact("this picture needs one .faces.h5 file, CAD file or part.mesh.toml")
    if str(files[0]).endswith(".h5"):
        return picture(open_artefact(files[0], "faces"))
    with tempfile.TemporaryDirectory(prefix="clatter-faces-") as folder:
        return picture(open_artefact(listed(files[0], folder), "faces"))


def listed(part, folder):
    """Path of the .faces.h5 of a part, written by clatter-mesh in that folder."""
    program = (shutil.which("clatter-mesh", path=os.environ["CLATTER_BIN"]) if "CLATTER_BIN" in os.environ
               else shutil.which("clatter-mesh"))
    if program is None:
        raise BadArtefact(f"{part}: clatter-mesh, which lists its faces, is not in PATH (or CLATTER_BIN)")
    output = pathlib.Path(folder) / "part.faces.h5"
    done = subprocess.run([program, "faces", str(part), "-o", str(output), "--quiet"], text=True,
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    if done.returncode:
        raise BadArtefact(done.stderr.strip().splitlines()[-1].partition("error: ")[2] or done.stderr.strip())
    return output


def picture(file):
    points, triangles = dataset(file, "nodes"), dataset(file, "triangles")
    if not len(triangles):
        raise BadArtefact(f"{file.filename}: triangles: found none: its faces could not be meshed; see the printed table")
    face = dataset(file, "triangle_face")
    kinds = {number: text(kind).split(" ")[0].rstrip(",")
             for number, kind in zip(dataset(file, "number"), dataset(file, "kind"))}
    views = [seen(*cut(points, triangles, face, along), kinds, azimuth, elevation)
             for azimuth, elevation, along in VIEWS]
    labels = place_labels([ids for _, ids in views])
    figure, axes = style.figure(3, 2, height=4.6)
    figure.set_size_inches(14, 17)
    for axis, (image, _), found in zip(axes.ravel(), views, labels):
        axis.imshow(image)
        axis.set_axis_off()
        for number, (row, column) in found.items():
            axis.text(column, row, str(number), ha="center", va="center", fontsize=8,
                      bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.8})
    for axis, (azimuth, elevation, along) in zip(axes.ravel(), VIEWS):
        axis.set_title(f"seen from azimuth {azimuth}, elevation {elevation} deg" +
                       (f", cut across {'xyz'[np.argmax(along)]}" if along else ""), loc="left", fontsize=9)
    present = [kind for kind in KINDS if kind in kinds.values()]
    handles = [style.plt.Line2D([], [], marker="s", linestyle="", markersize=9, color=KINDS[kind], label=kind)
               for kind in present]
    axes[0, 1].legend(handles=handles, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncol=len(present))
    hidden = sorted(set(kinds) - {number for found in labels for number in found})
    style.headline(figure, f"{text(file.attrs['name'])}: {len(kinds)} faces" +
                   (f"; in no view: {', '.join(map(str, hidden[:LISTED]))}"
                    f"{f' and {len(hidden) - LISTED} more' if len(hidden) > LISTED else ''}"
                    if hidden else ""))
    return figure


def cut(points, triangles, face, along):
    """The part without its half beyond the middle in that direction."""
    if along is None:
        return points, triangles, face
    middle = (points.min(axis=0) + points.max(axis=0)) @ np.array(along) / 2
    points, triangles, source = raster.clip(points, triangles, along, middle)
    return points, triangles, face[source]


def seen(points, triangles, face, kinds, azimuth, elevation):
    """(image, face number of each pixel, 0 outside) of one view."""
    view = points @ raster.view_matrix(azimuth, elevation).T
    low, high = view.min(axis=0), view.max(axis=0)
    scale = 0.94 * min(SIZE[0] / (high[0] - low[0]), SIZE[1] / (high[1] - low[1]))
    corners = ((view - (low + high) / 2) * scale + [SIZE[0] / 2, SIZE[1] / 2, 0.0])[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    turned = np.abs(normal[:, 2]) / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)
    keep = turned > 1e-6  # either side is visible: the skin is closed, and the nearest face hides the rest
    numbers = np.repeat(face[keep].astype(np.float32)[:, None], 3, axis=1)
    # The renderer interpolates three floats per corner: the face's number and the cosine to the viewer.
    value = np.stack([numbers, np.repeat(turned[keep][:, None], 3, axis=1), np.zeros_like(numbers)], axis=2)
    canvas = raster.Canvas(SIZE[1], SIZE[0])
    for chosen, weights in raster.sample_groups(corners[keep]):
        canvas.draw(corners[keep][chosen], value[chosen], np.zeros((len(chosen), 3), bool), weights, 0.0)
    pixels = canvas.image.reshape(SIZE[1], SIZE[0], 4)[::-1]
    ids = np.where(pixels[..., 3] > 0, np.rint(pixels[..., 0]), 0).astype(int)
    ids, bright = without_specks(ids, pixels[..., 1])
    return shaded(ids, bright, kinds), ids


def without_specks(ids, bright):
    """The same without single pixels between two of one face, or of none: faces seen edge-on."""
    for axis in (0, 1):
        before = np.roll(ids, 1, axis)
        alone = (before == np.roll(ids, -1, axis)) & (ids != before)
        ids, bright = np.where(alone, before, ids), np.where(alone, np.roll(bright, 1, axis), bright)
    return ids, bright


def shaded(ids, bright, kinds):
    """Colours by kind, a little lighter or darker from face to face, dark lines between faces."""
    image = np.ones((*ids.shape, 3))
    for number in np.unique(ids[ids > 0]):
        colour = np.array([int(KINDS.get(kinds.get(number), "#999999")[i:i + 2], 16) / 255 for i in (1, 3, 5)])
        mask = ids == number
        image[mask] = colour * (1.0 - 0.07 * (number % 3)) * (0.6 + 0.4 * bright[mask])[:, None]
    border = np.zeros(ids.shape, bool)
    border[:, 1:] |= ids[:, 1:] != ids[:, :-1]
    border[1:] |= ids[1:] != ids[:-1]
    image[border] = 0.15
    return image


def place_labels(views):
    """One dictionary per view: face number -> (row, column), each face in the view that shows most of it, in cut
    views only if it is hidden in the others."""
    counts = [dict(zip(*np.unique(ids[ids > 0], return_counts=True))) for ids in views]
    labels = [{} for _ in views]
    for number in sorted(set().union(*counts)):
        shown = [count.get(number, 0) for count in counts]
        uncut = [pixels if VIEWS[i][2] is None else 0 for i, pixels in enumerate(shown)]
        best = int(np.argmax(uncut if max(uncut) >= SMALLEST else shown))
        if counts[best][number] >= SMALLEST:
            labels[best][int(number)] = innermost(views[best] == number)
    return labels


def innermost(mask):
    """A pixel of the mask far from its border, by repeated removal of the border."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    first = (rows[0], columns[0])
    left = np.pad(mask[rows[0]:rows[-1] + 1, columns[0]:columns[-1] + 1], 1)
    while True:
        inner = left.copy()
        inner[1:-1, 1:-1] &= left[:-2, 1:-1] & left[2:, 1:-1] & left[1:-1, :-2] & left[1:-1, 2:]
        if not inner.any():
            break
        left = inner
    found = np.argwhere(left) - 1 + first
    return tuple(found[np.argmin(np.abs(found - np.median(found, axis=0)).sum(axis=1))])
