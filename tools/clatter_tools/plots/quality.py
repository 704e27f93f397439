# SPDX-License-Identifier: GPL-3.0-or-later
"""Quality of mesh cells: histograms by cell type, the worst cells with number and position."""
import numpy as np

from clatter.artefact import BadArtefact
from . import style

MEASURES = {"min_dihedral_deg": "smallest dihedral angle [deg]", "scaled_jacobian": "scaled Jacobian (proved bound)"}
LISTED = 5


def draw(files):
    """Histograms of the dihedral angle and the scaled Jacobian, one row per mesh, one colour per cell type (mesh files)."""
    meshes = style.open_all(files, "mesh")
    figure, axes = style.figure(len(meshes), len(MEASURES), height=3.4)
    for row, mesh in zip(axes, meshes):
        if "quality" not in mesh:
            raise BadArtefact(f"{mesh.filename}: no group quality, expected a mesh of clatter-mesh")
        for axis, (name, title) in zip(row, MEASURES.items()):
            draw_measure(axis, mesh["quality"][name], title)
        row[0].set_title(f"{style.label(mesh)}: {cell_count(mesh)} cells", loc="left")
    return figure


def cell_count(mesh):
    return sum(len(block["nodes"]) for block in mesh["cells"].values())


def draw_measure(axis, measure, title):
    low, high = float(measure.attrs["low"]), float(measure.attrs["high"])
    kinds = measure["by_type"] if "by_type" in measure else {"cells": measure["histogram"]}
    edges = np.linspace(low, high, len(measure["histogram"]) + 1)
    most = 1
    for colour, (kind, histogram) in zip(style.COLOURS, kinds.items()):
        counts = np.asarray(histogram)
        most = max(most, counts.max())
        axis.stairs(counts, edges, fill=True, alpha=0.35, color=colour)
        axis.stairs(counts, edges, color=colour, linewidth=1.2, label=kind)
    axis.axvline(float(measure.attrs["worst"]), ymax=0.7, color="#000000", linewidth=1.0,
                 linestyle=":")
    axis.set_yscale("symlog", linthresh=1)  # the few bad ones matter
    axis.set_ylim(0, most * 10 ** (1.6 + 0.25 * len(kinds)))  # space for text and legend above the bars
    axis.set_xlabel(title)
    axis.set_ylabel("cells")
    axis.legend(loc="upper right")
    if "worst_cells" in measure:
        axis.text(0.02, 0.97, worst_text(measure), transform=axis.transAxes, va="top", fontsize=7,
                  family="monospace")


def worst_text(measure):
    """Number, value and position of the worst cells, one line each."""
    lines = ["worst: cell  value  at [mm]"]
    for label, value, position in list(zip(measure["worst_cells"][()], measure["worst_values"][()],
                                        measure["worst_places"][()]))[:LISTED]:
        x, y, z = 1e3 * position
        lines.append(f"{label:11d} {value:6.3g}  {x:.1f} {y:.1f} {z:.1f}")
    return "\n".join(lines)
