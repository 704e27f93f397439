# SPDX-License-Identifier: GPL-3.0-or-later
"""Chain drives: the animation of `clatter drive`, tension around the loop."""
from .. import chains
from ..plots import drive, drive_film, loop


def collect(folder, pack):
    """One entry per chain of each run."""
    found = [read(one, chains.read_chain(one.run, name), pack) for one in folder.with_run() for name in chains.names(one.run)]
    return found or None


def read(one, chain, pack):
    instant = drive.instant_of_largest_tension(chain)
    around = chains.Loop(chain, instant)
    at, low, mean, high = loop.around(chain, around, chain.last_cycle())
    curve = lambda values: pack.add("curves", values)  # noqa: E731
    return {"run": one.number, "name": chain.name, "page": drive_film.page(chain, *drive.titled(one.run)), "first": chain.over[0].name,
            "loop": {"at": curve(1e3 * at), "low": curve(low), "mean": curve(mean), "high": curve(high),
                     "zones": [[name, 1e3 * begin, 1e3 * end] for name, begin, end in around.zones]}}
