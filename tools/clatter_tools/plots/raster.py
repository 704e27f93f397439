# SPDX-License-Identifier: GPL-3.0-or-later
"""A small z-buffer renderer: triangles to an image, with shading and element edges, by NumPy alone."""
import numpy as np

LIGHT = np.array([-0.3, 0.55, 0.8])  # toward the light, in view coordinates (right, up, viewer)
EDGE_PIXELS = 0.9


def view_matrix(azimuth_deg, elevation_deg):
    """Rows: right, up, toward the viewer, for an eye at that azimuth (from x) and elevation."""
    a, e = np.radians([azimuth_deg, elevation_deg])
    toward = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    return np.array([right, np.cross(toward, right), toward])


def split_quadratic(triangles):
    """tri6 (Gmsh order) as four flat triangles each; `edges` marks the sides that are element edges.

    Side k is opposite corner k. Returns triangles (4 m, 3), edges (4 m, 3) of bool.
    """
    t = np.asarray(triangles)
    parts = [t[:, [0, 3, 5]], t[:, [3, 1, 4]], t[:, [5, 4, 2]], t[:, [3, 4, 5]]]
    sides = [(False, True, True), (True, False, True), (True, True, False), (False, False, False)]
    return np.vstack(parts), np.repeat(np.array(sides), len(t), axis=0)


def clip(points, triangles, normal, offset):
    """Cuts triangles (m, 3) by the plane normal . x = offset and keeps the side below it.

    Returns (points with the new ones appended, triangles, source): `source` is the old triangle of each new one.
    """
    distance = points @ np.asarray(normal, float) - offset
    inside = distance[triangles] <= 0
    count = inside.sum(axis=1)
    source = [np.flatnonzero(count == 3)]
    kept, new_points, n = [triangles[source[0]]], [points], len(points)
    for wanted in (1, 2):
        old = np.flatnonzero(count == wanted)
        # The corner that is alone on its side comes first; the orientation of the triangle is kept.
        alone = np.argmax(inside[old] == (wanted == 1), axis=1)
        a, b, c = (triangles[old, (alone + k) % 3] for k in range(3))
        ab = points[a] + (distance[a] / (distance[a] - distance[b]))[:, None] * (points[b] - points[a])
        ac = points[a] + (distance[a] / (distance[a] - distance[c]))[:, None] * (points[c] - points[a])
        new_points += [ab, ac]
        i_ab, i_ac = n + np.arange(len(old)), n + len(old) + np.arange(len(old))
        n += 2 * len(old)
        parts = [(a, i_ab, i_ac)] if wanted == 1 else [(i_ab, b, c), (i_ab, c, i_ac)]
        kept += [np.column_stack(part) for part in parts]
        source += [old] * len(parts)
    return np.vstack(new_points), np.vstack(kept), np.concatenate(source)


def render(points, triangles, colour, edges=None, inner=None, azimuth=-60.0, elevation=25.0, size=(900, 640),
           smooth=2):
    """An RGBA image (rows, columns, 4) of float in 0..1; the background is transparent.

    points (n, 3); triangles (m, 3); colour (n, 3) by point or (m, 3) by triangle; edges (m, 3) of bool draws these
    sides dark; `inner` (3) is the flat colour of faces seen from inside, that is, of a cut solid's section.
    `smooth` is the oversampling per direction.
    """
    columns, rows = size[0] * smooth, size[1] * smooth
    view = points @ view_matrix(azimuth, elevation).T
    low, high = view.min(axis=0), view.max(axis=0)
    scale = 0.94 * min(columns / (high[0] - low[0]), rows / (high[1] - low[1]))
    view = (view - (low + high) / 2) * scale + [columns / 2, rows / 2, 0.0]

    corners = view[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    turned = normal[:, 2] / np.maximum(length, 1e-300)  # > 0: faces the viewer
    keep = turned > 1e-6 if inner is None else np.abs(turned) > 1e-6
    bright = 0.62 + 0.38 * np.clip(normal[keep] / length[keep, None] @ (LIGHT / np.linalg.norm(LIGHT)), 0, 1)
    by_point = len(colour) == len(points)
    corner_colour = colour[triangles[keep]] if by_point else np.repeat(colour[keep][:, None], 3, axis=1)
    corner_colour = corner_colour * bright[:, None, None]
    marks = np.zeros((keep.sum(), 3), bool) if edges is None else edges[keep].copy()
    if inner is not None:
        corner_colour[turned[keep] < 0] = inner
        marks[turned[keep] < 0] = False

    canvas = Canvas(rows, columns)
    for chosen, weights in sample_groups(corners[keep]):
        canvas.draw(corners[keep][chosen], corner_colour[chosen], marks[chosen], weights, EDGE_PIXELS * smooth / 2)
    return average(canvas.image.reshape(rows, columns, 4)[::-1], smooth)


class Canvas:
    """Depth and colour of each pixel, row 0 at the bottom."""

    def __init__(self, rows, columns):
        self.rows, self.columns = rows, columns
        self.depth = np.full(rows * columns, -np.inf, np.float32)
        self.owner = np.zeros(rows * columns, np.int64)  # the sample of the last drawing that a pixel shows
        self.image = np.zeros((rows * columns, 4), np.float32)

    def draw(self, corners, colour, marks, weights, edge_width):
        """Draws samples of triangles: corners and colour (m, 3, 3), marks (m, 3), weights (s, 3)."""
        position = np.moveaxis(corners.astype(np.float32), 1, 2) @ weights.T  # (m, 3, s)
        x, y, z = position[:, 0].astype(np.int32), position[:, 1].astype(np.int32), position[:, 2].ravel()
        index = (y * self.columns + x).ravel()
        seen = np.flatnonzero(((x >= 0) & (x < self.columns) & (y >= 0) & (y < self.rows)).ravel())
        seen = self.nearest(index, z, seen)
        index, triangle, sample = index[seen], seen // len(weights), seen % len(weights)
        weight = weights[sample]
        rgb = sum(weight[:, k, None] * colour[:, k][triangle] for k in range(3))
        if marks.any():
            distance = weight * heights(corners)[triangle]
            rgb[((distance < edge_width) & marks[triangle]).any(axis=1)] *= 0.45
        self.image[index, :3] = rgb
        self.image[index, 3] = 1.0

    def nearest(self, index, z, seen):
        """Those of the samples `seen` that are the nearest of their pixel, one per pixel; notes their depths."""
        rest = seen[z[seen] > self.depth[index[seen]]]
        kept = rest
        while len(rest):  # of several samples in a pixel any one is written: those before it are tried again
            self.depth[index[rest]] = z[rest]
            rest = rest[z[rest] > self.depth[index[rest]]]
        kept = kept[z[kept] == self.depth[index[kept]]]
        self.owner[index[kept]] = kept
        return kept[self.owner[index[kept]] == kept]


def average(image, smooth):
    """Mean of smooth x smooth blocks, colours weighted by coverage."""
    rows, columns = image.shape[0] // smooth, image.shape[1] // smooth
    blocks = image.reshape(rows, smooth, columns, smooth, 4)
    cover = blocks[..., 3].sum(axis=(1, 3))
    rgb = (blocks[..., :3] * blocks[..., 3:]).sum(axis=(1, 3)) / np.maximum(cover, 1e-9)[..., None]
    return np.clip(np.dstack([rgb, cover / smooth**2]), 0, 1)


def heights(corners):
    """Heights of triangles in the image plane [pixels], (m, 3)."""
    sides = np.linalg.norm(corners[:, [2, 0, 1], :2] - corners[:, [1, 2, 0], :2], axis=2)
    area2 = np.abs(np.cross(corners[:, 1, :2] - corners[:, 0, :2], corners[:, 2, :2] - corners[:, 0, :2]))
    return (area2[:, None] / np.maximum(sides, 1e-9)).astype(np.float32)


def sample_groups(corners):
    """Yields (triangle ids, barycentric weights (s, 3)): groups of similar size, sampled densely enough to leave no hole."""
    side = np.linalg.norm(corners[:, [2, 0, 1], :2] - corners[:, [1, 2, 0], :2], axis=2).max(axis=1)
    counts = np.ceil(np.maximum(side * 1.2, 1.0)).astype(int)
    for level in 2 ** np.arange(0, int(np.ceil(np.log2(counts.max()))) + 1):
        group = np.flatnonzero((counts <= level) & (counts > level // 2))
        weights = barycentric_grid(level).astype(np.float32)
        step = max(1, 1_000_000 // len(weights))
        for begin in range(0, len(group), step):
            yield group[begin:begin + step], weights


def barycentric_grid(count):
    """Barycentric coordinates of (count + 1)(count + 2)/2 points spread over a triangle, (k, 3)."""
    i, j = np.meshgrid(np.arange(count + 1), np.arange(count + 1), indexing="ij")
    inside = i + j <= count
    a, b = i[inside] / count, j[inside] / count
    return np.column_stack([a, b, 1 - a - b])
