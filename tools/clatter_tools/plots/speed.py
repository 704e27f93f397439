# SPDX-License-Identifier: GPL-3.0-or-later
"""Fluctuation of the angular velocity of sprockets, as in figure 5 of the paper."""
from clatter import chains
from clatter.artefact import BadArtefact
from . import style
from .over_cycle import LastCycle

ROW_IN = 1.9


def sprockets(run, name):
    """(name, teeth) of the sprockets of a chain, the first of them first."""
    over = run[f"chain/{name}/over"]
    ordered = sorted(over, key=lambda one: over[one].attrs["order"])
    return [(one, int(over[one].attrs["teeth"])) for one in ordered if over[one].attrs["teeth"] > 0]


def draw(files):
    """Fluctuation of the speed of all sprockets over the last cycle, one row per run, by speed (run files with a chain)."""
    runs = style.open_all(files, "run")
    for run in runs:
        if not chains.names(run):
            raise BadArtefact(f"{run.filename}: chain: found no shapes of a chain, whose sprockets this picture shows")
    runs.sort(key=chains.mean_rpm)
    figure, axes = style.figure(len(runs), height=ROW_IN, sharex=True, sharey=True)
    for axis, run in zip(axes[:, 0], runs):
        cycle, name = LastCycle(run), chains.names(run)[0]
        (first, first_teeth), *others = sprockets(run, name)
        for number, (one, teeth) in enumerate(others):
            axis.plot(cycle.x, cycle.fluctuation(f"{name}_{one}_speed", "rad/s"), color=style.COLOURS[number], label=one, linewidth=1.2)
        teeth = others[0][1] if others else first_teeth
        share = first_teeth / teeth
        axis.plot(cycle.x, share * cycle.fluctuation(f"{name}_{first}_speed", "rad/s"), color="#777777", linewidth=1.0,
                  label=f"{first} × {first_teeth}/{teeth}" if others else first)
        axis.set_title(f"{chains.mean_rpm(run):.0f} rpm", loc="left", fontsize=10)
    cycle.finish(axes[-1, 0])
    axes[len(runs) // 2, 0].set_ylabel("angular velocity\nless its mean [rad/s]")
    axes[0, 0].legend(loc="lower right", bbox_to_anchor=(1.01, 1.0), ncol=4, borderaxespad=0.2)
    style.headline(figure, "Speed fluctuation of the sprockets")
    return figure

