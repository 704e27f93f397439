# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter keys` and `clatter schema`."""
import json
import sys

from clatter.errors import BadArtefact
from . import files, rows, schema, words


def add_arguments(commands):
    one = commands.add_parser("keys", help="what may be in a TOML file: all, a table, a key, or a search by word")
    one.add_argument("what", nargs="*", metavar="word",
                     help=f"kind of file ({', '.join(files.KINDS)}), then a table or table.key; anything else is searched in names, meanings and defaults")
    one = commands.add_parser("schema", help="print the JSON schema of a TOML file, for editors and taplo")
    one.add_argument("kind", choices=files.KINDS, help="kind of file")


def note_missing(missing):
    for kind in missing:
        print(f"clatter: {kind}.toml: {files.KINDS[kind]} is missing or has no command keys, skipped", file=sys.stderr)


def found_at(table, path):
    """The key at a path of names, or None."""
    return next((key for at, key in files.walk(table) if at == path), None)


def matches(tables, word):
    """[(kind, path, key)] whose path, meaning or default has the word."""
    return [(kind, path, key) for kind, table in tables.items() for path, key in files.walk(table)
            if any(word.lower() in text.lower() for text in (path, key["meaning"], key.get("default", "")))]


def search(tables, word):
    """Lines of the keys with a word; BadArtefact with the nearest names where there are none."""
    found = matches(tables, word)
    if not found:
        names = sorted({part for table in tables.values() for path, _ in files.walk(table) for part in path.split(".")})
        raise BadArtefact(f"{word}: in no name, meaning or default of a key, did you mean {rows.nearest(word, names):.200}?")
    lines = []
    for kind, path, key in found:
        if f"{kind}.toml" not in lines:
            lines.append(f"{kind}.toml")
        lines.append(words.line_of(path, key))
    return lines


def keys_text(what):
    """What `clatter keys WHAT...` prints."""
    if len(what) > 2:
        raise BadArtefact(f"keys: found {len(what)} words, expected a kind of file and a table or key")
    kind = what[0].removesuffix(".toml") if what else None
    tables, missing = files.read([kind] if kind in files.KINDS else files.KINDS)
    note_missing(missing)
    if not what:
        return "\n".join(f"{one:<12}{table['meaning']}" for one, table in tables.items())
    if kind not in files.KINDS:
        if len(what) > 1:
            raise BadArtefact(f"keys: found {what[0]}, expected a kind of file: {', '.join(files.KINDS)}")
        return "\n".join(search(tables, what[0]))
    if kind in missing:
        return ""
    if len(what) == 1:
        return f"{tables[kind]['meaning']}\n{words.text_of(tables[kind])}"
    key = found_at(tables[kind], what[1])
    if key is None:
        return "\n".join(search(tables, what[1]))
    return words.line_of(what[1], key) if "table" not in key else \
        f"{words.heading_of(key, what[1])}  {key['meaning']}\n{words.text_of(key['table'], what[1])}"


def print_keys(options):
    text = keys_text(options.what)
    if text:
        print(text)


def print_schema(options):
    tables, missing = files.read([options.kind])
    if missing:
        raise BadArtefact(f"{options.kind}.toml: {files.KINDS[options.kind]} is missing or has no command keys")
    print(json.dumps(schema.of_file(tables[options.kind]), indent=1))
