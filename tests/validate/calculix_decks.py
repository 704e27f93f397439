#!/usr/bin/python3
"""Decks of package calculix-ccx-test through clatter, against the reference output that comes with them.

    tests/validate/calculix_decks.py            prints the table
    tests/validate/calculix_decks.py --write    puts it into docs/validation.md
    tests/validate/calculix_decks.py --all      says of each deck of the package whether it is read, or why not

Each deck is read, assembled and solved by the executables alone; what they find is compared with the frequencies or
the nodal displacements printed in the .dat.ref (or .frd.ref) file: the largest difference over the largest value.
Of decks with several steps the first one is compared.
"""
import collections
import gzip
import pathlib
import re
import sys
import tempfile

import h5py
import numpy as np

import docs_table
import reduced_mass
from stage_run import run

DECKS = pathlib.Path("/usr/share/doc/calculix-ccx-test/examples/test")
PRINTED = 6e-7  # seven digits are printed

# name, what it shows, largest error allowed, words for one that is larger than the digits printed
CASES = [
    ("beam8p", "C3D8, forces", PRINTED, ""),
    ("beam10p", "C3D10, forces", PRINTED, ""),
    ("beam20p", "C3D20, forces", PRINTED, ""),
    ("c3d15", "C3D15, pressure, orientation", PRINTED, ""),
    ("beamp", "C3D20R, forces", 1e-6, "six digits in the .frd file"),
    ("beamd", "C3D20R, pressure", PRINTED, ""),
    ("beamidset", "sets within sets", PRINTED, ""),
    ("beampset", "sets of nodes", PRINTED, ""),
    ("beamp2stage", "two stages of loading", PRINTED, ""),
    ("beampis", "iterative solver of CalculiX", PRINTED, ""),
    ("beampic", "iterative solver of CalculiX", 2e-3, "their solver stops early: beampis, the same deck with the other one, agrees"),
    ("beampo1", "orthotropic, orientation", PRINTED, ""),
    ("beampo2", "orthotropic, orientation", PRINTED, ""),
    ("aniso", "anisotropic, 21 constants", PRINTED, ""),
    ("achteld", "prescribed displacement", PRINTED, ""),
    ("achtelp", "forces, symmetry planes", PRINTED, ""),
    ("achtelg", "gravity", PRINTED, ""),
    ("achtel2", "equations", PRINTED, ""),
    ("achtel29", "equations", PRINTED, ""),
    ("achtel9", "equations", PRINTED, ""),
    ("achtelcas", "equations", PRINTED, ""),
    ("beampdepmpc", "dependent equations", PRINTED, ""),
    ("segmentf", "transform, cylindrical", PRINTED, ""),
    ("beamprb", "rigid body with rotation node", 3e-6, "six digits in the .frd file"),
    ("beamptied1", "tie", PRINTED, ""),
    ("beamptied2", "tie", PRINTED, ""),
    ("beam8t", "C3D8, temperature", PRINTED, ""),
    ("beamt", "C3D20R, temperature", PRINTED, ""),
    ("beamt2", "C3D20R, temperature", PRINTED, ""),
    ("beamt3", "C3D20R, temperature of middle nodes", PRINTED, ""),
    ("beam8f", "C3D8, frequencies", PRINTED, ""),
    ("beamf", "C3D20R, frequencies", 2e-3, "clatter's mass is exact, CalculiX takes the eight points of K"),
    *((f"beamdy{i}", "first step: C3D20R, frequencies", 2e-3, "mass as in beamf; the dynamic step is left out")
      for i in range(1, 20)),
    ("dloadlinIf", "C3D8I, frequencies, nodes too many", 1e-6, "likely the inertia that CalculiX gives incompatible modes"),
    ("achtelc", "centrifugal force", PRINTED, ""),
    ("segment1", "centrifugal force, curved C3D20R", 1e-2, "clatter's load is exact, CalculiX takes the eight points of K"),
    ("segment1, eight-point load", "the same with CalculiX's load", PRINTED, "what explains the line above (reduced_mass.py)"),
    ("segment2", "centrifugal force, curved C3D20R", 1e-2, "clatter's load is exact, CalculiX takes the eight points of K"),
    ("segment2, eight-point load", "the same with CalculiX's load", PRINTED, "what explains the line above (reduced_mass.py)"),
    ("beampfix", "first step: forces", PRINTED, "the step that holds what the first one moved is left out"),
    ("changesolidsection", "first step: forces", PRINTED, "the step with another material is left out"),
    ("beamt6", "first step: temperature", PRINTED, "the coupled step is left out"),
    ("beamf, eight-point mass", "the same with CalculiX's mass", PRINTED, "what explains the line above (reduced_mass.py)"),
]


def reference(name, suffix):
    """Lines of a reference file, packed or not; none when there is no such file."""
    for path in (DECKS / f"{name}{suffix}", DECKS / f"{name}{suffix}.gz"):
        if path.exists():
            data = gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes()
            return data.decode(errors="replace").splitlines()
    return []


# Words that a deck needs beside its own, as the user writes them after --ignore.
IGNORE = {
    "dloadlinI": ("EXTRA NODES", "NLGEOM"),
    "dloadlinIf": ("EXTRA NODES",),
    "distcoup": ("MOMENT",),
}


def numbers(line):
    try:
        return [float(word) for word in line.split()]
    except ValueError:
        return []


def frequencies(name):
    found = []
    for line in reference(name, ".dat.ref"):
        if "P A R T I C I P A T I O N" in line:
            break
        row = numbers(line)
        if len(row) == 5:
            found.append(row[3])
    return np.array(found)


def displacements(name):
    """{node: (x, y, z)} of the first step that prints them."""
    found = {}
    inside = False
    for line in reference(name, ".dat.ref"):
        row = numbers(line)
        if "displacements (vx,vy,vz)" in line:
            if found:
                break
            inside = True
        elif inside and len(row) == 4:
            found[int(row[0])] = row[1:]
        elif line.strip():
            inside = False
    if found:
        return found
    for line in reference(name, ".frd.ref"):
        if line.startswith(" -4  DISP"):
            if found:
                break
            inside = True
        elif line.startswith((" -3", " -4")):
            inside = False
        elif inside and line.startswith(" -1"):
            found[int(line[3:13])] = [float(line[13 + 12 * k:25 + 12 * k]) for k in range(3)]
    return found


def assemble(deck, folder):
    """a.mesh.h5, a.fe.toml and a.fe.h5 of a deck in `folder`."""
    ignore = [word for name in IGNORE.get(deck.removesuffix(".inp"), ()) for word in ("--ignore", name)]
    run("mesh", deck, "--units", "m-kg-s", "-o", "a.mesh.h5", "--recipe", "a.fe.toml", *ignore, folder=folder)
    run("assembly", "a.mesh.h5", "-c", "a.fe.toml", "-o", "a.fe.h5", folder=folder)


def row_of_node(folder):
    """{number in the deck: row in our files}."""
    with h5py.File(folder / "a.mesh.h5") as file:
        return {int(label): row for row, label in enumerate(file["node_ids"][()])}


def compare(name, folder):
    """(what was compared, how many values, largest difference over the largest value)."""
    name, _, mass = name.partition(", ")
    deck = folder / f"{name}.inp"
    deck.write_text("\n".join(reference(name, ".inp")) + "\n")
    assemble(deck.name, folder)
    theirs = frequencies(name)
    if len(theirs):
        run("modal", "a.fe.h5", "--count", len(theirs), "-o", "a.modes.h5", folder=folder)
        with h5py.File(folder / "a.modes.h5") as file:
            ours = file["frequency_hz"][()]
        if mass:
            ours = reduced_mass.frequencies(folder / "a.mesh.h5", folder / "a.fe.h5", 7.8e-9, len(theirs))
        return "frequencies", len(theirs), float(np.abs(ours / theirs - 1).max())
    if mass:
        reduced_mass.turn_about_x(folder / "a.mesh.h5", folder / "a.fe.h5", 7.8e-9)
    run("modal", "a.fe.h5", "--static", "--case", "step_1", "-o", "a.static.h5", folder=folder)
    row_of = row_of_node(folder)
    with h5py.File(folder / "a.static.h5") as file:
        ours = file["cases/step_1/displacement"][()].reshape(-1, 3)
    printed = {node: value for node, value in displacements(name).items() if node in row_of}
    if not printed:
        raise RuntimeError("no displacements in the reference files")
    want = np.array(list(printed.values()))
    have = ours[[row_of[node] for node in printed]]
    return "displacements", len(printed), float(np.abs(have - want).max() / np.abs(want).max())


def all_decks(folder):
    """{name: what clatter-mesh says when it refuses the deck, empty when it reads it}, of the whole package."""
    said = {}
    for path in sorted([*DECKS.glob("*.inp"), *DECKS.glob("*.inp.gz")]):
        name = path.name.removesuffix(".gz").removesuffix(".inp")
        deck = folder / f"{name}.inp"
        deck.write_text("\n".join(reference(name, ".inp")) + "\n")
        try:
            run("mesh", deck.name, "--units", "m-kg-s", "-o", "a.mesh.h5", "--recipe", "a.fe.toml", folder=folder)
            said[name] = ""
        except RuntimeError as refusal:
            said[name] = str(refusal)
    return said


def say_all():
    """Prints each deck with its refusals, then the refusals by how many decks have them."""
    with tempfile.TemporaryDirectory(prefix="clatter-ccx-") as folder:
        said = all_decks(pathlib.Path(folder))
    reasons = collections.Counter()
    for name, text in said.items():
        print(f"{name}: {text or 'read'}")
        reasons.update({re.sub(r"\S+\.inp:\d+", "FILE:LINE", re.sub(r"( \(and .*|; ignore = .*)", "", line)).strip()
                        for line in text.splitlines()})
    print(f"\n{sum(not text for text in said.values())} of {len(said)} decks are read\n")
    for reason, count in reasons.most_common():
        print(f"{count:4} {reason}")


def table():
    """Rows (name, shows, quantity, count, error, limit, remark)."""
    return docs_table.compared(CASES, compare)


def main():
    if "--all" in sys.argv[1:]:
        say_all()
        return
    rows = [(name, shows, f"{count} {quantity}", f"{error:.1e}", remark)
            for name, shows, quantity, count, error, _, remark in table()]
    head = ("deck", "shows", "compared", "largest difference", "")
    docs_table.finish("calculix_decks", docs_table.markdown(head, rows), sys.argv[1:])


if __name__ == "__main__":
    main()
