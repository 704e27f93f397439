# SPDX-License-Identifier: GPL-3.0-or-later
"""A surface of triangles and its motion: what every format of a hand-off is written from."""
import dataclasses
from collections.abc import Callable

import numpy as np


@dataclasses.dataclass(frozen=True)
class Quantity:
    """A quantity of a motion: its unit, and whether it is a vector at each node or a number on each face."""
    unit: str
    at_nodes: bool


QUANTITIES = {"velocity": Quantity("m/s", True), "displacement": Quantity("m", True),
              "acceleration": Quantity("m/s2", True), "normal_velocity": Quantity("m/s", False)}


@dataclasses.dataclass(frozen=True)
class Surface:
    """n nodes and f triangles.

    nodes      n x 3 [m]
    triangles  f x 3, or f x 6: corners, then the mid-side nodes of edges 01, 12, 20; rows of nodes from 0; outward
    area       f [m2]; normal f x 3, mean outward unit normal; centre f x 3 [m]
    panels     {name: rows of triangles}, may overlap
    """
    nodes: np.ndarray
    triangles: np.ndarray
    area: np.ndarray
    normal: np.ndarray
    centre: np.ndarray
    panels: dict

    @classmethod
    def flat(cls, nodes, triangles, panels):
        """Of triangles with three nodes (f x 3), whose areas and normals are those of their planes."""
        a, b, c = np.moveaxis(nodes[triangles], 1, 0)
        twice = np.cross(b - a, c - a)
        length = np.linalg.norm(twice, axis=1)
        normal = twice / np.maximum(length, np.finfo(float).tiny)[:, None]
        return cls(nodes, triangles, 0.5 * length, normal, (a + b + c) / 3.0, panels)

    @property
    def is_quadratic(self):
        return self.triangles.shape[1] == 6


@dataclasses.dataclass(frozen=True)
class Origin:
    """What the head of a written file says about its source."""
    body: str
    file: str              # name of the source
    phase: str             # "x(t) = Re( X exp(+i 2 pi f t) ), t = 0 at crank angle 0 ..."
    air_density: float     # [kg/m3]
    air_sound_speed: float  # [m/s]


@dataclasses.dataclass(frozen=True)
class Motion:
    """Motion of a surface: complex peak amplitudes over frequency (lines), or real values at instants (frames).

    kind        "lines" or "frames"
    at          frequency [Hz] or time [s] of each step
    quantities  names in QUANTITIES that `read` knows
    read        read(quantity, step): n x 3 at nodes, f on faces; complex for lines
    """
    kind: str
    at: np.ndarray
    quantities: tuple
    read: Callable
    origin: Origin

    @property
    def is_complex(self):
        return self.kind == "lines"

    @property
    def axis(self):
        """(name, unit) of `at`."""
        return ("frequency", "Hz") if self.is_complex else ("time", "s")

    def step_name(self, step):
        """Of messages and ID lines: "1033.33 Hz"."""
        return f"{self.at[step]:.6g} {self.axis[1]}"

    def convention(self):
        """One line on phase or time, for the head of a file."""
        return f"peak amplitudes, {self.origin.phase}" if self.is_complex else "real values, time from crank angle 0 (from the first sample when nothing turns)"

    def parts(self, quantity):
        """Names of the real arrays that hold a quantity, with the functions that form them."""
        if not self.is_complex:
            return {quantity: np.asarray}
        return {f"{quantity}_re": np.real, f"{quantity}_im": np.imag}


def interleaved(values):
    """Rows as real numbers: re, im, re, im, ... of complex values; real ones as they are; two-dimensional."""
    rows = values.reshape(len(values), -1)
    if not np.iscomplexobj(rows):
        return rows.astype(float)
    return np.stack([rows.real, rows.imag], axis=2).reshape(len(rows), -1)
