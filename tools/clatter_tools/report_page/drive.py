# SPDX-License-Identifier: GPL-3.0-or-later
"""Chain drives: the animation of `clatter drive`, tension around the loop."""
from clatter import chains
from clatter.artefact import dataset
from ..plots import drive, drive_film, loop


def collect(folder, pack):
    """One entry per chain of each run."""
    runs = [one for one in folder.with_run() if chains.names(one.run)]
    chosen = outstanding(runs) if folder.many else runs
    found = [read(one, chains.read_chain(one.run, name), pack) for one in chosen for name in chains.names(one.run)]
    return {"chains": found, "left_out": len(runs) - len(chosen)} if found else None


def outstanding(runs):
    """Of many runs the slowest, that with the largest tension, and the fastest."""
    speed = lambda one: chains.mean_rpm(one.run)  # noqa: E731
    tension = lambda one: max(float(dataset(one.run, f"chain/{name}/tension").max()) for name in chains.names(one.run))  # noqa: E731
    chosen = {min(runs, key=speed).number, max(runs, key=tension).number, max(runs, key=speed).number} if runs else set()
    return [one for one in runs if one.number in chosen]


def read(one, chain, pack):
    instant = drive.instant_of_largest_tension(chain)
    around = chains.Loop(chain, instant)
    at, low, mean, high = loop.around(chain, around, chain.last_cycle())
    curve = lambda values: pack.add("curves", values)  # noqa: E731
    return {"run": one.number, "name": chain.name, "page": drive_film.page(chain, *drive.titled(one.run)), "first": chain.over[0].name,
            "loop": {"at": curve(1e3 * at), "low": curve(low), "mean": curve(mean), "high": curve(high),
                     "zones": [[name, 1e3 * begin, 1e3 * end] for name, begin, end in around.zones]}}
