#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""NAFEMS FV52, FV32 and LE10 with clatter's cells: decks of nafems_mesh.py through the executables alone.

    tests/validate/nafems.py            prints the tables
    tests/validate/nafems.py --write    puts them into docs/validation.md
"""
import contextlib
import pathlib
import shutil
import sys
import tempfile

import h5py
import numpy as np
import scipy.optimize
import scipy.sparse.linalg

import calculix_stress
import docs_table
import nafems_mesh
from calculix_decks import assemble, calculix
from stage_run import run

# NAFEMS R0015, "Selected benchmarks for natural frequency analysis" [Hz]; LE10: "The Standard NAFEMS Benchmarks" [MPa].
FV52 = np.array([45.897, 109.44, 109.44, 167.89, 193.59, 206.19, 206.19])  # modes 4 to 10
FV32 = np.array([44.623, 130.03, 162.70, 246.05, 379.90, 391.44])
LE10 = -5.38  # sigma_yy at D

# The same meshes elsewhere. OptiStruct's help, OS-V 0455: frequencies over FV52, modes 4, 5, 7, 8, 9.
OPTISTRUCT = {
    "C3D20": ((4, 4, 1), np.array([0.9760, 1.0101, 1.0072, 1.0017, 1.0022])),
    "C3D8I": ((8, 8, 3), np.array([0.9874, 1.0413, 1.0322, 1.0164, 1.0164])),
}
DISTINCT = [0, 1, 3, 4, 5]  # modes 4, 5, 7, 8, 9 among 4 to 10
# A mesh of 4 x 4 x 1 bricks of 20 nodes: reference of code_aster's test SDLS502 (V2.03.502) [Hz].
BRICKS_20 = np.array([44.762, 110.52, 169.08, 193.93, 206.64])

CELL_NAME = {"C3D20": "hex20", "C3D20R": "hex20, reduced", "C3D10": "tet10", "C3D15": "wedge15, reduced", "C3D8I": "hex8",
             "C3D8": "hex8, full"}


@contextlib.contextmanager
def assembled(deck):
    """A folder with a.mesh.h5 and a.fe.h5 of a deck."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-nafems-"))
    try:
        (folder / "a.inp").write_text(deck)
        assemble("a.inp", folder)
        yield folder
    finally:
        shutil.rmtree(folder)


def modes(deck, count):
    """Frequencies [Hz], rigid motions first, and the share of z in each mode's motion."""
    with assembled(deck) as folder:
        run("modal", "a.fe.h5", "--count", count, "-o", "a.modes.h5", folder=folder)
        with h5py.File(folder / "a.modes.h5") as file:
            square = np.square(file["shapes"][()], dtype=float).sum(axis=1)
            return file["frequency_hz"][()], square[:, 2] / square.sum(axis=1)


def frequencies(deck, count):
    return modes(deck, count)[0]


def fv52(kind, bricks):
    """Modes 4 to 10: three rigid ones are left out, then four bend the plate and three stay in its plane. Where fine
    meshes have further bending modes below the latter, these are left out too."""
    hz, share = modes(nafems_mesh.plate(kind, bricks), 20)
    hz, bends = hz[3:], share[3:] > 0.5
    return np.concatenate([hz[bends][:4], hz[~bends][:3]])


def fv32(kind, bricks):
    return frequencies(nafems_mesh.membrane(kind, bricks), 6)


def stress_at(folder, position):
    """xx yy zz xy yz zx [Pa] at the node nearest to a position."""
    run("modal", "statics", "a.fe.h5", "--case", "step_1", "-o", "a.static.h5", folder=folder)
    with h5py.File(folder / "a.static.h5") as file:
        (region,) = file["stress_nodes"]
        nodes = file["nodes"][()][file["stress_nodes"][region][()]]
        return file["cases/step_1/stress"][region][int(np.linalg.norm(nodes - position, axis=1).argmin())]


def le10(kind, bricks):
    """sigma_yy at D [MPa]."""
    with assembled(nafems_mesh.ellipse(kind, bricks)) as folder:
        return 1e-6 * stress_at(folder, (2.0, 0.0, 0.6))[1]


def calculix_frequencies(deck, count, solve=calculix.solve):
    """The same deck solved by CalculiX [Hz], without the three rigid motions."""
    deck = f"{deck}*STEP\n*FREQUENCY\n{count}\n*END STEP\n"
    return solve(deck, lambda folder: {"hz": calculix.frequencies(calculix.lines(folder))[3:]})["hz"]


def calculix_frequencies_without_mode_mass(deck, nodes, count, solve=calculix.solve):
    """The same [Hz] from CalculiX's matrices, where the incompatible modes of C3D8I are DoFs of nodes above `nodes`, after
    their mass is removed."""
    deck = f"{deck}*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n{count}\n*END STEP\n"
    return solve(deck, lambda folder: {"hz": frequencies_without_mode_mass(folder, nodes, count)[3:]})["hz"]


def frequencies_without_mode_mass(folder, nodes, count):
    of_node = [int(line.strip().split(".")[0]) <= nodes for line in (folder / "deck.dof").read_text().splitlines()]
    K, M = (upper_triangle(folder / f"deck.{name}") for name in ("sti", "mas"))
    keep = scipy.sparse.diags(np.array(of_node, float))
    M = keep @ M @ keep
    shift = 1e-3 * K.diagonal().max() / M.diagonal().max()  # K alone is singular: three rigid motions
    values = scipy.sparse.linalg.eigsh(M, count, K + shift * M, which="LM", return_eigenvectors=False)
    return np.sqrt(np.maximum(np.sort(1 / values) - shift, 0)) / (2 * np.pi)


def upper_triangle(path):
    row, column, value = np.loadtxt(path, unpack=True)
    matrix = scipy.sparse.csc_matrix((value, (row.astype(int) - 1, column.astype(int) - 1)))
    return matrix + scipy.sparse.triu(matrix, 1).T


def calculix_le10(kind, bricks, solve=calculix.solve):
    """sigma_yy at D [MPa] from its .frd file; only the node at D has that position."""
    deck = nafems_mesh.ellipse(kind, bricks).replace("*END STEP", "*EL FILE\nS\n*END STEP")
    node = next(words[0] for words in map(str.split, deck.replace(",", " ").splitlines()) if words[1:] == ["2", "0", "0.6"])
    found = solve(deck, lambda folder: {"stress": calculix_stress.printed_stress(folder / "deck.frd")[int(node)]})
    return 1e-6 * found["stress"][1]


def bending(wave_number, thickness=1.0, youngs=200e9, poisson=0.3, density=8000.0):
    """Frequency [Hz] of the lowest antisymmetric wave of Rayleigh and Lamb in a plate (Graff 1975, section 8.1): the
    bending modes of a hard simply supported plate are such waves."""
    shear = np.sqrt(youngs / (2 * (1 + poisson)) / density)
    press = shear * np.sqrt(2 * (1 - poisson) / (1 - 2 * poisson))

    def residue(omega):
        # Below the shear wave's line both numbers across the thickness are imaginary.
        p = np.sqrt(wave_number**2 - (omega / press)**2)
        q = np.sqrt(wave_number**2 - (omega / shear)**2)
        return (wave_number**2 + q**2)**2 * np.tanh(p * thickness / 2) - 4 * wave_number**2 * p * q * np.tanh(q * thickness / 2)
    line = shear * wave_number
    return scipy.optimize.brentq(residue, 0.01 * line, 0.99 * line, xtol=1e-9) / (2 * np.pi)


def hard_plate_exact(count, length=10.0):
    """The lowest exact frequencies [Hz]: bending waves and waves of in-plane shear that fit the sides."""
    shear = np.sqrt(200e9 / 2.6 / 8000.0)
    found = []
    for m in range(6):
        for n in range(6):
            wave_number = np.pi / length * np.hypot(m, n)
            if m + n > 0:
                found.append(shear * wave_number / (2 * np.pi))
            if m * n > 0:
                found.append(bending(wave_number))
    return np.sort(found)[:count]


def hard_plate(kind, bricks, count=6):
    return frequencies(nafems_mesh.hard_plate(kind, bricks), count)


def size(bricks):
    return " x ".join(map(str, bricks))


def hertz(values):
    return [f"{value:.3f}" for value in values]


def same_mesh_table():
    rows = []
    for kind, (bricks, published) in OPTISTRUCT.items():
        ours = fv52(kind, bricks)
        deck = nafems_mesh.plate(kind, bricks)
        theirs = calculix_frequencies(deck, 10)
        rows.append([f"OptiStruct, {size(bricks)}", *(f"{ratio:.4f}" for ratio in published)])
        rows.append([f"clatter, {CELL_NAME[kind]}", *(f"{ratio:.4f}" for ratio in (ours / FV52)[DISTINCT])])
        rows.append([f"CalculiX, {kind}", *(f"{ratio:.4f}" for ratio in (theirs / FV52)[DISTINCT])])
        if kind == "C3D8I":
            nodes = len(nafems_mesh.Grid(kind, bricks, None).nodes)
            theirs = calculix_frequencies_without_mode_mass(deck, nodes, 10)
            rows.append(["its matrices without mass on incompatible modes",
                         *(f"{ratio:.4f}" for ratio in (theirs / FV52)[DISTINCT])])
    return docs_table.markdown(("over the reference, mode", "4", "5, 6", "7", "8", "9, 10"), rows)


def fv52_table():
    rows = [["NAFEMS", "", *hertz(FV52[DISTINCT])],
            ["20-node bricks, reference of code_aster's SDLS502", "4 x 4 x 1", *hertz(BRICKS_20)]]
    for kind, meshes in {
        "C3D20": [(4, 4, 1), (8, 8, 2), (16, 16, 4)], "C3D20R": [(4, 4, 1), (8, 8, 2)],
        "C3D15": [(4, 4, 1), (8, 8, 2)], "C3D10": [(4, 4, 1), (8, 8, 2)], "C3D8I": [(8, 8, 2), (16, 16, 4)],
    }.items():
        rows += [[CELL_NAME[kind], size(bricks), *hertz(fv52(kind, bricks)[DISTINCT])] for bricks in meshes]
    return docs_table.markdown(("", "bricks", "4", "5, 6", "7", "8", "9, 10"), rows)


def hard_plate_table():
    exact = hard_plate_exact(6)
    rows = [["exact", "", *hertz(exact), ""]]
    for kind in ("C3D20", "C3D20R", "C3D15", "C3D10", "C3D8I"):
        before = None
        for bricks in ((4, 4, 1), (8, 8, 2), (16, 16, 4)):
            values = hard_plate(kind, bricks)
            error = np.abs(values / exact - 1).max()
            order = f", order {np.log2(before / error):.1f}" if before else ""
            rows.append([CELL_NAME[kind], size(bricks), *hertz(values), f"{error:.1e}{order}"])
            before = error
    return docs_table.markdown(("", "bricks", *(f"mode {k}" for k in range(1, 7)), "largest error"), rows)


def fv32_table():
    rows = [["NAFEMS", "", *hertz(FV32), ""]]
    for kind in ("C3D20", "C3D20R", "C3D15", "C3D10", "C3D8I"):
        for bricks in ((8, 4, 1), (16, 8, 1), (32, 16, 1)):
            values = fv32(kind, bricks)
            rows.append([CELL_NAME[kind], size(bricks), *hertz(values), f"{np.abs(values / FV32 - 1).max():.1e}"])
    return docs_table.markdown(("", "bricks", *(f"mode {k}" for k in range(1, 7)), "largest difference"), rows)


def le10_table():
    rows = []
    sizes = [(2 * k, 3 * k, 2 * k) for k in (1, 2, 4, 8)]
    for kind in ("C3D20", "C3D20R", "C3D15", "C3D10", "C3D8I"):
        found = [le10(kind, bricks) for bricks in sizes]
        rows.append([CELL_NAME[kind], *(f"{value:.3f} ({100 * (value / LE10 - 1):+.1f} %)" for value in found)])
    rows.append(["CalculiX, C3D20R", *(f"{calculix_le10('C3D20R', bricks):.3f}" for bricks in sizes[:3]), ""])
    return docs_table.markdown(("sigma_yy at D [MPa], bricks", *map(size, sizes)), rows)


def main():
    for name, make in (("nafems_same_mesh", same_mesh_table), ("nafems_fv52", fv52_table),
                       ("nafems_hard_plate", hard_plate_table), ("nafems_fv32", fv32_table), ("nafems_le10", le10_table)):
        docs_table.finish(name, make(), sys.argv[1:])


if __name__ == "__main__":
    main()
