# SPDX-License-Identifier: GPL-3.0-or-later
"""Small readers of the files that `clatter-condense export` writes, each from the format's description alone."""
import struct

import numpy as np
import scipy.linalg


def frequencies(K, M):
    """[Hz], ascending; rigid motions may be imaginary and count as zero."""
    return np.sqrt(np.maximum(scipy.linalg.eigh(K, M, eigvals_only=True), 0.0)) / (2.0 * np.pi)


def number(field):
    """A Nastran real: 1.0D+3, 1.0E3, 1.+3."""
    text = field.strip().upper().replace("D", "E")
    at = max(text.rfind("+"), text.rfind("-"))
    return float(text[:at] + "E" + text[at:] if at > 0 and text[at - 1] != "E" else text)


def bulk_entries(text):
    """Entries of fixed-field bulk data: lists of fields, the name first; continuations are joined, blanks kept."""
    entries = []
    for line in text.splitlines():
        line = line.split("$")[0].rstrip()
        if not line:
            continue
        if "," in line:
            name, *fields = [field.strip() for field in line.split(",")]
        elif line.startswith("BEGIN") or line.startswith("INCLUDE"):
            name, fields = line, []
        else:
            head = line[:8].strip()
            width, fields_of_line = (16, 4) if head.endswith("*") else (8, 8)
            name = head.rstrip("*")
            padded = line.ljust(8 + width * fields_of_line)
            fields = [padded[8 + width * f:8 + width * (f + 1)].strip() for f in range(fields_of_line)]
        if name in ("", "+"):
            entries[-1] += fields
        else:
            entries.append([name, *fields])
    return entries


def read_dmig(entries):
    """({name: {((column node, c), (row node, c)): value}}, {name: (form, type)})."""
    matrices, kinds = {}, {}
    for name, *fields in entries:
        if name != "DMIG":
            continue
        if fields[1] == "0":
            matrices[fields[0]], kinds[fields[0]] = {}, (fields[2], fields[3])
            continue
        column = (int(fields[1]), int(fields[2]))
        rows = [field for field in fields[4:]]
        for k in range(0, len(rows) - 2, 4):
            if rows[k]:
                matrices[fields[0]][column, (int(rows[k]), int(rows[k + 1]))] = number(rows[k + 2])
    return matrices, kinds


def read_bulk(text):
    """({DMIG name: {(column, row): value}}, {grid: (position, PS)}, spoints)."""
    entries = bulk_entries(text)
    matrices, kinds = read_dmig(entries)
    assert set(kinds.values()) == {("6", "2")}, kinds  # symmetric, double
    grids = {int(f[0]): ([number(x) for x in f[2:5]], f[6]) for name, *f in entries if name == "GRID"}
    return matrices, grids, [int(f[0]) for name, *f in entries if name == "SPOINT"]


class Residual:
    """What is left of a Nastran deck beside a superelement: GRID, SPOINT, CELAS2, CONM2, SPC1 and DMIG, as K and M."""

    def __init__(self, text):
        entries = bulk_entries(text)
        self.row, self.position, held = {}, {}, set()
        for name, *f in entries:
            if name == "GRID":
                assert int(f[0]) not in self.position, f"GRID {f[0]} twice"
                self.position[int(f[0])] = np.array([number(x) for x in f[2:5]])
                for c in "123456":
                    self.row[int(f[0]), int(c)] = len(self.row)
                held |= {(int(f[0]), int(c)) for c in (f[6] if len(f) > 6 else "")}
            elif name == "SPOINT":
                assert (int(f[0]), 0) not in self.row and int(f[0]) not in self.position, f"SPOINT {f[0]} twice"
                self.row[int(f[0]), 0] = len(self.row)
            elif name == "SPC1":
                held |= {(int(node), int(c)) for node in f[2:] if node for c in f[1]}
        n = len(self.row)
        self.K, self.M = np.zeros((n, n)), np.zeros((n, n))
        for name, *f in entries:
            if name == "CELAS2":
                ends = [self.row[int(f[k]), int(f[k + 1])] for k in (2, 4) if k < len(f) and f[k]]  # one: to the ground
                signs = np.array([1.0, -1.0])[:len(ends)]
                self.K[np.ix_(ends, ends)] += number(f[1]) * np.outer(signs, signs)
            elif name == "CONM2":
                rows = [self.row[int(f[1]), c] for c in (1, 2, 3)]
                self.M[rows, rows] += number(f[3])
        matrices, _ = read_dmig(entries)
        for name, matrix in matrices.items():
            into = {"K": self.K, "M": self.M}.get(name[0])
            if into is None:
                continue
            for (a, b), value in matrix.items():
                into[self.row[a], self.row[b]] += value
                if a != b:
                    into[self.row[b], self.row[a]] += value
        used = (abs(self.K).sum(axis=0) > 0.0) | (abs(self.M).sum(axis=0) > 0.0)
        self.free = [j for dof, j in self.row.items() if dof not in held and used[j]]

    def frequencies(self):
        at = np.ix_(self.free, self.free)
        return frequencies(self.K[at], self.M[at])


def read_op4(path):
    """{name: (matrix, form)} of OUTPUT4's non-sparse format, as text or as Fortran records."""
    data = path.read_bytes()
    return read_op4_binary(data) if data[:4] == struct.pack("<i", 24) else read_op4_text(data.decode("ascii"))


def read_op4_text(text):
    lines, found = iter(text.splitlines()), {}
    for head in lines:
        columns, rows, form, kind = (int(head[8 * k:8 * k + 8]) for k in range(4))
        assert kind == 2 and head[40:] == "1P,3E23.16", head
        name, matrix = head[32:40].strip(), np.zeros((rows, columns))
        while True:
            column, first, words = (int(word) for word in next(lines).split())
            values = []
            count = max(words // 2, 1)
            while len(values) < count:
                line = next(lines)
                values += [float(line[k:k + 23]) for k in range(0, len(line), 23)]
            if column > columns:
                break
            matrix[first - 1:first - 1 + count, column - 1] = values
        found[name] = (matrix, form)
    return found


def read_op4_binary(data):
    found, at = {}, 0

    def record():
        nonlocal at
        size = struct.unpack_from("<i", data, at)[0]
        body = data[at + 4:at + 4 + size]
        assert struct.unpack_from("<i", data, at + 4 + size)[0] == size
        at += size + 8
        return body

    while at < len(data):
        head = record()
        columns, rows, form, kind = struct.unpack_from("<4i", head)
        assert kind == 2 and len(head) == 24
        matrix = np.zeros((rows, columns))
        while True:
            body = record()
            column, first, words = struct.unpack_from("<3i", body)
            values = np.frombuffer(body, "<f8", offset=12)
            assert 2 * len(values) == words
            if column > columns:
                break
            matrix[first - 1:first - 1 + len(values), column - 1] = values
        found[head[16:24].decode().strip()] = (matrix, form)
    return found


def read_sid(text):
    """Standard input data as nested dictionaries; a Taylor expansion is (m0, m1), m1[row, column, coordinate]."""
    lines = [line.strip() for line in text.splitlines()]
    at = lines.index("part")

    def value_of(line):
        return line.split("=", 1)[1].strip()

    def taylor(name):
        nonlocal at
        head, m0, m1 = {}, None, None
        while lines[at] != f"end {name}":
            key, value = lines[at].split("=", 1)
            key = key.strip()
            if key.startswith("m0") or key.startswith("m1"):
                where = tuple(int(k) - 1 for k in key[key.index("(") + 1:key.index(")")].split(","))
                (m0 if key.startswith("m0") else m1)[where] = float(value)
            else:
                head[key] = int(value)
                if key == "structure":
                    m0 = np.zeros((head["nrow"], head["ncol"]))
                    m1 = np.zeros((head["nrow"], head["ncol"], head["nq"]))
            at += 1
        at += 1
        assert set(head) == {"order", "nrow", "ncol", "nq", "nqn", "structure"}, head
        return m0, m1

    body = {"frame": {}}
    at += 1
    assert lines[at] == "new modal"
    at += 1
    while lines[at] != "end modal":
        word = lines[at]
        at += 1
        if word == "refmod":
            while lines[at] != "end refmod":
                body[lines[at].split("=")[0].strip()] = value_of(lines[at])
                at += 1
            at += 1
        elif word == "frame":
            while lines[at] != "end frame":
                assert lines[at].startswith("new node"), lines[at]
                node = body["frame"][int(value_of(lines[at]))] = {}
                at += 1
                while lines[at] != "end node":
                    if lines[at].startswith("rframe"):
                        at += 1
                        continue
                    name = lines[at]
                    at += 1
                    node[name] = taylor(name)
                at += 1
            at += 1
        else:
            body[word] = taylor(word)
    assert lines[at + 1] == "end part"
    return body


def read_flex_ascii(text):
    """(M, K, D, times, loads) by ExtPtfm's rules: keywords at the start of lines, one line skipped after each."""
    lines = text.splitlines()
    assert lines[0].startswith("!") and "FLEX 5 FORMAT" in lines[1].upper()
    upper = [line.upper() for line in lines]

    def find(keyword):
        return next(k for k, line in enumerate(upper) if line.startswith(keyword))

    n = int(lines[find("!DIMENSION:")].split(":")[1])
    step = float(lines[find("!TIME INCREMENT IN SIMULATION:")].split(":")[1])
    end = float(lines[find("!TOTAL SIMULATION TIME IN FILE:")].split(":")[1])

    def rows(keyword, count):
        at = find(keyword) + 2
        return np.array([[float(word) for word in line.split()] for line in lines[at:at + count]])

    loads = rows("!LOADING", round(end / step) + 1)
    assert loads.shape[1] == n + 2
    return *(rows(f"!{what} MATRIX", n) for what in ("MASS", "STIFFNESS", "DAMPING")), loads[:, 0], loads[:, 1:]


EXUDYN = ("version", "modeBasis", "trigList", "postProcessingModes", "massMatrixReduced", "stiffnessMatrixReduced",
          "infoList", "rigidBodyNodeType", "xRef", "inertiaLocal", "Mtt", "totalMass", "chiU", "chiUtilde",
          "mPsiTildePsi", "mPsiTildePsiTilde", "mPhitTPsi", "mPhitTPsiTilde", "mXRefTildePsi", "mXRefTildePsiTilde")


def read_exudyn(path):
    """The arrays in the order of ObjectFFRFreducedOrderInterface.LoadFromFile, by its names."""
    with open(path, "rb") as file:
        arrays = {name: np.load(file) for name in EXUDYN}
        assert file.read() == b""
    return arrays
