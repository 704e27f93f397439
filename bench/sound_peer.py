#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sound power of a run by a second boundary element method, beside that of its field file.

Uses block.rom.h5, block.sound.h5, slap.run.h5 and slap.field.h5 of samples/truck_diesel (after `make demo`), or of --folder. It takes
only the closed surface and its lids from the sound file; all else is another way: constant pressures collocated at the centres of the
triangles, points inside the body against irregular frequencies (Schenck 1968), and in place of the map the velocity of the nearest
exposed node. Prints the power of a point source inside the body over its exact value, and per band the power over the ERP of the
exposed faces, with lids at rest and lids that move with the nearest node. A line takes some seconds.
"""
import argparse
from pathlib import Path

import h5py
import numpy as np
from scipy.spatial import cKDTree

ROOT = Path(__file__).resolve().parent.parent
BANDS = [30, 71, 141, 282, 447, 708, 1122, 1500]
INNER_POINTS = 60
A, B, C, D = 0.059715871789770, 0.470142064105115, 0.797426985353087, 0.101286507323456
POINTS = np.array([[1 / 3] * 3, [A, B, B], [B, A, B], [B, B, A], [C, D, D], [D, C, D], [D, D, C]])  # degree 5
WEIGHTS = np.array([0.225] + [0.132394152788506] * 3 + [0.125939180544827] * 3)


class Solver:
    """Constant triangles, e^{+i w t}, normals out of the body."""

    def __init__(self, nodes, triangles, density, speed):
        self.density, self.speed = density, speed
        self.corners = nodes[triangles]
        normal = np.cross(self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0])
        self.area = np.linalg.norm(normal, axis=1) / 2
        self.normal = normal / (2 * self.area[:, None])
        self.centre = self.corners.mean(1)
        self.samples = np.einsum("ql,flx->qfx", POINTS, self.corners)
        self.inner = self.inner_points(nodes)

    def inner_points(self, nodes):
        """Points in the body, at least 40 mm from its surface."""
        tries = np.random.default_rng(1).uniform(nodes.min(0), nodes.max(0), (400, 3))
        a, b, c = (self.corners[None, :, k] - tries[:, None] for k in range(3))
        la, lb, lc = (np.linalg.norm(one, axis=2) for one in (a, b, c))
        above = np.einsum("pfx,pfx->pf", a, np.cross(b, c))
        below = la * lb * lc + (a * b).sum(2) * lc + (a * c).sum(2) * lb + (b * c).sum(2) * la
        inside = tries[np.abs(2 * np.arctan2(above, below).sum(1) / (4 * np.pi)) > 0.5]
        return inside[cKDTree(self.centre).query(inside)[0] > 0.04][:INNER_POINTS]

    def own(self):
        """Integral of 1/r over each triangle from its centre, exact."""
        total = np.zeros(len(self.area))
        for edge in range(3):
            p, q = self.corners[:, edge] - self.centre, self.corners[:, (edge + 1) % 3] - self.centre
            along = (q - p) / np.linalg.norm(q - p, axis=1)[:, None]
            height = np.linalg.norm(p - (p * along).sum(1)[:, None] * along, axis=1)
            total += height * (np.arcsinh((q * along).sum(1) / height) - np.arcsinh((p * along).sum(1) / height))
        return total

    def layers(self, k, points, at_centres):
        """Single and double layer potentials at points, n x faces."""
        single, double = (np.zeros((len(points), len(self.area)), complex) for _ in range(2))
        for sample, weight in zip(self.samples, WEIGHTS):
            r = sample[None] - points[:, None]
            distance = np.sqrt((r**2).sum(2))
            with np.errstate(divide="ignore", invalid="ignore"):  # the centre itself: set below
                green = np.exp(-1j * k * distance) / (4 * np.pi * distance) * (weight * self.area)
                single += green
                double -= (1 / distance**2 + 1j * k / distance) * green * (r * self.normal[None]).sum(2)
        if at_centres:
            np.fill_diagonal(single, self.own() / (4 * np.pi) - 1j * k * self.area / (4 * np.pi))
            np.fill_diagonal(double, 0.0)
        return single, double

    def power(self, hz, velocity):
        """Sound power [W] of columns of normal velocities (peak)."""
        w = 2 * np.pi * hz
        single, double = self.layers(w / self.speed, self.centre, True)
        inner_single, inner_double = self.layers(w / self.speed, self.inner, False)
        left = np.vstack([0.5 * np.eye(len(self.area)) - double, -inner_double])
        right = 1j * w * self.density * np.vstack([single, inner_single]) @ velocity
        pressure = np.linalg.solve(left.conj().T @ left, left.conj().T @ right)
        return 0.5 * np.real((self.area[:, None] * pressure * velocity.conj()).sum(0))

    def point_source(self, hz):
        """Power of a point source in the body over its exact value."""
        at = self.inner[np.argmax(cKDTree(self.centre).query(self.inner)[0])]
        r = self.centre - at
        distance, k = np.linalg.norm(r, axis=1), 2 * np.pi * hz / self.speed
        slope = -(1j * k + 1 / distance) * np.exp(-1j * k * distance) / distance**2 * (r * self.normal).sum(1)
        velocity = -slope / (2j * np.pi * hz * self.density)
        return self.power(hz, velocity[:, None])[0] / (2 * np.pi / (self.density * self.speed))


def velocities(folder, solver, lids):
    """(frequencies, normal velocities of a line with lids at rest and moving); faces x 2."""
    with h5py.File(folder / "block.rom.h5") as rom, h5py.File(folder / "slap.field.h5") as field:
        exposed = np.unique(rom["skin/triangles"][()][field["panels/exposed/faces"][()]])
        nearest = exposed[cKDTree(rom["skin/nodes"][()][exposed]).query(solver.centre)[1]]
        rows = rom["skin/T"][()].reshape(-1, 3, rom["skin/T"].shape[1])[nearest]
    per_reduced = np.einsum("fi,fir->fr", solver.normal, rows)
    at_rest = per_reduced.copy()
    at_rest[lids] = 0
    with h5py.File(folder / "slap.run.h5") as run:
        v, time = run["bodies/block/v"][:-1], run["output/time"][()]
    lines = np.fft.rfft(v, axis=0) * 2 / len(v)
    hz = np.arange(len(lines)) / (time[-1] - time[0])
    return hz, lambda line: np.array([at_rest @ lines[line], per_reduced @ lines[line]]).T


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--folder", type=Path, default=ROOT / "samples" / "truck_diesel")
    options = parser.parse_args()
    with h5py.File(options.folder / "block.sound.h5") as sound:
        solver = Solver(sound["skin/nodes"][()], sound["skin/triangles"][()], sound.attrs["air_density_kg_m3"], sound.attrs["air_sound_speed_m_s"])
        lids = sound["skin/lids"][()]
    for hz in (100, 500, 1000, 1500):
        print(f"point source at {hz} Hz: {100 * (solver.point_source(hz) - 1):+.2f} %")
    with h5py.File(options.folder / "slap.field.h5") as field:
        erp, ours = (field[f"analysis/cycle/{name}"][()] for name in ("panels/exposed/erp", "sound/power"))
    hz, line = velocities(options.folder, solver, lids)
    print("band [Hz]: power over ERP [dB] of clatter; peer with lids at rest; with moving lids")
    for low, high in zip(BANDS, BANDS[1:]):
        chosen = np.flatnonzero((hz >= low) & (hz < high))
        peer = sum(solver.power(hz[k], line(k)) for k in chosen)
        shown = 10 * np.log10(np.array([ours[chosen].sum(), *peer]) / erp[chosen].sum())
        print(f"{low:5d}-{high:4d}: " + "  ".join(f"{one:6.1f}" for one in shown), flush=True)


if __name__ == "__main__":
    main()
