# SPDX-License-Identifier: GPL-3.0-or-later
"""Principal shapes of the motion of a skin: a few shapes, whose amounts at each line and each instant make its velocity."""
import numpy as np

BYTES = 10e6          # of the shapes of a part, at most
TOLERANCE = 1e-2      # of the velocity of nearly all lines
SHARE = 0.95          # of the lines for which it holds
EVEN = 0.5            # lines are weighted by the inverse of this power of their size: quiet ones, which dB show, count too


def rigid_motions(points):
    """Three translations and three rotations about the centre, (3 n, 6)."""
    x, y, z = (points - points.mean(axis=0)).T
    zero, one = np.zeros_like(x), np.ones_like(x)
    motions = [(one, zero, zero), (zero, one, zero), (zero, zero, one), (zero, -z, y), (z, zero, -x), (-y, x, zero)]
    return np.stack([np.column_stack(motion).ravel() for motion in motions], axis=1)


class Basis:
    """Shapes of a part: six rigid motions, then orthonormal elastic shapes of its expansion T (3 n x r), by the velocities of
    its lines in coordinates r (proper orthogonal decomposition of snapshots, Sirovich 1987)."""

    def __init__(self, points, expansion, lines):
        rigid = rigid_motions(points)
        self.rigid_amount = np.linalg.pinv(rigid) @ expansion
        elastic = expansion - rigid @ self.rigid_amount
        value, vector = np.linalg.eigh(elastic.T @ elastic)
        self.size = vector * np.sqrt(np.maximum(value, 0.0))  # |T_e v| = |v size|
        sized = [one @ self.size for one in lines]
        weighted = [one / np.maximum(np.linalg.norm(one, axis=1, keepdims=True), 1e-300) ** EVEN for one in sized]
        _, ordered = np.linalg.eigh(sum((one.conj().T @ one).real for one in weighted))
        most = min(int(BYTES / (2 * len(elastic))), len(value))
        self.directions = ordered[:, ::-1][:, :most]
        count = self.enough(np.vstack(sized))
        self.directions = self.directions[:, :count]
        inverse = vector * np.where(value > 1e-13 * value[-1], 1.0 / np.sqrt(np.maximum(value, 1e-300)), 0.0)
        self.shapes = np.hstack([rigid, elastic @ (inverse @ self.directions)]).T

    def enough(self, sized):
        """How many shapes hold TOLERANCE on SHARE of the lines; all, if they are too few."""
        amount = np.abs(sized @ self.directions) ** 2
        total = np.maximum(np.linalg.norm(sized, axis=1) ** 2, 1e-300)
        left = 1.0 - np.cumsum(amount, axis=1) / total[:, None]
        worst = np.quantile(left, SHARE, axis=0)
        met = np.flatnonzero(worst < TOLERANCE**2)
        return int(met[0]) + 1 if len(met) else self.directions.shape[1]

    def amounts(self, velocity):
        """(amounts of all shapes, relative error of the elastic part) of velocities in coordinates r, one per row."""
        sized = velocity @ self.size
        elastic = sized @ self.directions
        total = np.maximum(np.linalg.norm(sized, axis=1), 1e-300)
        error = np.linalg.norm(sized - elastic @ self.directions.T, axis=1) / total
        return np.hstack([velocity @ self.rigid_amount.T, elastic]), error


def packed(pack, block, rows):
    """Rows, shapes or amounts, as 16-bit numbers with one factor each."""
    largest = np.maximum(np.abs(rows).max(axis=1), 1e-30)
    return {"count": len(rows), "numbers": pack.add(block, rows / largest[:, None] * 32767.0, "<i2"),
            "factor": pack.add(block, largest / 32767.0)}
