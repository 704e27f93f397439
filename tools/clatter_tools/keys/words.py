# SPDX-License-Identifier: GPL-3.0-or-later
"""A key in words, for the terminal and for pages."""


def range_of(key):
    """" above 0", " from 2 to 400", " of at least 1"."""
    text = f" above {key['above']:g}" if "above" in key else ""
    if "min" in key:
        text = f" from {key['min']:g}" if "max" in key else f" of at least {key['min']:g}"
    if "max" in key:
        text += f" to {key['max']:g}" if text else f" of at most {key['max']:g}"
    return text


def values_of(key):
    """What may be written: "number above 0", "list of 3 numbers", "true or false"."""
    kind, choices = key["type"], " | ".join(f'"{one}"' for one in key.get("choices", []))
    if kind == "choice":
        return choices
    if kind == "texts":
        return f"list of {choices or 'texts'}"
    if kind == "numbers":
        each = range_of(key)
        count, ascending = f"{key['count']} " if "count" in key else "", "ascending " if key.get("ascending") else ""
        return f"list of {count}{ascending}numbers{', each' + each if each else ''}"
    if kind == "either":
        return key["shape"] + range_of(key)
    return {"integer": "whole number", "flag": "true or false", "path": "path of a file"}.get(kind, kind) + range_of(key)


def rules_of(key):
    """["not with restitution (an impact has no stiffness)", ...]."""
    words = {"excludes": "not with", "needs": "only with", "required_with": "required with", "as_many_as": "as many as"}
    return [f"{words[rule['kind']]} {rule['other']}{' = ' + ' or '.join(rule['values']) if 'values' in rule else ''}"
            f"{' (' + rule['reason'] + ')' if 'reason' in rule else ''}" for rule in key.get("rules", [])]


def unit_of(key):
    return f" [{key['unit']}]" if "unit" in key else ""


def heading_of(key, path):
    """How the table of a key is written: [grid], [[window]], [material.NAME]."""
    return {"tables": f"[[{path}]]", "named tables": f"[{path}.NAME]"}.get(key["type"], f"[{path}]")


def line_of(path, key):
    """Two lines for the terminal."""
    facts = ([values_of(key)] if "table" not in key else [heading_of(key, path)]) + (["required"] if key.get("required") else []) + \
        ([f"default {key['default']}"] if key.get("default", "[]") != "[]" else []) + rules_of(key)
    return f"  {path:<26} {key['meaning']}{unit_of(key)}\n{'':29}{', '.join(facts)}"


def text_of(table, path=""):
    """All keys of a table, then those of the tables below."""
    prefix = f"{path}." if path else ""
    lines = [line_of(prefix + key["name"], key) for key in table["keys"] if "table" not in key]
    lines += [f"  exactly one of {', '.join(group)}" for group in table.get("one_of", [])]
    for key in table["keys"]:
        if "table" in key:
            inner = prefix + key["name"]
            lines += ["", f"{heading_of(key, inner)}  {key['meaning']}", text_of(key["table"], inner)]
    return "\n".join(lines)
