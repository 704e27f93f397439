# SPDX-License-Identifier: GPL-3.0-or-later
"""What bench/stability.py compares: numbers of artefacts in the axes, lengths and times of the unmoved model, digests of their bits."""
import hashlib

import h5py
import numpy as np
import scipy.linalg

from stability_models import Motion

UNCOMPARED = ("timing", "effects", "statistics", "inputs", "request")  # seconds of processor time, paths
LOSS = 0.02  # of the frequency response functions


def digest(path):
    """SHA-256 of all numeric datasets of an artefact but those of processor time and provenance."""
    found = hashlib.sha256()

    def add(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind in "fiu" and not name.startswith(UNCOMPARED):
            found.update(name.encode() + np.ascontiguousarray(item[()]).tobytes())

    with h5py.File(path) as file:
        file.visititems(add)
    return found.hexdigest()


def mass_numbers(path, motion=Motion()):
    """Mass [kg], centre [m], inertia about it [kg m2] of a part, before the motion."""
    with h5py.File(path) as file:
        mass = file["mass"].attrs["mass"] / motion.scale**3
        centre, inertia = motion.back(file["mass/centre"][()]), motion.R.T @ file["mass/inertia"][()] @ motion.R / motion.scale**5
    return {"mass": np.array([mass]), "centre": centre, "inertia": inertia}


def reduced_numbers(path, motion=Motion(), limit_hz=None):
    """Eigenfrequencies [Hz] of the reduced pencil up to `limit_hz` (default: where it is accurate) without rigid motions; its counts.

    The pencil is solved as M x = mu (K + s M) x, whose largest mu are the lowest frequencies: relative to them, rounding of the highest is small.
    """
    with h5py.File(path) as rom:
        K, M, certificate = rom["K_rr"][()], rom["M_rr"][()], rom["certificate"].attrs
        shift = (2 * np.pi * certificate["first_elastic_hz"]) ** 2 * (certificate["rigid_modes"] > 0)
        mu = scipy.linalg.eigh(M, K + shift * M, eigvals_only=True)[::-1]
        rigid = int(certificate["rigid_modes"])
        hz = np.sqrt(1 / mu[rigid:] - shift) / (2 * np.pi) * motion.scale
        limit = limit_hz or certificate["accurate_to_hz"] * motion.scale
        counts = [len(K), *(certificate[name] for name in ("fixed_interface_modes", "residual_modes", "dropped_vectors", "rigid_modes", "certified",
                                                          "count_proved"))]
        return {"reduced_hz": hz[hz < limit * (1 - 1e-6)], "counts": np.array(counts, float)}


def response_numbers(path, load, sensor, hz, motion=Motion()):
    """Displacement of a sensor per unit of a load [m/N]: static, and complex at `hz` with a loss factor."""
    with h5py.File(path) as rom:
        K, M, f = rom["K_rr"][()], rom["M_rr"][()], rom[f"loads/{load}"][()]
        dofs = rom[f"sets/{sensor}/dofs"][()]
    at = 2 * np.pi * np.asarray(hz) / motion.scale

    def sensed(matrix):
        return motion.direction_back(np.linalg.solve(matrix, f)[dofs]) * motion.scale  # K grows with the length, the force with its square

    return {"static": sensed(K), "response": np.array([sensed(K * (1 + 1j * LOSS) - w**2 * M) for w in at])}


def energy_residue(path):
    with h5py.File(path) as run:
        return {"residue": np.array([run["certificate"].attrs["energy_residue"]]),
                "steps": np.array([run["certificate"].attrs["steps_accepted"]])}


def radiated_numbers(path, at, panel="exposed", motion=Motion()):
    """ERP [W] and third octaves [dB] of a panel; both as at the unmoved size."""
    with h5py.File(path) as field:
        group = field[f"{at}/panels/{panel}"]
        mid = field[f"{at}/third_octave/mid_hz"][()] * motion.scale
        return {"erp": np.array([group.attrs["erp_w"]]) / motion.scale**2,
                "bands": np.column_stack([mid, group["third_octave/velocity_db"][()]])}


def band_difference(found, base):
    """Largest difference [dB] of the third octaves (rows: mid-band [Hz], level [dB]) that both have: those of 1 Hz to 1 MHz, at any scale."""
    common = [(a[1], b[1]) for a in found for b in base if abs(a[0] / b[0] - 1) < 1e-6]
    return max(abs(a - b) for a, b in common) if len(common) >= 5 else np.inf


def largest(found, base):
    """Largest difference over the largest value of the base."""
    if found.shape != base.shape:
        return np.inf
    return float(np.abs(found - base).max() / np.abs(base).max())


def relative(found, base):
    """Largest relative difference of values that are compared one by one."""
    if found.shape != base.shape:
        return np.inf
    return float(np.abs(found / base - 1).max())


def absolute(found, base):
    return float(np.abs(found - base).max()) if found.shape == base.shape else np.inf
