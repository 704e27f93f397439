#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The decks that FreeCAD's finite element tests write, through clatter, against CalculiX.

    tests/validate/freecad_decks.py [FOLDER]            prints the table
    tests/validate/freecad_decks.py [FOLDER] --write    puts it into docs/validation.md

FOLDER holds the decks of package freecad-common: /usr/share/freecad/Mod/Fem/femtest/data/calculix. Each is read (mm, t, s), assembled
and solved by the executables alone (CLATTER_BIN); ccx runs it up to its first step, from which displacements of all nodes, or
frequencies, are compared: the largest difference over the largest displacement, or over the frequency.
"""
import collections
import pathlib
import re
import sys
import tempfile

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
import calculix  # noqa: E402
import docs_table  # noqa: E402
from calculix_decks import all_displacements, first_step, relative_difference  # noqa: E402
from nastran_f06 import refusal  # noqa: E402
from stage_run import run  # noqa: E402

FOLDER = pathlib.Path("/usr/share/freecad/Mod/Fem/femtest/data/calculix")
PRINTED = 1e-6  # a unit of the last of seven digits, of a number that begins with 1

# What makes the difference where it is larger, by elements.
SHELLS = "CalculiX makes solids of shells"
BEAMS = "CalculiX makes solids of beams"
CURVED = "curved cells: 14 points for K, CalculiX has 4"
REMARKS = {
    "constraint_centrif": "CalculiX takes the centrifugal force at one point of a cell",
    "constraint_sectionprint": CURVED,
    "constraint_transform_torque": CURVED,
    "box_frequency": "CalculiX takes the mass at four points of a cell",
    "constraint_tie": "held along an edge alone: CalculiX solves it with what rounding holds",
    "constraint_transform_beam_hinged": "CalculiX has no point where these two cells are folded",
    "material_nonlinear": "plastic",
}


def ours(folder):
    """{number in the deck: displacement [mm]} of the nodes, or the points where a deck has beams alone."""
    run("modal", "statics", "a.fe.h5", "--case", "step_1", "-o", "a.static.h5", folder=folder)
    with h5py.File(folder / "a.static.h5") as file:
        case = file["cases/step_1"]
        found = dict(zip(file["node_ids"][()].tolist(), 1e3 * case["displacement"][()].reshape(-1, 3))) if "node_ids" in file else {}
        if "points" in file:
            for name, row in zip(file["points/names"][()], case["points"][()].reshape(-1, 6)):
                found[int(name.decode().rsplit("_", 1)[1])] = 1e3 * row[:3]
    return found


def compare(text, folder):
    """(what is compared, largest relative difference)."""
    step = first_step(text)
    if re.search(r"(?im)^\*FREQUENCY", step):
        theirs = calculix.solve(step, lambda files: calculix.frequencies(calculix.lines(files)))
        run("modal", "a.fe.h5", "--count", len(theirs) + 6, "-o", "a.modes.h5", folder=folder)
        with h5py.File(folder / "a.modes.h5") as file:
            have = file["frequency_hz"][()]
        return f"{len(theirs)} frequencies", relative_difference(have[have > 0.5 * theirs.min()][:len(theirs)], theirs)
    theirs, have = calculix.solve(step, all_displacements), ours(folder)
    common = [k for k, node in enumerate(theirs["node"]) if int(node) in have]
    want = theirs["displacement"][common]
    found = np.array([have[int(theirs["node"][k])] for k in common])
    return f"{len(common)} displacements", float(np.abs(found - want).max() / np.abs(want).max())


def remark(name, text):
    if name in REMARKS:
        return REMARKS[name]
    return SHELLS if "*SHELL SECTION" in text else BEAMS if re.search(r"TYPE=B3", text) else ""


def row_of(path):
    text = path.read_text(errors="replace")
    with tempfile.TemporaryDirectory(prefix="clatter-freecad-") as name:
        folder = pathlib.Path(name)
        (folder / path.name).write_text(text)
        try:
            run("mesh", path.name, "--units", "mm-t-s", "-o", "a.mesh.h5", "--recipe", "a.fe.toml", folder=folder)
            run("assembly", "a.mesh.h5", "-c", "a.fe.toml", "-o", "a.fe.h5", folder=folder)
            what, difference = compare(text, folder)
        except RuntimeError as error:
            return [path.stem, refusal(str(error)).replace("|", "\\|"), "", "refused", remark(path.stem, text)]
        except AssertionError:
            return [path.stem, "ccx refuses it", "", "read", ""]
    agrees = difference < PRINTED
    return [path.stem, what, f"{difference:.1e}", "agrees" if agrees else "differs", "" if agrees else remark(path.stem, text)]


def main():
    folders = [pathlib.Path(word) for word in sys.argv[1:] if not word.startswith("--")]
    rows = [row_of(path) for path in sorted((folders or [FOLDER])[0].glob("*.inp"))]
    count = collections.Counter(row[3] for row in rows)
    text = (f"{len(rows)} decks: {count['agrees']} agree, {count['differs']} differ, {count['refused']} are refused; "
            f"CalculiX refuses {count['read']}.")
    docs_table.finish("freecad_decks", text + "\n\n" + docs_table.markdown(
        ["deck", "compared, or why it is refused", "difference", "", ""], rows), sys.argv[1:])


if __name__ == "__main__":
    main()
