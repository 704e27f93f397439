# SPDX-License-Identifier: GPL-3.0-or-later
"""Modes of a full or a reduced model, part.modes.h5."""
import numpy as np

from .artefact import Artefact, dataset


class Modes(Artefact):
    """m modes, the rigid ones first."""

    kind = "modes"

    @property
    def name(self) -> str:
        """Name of the part."""
        return self.attribute("name")

    @property
    def rigid_modes(self) -> int:
        """Number of rigid modes."""
        return int(self.attribute("rigid_modes"))

    @property
    def frequency_hz(self) -> np.ndarray:
        """Frequencies, m [Hz]."""
        return dataset(self.file, "frequency_hz")

    @property
    def residual(self) -> np.ndarray:
        """Relative residual of each mode, m [1]."""
        return dataset(self.file, "residual")

    @property
    def nodes(self) -> np.ndarray:
        """Coordinates of the nodes, n x 3 [m]."""
        return dataset(self.file, "nodes")

    def shape(self, number) -> np.ndarray:
        """Displacements of the nodes in a mode, n x 3, unit modal mass [1/sqrt(kg)]; modes are numbered from 1."""
        count = self.file["shapes"].shape[0]
        self._check(1 <= number <= count, f"found {count} modes, expected mode {number}")
        return self.file["shapes"][number - 1]

    @property
    def shapes(self) -> np.ndarray:
        """All of them, m x n x 3 [1/sqrt(kg)]."""
        return dataset(self.file, "shapes")
