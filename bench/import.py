#!/usr/bin/python3
"""How fast decks are read: a block of n x n x n cubes, six tet10 each (n = 50: a million nodes, 750 000 cells).

Counts seconds of the reader and the peak memory of the whole process beside the mesh's own size. With --peers
CalculiX reads the Abaqus deck (*NO ANALYSIS: it reads, checks and stops), which takes over a minute and 4 GB.
"""
import argparse
import itertools
import multiprocessing
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]


def tet_block(n):
    """Nodes on half the cubes' pitch, and the tet10 of each cube along its diagonal, nodes from 1."""
    side = 2 * n + 1
    z, y, x = np.meshgrid(*[np.arange(side)] * 3, indexing="ij")
    nodes = np.column_stack([x.ravel(), y.ravel(), z.ravel()]) * (0.1 / (2 * n))
    cube = np.stack([a.ravel() * 2 for a in np.meshgrid(*[np.arange(n)] * 3, indexing="ij")[::-1]])
    cells = []
    for order in itertools.permutations(range(3)):
        corners = [np.zeros(3, int)]
        for axis in order:
            corners.append(corners[-1] + 2 * np.eye(3, dtype=int)[axis])
        if np.linalg.det(np.array(corners[1:])) < 0:
            corners[1], corners[2] = corners[2], corners[1]
        points = corners + [(corners[a] + corners[b]) // 2 for a, b in EDGES]
        cells.append(np.column_stack([(cube + p[:, None]).T @ [1, side, side**2] + 1 for p in points]))
    return nodes, np.vstack(cells)


def write_abaqus(path, nodes, cells):
    with open(path, "w") as file:
        file.write("*NODE, NSET=NALL\n")
        np.savetxt(file, np.column_stack([np.arange(1, len(nodes) + 1), nodes]), "%d, %.12e, %.12e, %.12e")
        file.write("*ELEMENT, TYPE=C3D10, ELSET=EALL\n")
        np.savetxt(file, np.column_stack([np.arange(1, len(cells) + 1), cells]), "%d", ", ")
        file.write("*MATERIAL, NAME=M\n*ELASTIC\n2.1E11, .3\n*DENSITY\n7800.\n"
                   "*SOLID SECTION, ELSET=EALL, MATERIAL=M\n*STEP\n*NO ANALYSIS\n*END STEP\n")


def write_nastran(path, nodes, cells):
    """Nodes in large fields, cells in small ones: two lines each."""
    with open(path, "w") as file:
        file.write("BEGIN BULK\nPSOLID  1       1\nMAT1    1       2.1+11          .3      7800.\n")
        np.savetxt(file, np.column_stack([np.arange(1, len(nodes) + 1), nodes]),
                   "GRID*   %-16d                %16.9e%16.9e*\n*       %16.9e")
        np.savetxt(file, np.column_stack([np.arange(1, len(cells) + 1), np.ones(len(cells), int), cells]),
                   "CTETRA  " + 8 * "%8d" + "+\n+       " + 4 * "%8d")
        file.write("ENDDATA\n")


def make(write, deck, cubes):
    """In a process of its own: what this one holds would count as the peak of those it starts."""
    maker = multiprocessing.Process(target=lambda: write(deck, *tet_block(cubes)))
    maker.start()
    maker.join()
    if maker.exitcode != 0:
        sys.exit(f"{deck} was not written")


def run(command, folder):
    """Standard output, seconds and peak megabytes of a process."""
    begin = time.monotonic()
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{command[0]} failed")
    return output, time.monotonic() - begin, usage.ru_maxrss / 1e3


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cubes", type=int, default=50, help="cubes along an edge")
    parser.add_argument("--peers", action="store_true", help="CalculiX as well")
    parser.add_argument("--build", default=ROOT / "build/release", type=Path, help="with target import_deck built")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        print(f"{'reader':<18} {'deck MB':>8} {'seconds':>8} {'peak MB':>8}")
        for name, file, write in (("Abaqus", "block.inp", write_abaqus), ("Nastran", "block.bdf", write_nastran)):
            deck = Path(folder) / file
            make(write, deck, options.cubes)
            output, _, peak = run([options.build.resolve() / "bench/import_deck", deck], folder)
            nodes, cells, seconds, own = output.split()
            print(f"{'clatter, ' + name:<18} {deck.stat().st_size / 1e6:8.0f} {float(seconds):8.2f} {peak:8.0f}")
        print(f"{nodes} nodes, {cells} tet10, mesh of {own} MB")
        if options.peers:
            _, whole, peak = run(["ccx", "block"], folder)
            print(f"{'CalculiX, Abaqus':<27} {whole:8.2f} {peak:8.0f}")


if __name__ == "__main__":
    main()
