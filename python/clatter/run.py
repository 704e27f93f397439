# SPDX-License-Identifier: GPL-3.0-or-later
"""A run in time, scene.run.h5."""
import functools

import numpy as np

from .artefact import Artefact, dataset, sha256, text
from .chains import Chain, read_chain
from .chains import names as chain_names
from .errors import BadArtefact, Refused
from .films import Film, contacts
from .rom import Rom

try:
    import pandas
except ImportError:
    pandas = None

MOTIONS = {"displacement": ("q", "m", "rad"), "velocity": ("v", "m/s", "rad/s"), "acceleration": ("a", "m/s2", "rad/s2")}
AXES = ("time", "crank_angle_deg")


def table_of(columns):
    """{name: array} as pandas.DataFrame by its first column, without pandas as a structured array."""
    if pandas is not None:
        return pandas.DataFrame(columns).set_index(next(iter(columns)))
    found = np.empty(len(next(iter(columns.values()))), [(name, values.dtype) for name, values in columns.items()])
    for name, values in columns.items():
        found[name] = values
    return found


class Run(Artefact):
    """Histories are scalars of the scene over `history_time`; motions are those of bodies over `time`. A column is a history
    ("piston_lateral") or a body's coordinate ("block.sensor.z")."""

    kind = "run"

    @property
    def title(self) -> str:
        """Title of the scene."""
        return self.attribute("title")

    @property
    def complete(self) -> bool:
        """False: the run was interrupted."""
        return bool(self.attribute("complete"))

    @property
    def time(self) -> np.ndarray:
        """Instants of the motions, n_t, equally spaced [s]."""
        return dataset(self.file, "output/time")

    @property
    def crank_angle_deg(self) -> np.ndarray:
        """Crank angle at these instants, n_t, rising through all cycles; 0 is what `angle_zero` says, firing TDC of an engine [deg]. Refused in a scene without a crank."""
        return dataset(self.file, "output/crank_angle_deg")

    @property
    def history_time(self) -> np.ndarray:
        """Instants of the histories, n_h, the ends of the integration's steps: not equally spaced [s]."""
        return dataset(self.file, "history/time")

    @property
    def bodies(self) -> list:
        """Names of the bodies."""
        return list(self.file.get("bodies", ()))

    @functools.cached_property
    def units(self) -> dict:
        """{column: unit} of all histories and, where the reduced models are there as they were, all displacements or angles of bodies."""
        found = {name: text(one.attrs.get("unit", "")) for name, one in self.file.get("history", {}).items() if name not in AXES}
        for body in self.bodies:
            try:
                sets = self.rom(body).sets.values()
            except BadArtefact:
                continue
            found.update({f"{body}.{label}": "rad" if turns else "m" for own in sets for label, turns in zip(own.labels, own.is_rotation)})
        return found

    def __getitem__(self, column) -> np.ndarray:
        """A history, n_h, in its own unit, or the displacement of a body's coordinate, n_t [m] (angle [rad])."""
        if f"history/{column}" in self.file:
            return dataset(self.file, f"history/{column}")
        body, point, coordinate = column.partition(".")
        known = point and body in self.bodies
        self._check(known, f"found no column {column}, expected one of {', '.join(list(self.units)[:12]) or 'none'}")
        return self.motion(body, coordinate)[:, 0]

    def rom(self, body) -> Rom:
        """The reduced model of a body, from the path of the scene or beside the run. Refused where it is missing or has changed since."""
        self._check(body in self.bodies, f"bodies: found {', '.join(self.bodies)}, expected {body}")
        if body not in self._roms:
            self._roms[body] = self._read_rom(body)
        return self._roms[body]

    @functools.cached_property
    def _roms(self):
        return {}

    def close(self) -> None:
        """Closes the file and those of the reduced models; arrays that were read stay."""
        for one in self._roms.values():
            one.close()
        super().close()

    def _read_rom(self, body):
        attributes = self.file[f"bodies/{body}"].attrs
        name = text(attributes["rom"])
        paths = [path for path in (self.path.parent / name, self.path.parent / name.rpartition("/")[2]) if path.exists()]
        self._check(paths, f"bodies/{body}: {name} is missing: it names the coordinates")
        self._check(sha256(paths[0]) == text(attributes["rom_sha256"]), f"bodies/{body}: {name} has changed since the run: repeat the run")
        return Rom(paths[0])

    def q(self, body) -> np.ndarray:
        """Reduced coordinates of a body, n_t x r [m]."""
        return dataset(self.file, f"bodies/{body}/q")

    def v(self, body) -> np.ndarray:
        """Their velocities, n_t x r [m/s]."""
        return dataset(self.file, f"bodies/{body}/v")

    def a(self, body) -> np.ndarray:
        """Their accelerations, means over an output interval, n_t x r [m/s2]."""
        return dataset(self.file, f"bodies/{body}/a")

    def motion(self, body, name, quantity="displacement") -> np.ndarray:
        """Motion of a set ("tip") or a coordinate ("tip.z") of a body, n_t x c, in the frame of its attribute `frame`: displacement [m],
        velocity [m/s] or acceleration [m/s2], of rotations with rad."""
        self._check(quantity in MOTIONS, f"motion: found {quantity}, expected {', '.join(MOTIONS)}")
        rows = self.rom(body).T(name)
        return dataset(self.file, f"bodies/{body}/{MOTIONS[quantity][0]}") @ rows.T

    def table(self, body=None, quantity="displacement"):
        """All histories over `history_time`, which is not equally spaced, or all coordinates of a body over `time`: a pandas.DataFrame whose index is the time [s],
        without pandas a structured array whose first field is `time` [s]. Units of the columns are in `units`."""
        return table_of({name: values for name, (values, _) in self._columns(body, quantity).items()})

    def dataset(self, body=None, quantity="displacement"):
        """The same as an xarray.Dataset over the coordinate `time` [s], with the crank angle [deg] as a second one where there is one; each variable has its
        attribute `units`. Refused without xarray."""
        try:
            import xarray  # here, because it loads pandas
        except ImportError as error:
            raise Refused(f"{self.path.name}: dataset needs xarray: apt-get install python3-xarray") from error
        columns = {name: ("time", values, {"units": unit}) for name, (values, unit) in self._columns(body, quantity).items()}
        axes = {name: columns.pop(name) for name in AXES if name in columns}
        return xarray.Dataset(columns, axes)

    def _columns(self, body, quantity):
        """{name: (values, unit)}, the time first."""
        if body is None:
            histories = self.file.get("history", {})
            return {"time": (self.history_time, "s"), **{name: (dataset(self.file, f"history/{name}"), text(one.attrs.get("unit", "")))
                                                        for name, one in histories.items() if name != "time"}}
        motions = {name: self.motion(body, name, quantity) for name in self.rom(body).sets}
        _, *units = MOTIONS[quantity]
        return {"time": (self.time, "s"), **{label: (values, units[int(turns)]) for name, own in self.rom(body).sets.items()
                                             for label, turns, values in zip(own.labels, own.is_rotation, motions[name].T)}}

    @functools.cached_property
    def films(self) -> dict:
        """{"pad", of named cylinders "cylinder/pad": Film} of the maps of oil films; empty without film_every_deg in the scene."""
        return {f"{cylinder}/{pad}".lstrip("/"): Film(self.file, f"film/{cylinder}/{pad}".replace("//", "/"))
                for cylinder, group in contacts(self.file) for pad in group if "axial" in group[pad]}

    @property
    def chains(self) -> list:
        """Names of the chains whose shapes were recorded."""
        return chain_names(self.file)

    def chain(self, name=None) -> Chain:
        """Shapes of a chain: positions [m], angles [rad], tensions [N] of its links at instants [s]. Refused without any."""
        return read_chain(self.file, name)
