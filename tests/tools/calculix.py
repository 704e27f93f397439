# SPDX-License-Identifier: GPL-3.0-or-later
"""CalculiX for tests: the only file of them that starts ccx.

Where ccx is installed it solves a deck, and what it finds must agree with the values stored for that deck. Debian 13 has no
package calculix-ccx; there the stored values take its part. They are in tests/reference/calculix, a file for each test file, with
the SHA-256 of the deck they belong to, so that another deck is an error. To store again:

    CLATTER_STORE_CALCULIX=1 ctest --test-dir build/release -R '^deck_test'

CLATTER_WITHOUT_CALCULIX=1 takes the stored values although ccx is installed. CLATTER_CALCULIX_DECKS is a folder of another version
of package calculix-ccx-test: 2.11 on Debian 12, 2.22 on Debian 13; some of their decks differ.
"""
import gzip
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import textwrap
import unittest

import numpy as np

PROGRAM = None if os.environ.get("CLATTER_WITHOUT_CALCULIX") else shutil.which("ccx")
DECKS = pathlib.Path(os.environ.get("CLATTER_CALCULIX_DECKS", "/usr/share/doc/calculix-ccx-test/examples/test"))
FOLDER = pathlib.Path(__file__).resolve().parents[1] / "reference/calculix"
ABSENT = "package calculix-ccx is not installed (Debian 13 has none)"
GMSH = "this deck depends on gmsh's mesh, so no result is stored"


def required(why_not_stored):
    """Skips a test or a class without ccx."""
    return unittest.skipUnless(PROGRAM, f"{ABSENT}, and {why_not_stored}")


def run(deck, folder, name="deck"):
    """Runs ccx on the text of a deck; its files are `name`.dat and so on."""
    if not PROGRAM:
        raise AssertionError(ABSENT)
    (folder / f"{name}.inp").write_text(deck)
    # One thread: the same digits each time.
    done = subprocess.run([PROGRAM, name], cwd=folder, capture_output=True, text=True, errors="replace", timeout=300,
                          env={**os.environ, "OMP_NUM_THREADS": "1"})
    if "Job finished" not in done.stdout:
        raise AssertionError(f"ccx ended with {done.returncode}: {(done.stdout + done.stderr)[-1500:]}")


def solve(deck, extract):
    """extract(folder) of the files that ccx wrote."""
    with tempfile.TemporaryDirectory(prefix="clatter-ccx-") as folder:
        run(deck, pathlib.Path(folder))
        return extract(pathlib.Path(folder))


def lines(folder):
    """The lines of the .dat file."""
    return (folder / "deck.dat").read_text().splitlines()


def numbers(line):
    try:
        return [float(word) for word in line.split()]
    except ValueError:
        return []


def frequencies(text):
    """[Hz] from the lines of a .dat file. The table: mode, eigenvalue, rad/time, cycles/time, imaginary part."""
    found, inside = [], False
    for line in text:
        if "P A R T I C I P A T I O N" in line:
            break
        inside = inside or "E I G E N V A L U E" in line
        row = numbers(line)
        if inside and len(row) == 5:
            found.append(row[3])
    return np.array(found)


def table(text, title):
    """Rows of numbers after the first line with `title`."""
    begin = next(k for k, line in enumerate(text) if title in line)
    rows = []
    for line in text[begin + 1:]:
        if row := numbers(line):
            rows.append(row)
        elif rows:
            break
    return np.array(rows)


def package(name, suffix):
    """Lines of a file of package calculix-ccx-test, compressed or not; none if there is no such file."""
    for path in (DECKS / f"{name}{suffix}", DECKS / f"{name}{suffix}.gz"):
        if path.exists():
            data = gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes()
            return data.decode(errors="replace").splitlines()
    return []


def some(values, count=60):
    """About `count` rows of each array, evenly spaced: enough to compare, few enough to store."""
    return {name: rows[np.unique(np.linspace(0, len(rows) - 1, count).astype(int))] for name, rows in values.items()}


def same(found, stored, digits):
    """Whether two results agree to a unit of the last digit; numbers below 1e-8 of the largest (7 digits) are rounding."""
    unit = 10.0 ** (1 - digits)
    return found.keys() == stored.keys() and all(
        np.shape(found[name]) == np.shape(stored[name]) and
        np.allclose(found[name], stored[name], rtol=1.01 * unit, atol=0.01 * unit * np.abs(stored[name]).max())
        for name in stored)


def rounded(values, digits):
    """Lists with that many digits; rounding near zero is 0."""
    values = np.asarray(values)
    if values.dtype.kind == "i":
        return values.tolist()
    values = np.where(np.abs(values) < 10.0 ** (-2 - digits) * np.abs(values).max(), 0.0, values)
    return np.vectorize(lambda x: float(f"{x:.{digits - 1}e}"), otypes=[float])(values).tolist()


class Results:
    """The stored results of one test file."""

    def __init__(self, test_file):
        self.test = pathlib.Path(test_file).stem
        self.path = FOLDER / f"{self.test}.json"
        self.command = f"CLATTER_STORE_CALCULIX=1 ctest --test-dir build/release -R '^{self.test}'"

    def of(self, name, deck, extract, keep=lambda values: values, digits=7):
        """{name: array}: extract(folder) of the files that ccx wrote for the deck; without ccx what is stored of it. `keep` takes
        from the result what is to be stored, with that many digits."""
        deck_hash = hashlib.sha256(deck.encode()).hexdigest()
        storing = os.environ.get("CLATTER_STORE_CALCULIX")
        if not (PROGRAM or storing):
            return self.stored(name, deck_hash)
        values = {key: np.asarray(array) for key, array in solve(deck, extract).items()}
        if storing:
            self.store(name, deck_hash, keep(values), digits)
        if not same(keep(values), self.stored(name, deck_hash), digits):
            raise AssertionError(f"{self.path.name}, {name}: ccx {version()} finds other values than are stored; after a check of "
                                 f"both, store again by: {self.command}")
        return values

    def read(self):
        return json.loads(self.path.read_text()) if self.path.exists() else {"results": {}}

    def stored(self, name, deck_hash):
        entry = self.read()["results"].get(name)
        if entry is None or deck_hash not in entry["decks"]:
            found = "no result is stored" if entry is None else "the stored result is that of another deck"
            raise AssertionError(f"{self.path.name}, {name}: {found}; with ccx installed, store it by: {self.command}")
        return {key: np.array(values) for key, values in entry["values"].items()}

    def store(self, name, deck_hash, values, digits):
        """Another deck with the same result, as in another version of the package, is added; otherwise the result is replaced."""
        values = {key: rounded(array, digits) for key, array in values.items()}
        everything = self.read()["results"]
        before = everything.get(name, {"decks": [], "values": {}})
        others = before["decks"] if same(values, before["values"], digits) else []
        everything[name] = {"decks": sorted({*others, deck_hash}), "values": values}
        text = json.dumps({"made by": self.command, "ccx": version(), "results": dict(sorted(everything.items()))}, indent=0)
        self.path.parent.mkdir(parents=True, exist_ok=True)
        # Lists of numbers in full lines.
        self.path.write_text(re.sub(r"\[[^][{}]*\]", lambda one: textwrap.fill(" ".join(one[0].split()), 150), text) + "\n")


def version():
    """As ccx prints it."""
    said = subprocess.run([PROGRAM, "-v"], capture_output=True, text=True).stdout
    return said.split()[-1]
