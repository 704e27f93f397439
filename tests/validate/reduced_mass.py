# SPDX-License-Identifier: GPL-3.0-or-later
"""Frequencies with the mass as in CalculiX: by the points of the stiffness of C3D20R (8), C3D10 (4), C3D4 (1), where
clatter is exact."""
import h5py
import numpy as np
import scipy.linalg
import scipy.sparse

CORNERS = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)], float)
EDGES = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]  # Gmsh's order


def shape(xi):
    """The 20 serendipity functions at a point."""
    values = [np.prod(1 + corner * xi) * (corner @ xi - 2) / 8 for corner in CORNERS]
    for a, b in EDGES:
        along = CORNERS[a] != CORNERS[b]
        values.append(0.25 * np.prod(np.where(along, 1 - xi**2, 1 + CORNERS[a] * xi)))
    return np.array(values)


def slope(xi, of=shape, step=1e-5):
    """Gradients of shape functions, (3, n): central differences are exact for the quadratic part along each axis."""
    return np.array([(of(xi + d) - of(xi - d)) / (2 * step) for d in step * np.eye(3)])


HEX_POINTS = [np.array((a, b, c)) / np.sqrt(3) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
TET_EDGES = [(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)]  # Gmsh's order
TET_POINTS = (5 - np.sqrt(5)) / 20 + np.eye(4)[:, 1:] / np.sqrt(5)


def tet_shape(xi):
    """The 10 quadratic functions at a point."""
    l = np.array([1 - xi.sum(), *xi])
    return np.array([*(l * (2 * l - 1)), *(4 * l[a] * l[b] for a, b in TET_EDGES)])


def linear_shape(xi):
    return np.array([1 - xi.sum(), *xi])


# Shape functions, points and the weight of each, by the number of nodes.
RULES = {20: (shape, HEX_POINTS, 1.0), 10: (tet_shape, TET_POINTS, 1 / 24), 4: (linear_shape, [np.full(3, 0.25)], 1 / 6)}


def sparse(group):
    return scipy.sparse.csc_matrix((group["data"][()], group["indices"][()], group["indptr"][()]),
                                   shape=group.attrs["shape"])


def frequencies(mesh_file, model_file, density, count):
    """The lowest frequencies [Hz] of a small model of cells of one type, K from clatter, M by the points of CalculiX."""
    with h5py.File(mesh_file) as file:
        nodes, cells = file["nodes"][()], file["cells/0/nodes"][()]
    of, points, weight = RULES[cells.shape[1]]
    mass = np.zeros((len(nodes), len(nodes)))
    for point in points:
        value, gradient = of(point), slope(point, of)
        for cell in cells:
            mass[np.ix_(cell, cell)] += weight * density * np.linalg.det(gradient @ nodes[cell]) * np.outer(value, value)
    with h5py.File(model_file) as file:
        K, T = sparse(file["K"]), sparse(file["T"]).toarray()
    K = (K + scipy.sparse.tril(K, -1).T).toarray()
    # Eight points leave M singular, so the largest 1 / omega^2 are computed.
    values = scipy.linalg.eigh(T.T @ np.kron(mass, np.eye(3)) @ T, K, eigvals_only=True)
    return 1 / np.sqrt(values[::-1][:count]) / (2 * np.pi)


def rotate_about_x(mesh_file, model_file, density):
    """Replaces the model's load by that of a part of hex20 cells that rotates about the x axis, with eight
    points per cell; omega^2 remains the factor of the case."""
    with h5py.File(mesh_file) as file:
        nodes, cells = file["nodes"][()], file["cells/0/nodes"][()]
    force = np.zeros_like(nodes)
    for cell in cells:
        for point in HEX_POINTS:
            value = shape(point)
            arm = value @ nodes[cell] * (0, 1, 1)
            force[cell] += density * np.linalg.det(slope(point) @ nodes[cell]) * np.outer(value, arm)
    with h5py.File(model_file, "a") as file:
        load = next(name for name in file["loads"] if "rotation" in name)
        file["loads"][load][...] = sparse(file["T"]).T @ force.ravel()
