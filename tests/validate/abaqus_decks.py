#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Abaqus and CalculiX decks as programs and users write them, through clatter, against CalculiX.

    tests/validate/abaqus_decks.py            prints the table
    tests/validate/abaqus_decks.py --write    puts it into docs/validation.md
    tests/validate/abaqus_decks.py cae_tie    some decks (any part of a name), with all messages

The decks are those of abaqus_programs.py, in mm, t, s. Each is read, assembled and solved by the executables alone
(CLATTER_BIN); CalculiX, or what is stored of its results (calculix.py), solves the plain deck of the same model. A
deck agrees when no frequency, or no displacement over the largest one, differs by more than a unit of the seventh digit.
"""
import collections
import functools
import pathlib
import sys
import tempfile

import h5py
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path += [str(HERE.parent / "tools"), str(HERE.parent / "pipeline")]
import calculix  # noqa: E402
import docs_table  # noqa: E402
import reduced_mass  # noqa: E402
from abaqus_programs import CALCULIX_MASS, DECKS  # noqa: E402
from calculix_decks import all_displacements, first_step  # noqa: E402
from nastran_f06 import refusal  # noqa: E402
from stage_run import run  # noqa: E402

CALCULIX = calculix.Results("abaqus_dialect_test")
PRINTED = 1e-6  # a unit of the last of seven digits, of a number that begins with 1

# One row of the table. `verdict`: agrees, differs, refused.
Row = collections.namedtuple("Row", "deck program figure ours theirs difference verdict remark")


@functools.lru_cache(maxsize=None)
def theirs(plain):
    """{"hz": [...]} or {"node": [...], "displacement": [[x, y, z], ...]} of CalculiX for a plain deck."""
    name = next(one.name for one in DECKS if one.plain == plain)
    if "*FREQUENCY" in plain:
        return CALCULIX.of(name, plain, lambda folder: {"hz": calculix.frequencies(calculix.lines(folder))})
    return CALCULIX.of(name, first_step(plain), all_displacements, keep=lambda found: calculix.some(found, 15))


def assemble(deck, folder):
    for name, text in deck.files.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)
    run("mesh", next(iter(deck.files)), "--units", "mm-t-s", "-o", "a.mesh.h5", "--recipe", "a.fe.toml", folder=folder)
    run("assembly", "a.mesh.h5", "-c", "a.fe.toml", "-o", "a.fe.h5", folder=folder)


def frequencies(deck, folder):
    """(what is compared, ours, theirs, relative difference) of the frequency that differs most."""
    want = theirs(deck.plain)["hz"]
    run("modal", "a.fe.h5", "--count", len(want), "-o", "a.modes.h5", folder=folder)
    with h5py.File(folder / "a.modes.h5") as file:
        have = file["frequency_hz"][()]
    if deck.figure == CALCULIX_MASS:
        have = reduced_mass.frequencies(folder / "a.mesh.h5", folder / "a.fe.h5", 7850.0, len(want))
    worst = np.abs(have / want - 1.0).argmax()
    return f"{len(want)} {deck.figure} [Hz], mode {worst + 1}", have[worst], want[worst], abs(have[worst] / want[worst] - 1.0)


def displacements(deck, folder):
    """The same of the displacement that differs most, relative to the largest one."""
    found = theirs(deck.plain)
    run("modal", "statics", "a.fe.h5", "-o", "a.static.h5", folder=folder)
    with h5py.File(folder / "a.static.h5") as file:
        row_of = {int(label): row for row, label in enumerate(file["node_ids"][()])}
        ours = next(iter(file["cases"].values()))["displacement"][()].reshape(-1, 3) * 1e3  # mm
    common = [k for k, node in enumerate(found["node"]) if int(node) in row_of]
    want = found["displacement"][common]
    have = ours[[row_of[int(found["node"][k])] for k in common]]
    k, axis = np.unravel_index(np.abs(have - want).argmax(), want.shape)
    return (f"{want.size} displacements [mm], node {found['node'][common[k]]:.0f} {'xyz'[axis]}", have[k, axis], want[k, axis],
            np.abs(have - want).max() / np.abs(want).max())


def rows_of(deck):
    """The row of a deck, and the entire text of a refusal."""
    with tempfile.TemporaryDirectory(prefix="clatter-decks-") as name:
        folder = pathlib.Path(name)
        try:
            assemble(deck, folder)
            figure, ours, want, difference = (displacements if deck.figure == "displacements" else frequencies)(deck, folder)
        except RuntimeError as error:
            return Row(deck.name, deck.program, refusal(str(error)), "", "", "", "refused", deck.remark), str(error)
    verdict = "agrees" if difference <= (deck.limit or PRINTED) else "differs"
    return Row(deck.name, deck.program, figure, f"{ours:.7g}", f"{want:.7g}", f"{difference:.1e}", verdict, deck.remark), ""


def table_text(rows):
    worst = {row.deck: row.verdict for row in sorted(rows, key=lambda row: row.verdict == "differs")}
    count = collections.Counter(worst.values())
    head = ("deck", "as written by", "figure, or why it is refused", "ours", "CalculiX", "difference", "", "")
    return (f"{len(worst)} decks: {count['agrees']} agree, {count['differs']} differ, {count['refused']} are refused.\n\n" +
            docs_table.markdown(head, [(*row[:2], row.figure.replace("|", "\\|"), *row[3:]) for row in rows]))


def main():
    names = [word for word in sys.argv[1:] if not word.startswith("--")]
    if not names:
        docs_table.finish("abaqus_decks", table_text([rows_of(deck)[0] for deck in DECKS]), sys.argv[1:])
    for deck in DECKS:
        if any(name in deck.name for name in names):
            row, refused = rows_of(deck)
            print(" | ".join(row) + f"\n{refused}")


if __name__ == "__main__":
    main()
