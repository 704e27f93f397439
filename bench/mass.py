#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error and savings of a lumped mass: free steel bar of 600 x 40 x 30 mm (tet10), ten lowest elastic modes.

One row per mesh; errors against the consistent mass on the finest mesh, entries of M, seconds of assembly and of the
modes (wall time of the programs themselves).
"""
import argparse
import tempfile
from pathlib import Path

import h5py
import numpy as np

from measured import run

ROOT = Path(__file__).resolve().parent.parent
MESH = """name = "bar"
kind = "box"
length_unit = "mm"
[box]
size = [600.0, 40.0, 30.0]
region = "bar"
[mesh]
element_size_mm = {size}
"""
MODEL = """[material.steel]
regions = ["bar"]
E_gpa = 210.0
nu = 0.3
rho = 7850.0
[mass]
lumping = "{lumping}"
"""
ELASTIC_HZ = 100.0  # the first elastic mode lies near 440 Hz, the rigid ones at 0


def modes(folder, build, size, lumping, count):
    """DoFs, entries of M, seconds of assembly and of the modes, `count` elastic frequencies [Hz]."""
    (folder / "bar.mesh.toml").write_text(MESH.format(size=size))
    (folder / "bar.fe.toml").write_text(MODEL.format(lumping=lumping))

    def stage(name, *arguments):
        return run([build / f"bin/clatter-{name}", *arguments, "--quiet"], folder)[1]

    stage("mesh", "bar.mesh.toml", "-o", "bar.mesh.h5")
    assembly = stage("assembly", "bar.mesh.h5", "-c", "bar.fe.toml", "-o", "bar.fe.h5")
    solve = stage("modal", "bar.fe.h5", "--count", str(count + 6), "-o", "bar.modes.h5")
    with h5py.File(folder / "bar.fe.h5") as fe, h5py.File(folder / "bar.modes.h5") as found:
        shape, entries = fe["M"].attrs["shape"], fe["M/data"].shape[0]
        frequencies = found["frequency_hz"][()]
    return shape[0], entries, assembly, solve, frequencies[frequencies > ELASTIC_HZ][:count]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=float, nargs="+", default=[30.0, 20.0, 12.0, 8.0], help="element sizes [mm]")
    parser.add_argument("--finest", type=float, default=5.0, help="element size of the reference [mm]")
    parser.add_argument("--count", type=int, default=10, help="elastic modes")
    parser.add_argument("--build", default=ROOT / "build/release", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder, build = Path(name), options.build.resolve()
        *_, exact = modes(folder, build, options.finest, "consistent", options.count)
        print("| size mm | DoF | mass | entries of M | assembly s | modes s | largest error | mean error |")
        print("|---" * 8 + "|")
        for size in options.sizes:
            for lumping in ("consistent", "hrz"):
                dofs, entries, assembly, solve, f = modes(folder, build, size, lumping, options.count)
                error = f / exact - 1
                worst = error[np.argmax(abs(error))]
                print(f"| {size:g} | {dofs} | {lumping} | {entries} | {assembly:.2f} | {solve:.2f} | {100 * worst:+.3f} % "
                      f"| {100 * abs(error).mean():.3f} % |", flush=True)


if __name__ == "__main__":
    main()
