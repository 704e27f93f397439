#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The lowest modes of the free truck-diesel block: clatter-modal, SciPy and CalculiX.

All three use the same tet10 mesh; SciPy uses clatter's matrices. Seconds are wall time of the
complete process, median of the runs; memory is the largest resident set of the process.
"""
import argparse
import os
import shutil
import statistics
import sys
import tempfile
from pathlib import Path

import block
from measured import apart, blas, run

ROOT = Path(__file__).resolve().parent.parent
PEERS = Path(__file__).resolve().parent / "peers"
RIGID_HZ = 1.0  # below this a mode of the free block is a rigid one (the first elastic: hundreds of Hz)


def measure(name, command, folder, runs, frequencies, setting):
    samples = [run(command, folder, **setting) for _ in range(runs)]
    seconds, memory = [s[1] for s in samples], max(s[2] for s in samples) / 1024
    values = [f for f in frequencies(samples[-1][0]) if f > RIGID_HZ]
    return name, statistics.median(seconds), min(seconds), max(seconds), memory, values


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dof-size", type=float, help="element_size_mm of the block (default: the sample's)")
    parser.add_argument("--count", type=int, default=50, help="modes, the six rigid ones included")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--bin", type=Path, default=ROOT / "build" / "release" / "bin")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder, binaries = Path(name), options.bin.resolve()
        block.make_mesh(folder, binaries, options.dof_size)
        block.assemble(folder, binaries, block.fe_toml())
        apart(block.save_npz, folder)
        block.deck(folder, "ccx", ["*STEP", "*FREQUENCY", str(options.count), "*END STEP"])
        common = folder, options.runs
        setting = blas(os.cpu_count())
        rows = [
            measure("clatter-modal, count proved",
                    [binaries / "clatter-modal", "block.fe.h5", "--count", str(options.count), "--quiet", "-o", "block.modes.h5"],
                    *common, lambda _: block.clatter_frequencies(folder), setting),
            measure("SciPy eigsh", ["/usr/bin/python3", PEERS / "scipy_modes.py", str(options.count)], *common,
                    lambda out: sorted(float(f) for f in out.split()), setting),
        ]
        if shutil.which("ccx"):
            rows.append(measure("CalculiX *FREQUENCY", ["ccx", "ccx"], *common, lambda _: block.ccx_frequencies(folder, "ccx"), setting))
        else:
            print("bench: ccx is not installed, its row is left out", file=sys.stderr)
    reference = rows[0][5]
    print(f"{'program':30s} {'median s':>9s} {'min':>7s} {'max':>7s} {'GiB':>6s} {'modes':>6s} {'largest difference':>20s}")
    for name, median, low, high, memory, values in rows:
        shared = min(len(values), len(reference))
        difference = max(abs(a / b - 1.0) for a, b in zip(values[:shared], reference[:shared]))
        print(f"{name:30s} {median:9.2f} {low:7.2f} {high:7.2f} {memory:6.2f} {len(values):6d} {difference:20.2e}")


if __name__ == "__main__":
    main()
