# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of oil films in a run file."""
import numpy as np

from .artefact import dataset
from .errors import BadArtefact


def contacts(run):
    """[(cylinder, group of its pads)]: the only cylinder, without a name, or each named one; none without maps."""
    film = run.get("film", {})
    if any("axial" in film[name] for name in film):
        return [("", film)]
    return [(name, film[name]) for name in sorted(film) if hasattr(film[name], "keys")]


class Film:
    """Maps of one pad at n_f instants, over angles and heights. `names` lists the quantities: gap, liner_oil [m], pressure,
    contact_pressure [Pa], fill [1]."""

    def __init__(self, run, path):
        self.group = run[path]
        self._over = run["film"]
        self.names = [name for name in self.group if self.group[name].ndim == 3]

    @property
    def time(self) -> np.ndarray:
        """Instants, n_f [s]."""
        return self._over["time"][()]

    @property
    def crank_angle_deg(self) -> np.ndarray:
        """Crank angle of the instants from firing TDC, rising through all cycles, n_f [deg]."""
        return dataset(self._over.file, "film/crank_angle_deg")

    @property
    def angle_deg(self) -> np.ndarray:
        """Angles around the piston, 0 on the thrust side, columns of a map [deg]."""
        return self.group["angle_deg"][()]

    @property
    def axial(self) -> np.ndarray:
        """Heights above the pin [m]."""
        return self.group["axial"][()]

    def map(self, name, frame) -> np.ndarray:
        """One map, angles x heights, in the unit of its quantity [m], [Pa] or [1]; frame: index of the instant."""
        if name not in self.names:
            raise BadArtefact(f"{self.group.file.filename}: {self.group.name}: found no map of {name}, expected {', '.join(self.names)}")
        return self.group[name][frame]
