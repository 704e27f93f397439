# SPDX-License-Identifier: GPL-3.0-or-later
"""Histories of runs over the crank angle of their last cycle: motion, forces, gaps."""
import numpy as np

from clatter.artefact import dataset, text
from ..plots.over_cycle import LastCycle

# Curves that are drawn first: end of the history's name, title, label of the axis, factor, unit, less its mean.
SHOWN = [
    ("piston_lateral", "Lateral position of the piston pin, positive toward the thrust side", "lateral position", 1e6, "µm", False),
    ("piston_tilt", "Tilt of the piston", "tilt", 1e3, "mrad", False),
    ("side_force", "Side force of the piston", "side force", 1e-3, "kN", False),
    ("pin_force_y", "Lateral force in the joints of the rod", "force", 1e-3, "kN", False),
    ("pin_force_z", "Force in the joints of the rod along the bore", "force", 1e-3, "kN", False),
    ("film_min", "Smallest gap between skirt and liner", "smallest gap", 1e6, "µm", False),
    ("film_pressure_max", "Largest pressure of the oil film", "pressure", 1e-6, "MPa", False),
    ("contact_pressure_max", "Largest pressure of asperity contact", "pressure", 1e-6, "MPa", False),
    ("friction_force", "Friction force of the piston", "friction force", 1.0, "N", False),
    ("gas_pressure", "Gas pressure", "pressure", 1e-5, "bar", False),
    ("tension_max", "Largest tension of a chain joint", "tension", 1.0, "N", False),
    ("_speed", "Speed fluctuation", "speed less its mean", 1.0, "rad/s", True),
    ("_pressure", "Pressure of hydraulic chambers, absolute", "pressure", 1e-5, "bar", False),
    ("_travel", "Travel of plungers", "travel", 1e3, "mm", False),
    ("_coil_gap", "Least gap between coils of valve springs", "gap", 1e3, "mm", False),
]
NOT_HISTORIES = ("time", "crank_angle_deg")
VALUES = 4_000_000  # of all histories of all runs; of more only those in SHOWN are kept
LINES = 6  # of a curve with several histories of one run


def collect(folder, pack):
    """Every history of every run, and the list of those that are drawn first."""
    cycles = [(one, LastCycle(one.run)) for one in folder.with_run() if "history" in one.run]
    present = sorted({name for one, _ in cycles for name in scalars(one.run)})
    groups = shown(present)
    names = present
    if sum(len(np.asarray(cycle.x)) * len(scalars(one.run)) for one, cycle in cycles) > VALUES:
        names = sorted(name for group in groups for name in group["names"])
    runs = [read(one, cycle, set(names), pack) for one, cycle in cycles]
    return {"runs": runs, "names": names, "left_out": len(present) - len(names), "shown": groups} if names else None


def scalars(run):
    """Names of the histories of one number per instant."""
    return [name for name in run["history"] if name not in NOT_HISTORIES and run[f"history/{name}"].ndim == 1]


def read(one, cycle, names, pack):
    histories = {name: {"unit": text(one.run[f"history/{name}"].attrs.get("unit", "")),
                        "values": pack.add("histories", dataset(one.run, f"history/{name}")[cycle.window][cycle.order])}
                 for name in scalars(one.run) if name in names}
    return {"run": one.number, "x": pack.add("histories", np.asarray(cycle.x, float)), "axis": cycle.label, "histories": histories}


def shown(names):
    """Groups of histories with title, factor and unit; each history is in the first group that its name fits."""
    groups, taken = [], set()
    for ending, title, label, factor, unit, less_mean in SHOWN:
        own = [name for name in names if name not in taken and fits(name, ending)][:LINES]
        taken.update(own)
        if own:
            groups.append({"title": title, "label": label, "names": own, "factor": factor, "unit": unit, "less_mean": less_mean})
    return groups


def fits(name, ending):
    """Of a single body or of a named cylinder; of parts of a mechanism only sprockets, tensioners, adjusters and springs."""
    if ending == "_speed":
        return name.endswith("_speed") and "." not in name
    if ending == "_pressure":
        return name.endswith("_pressure") and name.startswith(("tensioner_", "lash_adjuster_"))
    if ending.startswith("_"):
        return name.endswith(ending)
    return name == ending or name.endswith(f"_{ending}")
