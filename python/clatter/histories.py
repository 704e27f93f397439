# SPDX-License-Identifier: GPL-3.0-or-later
"""Scalar histories of a run file over crank angle."""
import numpy as np

from .artefact import BadArtefact, dataset, text


def crank_angle(run):
    """Crank angle of the recorded histories [deg]."""
    return dataset(run, "history/crank_angle_deg")


def angle_zero(file):
    """What crank angle 0 of a run or field is, in words: "firing TDC"; "TDC" of an engine without gas, "the cycle's start" of other machines."""
    return text(file.attrs.get("angle_zero", "firing TDC"))


def history(run, name, unit):
    """One history; BadArtefact if the file's unit is not the expected one."""
    values = dataset(run, f"history/{name}")
    found = text(run[f"history/{name}"].attrs.get("unit", ""))
    if found != unit:
        raise BadArtefact(f"{run.filename}: history/{name}: unit: found '{found}', expected '{unit}'")
    return values


def time_weights(time):
    """Weights of samples at any instants, whose sum is 1: of the mean over time, piecewise linear between them. Histories have a row for
    each step of the integration, not at equal times."""
    steps = np.diff(time)
    if len(time) < 2 or not time[-1] > time[0]:
        return np.full(len(time), 1.0 / len(time))
    return 0.5 * (np.append(steps, 0.0) + np.append(0.0, steps)) / (time[-1] - time[0])


def has(run, name):
    return f"history/{name}" in run


def cylinders(run, history_name):
    """Names of the cylinders that have a history, alphabetically; [""] where the run has a single one without a name."""
    if "history" not in run:
        return []
    ending = "_" + history_name
    named = sorted(name.removesuffix(ending) for name in run["history"] if name.endswith(ending))
    return [""] if has(run, history_name) else named


def of(cylinder, name):
    """The name of a cylinder's history."""
    return f"{cylinder}_{name}" if cylinder else name


def last_cycle(angle):
    """Slice of the last complete cycle of 720 deg (the periodic one), or everything when the run is shorter."""
    first = int(np.searchsorted(angle, angle[-1] - 720.0 - 1e-6))
    return slice(first, None)


def last_cycle_of_fields(angle):
    """Slice of the last cycle of fields that are recorded at intervals, which has each of its crank angles once."""
    spacing = float(np.median(np.diff(angle))) if len(angle) > 1 else 0.0
    return slice(int(np.searchsorted(angle, angle[-1] - 720.0 + 0.5 * spacing)), None)


def centred(angle):
    """Maps the last cycle's angles to -360 .. 360 deg about firing TDC, and the permutation that sorts them."""
    wrapped = (angle + 360.0) % 720.0 - 360.0
    order = np.argsort(wrapped, kind="stable")
    return wrapped[order], order
