# SPDX-License-Identifier: GPL-3.0-or-later
"""JSON schemas (draft-07) of TOML files, for editors and for `taplo check`.

A file that may have `base = "..."` takes what it lacks from there: nothing is required of it, and of a list of tables a single one may be changed by its
name.
"""
import json
import pathlib
import tomllib

DRAFT = "http://json-schema.org/draft-07/schema#"


def limits(key):
    return {name: key[own] for own, name in (("min", "minimum"), ("above", "exclusiveMinimum"), ("max", "maximum")) if own in key}


def of_type(kind, key, strict):
    """The schema of a value of that type."""
    if kind in ("number", "integer"):
        return {"type": kind, **limits(key)}
    if kind == "numbers":
        count = {"minItems": key["count"], "maxItems": key["count"]} if "count" in key else {}
        return {"type": "array", "items": {"type": "number", **limits(key)}, **count}
    if kind == "texts":
        return {"type": "array", "items": {"enum": key["choices"]} if "choices" in key else {"type": "string"}}
    if kind == "choice":
        return {"enum": key["choices"]}
    if kind == "table":
        return of_table(key["table"], strict)
    if kind == "tables":
        one = of_table(key["table"], strict)
        several = {"type": "array", "items": one}
        return several if strict else {"anyOf": [several, {"type": "object", "additionalProperties": one}]}
    if kind == "named tables":
        return {"type": "object", "additionalProperties": of_table(key["table"], strict)}
    if kind == "numbers by name":
        return {"type": "object", "additionalProperties": {"type": "number", **limits(key)}}
    if kind == "texts by name":
        return {"type": "object", "additionalProperties": {"type": "string"}}
    return {"flag": {"type": "boolean"}, "text": {"type": "string"}, "path": {"type": "string"}, "empty": {"const": ""}, "list": {"type": "array"}}[kind]


def of_key(key, strict):
    kinds = key.get("types", [] if key["type"] == "either" else [key["type"]])
    found = of_type(kinds[0], key, strict) if len(kinds) == 1 else {"anyOf": [of_type(kind, key, strict) for kind in kinds]} if kinds else {}
    unit = f" [{key['unit']}]" if "unit" in key else ""
    default = {"default": tomllib.loads(f"v = {key['default']}")["v"]} if "default" in key else {}
    return {"description": key["meaning"] + unit, **found, **default}


def of_rule(name, rule, defaults):
    """A schema that a table fulfils only if it keeps the rule; None for one that no schema can say."""
    if rule["kind"] not in ("excludes", "needs", "required_with"):
        return None
    other = rule["other"]
    if "values" in rule:
        values = [{"true": True, "false": False}.get(value, value) for value in rule["values"]]
        by_default = defaults.get(other) in values
        holds = {"properties": {other: {"enum": values}}, **({} if by_default else {"required": [other]})}
    else:
        holds = {"required": [other]}
    given = {"required": [name]}
    if rule["kind"] == "excludes":
        return {"not": {"allOf": [given, holds]}}
    return {"if": given, "then": holds} if rule["kind"] == "needs" else {"if": holds, "then": given}


def of_table(table, strict=True):
    """The schema of a table; not strict: what it lacks may come from elsewhere."""
    strict = strict and table.get("complete", True)
    found = {"description": table["meaning"], "type": "object", "additionalProperties": False,
             "properties": {key["name"]: of_key(key, strict) for key in table["keys"]}}
    if not strict:
        return found
    defaults = {name: one["default"] for name, one in found["properties"].items() if "default" in one}
    rules = [kept for key in table["keys"] for rule in key.get("rules", []) if (kept := of_rule(key["name"], rule, defaults))]
    rules += [{"oneOf": [{"required": [name]} for name in group]} for group in table.get("one_of", [])]
    required = [key["name"] for key in table["keys"] if key.get("required")]
    return {**found, **({"required": required} if required else {}), **({"allOf": rules} if rules else {})}


def of_file(table):
    """The schema of a file."""
    strict = of_table(table)
    if all(key["name"] != "base" for key in table["keys"]):
        return {"$schema": DRAFT, "title": table["name"], **strict}
    return {"$schema": DRAFT, "title": table["name"], **of_table(table, strict=False), "if": {"not": {"required": ["base"]}}, "then": strict}


def write(tables, folder):
    """KIND.schema.json of each kind; returns the paths."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    paths = [folder / f"{kind}.schema.json" for kind in tables]
    for path, table in zip(paths, tables.values()):
        path.write_text(json.dumps(of_file(table), indent=1) + "\n", encoding="utf-8")
    return paths
