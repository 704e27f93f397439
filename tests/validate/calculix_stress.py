#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodal stresses of decks of package calculix-ccx-test compared with those in CalculiX's .frd file.

    tests/validate/calculix_stress.py            prints the table
    tests/validate/calculix_stress.py --write    puts it into docs/validation.md

Each deck gets *EL FILE, S in its first step and is solved by ccx (calculix.py); the six components at every node are
compared: the largest difference over the largest component.
"""
import sys

import h5py
import numpy as np

import docs_table
from calculix_decks import assemble, calculix, reference, row_of_node
from stage_run import run

CALCULIX = calculix.Results("calculix_stress_test")
PRINTED = 6e-6  # six digits in the .frd file
ROUNDED = 5e-5
FOUR_DIGITS = "the constants of CalculiX's extrapolation have four digits"

# name, what it shows, largest difference allowed, reason for one above the printed digits
CASES = [
    ("beamp", "C3D20R, forces", ROUNDED, FOUR_DIGITS),
    ("beampo1", "C3D20R, orthotropic", ROUNDED, FOUR_DIGITS),
    ("beamt", "C3D20R, temperature", ROUNDED, FOUR_DIGITS),
    ("beam8p", "C3D8, forces", ROUNDED, FOUR_DIGITS),
    ("beam10p", "C3D10, forces", PRINTED, ""),
    ("beam20p", "C3D20, forces", 0.2, "another method: CalculiX extrapolates from 27 points, clatter from the best 8"),
    ("c3d15", "C3D15, pressure", ROUNDED, "another method: CalculiX extrapolates from 9 points, clatter from the best 6"),
]


def printed_stress(path):
    """{node: (xx, yy, zz, xy, yz, zx)} of the first step in a .frd file."""
    found = {}
    inside = False
    for line in path.read_text().splitlines():
        if line.startswith(" -4  STRESS"):
            inside = True
        elif inside and line.startswith(" -1"):
            found[int(line[3:13])] = [float(line[13 + 12 * k:25 + 12 * k]) for k in range(6)]
        elif inside and line.startswith(" -3"):
            break
    return found


def nodal_stress(folder):
    found = printed_stress(folder / "deck.frd")
    return {"node": np.array(list(found)), "stress": np.array(list(found.values()))}


def compare(name, folder):
    """(number of nodes, largest difference over the largest component)."""
    text = "\n".join(reference(name, ".inp")) + "\n"
    text = text.replace("*END STEP", "*EL FILE\nS\n*END STEP", 1)
    (folder / "deck.inp").write_text(text)
    theirs = CALCULIX.of(name, text, nodal_stress, keep=calculix.some, digits=6)
    theirs = dict(zip(theirs["node"].tolist(), theirs["stress"]))
    assemble("deck.inp", folder)
    run("modal", "statics", "a.fe.h5", "--case", "step_1", "-o", "a.static.h5", folder=folder)
    row_of = row_of_node(folder)
    with h5py.File(folder / "a.static.h5") as file:
        (region,) = file["stress_nodes"]  # one material: CalculiX averages over all cells
        ours = dict(zip(file["stress_nodes"][region][()], file["cases/step_1/stress"][region][()]))
    nodes = [node for node in theirs if row_of.get(node) in ours]
    want = np.array([theirs[node] for node in nodes])
    have = np.array([ours[row_of[node]] for node in nodes])
    return len(nodes), float(np.abs(have - want).max() / np.abs(want).max())


def table():
    """Rows (name, shows, nodes, difference, limit, remark)."""
    return docs_table.compared(CASES, compare)


def main():
    rows = [(name, shows, f"{nodes} nodes", f"{error:.1e}", remark)
            for name, shows, nodes, error, _, remark in table()]
    head = ("deck", "shows", "compared", "largest difference", "")
    docs_table.finish("calculix_stress", docs_table.markdown(head, rows), sys.argv[1:])


if __name__ == "__main__":
    main()
