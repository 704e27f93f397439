# SPDX-License-Identifier: GPL-3.0-or-later
"""The sound of a part per reduced velocity, part.sound.h5."""
import functools

import numpy as np

from .artefact import Artefact, dataset, text

REACH = 3  # stored frequencies on either side of an interpolated one


class Sound(Artefact):
    """Boundary elements of a part, for reduced velocities v of its reduced model (r, complex, peak): P = 1/2 v^H R v, p = H v."""

    kind = "sound"

    @functools.cached_property
    def frequency_hz(self) -> np.ndarray:
        """Frequencies that were solved for, n_l, ascending [Hz]."""
        return dataset(self.file, "frequency_hz")

    def _weights(self, hz):
        """{number of a frequency: weight} of the polynomial through six neighbours at hz, as clatter-recover takes them."""
        grid = self.frequency_hz
        self._check(0.0 < hz <= grid[-1] * (1.0 + 1e-9),
                    f"found {hz:g} Hz, expected a positive frequency up to {grid[-1]:g} Hz, the limit of the acoustic skin")
        above = int(np.searchsorted(grid, hz))
        if above == 0:
            return {0: 1.0}
        near = range(max(0, above - REACH), min(above + REACH, len(grid)))
        return {i: float(np.prod([(hz - grid[j]) / (grid[i] - grid[j]) for j in near if j != i])) for i in near}

    def R(self, hz) -> np.ndarray:
        """Resistance at a frequency [Hz], r x r, symmetric [N s/m]: R / f^2 is interpolated. Refused above the last frequency."""
        return sum(weight * (hz / self.frequency_hz[i]) ** 2 * dataset(self.file, f"resistance/{i:05d}")
                   for i, weight in self._weights(hz).items())

    def H(self, hz) -> np.ndarray:
        """Pressures of the microphones per reduced velocity at a frequency [Hz], n_m x r, complex [Pa s/m]."""
        distance = dataset(self.file, "microphones/distance")[:, None]
        wavenumber = 2.0 * np.pi / self.attribute("air_sound_speed_m_s")
        parts = ((weight, self.frequency_hz[i], *(dataset(self.file, f"microphones/pressure_{part}/{i:05d}") for part in ("re", "im")))
                 for i, weight in self._weights(hz).items())
        return sum(weight * (hz / at) * np.exp(1j * wavenumber * (at - hz) * distance) * (re + 1j * im) for weight, at, re, im in parts)

    def power(self, v, hz) -> float:
        """Sound power of a reduced velocity, r, complex peak amplitudes [m/s], at a frequency [Hz]: 1/2 v^H R v [W]."""
        return float(0.5 * np.real(np.conj(v) @ self.R(hz) @ v))

    @property
    def microphones(self) -> list:
        """Names of the microphones, rows of H."""
        return [text(name) for name in dataset(self.file, "microphones/name")]

    @property
    def microphone_positions(self) -> np.ndarray:
        """Their positions in the frame of the part, n_m x 3 [m]."""
        return dataset(self.file, "microphones/position")

    @property
    def efficiency(self) -> np.ndarray:
        """Radiation efficiency of each reduced coordinate at each frequency, n_l x r [1]."""
        return dataset(self.file, "efficiency")
