# SPDX-License-Identifier: GPL-3.0-or-later
"""JSON schemas (draft-07) of TOML files, for editors and for `taplo check`.

Tables within a file are under `definitions`, each once. A file that may have `base = "..."` takes what it lacks from there: nothing is required of it,
and of a list of tables a single one may be changed by its name.
"""
import dataclasses
import itertools
import json
import pathlib
import tomllib

DRAFT = "http://json-schema.org/draft-07/schema#"


def limits(key):
    return {name: key[own] for own, name in (("min", "minimum"), ("above", "exclusiveMinimum"), ("max", "maximum")) if own in key}


@dataclasses.dataclass
class Shared:
    """The tables within a file, each once under a name of its own."""
    strict: bool  # tables are complete; not so where they may have a base
    definitions: dict = dataclasses.field(default_factory=dict)

    def table(self, key):
        """A reference to the schema of the table of a key."""
        own = dataclasses.replace(self, strict=self.strict and key["table"].get("complete", True))
        return self.refer(key["name"], of_table(key["table"], own))

    def refer(self, name, schema):
        """A reference to a schema, which is added unless it is there."""
        names = (f"{name}_{number}" if number > 1 else name for number in itertools.count(1))
        found = next(one for one in names if self.definitions.setdefault(one, schema) == schema)
        return {"$ref": f"#/definitions/{found}"}


def of_type(kind, key, shared):
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
        return shared.table(key)
    if kind == "tables":
        one = shared.table(key)
        several = {"type": "array", "items": one}
        return several if shared.strict else {"anyOf": [several, {"type": "object", "additionalProperties": one}]}
    if kind == "named tables":
        return {"type": "object", "additionalProperties": shared.table(key)}
    if kind == "numbers by name":
        return {"type": "object", "additionalProperties": {"type": "number", **limits(key)}}
    if kind == "texts by name":
        return {"type": "object", "additionalProperties": {"type": "string"}}
    return {"flag": {"type": "boolean"}, "text": {"type": "string"}, "path": {"type": "string"}, "empty": {"const": ""}, "list": {"type": "array"}}[kind]


def of_key(key, shared):
    kinds = key.get("types", [] if key["type"] == "either" else [key["type"]])
    found = of_type(kinds[0], key, shared) if len(kinds) == 1 else {"anyOf": [of_type(kind, key, shared) for kind in kinds]} if kinds else {}
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


def rules_of(table, properties):
    """What a table must have, and what it must not have together; `properties` are the schemas of its keys."""
    defaults = {name: one["default"] for name, one in properties.items() if "default" in one}
    rules = [kept for key in table["keys"] for rule in key.get("rules", []) if (kept := of_rule(key["name"], rule, defaults))]
    rules += [{"oneOf": [{"required": [name]} for name in group]} for group in table.get("one_of", [])]
    required = [key["name"] for key in table["keys"] if key.get("required")]
    return {**({"required": required} if required else {}), **({"allOf": rules} if rules else {})}


def of_table(table, shared):
    """The schema of a table; where it is not strict, what the table lacks may come from elsewhere."""
    found = {"description": table["meaning"], "type": "object", "additionalProperties": False,
             "properties": {key["name"]: of_key(key, shared) for key in table["keys"]}}
    return {**found, **rules_of(table, found["properties"])} if shared.strict else found


def completed(table, shared):
    """What the strict schema of a table asks for beyond the other one."""
    if not table.get("complete", True):
        return {}
    below = {}
    for key in table["keys"]:
        inner = completed(key["table"], shared) if "table" in key else {}
        one = shared.refer(f"{key['name']}_complete", inner) if inner else {}
        if key["type"] == "tables":
            below[key["name"]] = {"type": "array", "items": one}
        elif inner:
            below[key["name"]] = {"additionalProperties": one} if key["type"] == "named tables" else one
    rules = rules_of(table, {key["name"]: of_key(key, shared) for key in table["keys"]})
    return {**({"properties": below} if below else {}), **rules}


def of_file(table):
    """The schema of a file."""
    has_base = any(key["name"] == "base" for key in table["keys"])
    shared = Shared(strict=not has_base)
    found = {"$schema": DRAFT, "title": table["name"], **of_table(table, shared)}
    if has_base:
        found |= {"if": {"not": {"required": ["base"]}}, "then": completed(table, shared)}
    return {**found, "definitions": shared.definitions}


def write(tables, folder):
    """KIND.schema.json of each kind; returns the paths."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    paths = [folder / f"{kind}.schema.json" for kind in tables]
    for path, table in zip(paths, tables.values()):
        path.write_text(json.dumps(of_file(table), indent=1) + "\n", encoding="utf-8")
    return paths
