#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time to read decks of a million nodes: blocks of 50^3 cubes of six tet10 each, and of 99^3 hex8.

Measures seconds and CPU seconds of the reader alone ("read"), of the import, with skin and proof of the cells
("proved"), and of clatter-mesh --check ("checked"); the CPU seconds over those of the reader, by which a busy machine can be
compared with itself; the peak memory of the process and the size of the mesh. With --peers
CalculiX reads the Abaqus deck (*NO ANALYSIS: it reads, checks and stops), which takes over a minute and 4 GB.
"""
import argparse
import tempfile
from pathlib import Path

from measured import run
from tet_block import hex_block, make, tet_block, write_abaqus, write_nastran

ROOT = Path(__file__).resolve().parent.parent


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cubes", type=int, default=50, help="cubes of tet10 along an edge; of hex8 about twice as many")
    parser.add_argument("--runs", type=int, default=1, help="the fastest of these counts")
    parser.add_argument("--peers", action="store_true", help="CalculiX as well")
    parser.add_argument("--build", default=ROOT / "build/release", type=Path, help="with target bench_programs built")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        print(f"{'reader':<24} {'deck MB':>8} {'seconds':>8} {'CPU':>8} {'over read':>9} {'peak MB':>8}")
        for cell, block, cubes in (("hex8", hex_block, 2 * options.cubes - 1), ("tet10", tet_block, options.cubes)):
            for name, file, write in (("Abaqus", "block.inp", write_abaqus), ("Nastran", "block.bdf", write_nastran)):
                deck = Path(folder) / file
                make(write, deck, cubes, block)
                reader = None
                for how in ("read", "proved", "checked"):
                    outputs = [run([options.build.resolve() / "bench/import_deck", deck, how], folder) for _ in range(options.runs)]
                    found = min(([*map(float, output.split()), peak] for output, _, peak in outputs), key=lambda one: one[3])
                    if how == "read":
                        reader = found
                    print(f"{f'{name}, {cell}, {how}':<24} {deck.stat().st_size / 1e6:8.0f} {found[2]:8.2f} {found[3]:8.2f} "
                          f"{found[3] / reader[3]:9.2f} {found[5]:8.0f}", flush=True)
            print(f"{reader[0]:.0f} nodes, {reader[1]:.0f} {cell}, mesh of {reader[4]} MB")
        if options.peers:
            _, seconds, peak = run(["ccx", "block"], folder)
            print(f"{'CalculiX, Abaqus':<27} {seconds:8.2f} {peak:8.0f}")


if __name__ == "__main__":
    main()
