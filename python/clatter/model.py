# SPDX-License-Identifier: GPL-3.0-or-later
"""A full finite element model, part.fe.h5."""
import functools
import typing

import numpy as np

from .artefact import Artefact, dataset, text
from .coordinates import MassProperties, mass_properties, read_sets

try:
    from scipy.sparse import csr_matrix
except ImportError:
    csr_matrix = None


class Csr(typing.NamedTuple):
    """A matrix by rows, as scipy.sparse.csr_matrix has it: row i has the columns indices[indptr[i]:indptr[i + 1]]."""

    data: np.ndarray     # entries, in the matrix's unit [as it says]
    indices: np.ndarray  # their columns [index]
    indptr: np.ndarray   # rows + 1 [index]
    shape: tuple


def read_csr(file, name):
    """A sparse matrix with both triangles: scipy.sparse.csr_matrix, or Csr without SciPy."""
    columns_of, group = dataset(file, f"{name}/indptr"), file[name]
    rows, data = dataset(file, f"{name}/indices"), dataset(file, f"{name}/data")
    columns = np.repeat(np.arange(len(columns_of) - 1, dtype=rows.dtype), np.diff(columns_of))
    if text(group.attrs["symmetric"]) == "lower":
        below = rows != columns
        rows, columns, data = np.append(rows, columns[below]), np.append(columns, rows[below]), np.append(data, data[below])
    shape = tuple(int(n) for n in group.attrs["shape"])
    order = np.lexsort((columns, rows))
    indptr = np.append(0, np.cumsum(np.bincount(rows, minlength=shape[0])))
    found = Csr(data[order], columns[order], indptr, shape)
    return found if csr_matrix is None else csr_matrix(found[:3], shape)


class Model(Artefact):
    """n DoFs q after elimination of supports and couplings; K and M with both triangles."""

    kind = "fe"

    @property
    def name(self) -> str:
        """Name of the part."""
        return self.attribute("name")

    @functools.cached_property
    def M(self) -> Csr:
        """Mass matrix, n x n [kg] (rotations [kg m2]): scipy.sparse.csr_matrix, or Csr without SciPy, as all matrices."""
        return read_csr(self.file, "M")

    @functools.cached_property
    def K(self) -> Csr:
        """Stiffness matrix, n x n [N/m] (rotations [N m/rad])."""
        return read_csr(self.file, "K")

    @property
    def damping(self) -> tuple:
        """(alpha [s], beta [1/s]) of D = alpha K + beta M."""
        return tuple(float(self.file["damping"].attrs[name]) if "damping" in self.file else 0.0 for name in ("alpha", "beta"))

    @functools.cached_property
    def T(self) -> Csr:
        """Nodal displacements u = T q, 3 nodes x n [1], row 3 a + d for node a, direction d."""
        return read_csr(self.file, "T")

    @property
    def nodes(self) -> np.ndarray:
        """Coordinates of the nodes, nodes x 3 [m]."""
        return dataset(self.file, "nodes")

    @functools.cached_property
    def sets(self) -> dict:
        """{name: Set}: positions [m], directions [1]."""
        return read_sets(self.file)

    def dofs(self, name) -> np.ndarray:
        """Rows of q of a set's coordinates, c [index]."""
        return dataset(self.file, f"sets/{name}/dofs")

    @functools.cached_property
    def loads(self) -> dict:
        """{name: vector}, n, of the unit load cases [N] (a load with another unit of its factor: per that unit)."""
        return {name: dataset(self.file, f"loads/{name}") for name in self.file.get("loads", ())}

    @property
    def mass_properties(self) -> MassProperties:
        """Mass [kg], centre (3) [m] and inertia (3 x 3) about it [kg m2], without supports."""
        return mass_properties(self.file)
