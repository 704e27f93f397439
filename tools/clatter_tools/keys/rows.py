# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of keys in the form of `clatter-mesh keys --json`, for files that the tools read, and the check of an entry by them.

A table is {name, meaning, keys, one_of}; a key {name, type, meaning, ...} with unit, min, max, above, count, choices, default (TOML), required, rules,
table, types as in core/keys/describe.hpp.
"""
import difflib
import math

from clatter.errors import BadArtefact


def table(name, meaning, keys, one_of=()):
    return {"name": name, "meaning": meaning, "keys": keys, **({"one_of": [list(group) for group in one_of]} if one_of else {})}


def key(name, kind, meaning, **more):
    """`default` is TOML, as false or "last"."""
    return {"name": name, "type": kind, "meaning": meaning, **more}


def below(name, kind, inner, meaning=""):
    """A key with a table of its own: kind is table, tables or named tables."""
    return {"name": name, "type": kind, "meaning": meaning or inner["meaning"], "table": inner}


def find(tables, name):
    return next((one for one in tables["keys"] if one["name"] == name), None)


def nearest(name, names):
    """The name that was probably meant, or all of them."""
    close = difflib.get_close_matches(name, names, n=1, cutoff=0.5)
    return close[0] if close else " or ".join(names)


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def is_whole(value):
    return isinstance(value, int) and not isinstance(value, bool)


def is_list_of(holds):
    return lambda value: isinstance(value, list) and all(holds(one) for one in value)


def is_text(value):
    return isinstance(value, str) and value != ""


# type: (whether a value has it, how it is called).
TYPES = {
    "number": (is_number, "a number"),
    "integer": (is_whole, "a whole number"),
    "flag": (lambda value: isinstance(value, bool), "true or false"),
    "text": (is_text, "a text"),
    "path": (is_text, "a path"),
    "choice": (is_text, "a text"),
    "numbers": (is_list_of(is_number), "a list of numbers"),
    "texts": (is_list_of(is_text), "a list of texts"),
    "empty": (lambda value: value == "", "an empty text"),
    "list": (lambda value: isinstance(value, list), "a list"),
    "table": (lambda value: isinstance(value, dict), "a table"),
    "tables": (is_list_of(lambda one: isinstance(one, dict)), "tables"),
    "texts by name": (lambda value: isinstance(value, dict) and all(is_text(one) for one in value.values()), "texts by name"),
}


def expected(row):
    """What a value has to be, in words: "a number above 0", "one of: seconds, processor"."""
    if row.get("choices"):
        return f"one of: {', '.join(row['choices'])}"
    kinds = " or ".join(TYPES[kind][1] for kind in row.get("types", [row["type"]]))
    for bound, words in (("above", "above"), ("min", "at least"), ("max", "at most")):
        kinds += f" {words} {row[bound]:g}" if bound in row else ""
    return kinds


def fits(row, value):
    """Whether the value has the row's type, range and choices."""
    if not any(TYPES[kind][0](value) for kind in row.get("types", [row["type"]])):
        return False
    if row.get("choices") and value not in row["choices"]:
        return False
    numbers = value if isinstance(value, list) else [value]
    return not any(is_number(one) and (one < row.get("min", -math.inf) or one > row.get("max", math.inf) or one <= row.get("above", -math.inf))
                   for one in numbers)


def check(where, entry, rows, prefix=""):
    """BadArtefact names an unknown key of an entry, one that lacks, a value that does not fit, and keys that exclude or need each other. `prefix`: of the
    keys' names, the table that the entry is."""
    names = [row["name"] for row in rows["keys"]]
    for name in entry:
        if name not in names:
            raise BadArtefact(f"{where}: {prefix}{name}: unknown key, did you mean {nearest(name, names)}?")
    for row in rows["keys"]:
        name = row["name"]
        if name not in entry:
            if row.get("required"):
                raise BadArtefact(f"{where}: {prefix}{name}: found nothing, expected {expected(row)}")
        elif not fits(row, entry[name]):
            raise BadArtefact(f"{where}: {prefix}{name}: found {entry[name]!r:.80}, expected {expected(row)}")
        elif row["type"] == "tables":
            for number, one in enumerate(entry[name]):
                check(where, one, row["table"], f"{prefix}{name}[{number}].")
        elif isinstance(entry[name], dict) and "table" in row:
            check(where, entry[name], row["table"], f"{prefix}{name}.")
        check_rules(f"{where}: {prefix}", entry, row)
    for group in rows.get("one_of", []):
        given = [name for name in group if name in entry]
        if not given:
            raise BadArtefact(f"{where}: {prefix}{group[0]}: give {' or '.join(group)}")
        if len(given) > 1:
            raise BadArtefact(f"{where}: {prefix}{given[1]}: {' and '.join(given)} exclude each other")


def check_rules(before, entry, row):
    """`before`: of the key's name in messages."""
    name = row["name"]
    for rule in row.get("rules", []):
        other = rule["other"]
        holds = other in entry and entry[other] in rule.get("values", [entry[other]])
        said = other + (f" = {' or '.join(rule['values'])}" if "values" in rule else "")
        reason = f": {rule['reason']}" if "reason" in rule else ""
        if rule["kind"] == "excludes" and name in entry and holds:
            raise BadArtefact(f"{before}{name}: {name} and {said} exclude each other{reason}")
        if rule["kind"] == "needs" and name in entry and not holds:
            raise BadArtefact(f"{before}{name}: needs {said}{reason}")
        if rule["kind"] == "required_with" and name not in entry and holds:
            raise BadArtefact(f"{before}{name}: is missing, {said} needs it")
