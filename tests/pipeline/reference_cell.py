# SPDX-License-Identifier: GPL-3.0-or-later
"""An independent implementation of isoparametric cells in numpy, for comparison: shape functions by inverting the
monomials at the nodes, any quadrature rule. Coordinates of the reference cells as in core/mesh/cell.hpp; nodes
in the order of Abaqus."""
import itertools

import numpy as np

_LINE = {2: [(-3 ** -0.5, 1.0), (3 ** -0.5, 1.0)], 3: [(-0.6 ** 0.5, 5 / 9), (0.0, 8 / 9), (0.6 ** 0.5, 5 / 9)]}
_TRIANGLE = {1: [((1 / 3, 1 / 3), 0.5)], 3: [(at, 1 / 6) for at in ((1 / 6, 1 / 6), (2 / 3, 1 / 6), (1 / 6, 2 / 3))]}
_A, _B = (5 - 5 ** 0.5) / 20, (5 + 3 * 5 ** 0.5) / 20


def tet_rule(points):
    """One or four points (degrees 1 and 2)."""
    if points == 1:
        return [((0.25, 0.25, 0.25), 1 / 6)]
    return [(at, 1 / 24) for at in ((_A, _A, _A), (_B, _A, _A), (_A, _B, _A), (_A, _A, _B))]


def hex_rule(n):
    """Gauss points, n (2 or 3) each way."""
    return [((a, b, c), u * v * w) for (a, u), (b, v), (c, w) in itertools.product(_LINE[n], repeat=3)]


def wedge_rule(triangle, along):
    """Points of the triangle (1 or 3) times Gauss points along the prism (2 or 3)."""
    return [((*at, c), u * w) for at, u in _TRIANGLE[triangle] for c, w in _LINE[along]]


_CORNERS = {
    "tet": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    "hex": [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)],
    "wedge": [(0, 0, -1), (1, 0, -1), (0, 1, -1), (0, 0, 1), (1, 0, 1), (0, 1, 1)]}
EDGES = {
    "tet": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    "hex": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
    "wedge": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]}
_CUBE = list(itertools.product(range(3), repeat=3))
_FLAT = [(i, j) for i, j in itertools.product(range(3), repeat=2) if i + j <= 2]
_MONOMIALS = {
    ("tet", 1): [e for e in _CUBE if sum(e) <= 1], ("tet", 2): [e for e in _CUBE if sum(e) <= 2],
    ("hex", 1): [e for e in _CUBE if max(e) <= 1],
    ("hex", 2): [e for e in _CUBE if sum(k for k in e if k > 1) <= 2],  # serendipity: superlinear degree 2
    ("wedge", 1): [(i, j, k) for i, j in _FLAT if i + j <= 1 for k in (0, 1)],
    ("wedge", 2): [(i, j, k) for i, j in _FLAT for k in (0, 1)] + [(i, j, 2) for i, j in _FLAT if i + j <= 1]}


def mid_side_nodes(shape, corners):
    return [(corners[a] + corners[b]) / 2 for a, b in EDGES[shape]]


class Cell:
    def __init__(self, shape, order):
        self.shape, self.order = shape, order
        corners = [np.array(c, float) for c in _CORNERS[shape]]
        self.nodes = np.array(corners + (mid_side_nodes(shape, corners) if order == 2 else []))
        self._powers = np.array(_MONOMIALS[shape, order])
        self._inverse = np.linalg.inv(np.array([self._monomials(x) for x in self.nodes]))

    def _monomials(self, x):
        return np.prod(np.asarray(x, float) ** self._powers, axis=1)

    def values(self, x):
        return self._monomials(x) @ self._inverse

    def gradients(self, x):
        """n x 3."""
        columns = []
        for k in range(3):
            lower = self._powers.copy()
            lower[:, k] = np.maximum(lower[:, k] - 1, 0)
            columns.append(self._powers[:, k] * np.prod(np.asarray(x, float) ** lower, axis=1))
        return self._inverse.T @ np.array(columns).T

    def mass(self, x, rho, rule):
        """x: nodes, n x 3. 3n x 3n."""
        m = sum(w * np.linalg.det(x.T @ self.gradients(at)) * np.outer(self.values(at), self.values(at))
                for at, w in rule)
        return np.kron(rho * m, np.eye(3))

    def stiffness(self, x, elasticity, rule):
        """3n x 3n; strains in the order 11 22 33 12 23 31."""
        return self.stiffness_of(lambda at: self._gradients_on(x, at), x, elasticity, rule)

    def bubble_stiffness(self, x, elasticity, rule, scaled):
        """The same with Wilson's modes 1 - xi_k^2 condensed out: gradients by the Jacobian at the centre,
        `scaled` by det J_0 / det J (Taylor, Beresford and Wilson 1976) or not."""
        centre = x.T @ self.gradients((0, 0, 0))

        def gradients(at):
            factor = np.linalg.det(centre) / np.linalg.det(x.T @ self.gradients(at)) if scaled else 1.0
            return np.vstack([self._gradients_on(x, at), factor * np.diag(-2.0 * np.array(at)) @ np.linalg.inv(centre)])

        return without(self.stiffness_of(gradients, x, elasticity, rule), 3 * len(x))

    def stiffness_of(self, gradients, x, elasticity, rule):
        return sum(w * np.linalg.det(x.T @ self.gradients(at)) * (b := _strains(gradients(at))).T @ elasticity @ b
                   for at, w in rule)

    def _gradients_on(self, x, at):
        return self.gradients(at) @ np.linalg.inv(x.T @ self.gradients(at))


def without(matrix, n):
    """The rows after the first n condensed out."""
    return matrix[:n, :n] - matrix[:n, n:] @ np.linalg.solve(matrix[n:, n:], matrix[n:, :n])


def _strains(gradients):
    b = np.zeros((6, 3 * len(gradients)))
    for a, (x, y, z) in enumerate(gradients):
        b[:, 3 * a:3 * a + 3] = [[x, 0, 0], [0, y, 0], [0, 0, z], [y, x, 0], [0, z, y], [z, 0, x]]
    return b


def isotropic(E, nu):
    shear = E / (2 * (1 + nu))
    c = np.diag([2 * shear] * 3 + [shear] * 3)
    c[:3, :3] += E * nu / ((1 + nu) * (1 - 2 * nu))
    return c
