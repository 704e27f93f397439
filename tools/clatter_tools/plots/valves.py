# SPDX-License-Identifier: GPL-3.0-or-later
"""Valve train: lift, gap between cam and roller, least gap between the coils of springs."""
from ..artefact import BadArtefact
from . import style
from .over_cycle import LastCycle, named

ROWS = (("_lift", 1e3, "valve lift [mm]"), ("_least_gap", 1e3, "least gap of\ncoils [mm]"))


def draw(files):
    """Lift of the valves and least gap between the coils of their springs over the last cycle; 0: coils clash (one run file)."""
    run = style.open_one(files, "run")
    rows = [(named(run, "valve_", end), scale, text) for end, scale, text in ROWS]
    rows = [row for row in rows if row[0]]
    if not rows:
        raise BadArtefact(f"{run.filename}: history: found no valve_<name>_lift or _least_gap, expected a valve train")
    cycle = LastCycle(run)
    figure, axes = style.figure(len(rows), height=2.3, sharex=True)
    for axis, (names, scale, text) in zip(axes[:, 0], rows):
        for name in names:
            axis.plot(cycle.x, scale * cycle.history(name, "m"), label=short(name), linewidth=1.2)
        axis.set_ylabel(text)
        if names[0].endswith("_least_gap"):
            axis.axhline(0.0, color="#333333", linewidth=0.8)
    cycle.finish(axes[-1, 0])
    style.headline(figure, f"Valve train: {style.label(run)}")
    style.legend(axes[0, 0], columns=4)
    return figure


def short(name):
    """"valve_intake_1_lift" as "intake 1"."""
    for end, *_ in ROWS:
        name = name.removesuffix(end)
    return name.removeprefix("valve_").replace("_", " ")
