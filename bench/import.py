#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time to read decks: a block of n x n x n cubes, six tet10 each (n = 50: a million nodes, 750 000 cells).

Measures seconds of the reader, the peak memory of the process and the size of the mesh; the same with skin and
proof of the cells, and as clatter-mesh --check. With --peers
CalculiX reads the Abaqus deck (*NO ANALYSIS: it reads, checks and stops), which takes over a minute and 4 GB.
"""
import argparse
import tempfile
from pathlib import Path

from measured import run
from tet_block import make, write_abaqus, write_nastran

ROOT = Path(__file__).resolve().parent.parent


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cubes", type=int, default=50, help="cubes along an edge")
    parser.add_argument("--peers", action="store_true", help="CalculiX as well")
    parser.add_argument("--build", default=ROOT / "build/release", type=Path, help="with target bench_programs built")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        print(f"{'reader':<18} {'deck MB':>8} {'seconds':>8} {'peak MB':>8}")
        for name, file, write in (("Abaqus", "block.inp", write_abaqus), ("Nastran", "block.bdf", write_nastran)):
            deck = Path(folder) / file
            make(write, deck, options.cubes)
            for how in ("checked", "proved", "read"):
                output, _, peak = run([options.build.resolve() / "bench/import_deck", deck, how], folder)
                nodes, cells, seconds, own = output.split()
                print(f"{name + ', ' + how:<18} {deck.stat().st_size / 1e6:8.0f} {float(seconds):8.2f} {peak:8.0f}")
        print(f"{nodes} nodes, {cells} tet10, mesh of {own} MB")
        if options.peers:
            _, seconds, peak = run(["ccx", "block"], folder)
            print(f"{'CalculiX, Abaqus':<27} {seconds:8.2f} {peak:8.0f}")


if __name__ == "__main__":
    main()
