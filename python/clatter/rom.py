# SPDX-License-Identifier: GPL-3.0-or-later
"""A reduced model, part.rom.h5."""
import functools
import typing
import warnings

import numpy as np

from .artefact import Artefact, dataset
from .coordinates import MassProperties, mass_properties, pick, read_sets
from .errors import BadArtefact

POWERS = {"displacement": 0, "velocity": 1, "acceleration": 2}  # of i omega
ROUNDING = 1e-12  # of the highest eigenvalue: below it a motion without stiffness, where the certificate has not counted them


class Eigenmodes(typing.NamedTuple):
    """Modes of (K, M), ascending."""

    frequency_hz: np.ndarray  # n [Hz]
    shapes: np.ndarray        # r x n, shapes^T M shapes = 1 [1/sqrt(kg)]


class Rom(Artefact):
    """A reduced model: r coordinates, first the boundary's, then interface modes, then kept modes. M q'' + D q' + K q = f."""

    kind = "rom"

    @property
    def name(self) -> str:
        """Name of the part."""
        return self.attribute("name")

    @functools.cached_property
    def M(self) -> np.ndarray:
        """Mass matrix, r x r, symmetric [kg] (rotations [kg m2])."""
        return dataset(self.file, "M_rr")

    @functools.cached_property
    def K(self) -> np.ndarray:
        """Stiffness matrix, r x r, symmetric [N/m] (rotations [N m/rad])."""
        return dataset(self.file, "K_rr")

    @functools.cached_property
    def D(self) -> np.ndarray:
        """Damping matrix, r x r, symmetric [N s/m]: alpha K + beta M, with a table of modal damping also
        M Phi diag(2 zeta omega) Phi^T M. Loss factors are not in it, but in `loss`."""
        rayleigh = self.attribute("alpha") * self.K + self.attribute("beta") * self.M
        if "modal_damping" not in self.file:
            return rayleigh
        M_Phi = self.M @ self._modes.shapes
        return rayleigh + (M_Phi * self._table_rates) @ M_Phi.T

    @functools.cached_property
    def loss(self) -> np.ndarray:
        """Imaginary part of the stiffness by loss factors, r x r, symmetric [N/m]: K + i loss; 0 without loss factors."""
        return dataset(self.file, "loss") if "loss" in self.file else np.zeros_like(self.K)

    @functools.cached_property
    def sets(self) -> dict:
        """{name: Set} of the retained and the recovered coordinates: positions [m], directions [1]."""
        return read_sets(self.file)

    def T(self, *names) -> np.ndarray:
        """Rows of u = T q, c x r [1]: the displacements of sets ("tip") or single coordinates ("tip.z"), one below the other; of all
        sets without a name. Refused for a name that the model has not."""
        rows = []
        for name in names or self.sets:
            owner, within = pick(self.file, self.sets, name)
            rows.append(self._rows(dataset(self.file, f"sets/{owner}/dofs")[within]))
        return np.vstack(rows) if rows else np.zeros((0, len(self.K)))

    def _rows(self, dofs):
        """Of coordinates below r, and from r on of rows of `combined`."""
        size = len(self.K)
        every = np.eye(size)
        if np.any(dofs >= size):
            every = np.vstack([every, dataset(self.file, "combined")])
        return every[dofs]

    @functools.cached_property
    def loads(self) -> dict:
        """{name: vector}, r, of the unit load cases [N] (a load with another unit of its factor: per that unit)."""
        return {name: dataset(self.file, f"loads/{name}") for name in self.file.get("loads", ())}

    @property
    def skin_nodes(self) -> np.ndarray:
        """Coordinates of the nodes of the skin, n x 3 [m]. Refused where the skin was not kept, as are the next two."""
        return dataset(self.file, "skin/nodes")

    @property
    def skin_triangles(self) -> np.ndarray:
        """Nodes of its faces, f x 6, corners, then mid-side nodes [index]."""
        return dataset(self.file, "skin/triangles")

    @property
    def T_skin(self) -> np.ndarray:
        """Rows of u = T q of the skin, 3 n x r, row 3 a + d for node a, direction d [1]."""
        return dataset(self.file, "skin/T")

    @functools.cached_property
    def _modes(self):
        """All modes: K Phi = M Phi Lambda by Cholesky's factor of M with unit diagonal."""
        singular = "M_rr: found a matrix that is not positive definite, expected a mass of each coordinate"
        self._check(np.all(np.diag(self.M) > 0.0), singular)
        scale = 1.0 / np.sqrt(np.diag(self.M))
        try:
            inverse = np.linalg.inv(np.linalg.cholesky(self.M * np.outer(scale, scale)))
        except np.linalg.LinAlgError as error:
            raise BadArtefact(f"{self.path}: {singular}") from error
        eigenvalues, vectors = np.linalg.eigh(inverse @ (self.K * np.outer(scale, scale)) @ inverse.T)
        return Eigenmodes(np.sqrt(np.maximum(eigenvalues, 0.0)) / (2.0 * np.pi), scale[:, None] * (inverse.T @ vectors))

    @property
    def _table_rates(self):
        """2 zeta omega of each mode by the table of modal damping [1/s]; 0 without one."""
        hz = self._modes.frequency_hz
        if "modal_damping" not in self.file:
            return np.zeros(len(hz))
        return 4.0 * np.pi * hz * np.interp(hz, dataset(self.file, "modal_damping/hz"), dataset(self.file, "modal_damping/ratio"))

    def modes(self, count=None) -> Eigenmodes:
        """The lowest modes, all without a count: frequencies [Hz] and shapes, r x n, with unit modal mass [1/sqrt(kg)]. A part that is
        not held has its rigid motions first, at 0 Hz but for rounding. Frequencies are certified up to certificate["accurate_to_hz"]."""
        return Eigenmodes(self._modes.frequency_hz[:count], self._modes.shapes[:, :count])

    def _force(self, name):
        """Columns of unit forces, r x c: a load, or the coordinates of a set."""
        return self.loads[name][:, None] if name in self.loads else self.T(name).T

    def frf(self, input, output, hz, quantity="displacement") -> np.ndarray:
        """Frequency response H, len(hz) x outputs x inputs, complex: the `quantity` at `output` by a unit force exp(+i 2 pi f t) at
        `input`. displacement [m/N], velocity [m/(s N)], acceleration [m/(s2 N)]; rotations [rad], moments [N m].

        input: a load, a set or a coordinate ("tip.z"); output: a set or a coordinate; hz: frequencies [Hz]. It is exact for the
        matrices M, D, K + i loss: the modes have no coupling by D, that by loss factors is solved at each frequency. A frequency above the certificate's limit gives a warning, 0 Hz
        of a part that nothing holds is refused."""
        if quantity not in POWERS:
            raise BadArtefact(f"frf: quantity: found {quantity}, expected {', '.join(POWERS)}")
        omega = 2.0 * np.pi * np.atleast_1d(np.asarray(hz, float))
        if self.rigid_modes and np.any(omega == 0.0):
            raise BadArtefact(f"{self.path}: frf: found 0 Hz, expected another frequency: nothing holds the part's "
                              f"{self.rigid_modes} rigid motions")
        limit = self.certificate.get("accurate_to_hz", self.attribute("valid_to_hz"))
        if len(omega) and omega.max() > 2.0 * np.pi * limit * (1.0 + 1e-9):
            warnings.warn(f"{self.path}: {omega.max() / (2.0 * np.pi):g} Hz: its modes are accurate to {limit:g} Hz", stacklevel=2)
        squared = (2.0 * np.pi * self._modes.frequency_hz) ** 2
        rates = self.attribute("alpha") * squared + self.attribute("beta") + self._table_rates
        stiffness = squared + 1j * omega[:, None] * rates - omega[:, None] ** 2
        out, force = self.T(output) @ self._modes.shapes, self._modes.shapes.T @ self._force(input)
        power = (1j * omega) ** POWERS[quantity]
        if "loss" not in self.file:
            return np.einsum("om,fm,mi,f->foi", out, 1.0 / stiffness, force, power, optimize=True)
        loss = 1j * (self._modes.shapes.T @ self.loss @ self._modes.shapes)
        return np.array([p * (out @ np.linalg.solve(loss + np.diag(s), force)) for s, p in zip(stiffness, power)])

    @property
    def rigid_modes(self) -> int:
        """Number of rigid motions that nothing holds."""
        if "rigid_modes" in self.certificate:
            return int(self.certificate["rigid_modes"])
        hz = self._modes.frequency_hz
        return int(np.count_nonzero(hz**2 <= ROUNDING * hz[-1] ** 2))

    def static(self, load) -> np.ndarray:
        """Static response q, r [m], of K q = f: T(name) @ q are the displacements [m] of a set. load: the name of a load,
        {name: factor}, or a vector f, r [N]. Refused for a part that nothing holds."""
        if self.rigid_modes:
            raise BadArtefact(f"{self.path}: static: found {self.rigid_modes} rigid motions, expected a part that supports hold")
        factors = load if isinstance(load, dict) else {load: 1.0} if isinstance(load, str) else None
        if factors is None:
            return np.linalg.solve(self.K, load)
        unknown = [name for name in factors if name not in self.loads]
        if unknown:
            raise BadArtefact(f"{self.path}: loads: found no {unknown[0]}, expected one of {', '.join(self.loads) or 'none'}")
        return np.linalg.solve(self.K, sum(factor * self.loads[name] for name, factor in factors.items()))

    @property
    def mass_properties(self) -> MassProperties:
        """Mass [kg], centre (3) [m] and inertia (3 x 3) about it [kg m2] of the full model, without its supports."""
        return mass_properties(self.file)
