# SPDX-License-Identifier: GPL-3.0-or-later
"""TOML files with changed keys: values by a path of keys, and tables as text (comments are not kept)."""
import json
import math

from clatter.artefact import BadArtefact


def child(table, step):
    """The entry of a table by its key, of a list of tables by its name or number; None without one."""
    if isinstance(table, dict):
        return table.get(step)
    if isinstance(table, list):
        for number, entry in enumerate(table):
            if isinstance(entry, dict) and (entry.get("name") == step or ("name" not in entry and step == str(number))):
                return entry
        return table[int(step)] if step.isdigit() and int(step) < len(table) else None
    return None


def value_at(table, path):
    """The value at a path of keys; None where there is none."""
    for step in path:
        table = child(table, step)
    return table


def set_value(where, table, path, value):
    """Changes the value at a path; missing tables are made, but not the entry of a list."""
    for step in path[:-1]:
        below = child(table, step)
        if below is None and isinstance(table, dict):
            below = table[step] = {}
        if not isinstance(below, (dict, list)):
            raise BadArtefact(f"{where}: {'.'.join(path)}: found no table {step}, expected one")
        table = below
    last = path[-1]
    if isinstance(table, list) and last.isdigit() and int(last) < len(table):
        table[int(last)] = value
    elif isinstance(table, dict):
        table[last] = value
    else:
        raise BadArtefact(f"{where}: {'.'.join(path)}: found a list without entry {last}, expected one of its entries")


def text_of(table):
    """A table as a TOML file: keys first, then tables."""
    return "\n".join(lines(table, [])) + "\n"


def lines(table, path):
    plain = {key: value for key, value in table.items() if not is_table(value)}
    found = [f"{key_text(key)} = {value_text(value)}" for key, value in plain.items()]
    for key, value in table.items():
        if not is_table(value):
            continue
        inner = [*path, key_text(key)]
        head = ".".join(inner)
        if isinstance(value, dict):
            found += ["", f"[{head}]", *lines(value, inner)]
        else:
            for entry in value:
                found += ["", f"[[{head}]]", *lines(entry, inner)]
    return found


def is_table(value):
    return isinstance(value, dict) or (isinstance(value, list) and bool(value) and all(isinstance(one, dict) for one in value))


def key_text(key):
    return key if key and all(one.isascii() and (one.isalnum() or one in "-_") for one in key) else json.dumps(key)


def value_text(value):
    """A value in a line; tables in lists as inline tables."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else str(value)  # TOML has nan, inf and -inf as Python
    if isinstance(value, list):
        return f"[{', '.join(value_text(one) for one in value)}]"
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{key_text(key)} = {value_text(one)}' for key, one in value.items())} }}" if value else "{}"
    return value.isoformat() if hasattr(value, "isoformat") else str(value)


def texts_in(value):
    """All texts in a value."""
    if isinstance(value, str):
        yield value
    for one in value.values() if isinstance(value, dict) else value if isinstance(value, list) else ():
        yield from texts_in(one)


def replace_texts(value, replace):
    """The value with every text t as replace(t)."""
    if isinstance(value, str):
        return replace(value)
    if isinstance(value, dict):
        return {key: replace_texts(one, replace) for key, one in value.items()}
    return [replace_texts(one, replace) for one in value] if isinstance(value, list) else value
