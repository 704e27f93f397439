# SPDX-License-Identifier: GPL-3.0-or-later
"""Recovered motion and sound of a run, scene.field.h5."""
import functools

import numpy as np

from . import fields
from .artefact import Artefact, dataset, text
from .coordinates import pick, read_sets

QUANTITIES = ("displacement", "velocity", "acceleration")


class Field(Artefact):
    """One piece of a run: its cycle, or a window. Complex lines are peak amplitudes X of x(t) = Re(X exp(+i 2 pi f t))."""

    kind = "field"

    def __init__(self, path, piece=None):
        """piece: "cycle" or the name of a window; without it the cycle, or the first window where there is none."""
        super().__init__(path)
        self._at = fields.piece(self.file, *([piece] if piece else ["cycle", *self.pieces]))

    @property
    def pieces(self) -> list:
        """Names of the pieces in the file."""
        return fields.pieces(self.file)

    @property
    def body(self) -> str:
        """Name of the body whose surface it is."""
        return self.attribute("body")

    def _read(self, name):
        return dataset(self.file, f"{self._at}/{name}")

    @property
    def time(self) -> np.ndarray:
        """Samples, n_t, 0 at crank angle 0, firing TDC of an engine (of a scene without a crank: from the first sample) [s]."""
        return self._read("time")

    @property
    def frequency_hz(self) -> np.ndarray:
        """Lines of the spectra, n_l [Hz]."""
        return self._read("frequency_hz")

    @property
    def order(self) -> np.ndarray:
        """Engine orders of the lines, n_l [1]. Refused for a window."""
        return self._read("order")

    @functools.cached_property
    def sensors(self) -> dict:
        """{name: Set} of the sensors: positions [m], directions [1]."""
        return read_sets(self.file, f"{self._at}/sensors")

    def _sensor(self, name, quantity, path):
        """Columns of a sensor's dataset, those of a set or the one of a label."""
        self._check(quantity in QUANTITIES, f"found {quantity}, expected {', '.join(QUANTITIES)}")
        owner, within = pick(self.file, self.sensors, name, f"{self._at}/sensors")
        values = self._read(f"sensors/{owner}/{path}")
        return values[:, within[0]] if name not in self.sensors else values

    def history(self, name, quantity="velocity") -> np.ndarray:
        """Motion of a sensor, n_t x c, or of one of its coordinates ("sensor.z"), n_t: displacement [m], velocity [m/s] or acceleration
        [m/s2]."""
        return self._sensor(name, quantity, quantity)

    def spectrum(self, name, quantity="velocity") -> np.ndarray:
        """Its lines, n_l x c or n_l, complex peak amplitudes [m], [m/s] or [m/s2]. Refused where several segments were averaged, which
        have `power_spectrum` only."""
        return self._sensor(name, quantity, f"spectrum/{quantity}_re") + 1j * self._sensor(name, quantity, f"spectrum/{quantity}_im")

    def power_spectrum(self, name, quantity="velocity") -> np.ndarray:
        """Mean square (RMS^2) of each line, n_l x c or n_l [m2], [m2/s2] or [m2/s4]."""
        if f"{self._at}/sensors/{pick(self.file, self.sensors, name)[0]}/spectrum/{quantity}_power" in self.file:
            return self._sensor(name, quantity, f"spectrum/{quantity}_power")
        return 0.5 * np.abs(self.spectrum(name, quantity)) ** 2

    @functools.cached_property
    def panels(self) -> dict:
        """{name: area [m2]}."""
        return {name: float(one.attrs["area_m2"]) for name, one in self.file.get(f"{self._at}/panels", {}).items()}

    def _panel(self, name):
        return fields.panel(self.file, self._at, *([name] if name else ["exposed", "skin"])).removeprefix(f"{self._at}/")

    def mean_square_velocity(self, panel=None) -> np.ndarray:
        """Mean square normal velocity of a panel in each line, n_l [m2/s2]; without a name of the exposed faces, or the skin."""
        return self._read(f"{self._panel(panel)}/mean_square_velocity")

    def erp(self, panel=None) -> np.ndarray:
        """Equivalent radiated power of a panel in each line, n_l [W]: an upper estimate of the sound power."""
        return self._read(f"{self._panel(panel)}/erp")

    @property
    def has_sound(self) -> bool:
        """Whether the field was made with a sound file (boundary elements)."""
        return f"{self._at}/sound" in self.file

    @property
    def sound_power(self) -> np.ndarray:
        """Sound power in each line, n_l [W], of boundary elements up to `sound_to_hz`, above it the ERP. Refused without a sound file."""
        return self._read("sound/power")

    @property
    def sound_to_hz(self) -> float:
        """Up to which frequency boundary elements give the sound power [Hz]; 0 without a sound file."""
        return fields.sound_limit(self.file, self._at)

    def level_dba(self, panel=None) -> float:
        """A-weighted level [dB re 1 pW] of the ERP of a panel; without a name of the sound power, or the ERP where there is none."""
        if panel is None:
            return fields.radiated(self.file, self._at).dba
        return float(self.file[f"{self._at}/{self._panel(panel)}"].attrs["erp_dba"])

    def level_error_dba(self, panel=None) -> float:
        """Standard error [dB] of `level_dba` of a mean over several segments, as cycles; nan of one segment."""
        if panel is None:
            return fields.radiated(self.file, self._at).error
        return fields.standard_error(self.file[f"{self._at}/{self._panel(panel)}"], "erp")

    def third_octaves(self, panel=None) -> tuple:
        """(mid-bands, b [Hz]; A-weighted levels, b [dB re 1 pW]) of the same power."""
        path = fields.radiated(self.file, self._at).bands if panel is None else f"{self._at}/{self._panel(panel)}/third_octave/erp_dba"
        levels = dataset(self.file, path)
        return self._read("third_octave/mid_hz")[:len(levels)], levels

    @property
    def microphones(self) -> list:
        """Names of the microphones; none without a sound file."""
        return [text(name) for name in self.file.get(f"{self._at}/sound/microphones", ())]

    def pressure(self, microphone) -> np.ndarray:
        """Pressure at a microphone in the lines up to `sound_to_hz`, complex peak amplitudes [Pa]. Refused where several segments were
        averaged."""
        where = f"sound/microphones/{microphone}/pressure"
        return self._read(f"{where}_re") + 1j * self._read(f"{where}_im")
