# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of printed Nastran results (.f06), each value with the unit of its last printed digit.

Read: grid point tables (displacements, forces of supports, loads, eigenvectors), the same as complex numbers in
rectangular form, real and complex eigenvalues, stresses of solid elements. Pages of a table are joined.
"""
import collections
import re

NUMBER = re.compile(r"[+-]?\d+\.\d*(?:E[+-]\d+)?")
TITLE = re.compile(r"^\s*((?:\S ){3,}\S(?:  +(?:\S )*\S)*)")
AXES = ("T1", "T2", "T3", "R1", "R2", "R3")
STRESSES = ("X", "Y", "Z", "XY", "YZ", "ZX")

# A printed number: `unit` is one in its last digit.
Value = collections.namedtuple("Value", "number unit")
# One table: its title without the spaces within words, subcase (1 without any), frequency (None without), and
# rows {label: [Value]}; the label is a grid, a mode, or (element, grid) with grid 0 in the centre.
Table = collections.namedtuple("Table", "title subcase frequency rows")


def value(text):
    mantissa, _, exponent = text.partition("E")
    return Value(float(text), 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2])))


def values(text):
    return [value(word) for word in NUMBER.findall(text)]


def title_of(line):
    """"DISPLACEMENT VECTOR" of "D I S P L A C E M E N T   V E C T O R"; "" for a line that is no title."""
    if not TITLE.match(line):
        return ""
    words = re.split(r"  +", line.strip())
    return " ".join(word.replace(" ", "") for word in words)


def fewer_digits(found):
    """A value that rounds to zero is printed as 0.0: its unit is that of the other values of its table."""
    units = [one.unit for row in found.values() for one in row if one.number]
    smallest = min(units, default=1.0)
    return {label: [one if one.number else Value(0.0, smallest) for one in row] for label, row in found.items()}


class Reader:
    """One pass over the lines; a table ends at the next title or page."""

    def __init__(self):
        self.tables = {}
        self.subcase, self.frequency, self.title = 1, None, ""
        self.label = None
        self.element = 0

    def line(self, line):
        if line.startswith("0") and "FREQUENCY" not in line and not line[1:].strip()[:1].isdigit():
            found = re.search(r"SUBCASE (\d+)", line)
            self.subcase = int(found[1]) if found else self.subcase
        found = re.match(r"\s*FREQUENCY =\s*(\S+)", line)
        if found:
            self.frequency = float(found[1])
        title = title_of(line)
        if line.startswith("1") or title:
            self.title, self.label = title, None
        elif self.title.endswith("VECTOR") or "CONSTRAINT" in self.title or self.title.startswith("REALEIGENVECTOR"):
            self.grid_row(line)
        elif self.title == "REAL EIGENVALUES":
            self.eigenvalue_row(line, 2, 5)
        elif self.title == "COMPLEX EIGENVALUE SUMMARY":
            self.eigenvalue_row(line, 2, 4)
        elif "STRESSES IN" in self.title and "SOLID" in self.title:
            self.stress_row(line)

    def put(self, label, found):
        key = (self.title, self.subcase, self.frequency)
        self.tables.setdefault(key, {}).setdefault(label, []).extend(found)

    def grid_row(self, line):
        found = re.match(r"0?\s+(\d+)\s+[GS]\s+(.*)", line)
        if found:
            self.label = int(found[1])
            self.put(self.label, values(found[2]))
        elif self.title.startswith("COMPLEX") and self.label is not None and values(line):
            self.put(self.label, values(line))  # the imaginary parts
            self.label = None

    def eigenvalue_row(self, line, integers, reals):
        words = line.split()
        if len(words) == integers + reals and all(word.isdigit() for word in words[:integers]):
            self.put(int(words[0]), [value(word) for word in words[integers:]])

    def stress_row(self, line):
        element = re.match(r"0?\s+(\d+)\s+\d+GRID CS", line)
        if element:
            self.element = int(element[1])
        first = re.match(r"0?\s+(CENTER|\d+)\s+X\s+(\S+)\s+XY\s+(\S+)", line)
        more = re.match(r"\s+[YZ]\s+(\S+)\s+(?:YZ|ZX)\s+(\S+)", line)
        if first:
            self.label = (self.element, 0 if first[1] == "CENTER" else int(first[1]))
        if (first or more) and self.label:
            self.put(self.label, [value(word) for word in (first or more).groups()[-2:]])


def read(lines):
    """All tables, in the order of their first pages; zero values have the smallest unit of their table."""
    reader = Reader()
    for line in lines:
        reader.line(line.rstrip("\r\n").rstrip())
    tables = []
    for (title, subcase, frequency), rows in reader.tables.items():
        if "STRESSES" in title:  # printed as X XY, Y YZ, Z ZX
            rows = {label: [row[k] for k in (0, 2, 4, 1, 3, 5)] for label, row in rows.items() if len(row) == 6}
        tables.append(Table(title, subcase, frequency, fewer_digits(rows)))
    return tables


