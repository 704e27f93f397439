# SPDX-License-Identifier: GPL-3.0-or-later
"""Valve trains: lift of the valves, least gap between the coils of their springs, gap between cam and roller."""
from clatter.artefact import BadArtefact
from clatter.histories import has
from . import style
from .over_cycle import LastCycle, named

LINES = 6  # of a picture: colours that are told apart


def trains(run):
    """Names of the valves of trains with springs: histories <name>_lift and <name>_coil_gap."""
    return [name.removesuffix("_coil_gap") for name in named(run, "", "_coil_gap")
            if has(run, name.removesuffix("_coil_gap") + "_lift")]


def rows(run):
    """(histories with the names of their lines, label of the axis) of what the run has."""
    valves = trains(run)
    springs = [(name, short(name)) for name in named(run, "valve_spring_", "_least_gap")]
    found = [([(f"{name}_lift", short(name)) for name in valves], "valve lift\n[mm]"),
             ([(f"{name}_coil_gap", short(name)) for name in valves] + springs, "least gap of\ncoils [mm]"),
             ([(f"{name}_cam_gap", short(name)) for name in valves if has(run, f"{name}_cam_gap")], "gap of cam\nand roller [mm]")]
    return [(lines[:LINES], text) for lines, text in found if lines]


def draw(files):
    """Lift of the valves, least gap between the coils of their springs (0: they touch) and gap of cam and roller over the last
    cycle (one run file)."""
    run = style.open_one(files, "run")
    shown = rows(run)
    if not shown:
        raise BadArtefact(f"{run.filename}: history: found no <valve>_coil_gap or valve_spring_<name>_least_gap, expected a "
                          "scene with [[valve]] or [[valve_spring]]")
    cycle = LastCycle(run)
    figure, axes = style.figure(len(shown), height=1.9, sharex=True)
    for axis, (lines, text) in zip(axes[:, 0], shown):
        for name, line in lines:
            axis.plot(cycle.x, 1e3 * cycle.history(name, "m"), label=line, linewidth=1.2)
        axis.axhline(0.0, color="#333333", linewidth=0.8)
        axis.set_ylabel(text)
    cycle.finish(axes[-1, 0])
    style.headline(figure, f"Valve train: {style.label(run)}")
    style.legend(axes[0, 0], columns=LINES)
    return figure


def short(name):
    """"valve_spring_outer_least_gap" as "outer", "intake_1" as "intake 1"."""
    return name.removeprefix("valve_spring_").removesuffix("_least_gap").replace("_", " ")
