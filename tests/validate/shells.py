# SPDX-License-Identifier: GPL-3.0-or-later
"""Shells against oracles: displacements of benchmarks, and frequencies of a pan of sheet steel against solids.

    tests/validate/shells.py           prints the tables
    tests/validate/shells.py --write   puts them into docs/validation.md
    tests/validate/shells.py --draw    draws four modes of the pan instead: assembly/pan.png

The pan is that of `../shared/reference/shells/pan.py`, which is not part of the repository, and `kind = "pan"`.
"""
import pathlib
import subprocess
import sys
import tempfile

import docs_table
import h5py
import matplotlib
import numpy as np
from matplotlib import pyplot
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from stage_run import BIN, SOURCE, run

matplotlib.use("Agg")
PAN = SOURCE.parent / "shared/reference/shells/pan.py"
# CalculiX, two layers of C3D20R, 5 mm [Hz], modes 1 to 12: free at 1.5 mm, free at .8 mm, at 1.5 mm tied to a frame.
SOLIDS = {
    "free, 1.5 mm": (207.45, 250.08, 385.74, 548.36, 598.64, 612.59, 715.58, 892.95, 963.68, 984.95, 993.95, 1161.67),
    "free, .8 mm": (137.69, 185.52, 215.70, 302.50, 336.36, 404.59, 490.63, 499.32, 546.00, 612.05, 666.94, 677.70),
    "tied to a frame": (233.17, 237.04, 375.64, 422.61, 550.65, 600.19, 714.48, 786.28, 892.75, 971.33, 987.21,
                        1018.63),
}
CASES = [("free, 1.5 mm", "10 mm", 1, []), ("free, 1.5 mm", "5 mm", 2, []), ("free, 1.5 mm", "2.5 mm", 4, []),
         ("free, 1.5 mm", "`kind = \"pan\"`, 5 mm", 0, []),
         ("free, 1.5 mm", "quad8, 10 mm", 1, ["--cells", "s8r"]),
         ("free, 1.5 mm", "quad8, 5 mm", 2, ["--cells", "s8r"]),
         ("free, .8 mm", "5 mm", 2, ["--t", "0.8"]), ("free, .8 mm", "2.5 mm", 4, ["--t", "0.8"]),
         ("free, .8 mm", "quad8, 5 mm", 2, ["--t", "0.8", "--cells", "s8r"]),
         ("tied to a frame", "5 mm", 2, ["--frame", "tied"]), ("tied to a frame", "2.5 mm", 4, ["--frame", "tied"]),
         ("tied to a frame", "quad8, 5 mm", 2, ["--frame", "tied", "--cells", "s8r"])]


def benchmarks():
    """Rows of the test program: name, then ratios to the published displacement."""
    program = BIN.parent / "tests/core/fe/fe_test"
    said = subprocess.run([program, "--gtest_filter=*ShellBenchmark*"], check=True, capture_output=True, text=True)
    return [[word.strip() for word in line.strip().strip("|").split("|")]
            for line in said.stdout.splitlines() if line.startswith("| ")]


def mesh_pan(folder):
    """The pan by Gmsh from its dimensions, cells of 5 mm, smaller in its fillets: a.mesh.h5 and a.fe.toml."""
    (folder / "pan.mesh.toml").write_text('name = "pan"\nkind = "pan"\n[pan]\nthickness = 1.5\n[mesh]\n'
                                          "element_size_mm = 5\nelements_per_turn = 16\n")
    (folder / "a.fe.toml").write_text('[material.steel]\nregions = ["pan"]\nE_gpa = 210\nnu = 0.3\nrho = 7850\n')
    run("mesh", "pan.mesh.toml", "-o", "a.mesh.h5", folder=folder)


def read_pan(folder, level, options):
    """The pan of S4, or as `options` say, with sides of 10 mm / level: a.mesh.h5 and a.fe.toml."""
    subprocess.run([sys.executable, PAN, "pan.inp", "--level", str(level),
                    *(["--t", "1.5"] if "--t" not in options else []),
                    *(["--cells", "s4"] if "--cells" not in options else []), *options],
                   check=True, capture_output=True, cwd=folder)
    run("mesh", "pan.inp", "--units", "mm-t-s", "-o", "a.mesh.h5", "--recipe", "a.fe.toml", folder=folder)


def solve(folder, level, options):
    """a.modes.h5 in `folder`: eighteen modes of a pan; level 0: of the parametric one."""
    if level:
        read_pan(folder, level, options)
    else:
        mesh_pan(folder)
    run("assembly", "a.mesh.h5", "-c", "a.fe.toml", "-o", "a.fe.h5", folder=folder)
    run("modal", "a.fe.h5", "--count", "18", "-o", "a.modes.h5", folder=folder)


def elastic_frequencies(level, options):
    """The first twelve [Hz]."""
    with tempfile.TemporaryDirectory(prefix="clatter-pan-") as name:
        folder = pathlib.Path(name)
        solve(folder, level, options)
        with h5py.File(folder / "a.modes.h5") as file:
            hz = file["frequency_hz"][()]
    return hz[hz > 1.0][:12]


def draw(path):
    """Modes 1, 2, 4 and 8 of the free pan, coloured by how far they move."""
    with tempfile.TemporaryDirectory(prefix="clatter-pan-") as name:
        folder = pathlib.Path(name)
        solve(folder, 2, [])
        with h5py.File(folder / "a.mesh.h5") as mesh, h5py.File(folder / "a.modes.h5") as modes:
            nodes, quads = 1e3 * mesh["nodes"][()], mesh["shells/0/nodes"][()]
            hz, shapes = modes["frequency_hz"][()], modes["shapes"][()]
    figure = pyplot.figure(figsize=(10, 6.4))
    for place, mode in enumerate((6, 7, 9, 13)):
        moved = shapes[mode]
        size = np.linalg.norm(moved, axis=1)
        at = nodes + 25.0 * moved / size.max()
        axes = figure.add_axes([0.5 * (place % 2), 0.5 - 0.5 * (place // 2), 0.5, 0.46], projection="3d")
        colours = pyplot.cm.viridis((size / size.max())[quads].mean(axis=1))
        sheet = Poly3DCollection(at[quads], facecolors=colours, edgecolors=colours, linewidths=0.3)
        sheet.set_clip_on(False)
        axes.add_collection3d(sheet)
        axes.set(xlim=(-150, 150), ylim=(-150, 150), zlim=(-40, 100), title=f"mode {mode - 5}: {hz[mode]:.1f} Hz")
        axes.set_box_aspect((300, 300, 140), zoom=1.35)
        axes.view_init(elev=38, azim=-60)
        axes.set_axis_off()
    figure.savefig(path, dpi=80)


def pan_row(case, cells, level, options):
    off = 100.0 * (elastic_frequencies(level, options) / np.array(SOLIDS[case]) - 1.0)
    return [case, cells, *(f"{value:+.2f}" for value in off)]


def main():
    if "--draw" in sys.argv[1:]:
        draw(SOURCE / "assembly/pan.png")
        return
    docs_table.finish("shell_benchmarks", docs_table.markdown(
        ("case, mesh", *(f"{cell}{mesh}" for cell in ("quad4", "tri3", "quad8", "tri6") for mesh in ("", " distorted"))),
        benchmarks()), sys.argv[1:])
    docs_table.finish("pan", docs_table.markdown(
        ("pan", "cells", *(str(mode) for mode in range(1, 13))), [pan_row(*case) for case in CASES]), sys.argv[1:])


if __name__ == "__main__":
    main()
