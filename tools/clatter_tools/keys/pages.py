# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages docs/keys/*.md, one for each file of a stage: python3 -m clatter_tools.keys pages docs/keys."""
import json
import pathlib

from . import words
from ..wrapped_lines import wrapped

# page: its title, and the kinds of files on it.
PAGES = {
    "mesh": ("Keys of mesh.toml", ["mesh"]),
    "fe": ("Keys of fe.toml", ["fe"]),
    "modes": ("Keys of modes.toml", ["modes"]),
    "rom": ("Keys of rom.toml", ["rom"]),
    "run": ("Keys of run.toml", ["run"]),
    "field": ("Keys of field.toml", ["field"]),
    "sound": ("Keys of sound.toml", ["sound"]),
    "study": ("Keys of studies", ["study", "parameters"]),
}


def cell(text):
    return text.replace("|", "\\|")


def row_of(key):
    default = "required" if key.get("required") else f"`{cell(key['default'])}`" if "default" in key else ""
    rules = "".join(f"; {rule}" for rule in words.rules_of(key))
    return f"| `{key['name']}` | {cell(key['meaning'] + words.unit_of(key) + rules)} | {cell(words.values_of(key))} | {default} |"


def section(table, path="", seen=None):
    """Lines of a table and of those below; one that is `seen` with the same keys, {keys: heading}, is named instead."""
    seen = {} if seen is None else seen
    prefix = f"{path}." if path else ""
    plain = [key for key in table["keys"] if "table" not in key]
    lines = ["| key | meaning | values | default |", "|---|---|---|---|", *map(row_of, plain), ""] if plain else []
    for group in table.get("one_of", []):
        lines += [f"Exactly one of {', '.join(f'`{name}`' for name in group)} is given.", ""]
    for key in table["keys"]:
        if "table" in key:
            inner = prefix + key["name"]
            heading, keys = words.heading_of(key, inner), json.dumps(key["table"]["keys"])
            lines += [f"## `{heading}`", "", sentence("; ".join([key["meaning"], *words.rules_of(key)])), ""]
            lines += [f"Its keys are those of `{seen[keys]}`.", ""] if keys in seen else section(key["table"], inner, seen)
            seen.setdefault(keys, heading)
    return lines


def sentence(text):
    return text[0].upper() + text[1:] + "."


def page(title, tables):
    """The text of a page."""
    lines = [f"# {title}", "", "Written by `make keys-pages` from the tables that the programs read by; `clatter keys` prints and searches them. "
             "The unit is in brackets after the meaning. Paths are relative to the file.", ""]
    for table in tables:
        lines += ([f"# `{table['name']}`", ""] if len(tables) > 1 else []) + [sentence(table["meaning"]), "", *section(table)]
    return "\n".join(wrapped(lines)).rstrip() + "\n"


def write(tables, folder):
    """Writes the pages whose files are all described; returns their paths."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name, (title, kinds) in PAGES.items():
        if all(kind in tables for kind in kinds):
            written.append(folder / f"{name}.md")
            written[-1].write_text(page(title, [tables[kind] for kind in kinds]), encoding="utf-8")
    return written
