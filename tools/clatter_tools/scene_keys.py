# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a scene, or another TOML file, can have the keys that a sweep or a study changes, and their values: before thousands of runs are made."""
import math
import pathlib
import tomllib

from clatter.artefact import BadArtefact
from .keys import files, rows


def scene(path):
    """The tables of a TOML file over those of its bases; lists of tables are those of the file that has them as a list."""
    path, found, seen = pathlib.Path(path), {}, set()
    while path is not None and path.is_file() and path.resolve() not in seen:
        seen.add(path.resolve())
        try:
            own = tomllib.loads(path.read_text(encoding="utf-8"))
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise BadArtefact(f"{path}: not TOML: {error}") from error
        base = own.get("base")
        found = over(found, own)
        path = path.parent / base if isinstance(base, str) else None
    return found


def over(upper, lower):
    found = dict(lower)
    for key, value in upper.items():
        below = lower.get(key)
        if isinstance(value, dict) and isinstance(below, dict):
            found[key] = over(value, below)
        elif not (isinstance(value, dict) and isinstance(below, list)):  # a table over a list changes its entries
            found[key] = value
    return found


def steps_of(key):
    """The names of a dotted key."""
    try:
        table, steps = tomllib.loads(f"{key} = 0"), []
    except tomllib.TOMLDecodeError as error:
        raise BadArtefact(f"{key}: no key of TOML, expected names joined by points, such as engine.speed_rpm") from error
    while isinstance(table, dict):
        (step, table), = table.items()
        steps.append(step)
    return steps


def table_of_scenes():
    """The keys of a run.toml by clatter-dynamics; None where it is not there."""
    return files.tables_of(files.KINDS["run"]).get("run")


def check(base, key, value, table):
    """BadArtefact where scenes over `base`, as scene() has it, have no such key, or it cannot have the value. `table`: their keys, or None; without them
    only what is no number is found."""
    if any(isinstance(one, float) and not math.isfinite(one) for one in (value if isinstance(value, list) else [value])):
        raise BadArtefact(f"{key}: found {value}, expected a finite number")
    row = None if table is None else row_at(base, key, steps_of(key), table)
    if row and all(kind in rows.TYPES for kind in row.get("types", [row["type"]])) and not rows.fits(row, value):
        raise BadArtefact(f"{key}: found {value!r:.80}, expected {rows.expected(row)}")


def row_at(base, key, steps, table):
    """The row of the last step; None below a table whose keys are names."""
    at, left = base, list(steps)
    while True:
        name = left.pop(0)
        row = rows.find(table, name)
        if row is None:
            raise BadArtefact(f"{key}: unknown key {name}, did you mean {rows.nearest(name, [one['name'] for one in table['keys']]):.300}?")
        if not left:
            return row
        if "table" not in row:
            if row["type"] == "by name":
                return None
            raise BadArtefact(f"{key}: found {left[0]} below {name}, which is no table")
        at, table = at.get(name, {}) if isinstance(at, dict) else {}, row["table"]
        if row["type"] == "table":
            continue
        entry = left.pop(0)
        at = entry_of(key, name, at, entry) if row["type"] == "tables" else at.get(entry, {})
        if not left:
            raise BadArtefact(f"{key}: found a table, expected a key of it, as {key}.{table['keys'][0]['name']}")


def entry_of(key, name, entries, wanted):
    """The entry of a list of tables by its name, of those without one by number, as programs find it."""
    entries = entries if isinstance(entries, list) else []
    names = [one.get("name", str(number)) for number, one in enumerate(entries)]
    if wanted not in names:
        raise BadArtefact(f"{key}: found no [[{name}]] {wanted} in the base, expected one of: {', '.join(map(str, names)) or 'none, it has no such table'}")
    return entries[names.index(wanted)]
