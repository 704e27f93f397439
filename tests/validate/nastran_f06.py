#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Nastran decks of ../shared/data/nastran_f06 through clatter, against the printed results that are beside them.

    tests/validate/nastran_f06.py            prints the table
    tests/validate/nastran_f06.py --write    puts it into docs/validation.md
    tests/validate/nastran_f06.py rbe2_y     one deck (any part of its name), with all of its messages

Each deck is read, assembled and solved by the executables alone (CLATTER_BIN), in its own units. A value agrees when
it differs by at most one in the last digit that is printed of the largest value of its table (translations and
rotations each).
"""
import collections
import pathlib
import re
import sys
import tempfile

import h5py
import numpy as np

import docs_table
import f06
from stage_run import SOURCE, run

DECKS = SOURCE.parent / "shared/data/nastran_f06"

# Families of elements by their cards.
FAMILIES = {
    "solids": r"CTETRA|CPYRAM?|CPENTA|CHEXA",
    "rigid elements": r"RBE[123]|RBAR1?|RROD|RJOINT",
    "MPC": r"MPC",
    "springs": r"CELAS\d|CBUSH|CGAP",
    "dampers": r"CDAMP\d|CVISC",
    "masses": r"CONM\d|CMASS\d",
    "DMIG": r"DMIG",
    "bars": r"CBAR|CBEAM|CBEND|CROD|CONROD|CTUBE",
    "shells": r"CQUAD\w|CTRIA\w|CSHEAR",
    "contact": r"BCBODY|BCONP|BCONTACT",
    "finite strain": r"MATHP|PLSOLID",
}
# Those that clatter does not have yet.
LATER = ("contact", "finite strain")
ROUNDING = 1e-12  # of displacements and rotations
# Relative; the program has another quadrilateral and triangle.
OTHER_SHELLS = 0.01
# Why figures differ.
COARSE = "; few cells, which bend between their nodes in the deck's program"
EXPLAINED = {"rbe3": COARSE, "pload4d": COARSE, "nas101prob3": COARSE,
             "nas101prob6": "; distorted cells held at two nodes: 669, 490, 412, 353 Hz as each is divided on",
             "nas101prob4": "; rotations about the normal of a shell have no stiffness in the deck's program",
             "nas102prob14a": "; beams have the rotary inertia of their sections, which the coupled mass of the deck's program leaves out"}
NOT_LINEAR = {105: "buckling", 106: "nonlinear"}

# One row of the table. `verdict`: agrees, differs, refused, waits (for contact), read (nothing to compare).
Row = collections.namedtuple("Row", "deck families figure ours theirs difference verdict")


class Deck:
    """A deck's text, the results beside it, and what kinds of elements it has."""

    def __init__(self, path):
        self.path = path
        self.name = path.parent.name if path.parent != DECKS else path.name
        if len([one for one in decks_in(path.parent) if one.suffix]) > 1:
            self.name = f"{path.parent.name}/{path.name}" if path.parent != DECKS else path.name
        self.lines = text_of(path)
        self.cards = {word for line in self.lines + included(path, self.lines)
                      for word in re.findall(r"^([A-Za-z]\w*)", line)}
        self.families = [family for family, names in FAMILIES.items()
                         if any(re.fullmatch(names, card.upper()) for card in self.cards)]
        solution = re.search(r"(?im)^\s*SOL\s+(\d+)", "\n".join(self.lines))
        self.solution = int(solution[1]) if solution else 0
        self.turned = {int(line[8:16]) for line in self.lines
                       if re.match(r"GRID    ", line) and line[48:56].strip().isdigit() and int(line[48:56]) > 0}
        results = printed_beside(path)
        self.tables = f06.read(text_of(results)) if results else None

    def waits(self):
        """Why clatter cannot mean this deck yet; "" if it should."""
        later = [family for family in self.families if family in LATER]
        return ", ".join(later) or NOT_LINEAR.get(self.solution, "")

    def printed(self):
        """What the .f06 holds, in words."""
        if self.tables is None:
            return "no .f06"
        kinds = collections.Counter(table.title.lower() for table in self.tables)
        return ", ".join(f"{count} {kind}" if count > 1 else kind for kind, count in kinds.items())


def text_of(path):
    return path.read_text(encoding="latin-1").splitlines()


def included_paths(path, lines):
    names = re.findall(r"(?im)^\s*INCLUDE\s+'?([^'\s]+)", "\n".join(lines))
    return [path.parent / name for name in names]


def included(path, lines):
    return [line for one in included_paths(path, lines) if one.exists() for line in text_of(one)]


def decks_in(folder):
    """Decks of a folder, without those that another one includes."""
    found = [path for path in sorted(folder.iterdir()) if path.suffix in (".bdf", ".nas", ".dat", ".fem")]
    inside = {one for path in found for one in included_paths(path, text_of(path))}
    return [path for path in found if path not in inside]


def printed_beside(path):
    """The .f06 of a deck: of its name, with underscores around it, or the only one beside it."""
    if path.parent == DECKS:
        return None
    for name in (path.stem, f"__{path.stem}__"):
        if (path.parent / f"{name}.f06").exists():
            return path.parent / f"{name}.f06"
    return None


def all_decks():
    return [Deck(path) for folder in [DECKS, *sorted(DECKS.iterdir())] if folder.is_dir() for path in decks_in(folder)]


def without_deck():
    """Folders that hold results alone."""
    return [folder.name for folder in sorted(DECKS.iterdir()) if folder.is_dir() and not decks_in(folder)]


def read_deck(deck, folder):
    """a.mesh.h5 and a.fe.toml in `folder`, whose text is returned; numbers stay in the deck's units."""
    run("mesh", deck.path, "--units", "m-kg-s", "-o", "a.mesh.h5", "--recipe", "a.fe.toml", folder=folder)
    return (folder / "a.fe.toml").read_text()


def refusal(text):
    """The first line of a program's refusals that names one, and how many there are."""
    lines = [line.strip() for line in re.sub(r"clatter-\w+: (error: )?", "", text).splitlines() if line.strip()]
    lines = [line for line in lines if not re.search(r"\d+ refusals:$|^warning: ", line)]
    first = re.sub(r" \(and \d+ more, next at [^)]*\)", "", lines[0])
    first = re.sub(r"^.*/(?=[^/]+:\d+: |[^/ ]+: )", "", first)
    return first + (f" (and {len(lines) - 1} more)" if len(lines) > 1 else "")


class Worst:
    """The value that differs most, in units of the last digit of its table's largest value."""

    def __init__(self):
        self.count, self.units, self.where = 0, -1.0, None

    def add(self, label, ours, theirs, unit, largest):
        self.count += 1
        units = abs(ours - theirs.number) / unit
        if units > self.units:
            self.units, self.where = units, (label, ours, theirs.number, abs(ours - theirs.number) / largest)

    def row(self, deck, figure):
        label, ours, theirs, difference = self.where
        verdict = "agrees" if self.units <= 1.01 else "differs"
        alike = verdict == "differs" and "shells" in deck.families and difference <= OTHER_SHELLS
        if verdict == "differs" and not alike:
            if deck.waits():
                verdict = f"waits for {deck.waits()}"
            figure += EXPLAINED.get(deck.name, "")
        said = f"{difference:.1e}" if verdict != "agrees" else f"{self.units:.1f} in the last digit"
        if alike:
            verdict, figure = "agrees", figure + "; shells of another kind"
        return Row(deck.name, deck.families, f"{self.count} {figure}, worst {label}", f"{ours:.7g}", f"{theirs:.7g}",
                   said, verdict)


def largest_of(rows, columns):
    """The largest value of some columns, and the unit of its last digit."""
    largest = max((row[k] for row in rows for k in columns if k < len(row)), key=lambda one: abs(one.number),
                  default=f06.Value(0.0, 1.0))
    return (abs(largest.number), largest.unit) if largest.number else (1.0, largest.unit)


def our_motions(file, case):
    """{grid: six numbers} of a static case; rotations of nodes of solids are not a number."""
    motions = {}
    nodes = file[f"cases/{case}/displacement"][()].reshape(-1, 3)
    rotations = np.full_like(nodes, np.nan)
    if "rotation_nodes" in file:
        rotations[file["rotation_nodes"][()]] = file[f"cases/{case}/rotation"][()]
    for label, row, rotation in zip(file["node_ids"][()] if "node_ids" in file else (), nodes, rotations):
        motions[int(label)] = [*row, *rotation]
    if "points" in file:
        for name, row in zip(file["points/names"].asstr()[()], file[f"cases/{case}/points"][()].reshape(-1, 6)):
            grid = re.fullmatch(r"(?:point|on_node)_(\d+)", name)
            if grid:
                motions[int(grid[1])] = list(row)
    return motions


def compare_displacements(tables, file, deck):
    worst = Worst()
    for table in tables:
        case = f"subcase_{table.subcase}"
        if f"cases/{case}" not in file:
            raise RuntimeError(f"{deck.path.name}: {case} is printed, but no case of the recipe")
        motions = our_motions(file, case)
        for columns in (range(3), range(3, 6)):
            largest, unit = largest_of(table.rows.values(), columns)
            if largest < ROUNDING:
                continue
            for grid, row in table.rows.items():
                ours = motions.get(grid, [np.nan] * 6)
                if grid in deck.turned:  # printed along axes of its own: the lengths agree
                    theirs = f06.Value(float(np.linalg.norm([row[k].number for k in columns if k < len(row)])), unit)
                    if not np.isnan(ours[columns[0]]):
                        worst.add(f"{table.subcase}: {grid} length", float(np.linalg.norm([ours[k] for k in columns])),
                                  theirs, unit, largest)
                    continue
                for k in columns:
                    if k < len(row) and not np.isnan(ours[k]):
                        worst.add(f"{table.subcase}: {grid} {f06.AXES[k]}", ours[k], row[k], unit, largest)
    return worst.row(deck, "displacements")


def compare_stresses(tables, file, deck):
    """At corners that belong to one printed element: clatter averages over the cells of a region."""
    worst = Worst()
    ids = {int(label): row for row, label in enumerate(file["node_ids"][()])}
    for table in tables:
        used = collections.Counter(grid for _, grid in table.rows)
        largest, unit = largest_of(table.rows.values(), range(6))
        for region in file[f"cases/subcase_{table.subcase}/stress"]:
            at = {int(node): row for row, node in enumerate(file[f"stress_nodes/{region}"][()])}
            ours = file[f"cases/subcase_{table.subcase}/stress/{region}"][()]
            for (_, grid), row in table.rows.items():
                if grid and used[grid] == 1 and ids.get(grid) in at:
                    for k in range(6):
                        worst.add(f"{grid} {f06.STRESSES[k]}", ours[at[ids[grid]], k], row[k], unit, largest)
    return worst.row(deck, "stresses") if worst.count else None


def compare_statics(deck, folder):
    of = {title: [table for table in deck.tables or () if title in table.title and "COMPLEX" not in table.title]
          for title in ("DISPLACEMENT VECTOR", "SOLID ELEMENTS")}
    if not of["DISPLACEMENT VECTOR"]:
        return []
    run("modal", "statics", "a.fe.h5", "-o", "a.static.h5", folder=folder)
    with h5py.File(folder / "a.static.h5") as file:
        rows = [compare_displacements(of["DISPLACEMENT VECTOR"], file, deck)]
        if of["SOLID ELEMENTS"]:
            rows.append(compare_stresses(of["SOLID ELEMENTS"], file, deck))
    return [row for row in rows if row]


def compare_frequencies(deck, folder):
    rows = []
    for table in deck.tables or ():
        if table.title != "REAL EIGENVALUES":
            continue
        run("modal", "a.fe.h5", "--count", len(table.rows), "-o", "a.modes.h5", folder=folder)
        with h5py.File(folder / "a.modes.h5") as file:
            ours = file["frequency_hz"][()]
        worst = Worst()
        for (mode, row), frequency in zip(table.rows.items(), ours):
            cycles = row[2]
            worst.add(f"mode {mode}", frequency, cycles, cycles.unit, abs(cycles.number) or 1.0)
        rows.append(worst.row(deck, "frequencies"))
    return rows


def compare(deck, folder):
    """Rows of a deck; one that says why there is nothing to compare, where there is nothing."""
    recipe = read_deck(deck, folder)
    why, rows = "", []
    if not re.search(r"(?m)^\[material\.", recipe) and {"solids", "shells"} & set(deck.families):
        why = "; the deck is a mesh without materials"
    else:
        run("assembly", "a.mesh.h5", "-c", "a.fe.toml", "-o", "a.fe.h5", folder=folder)
        rows = compare_frequencies(deck, folder)
        if re.search(r"(?m)^\[\[case\]\]", recipe):
            rows += compare_statics(deck, folder)
    return rows or [Row(deck.name, deck.families, f"printed: {deck.printed()}{why}", "", "", "", "read")]


def rows_of(deck):
    """Rows of the table for one deck; the text of its refusal or None."""
    with tempfile.TemporaryDirectory(prefix="clatter-f06-") as folder:
        try:
            return compare(deck, pathlib.Path(folder)), None
        except RuntimeError as error:
            verdict = f"waits for {deck.waits()}" if deck.waits() else "refused"
            return [Row(deck.name, deck.families, refusal(str(error)), "", "", "", verdict)], str(error)


ORDER = ("refused", "differs", "agrees", "read", "waits", "no deck")


def verdicts(rows):
    """{deck: the worst word of its rows}."""
    words = collections.defaultdict(list)
    for row in rows:
        words[row.deck].append(ORDER.index("waits" if row.verdict.startswith("waits") else row.verdict))
    return {deck: ORDER[min(found)] for deck, found in words.items()}


def summary(rows):
    count = collections.Counter(verdicts(rows).values())
    return (f"{len(verdicts(rows))} decks: {count['agrees']} agree, {count['differs']} differ, "
            f"{count['refused']} are refused; {count['read']} are read and have nothing printed that clatter "
            f"computes; {count['waits']} wait for elements or solutions that clatter does not have yet; "
            f"{count['no deck']} is printed results without a deck.")


def table_text(rows):
    head = ("deck", "elements", "figure, or why it is refused", "ours", "printed", "difference", "")
    cells = [(row.deck, ", ".join(row.families), row.figure.replace("|", "\\|"), *row[3:]) for row in rows]
    return summary(rows) + "\n\n" + docs_table.markdown(head, cells)


def all_rows():
    rows = [row for deck in all_decks() for row in rows_of(deck)[0]]
    return rows + [Row(name, [], "no deck beside the printed results", "", "", "", "no deck")
                   for name in without_deck()]


def say_some(names):
    """All rows and messages of decks whose name contains one of `names`."""
    for deck in all_decks():
        if any(name in deck.name for name in names):
            rows, refused = rows_of(deck)
            print(f"{deck.name}: {', '.join(deck.families)}; SOL {deck.solution}; printed: {deck.printed()}")
            for row in rows:
                print("  " + " | ".join(row[2:]))
            print(refused or "")


def main():
    names = [word for word in sys.argv[1:] if not word.startswith("--")]
    if not DECKS.exists():
        sys.exit(f"{DECKS} is absent")
    if names:
        say_some(names)
    else:
        docs_table.finish("nastran_f06", table_text(all_rows()), sys.argv[1:])


if __name__ == "__main__":
    main()
