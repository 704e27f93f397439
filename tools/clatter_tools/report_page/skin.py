# SPDX-License-Identifier: GPL-3.0-or-later
"""The skins of parts for the 3-D view: geometry, panels, edges."""
import numpy as np

from clatter.artefact import dataset
from ..plots import raster

SHARP_DEG = 35.0  # between the normals of two faces: their common edge belongs to the outline


def geometry(pack, block, nodes, triangles, normals):
    """Corners come first, then mid-side nodes, whose motion is the mean of that of their edge's corners: exact for positions,
    a quarter of the numbers for shapes. Returns (what the page needs, corners as rows of `nodes`)."""
    corners = np.unique(triangles[:, :3])
    new = np.full(len(nodes), -1, np.int64)
    new[corners] = np.arange(len(corners))
    mids, first = np.unique(triangles[:, 3:].ravel(), return_index=True)
    mids, first = mids[new[mids] < 0], first[new[mids] < 0]
    ends = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)[first]
    new[mids] = len(corners) + np.arange(len(mids))
    kept = np.concatenate([corners, mids])
    points = nodes[kept]
    flat, _ = raster.split_quadratic(new[triangles])
    low = points.min(axis=0)
    step = float(np.ptp(points, axis=0).max()) / 65535.0
    index = "<u2" if len(kept) < 65536 else "<u4"
    return {"block": block, "corners": len(corners), "nodes": len(kept), "low": low, "high": points.max(axis=0), "step": step,
            "points": pack.add(block, (points - low) / step, "<u2"),
            "normals": pack.add(block, 127.0 * normals[kept], "<i1"),
            "ends": pack.add(block, new[ends], index),
            "triangles": pack.add(block, interleaved(flat, len(triangles)), index),
            "edges": pack.add(block, new[sharp_edges(nodes, triangles)], index)}, corners


def interleaved(flat, count):
    """The four parts of each face together, face by face: 4 m x 3."""
    return flat.reshape(4, count, 3).transpose(1, 0, 2).reshape(-1, 3)


def sharp_edges(nodes, triangles):
    """Edges where the skin bends by more than SHARP_DEG or ends, as pairs of nodes, two per edge."""
    a, b, c = (nodes[triangles[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    edges = triangles[:, [[0, 3, 1], [1, 4, 2], [2, 5, 0]]].reshape(-1, 3)
    face = np.repeat(np.arange(len(triangles)), 3)
    ends = np.sort(edges[:, [0, 2]], axis=1)
    order = np.lexsort((ends[:, 1], ends[:, 0]))
    same = (np.diff(ends[order], axis=0) == 0).all(axis=1)
    paired = np.zeros(len(edges), bool)
    paired[order[1:][same]] = paired[order[:-1][same]] = True
    cosine = np.einsum("ij,ij->i", normal[face[order[:-1]]], normal[face[order[1:]]])
    sharp = order[:-1][same & (cosine < np.cos(np.radians(SHARP_DEG)))]
    chosen = edges[np.concatenate([sharp, np.flatnonzero(~paired)])]
    return chosen[:, [0, 1, 1, 2]].reshape(-1, 2)


def panels(pack, block, field):
    """Panels of a field file as (name, faces); each face has the colour of the smallest panel that has it."""
    names = [name for name in sorted(field["panels"])] if "panels" in field else []
    owner = np.full(len(field["skin/triangles"]), 255, np.int64)
    names.sort(key=lambda name: -len(field[f"panels/{name}/faces"]))
    for number, name in enumerate(names):
        owner[dataset(field, f"panels/{name}/faces")] = number
    return {"names": names, "labels": [name.replace("_", " ") for name in names], "owner": pack.add(block, owner, "<u1")}


def smooth_normals(nodes, triangles):
    """Normals at nodes: the mean of those of the flat parts around them, weighted by area."""
    flat, _ = raster.split_quadratic(triangles)
    a, b, c = (nodes[flat[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    total = np.zeros_like(nodes)
    for k in range(3):
        np.add.at(total, flat[:, k], normal)
    return total / np.maximum(np.linalg.norm(total, axis=1), 1e-300)[:, None]
