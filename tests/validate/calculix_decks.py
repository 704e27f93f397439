#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Decks of package calculix-ccx-test through clatter, against the reference output that comes with them.

    tests/validate/calculix_decks.py            prints the table
    tests/validate/calculix_decks.py --write    puts it into docs/validation.md, and the table of refused decks
    tests/validate/calculix_decks.py --all      prints for each deck of the package whether it is read, or why not

Each deck is read, assembled and solved by the executables alone; the results are compared with the frequencies or
the nodal displacements printed in the .dat.ref (or .frd.ref) file: the largest difference over the largest value.
Of decks with several steps the first one is compared. Where the reference prints nothing that clatter computes (only
stresses, for example), ccx (calculix.py) runs the same deck up to its first step with *NODE PRINT, U added. Decks with
NLGEOM are read with --ignore NLGEOM, and ccx runs them without that parameter: linear against linear.
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
import reduced_mass  # noqa: E402
from calculix import DECKS, frequencies, numbers, package as reference  # noqa: E402
from calculix_cases import CASES, CAUSES, CHANGED, IGNORE, LINEAR, REPLACED, RINGS, SECTORS, SMALL_LOADS, SOLVED  # noqa: E402
from stage_run import run  # noqa: E402

CALCULIX = calculix.Results("calculix_decks_test")


def deck_text(name):
    text = "\n".join(reference(name, ".inp")) + "\n"
    if name in REPLACED:
        assert text.count(REPLACED[name][0]) == 1
        text = text.replace(*REPLACED[name])
    return text


def ring_frequencies(name):
    """Of the first step of a sector, all nodal diameters: CalculiX solves for a sine and a cosine together, so that
    modes of 0 and of half the sectors' number of diameters, of which a ring has one each, are listed twice."""
    of_diameter = collections.defaultdict(list)
    for line in reference(name, ".dat.ref"):
        row = numbers(line)
        if len(row) == 6 and row[0] == int(row[0]) and row[1] == len(of_diameter[int(row[0])]) + 1:
            of_diameter[int(row[0])].append(row[4])
    found = []
    for diameter, values in of_diameter.items():
        found += values[::2] if diameter in (0, SECTORS // 2) else values
    return np.sort(found)


def displacements(lines, of_set=""):
    """{node: (x, y, z)} of the first step that prints them (of that set of nodes) into a .dat file."""
    found = {}
    inside = False
    for line in lines:
        row = numbers(line)
        if "displacements (vx,vy,vz)" in line and of_set in line:
            if found:
                break
            inside = True
        elif inside and len(row) == 4:
            found[int(row[0])] = row[1:]
        elif line.strip():
            inside = False
    return found


def frd_displacements(lines):
    """The same of a .frd file."""
    found = {}
    inside = False
    for line in lines:
        if line.startswith(" -4  DISP"):
            if found:
                break
            inside = True
        elif line.startswith((" -3", " -4")):
            inside = False
        elif inside and line.startswith(" -1"):
            found[int(line[3:13])] = [float(line[13 + 12 * k:25 + 12 * k]) for k in range(3)]
    return found


def assemble(deck, folder, *ignored):
    """a.mesh.h5, a.fe.toml and a.fe.h5 of a deck in `folder`."""
    ignore = [word for name in (*IGNORE.get(deck.removesuffix(".inp"), ()), *ignored) for word in ("--ignore", name)]
    run("mesh", deck, "--units", "m-kg-s", "-o", "a.mesh.h5", "--recipe", "a.fe.toml", *ignore, folder=folder)
    run("assembly", "a.mesh.h5", "-c", "a.fe.toml", "-o", "a.fe.h5", folder=folder)


def nodes_of(text):
    """Numbers of all nodes of a deck."""
    blocks = re.findall(r"(?im)^\*NODE *(?:,.*)?\n((?:[^*\n].*\n|\*\*.*\n)*)", text)
    return sorted({int(line.split(",")[0]) for block in blocks for line in block.splitlines() if line.strip() and line[0] != "*"})


def first_step(text):
    """A deck up to its first step, which prints the displacements of all nodes; without NLGEOM."""
    nodes = nodes_of(text)
    text = re.sub(r"(?im)^(\*STEP\b.*?),\s*NLGEOM(\s*=\s*YES)?", r"\1", text)
    text = re.split(r"(?im)^\*END\s*STEP", text)[0]
    begin = re.search(r"(?im)^\*STEP", text).start()
    printed = "*NSET, NSET=CLATTERALL\n" + "\n".join(f"{node}," for node in nodes) + "\n"
    return text[:begin] + printed + text[begin:] + "*NODE PRINT, NSET=CLATTERALL, GLOBAL=YES\nU\n*END STEP\n"


def all_displacements(folder):
    found = displacements(calculix.lines(folder), "CLATTERALL")
    return {"node": np.array(list(found)), "displacement": np.array(list(found.values()))}


def solved(name):
    """{node: (x, y, z)} that ccx finds in the first step of a deck."""
    text = deck_text(name)
    if name in SMALL_LOADS:
        assert text.count(SMALL_LOADS[name][0]) == 1
        text = text.replace(*SMALL_LOADS[name])
    found = CALCULIX.of(name, first_step(text), all_displacements, keep=calculix.some)
    factor = 1e5 if name in SMALL_LOADS else 1.0
    return dict(zip(found["node"].tolist(), factor * found["displacement"]))


def row_of_node(folder):
    """{number in the deck: row in clatter's files}."""
    with h5py.File(folder / "a.mesh.h5") as file:
        return {int(label): row for row, label in enumerate(file["node_ids"][()])}


def relative_difference(ours, theirs):
    """Largest relative difference; frequencies of CalculiX below 2e-5 of the highest are rigid motions with
    rounding, there the difference is relative to the highest."""
    highest = theirs.max()
    rigid = theirs < 2e-5 * highest
    return float(np.where(rigid, ours / highest, np.abs(ours - theirs) / np.where(rigid, highest, theirs)).max())


def compare_frequencies(theirs, mass, folder):
    run("modal", "a.fe.h5", "--count", len(theirs), "-o", "a.modes.h5", folder=folder)
    with h5py.File(folder / "a.modes.h5") as file:
        ours = file["frequency_hz"][()]
    if mass:
        ours = reduced_mass.frequencies(folder / "a.mesh.h5", folder / "a.fe.h5", 7.8e-9, len(theirs))
    return "frequencies", len(theirs), relative_difference(ours, theirs)


def compare_ring(theirs, folder):
    """Each of CalculiX's with the nearest of clatter's that is not used yet."""
    run("modal", "a.fe.h5", "--fmax-hz", 1.001 * theirs.max(), "-o", "a.modes.h5", folder=folder)
    with h5py.File(folder / "a.modes.h5") as file:
        left = list(file["frequency_hz"][()])
    ours = [left.pop(int(np.abs(np.array(left) - value).argmin())) for value in theirs]
    return "frequencies", len(theirs), relative_difference(np.array(ours), theirs)


def compare_displacements(theirs, folder):
    run("modal", "statics", "a.fe.h5", "--case", "step_1", "-o", "a.static.h5", folder=folder)
    row_of = row_of_node(folder)
    with h5py.File(folder / "a.static.h5") as file:
        ours = file["cases/step_1/displacement"][()].reshape(-1, 3)
    printed = {node: value for node, value in theirs.items() if node in row_of}
    if not printed:
        raise RuntimeError("no displacements in the reference files")
    want = np.array(list(printed.values()))
    have = ours[[row_of[node] for node in printed]]
    return "displacements", len(printed), float(np.abs(have - want).max() / np.abs(want).max())


def write_deck(name, folder):
    (folder / f"{name}.inp").write_text(deck_text(name))


def compare(name, folder):
    """(what was compared, how many values, largest difference over the largest value)."""
    name, _, mass = name.partition(", ")
    write_deck(name, folder)
    assemble(f"{name}.inp", folder)
    theirs = frequencies(reference(name, ".dat.ref"))
    if name in RINGS:
        return compare_ring(ring_frequencies(name), folder)
    if len(theirs):
        return compare_frequencies(theirs, mass, folder)
    if mass:
        reduced_mass.rotate_about_x(folder / "a.mesh.h5", folder / "a.fe.h5", 7.8e-9)
    theirs = displacements(reference(name, ".dat.ref")) or frd_displacements(reference(name, ".frd.ref"))
    return compare_displacements(theirs, folder)


def compare_solved(name, folder):
    """The same, compared with ccx or with what is stored of its result."""
    write_deck(name, folder)
    assemble(f"{name}.inp", folder)
    return compare_displacements(solved(name), folder)


def compare_linear(name, folder):
    """The same of a deck whose NLGEOM both programs ignore."""
    write_deck(name, folder)
    assemble(f"{name}.inp", folder, "NLGEOM")
    return compare_displacements(solved(name), folder)


def all_decks(folder):
    """{name: errors of clatter-mesh, empty for a deck that is read}, of the entire package."""
    messages = {}
    for path in sorted([*DECKS.glob("*.inp"), *DECKS.glob("*.inp.gz")]):
        name = path.name.removesuffix(".gz").removesuffix(".inp")
        deck = folder / f"{name}.inp"
        deck.write_text("\n".join(reference(name, ".inp")) + "\n")
        try:
            run("mesh", deck.name, "--units", "m-kg-s", "-o", "a.mesh.h5", "--recipe", "a.fe.toml", folder=folder)
            messages[name] = ""
        except RuntimeError as refusal:
            messages[name] = str(refusal)
    return messages


def cause(text):
    """The first cause of CAUSES that matches a deck's errors, or the first error if none does."""
    for words, pattern in CAUSES:
        if re.search(pattern, text):
            return words
    lines = [line for line in text.splitlines() if re.search(r"\.inp:\d+: ", line)] or [text]
    return re.sub(r".*\.inp:\d+: ", "", lines[0])


def refused(messages):
    """The table of causes with the number of decks of each."""
    counts, examples = collections.Counter(), {}
    for name, text in messages.items():
        if text:
            counts[cause(text)] += 1
            examples.setdefault(cause(text), []).append(name)
    rows = [(words, str(count), ", ".join(examples[words][:4])) for words, count in counts.most_common()]
    read = sum(not text for text in messages.values())
    return (f"{len(messages)} decks, {read} read as is, {len(messages) - read} refused:\n\n" +
            docs_table.markdown(("cause", "decks", "such as"), rows))


def say_all():
    """Prints each deck with its errors, then the number of decks of each error."""
    with tempfile.TemporaryDirectory(prefix="clatter-ccx-") as folder:
        messages = all_decks(pathlib.Path(folder))
    reasons = collections.Counter()
    for name, text in messages.items():
        print(f"{name}: {text or 'read'}")
        reasons.update({re.sub(r"\S+\.inp:\d+", "FILE:LINE", re.sub(r"( \(and .*|; ignore = .*)", "", line)).strip()
                        for line in text.splitlines()})
    print()
    for reason, count in reasons.most_common():
        print(f"{count:4} {reason}")
    print("\n" + refused(messages))


def left_out():
    """{name: why it is not compared} of decks that this version of the package does not have or has with another reference."""
    reasons = {}
    for name, *_ in (*CASES, *SOLVED, *LINEAR):
        number, why = CHANGED.get(name, ("", ""))
        if not reference(name.partition(", ")[0], ".inp"):
            reasons[name] = f"deck {name} is not in this version of package calculix-ccx-test"
        elif number and number in "\n".join(reference(name, ".dat.ref")):
            reasons[name] = f"deck {name}: {why}"
    return reasons


def table():
    """Rows (name, shows, quantity, count, error, limit, remark) of the decks that can be compared."""
    reasons, rows = left_out(), []
    for cases, compared_by in ((CASES, compare), (SOLVED, compare_solved), (LINEAR, compare_linear)):
        rows += docs_table.compared([case for case in cases if case[0] not in reasons], compared_by)
    return rows


def main():
    if "--all" in sys.argv[1:]:
        say_all()
        return
    rows = [(name, shows, f"{count} {quantity}", f"{error:.1e}", remark)
            for name, shows, quantity, count, error, _, remark in table()]
    head = ("deck", "shows", "compared", "largest difference", "")
    for reason in left_out().values():
        print(f"left out: {reason}", file=sys.stderr)
    docs_table.finish("calculix_decks", docs_table.markdown(head, rows), sys.argv[1:])
    if "--write" in sys.argv[1:]:
        with tempfile.TemporaryDirectory(prefix="clatter-ccx-") as folder:
            docs_table.finish("calculix_refused", refused(all_decks(pathlib.Path(folder))), sys.argv[1:])


if __name__ == "__main__":
    main()
