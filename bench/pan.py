#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the frequencies of an oil pan of sheet steel cost: seconds and memory of mesh, assembly and modes against the error of the first
twelve elastic modes, with shells of several sizes and with solids.

The pan is that of `kind = "pan"`, 300 x 200 x 60 mm of 1.5 mm. Shells: its mesh by Gmsh. Solids: the structured meshes of quadratic
hexahedra of ../shared/reference/shells/pan.py, whose finest one, by CalculiX, is the reference.
"""
import argparse
import pathlib
import statistics
import subprocess
import sys
import tempfile

import h5py
import numpy as np
import page
from measured import blas, run

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/validate"))
from shells import PAN, SOLIDS  # noqa: E402

REFERENCE = np.array(SOLIDS["free, 1.5 mm"])
SHELLS = [("quadrilaterals", size) for size in (20, 14, 10, 7, 5, 3.5, 2.5)]  # cells, sides [mm]
SHELLS += [("quadratic", size) for size in (30, 20, 14, 10, 7)]
HEXAHEDRA = ((1, 1), (2, 1), (2, 2))   # level: sides of 10 mm over it; layers


def shells(folder, cells, size, program):
    """The commands that make a.mesh.h5 of shells."""
    (folder / "pan.mesh.toml").write_text(f'name = "pan"\nkind = "pan"\n[pan]\nthickness = 1.5\ncells = "{cells}"\n[mesh]\n'
                                          f"element_size_mm = {size}\nelements_per_turn = {max(8, round(80 / size))}\n")
    (folder / "a.fe.toml").write_text('[material.steel]\nregions = ["pan"]\nE_gpa = 210\nnu = 0.3\nrho = 7850\n')
    return [[program("mesh"), "pan.mesh.toml", "-o", "a.mesh.h5", "--quiet"]]


def hexahedra(folder, level, layers, program):
    subprocess.run([sys.executable, PAN, "pan.inp", "--cells", "c3d20r", "--level", str(level), "--layers", str(layers), "--t", "1.5"],
                   check=True, capture_output=True, cwd=folder)
    return [[program("mesh"), "pan.inp", "--units", "mm-t-s", "-o", "a.mesh.h5", "--recipe", "a.fe.toml", "--quiet"]]


def measured(make, arguments, runs, build):
    """DoFs, error in percent, seconds of each stage and peak megabytes."""
    def program(stage):
        return str(build / f"bin/clatter-{stage}")

    with tempfile.TemporaryDirectory(prefix="clatter-pan-") as name:
        folder = pathlib.Path(name)
        commands = make(folder, *arguments, program)
        commands += [[program("assembly"), "a.mesh.h5", "-c", "a.fe.toml", "-o", "a.fe.h5", "--quiet"],
                     [program("modal"), "a.fe.h5", "--count", "18", "-o", "a.modes.h5", "--quiet"]]
        found = [[run(command, folder, **blas(2)) for command in commands] for _ in range(runs)]
        with h5py.File(folder / "a.modes.h5") as modes, h5py.File(folder / "a.fe.h5") as model:
            hz, size = modes["frequency_hz"][()], len(model["K/indptr"]) - 1
    off = 100.0 * (hz[hz > 1.0][:12] / REFERENCE - 1.0)
    seconds = [statistics.median(each[k][1] for each in found) for k in range(3)]
    return size, np.abs(off).max(), np.abs(off).mean(), seconds, max(one[2] for each in found for one in each)


def row(cells, figures):
    size, worst, mean, seconds, memory = figures
    return [cells, f"{size}", f"{worst:.2f} %", f"{mean:.2f} %", *(f"{s:.2g} s" for s in seconds), f"{sum(seconds):.2g} s",
            f"{memory:.0f} MB"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=3, help="of each mesh; seconds are medians (%(default)s)")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--write", action="store_true", help="put the table into docs/accuracy.md")
    given = parser.parse_args()
    rows = [row(f"{cells if cells == 'quadratic' else 'linear'} shells, {size:g} mm",
                measured(shells, (cells, size), given.runs, given.build)) for cells, size in SHELLS]
    if PAN.exists():
        rows += [row(f"C3D20R, {10 / level:g} mm, {layers} layer{'s' * (layers > 1)}",
                     measured(hexahedra, (level, layers), given.runs, given.build)) for level, layers in HEXAHEDRA]
    table = page.markdown(["cells", "DoFs", "worst of 12 modes", "mean", "mesh", "assembly", "modes", "sum", "memory"], rows)
    print("\n".join(table))
    if given.write:
        page.write("pan_cost", table)


if __name__ == "__main__":
    main()
