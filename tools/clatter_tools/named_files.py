# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that a TOML file names: what its artefact depends on, known before a stage has run."""
import os
import pathlib
import tomllib

MOST_BASES = 100  # in a chain of scenes, of which a longer one is a circle


def merged(upper, lower):
    """A table over its base: keys of tables one by one, everything else as a whole."""
    found = dict(lower)
    for key, value in upper.items():
        both = isinstance(value, dict) and isinstance(lower.get(key), dict)
        found[key] = merged(value, lower[key]) if both else value
    return found


def placed(value, folder):
    """The value with each text as (text, folder of its file)."""
    if isinstance(value, dict):
        return {key: placed(one, folder) for key, one in value.items()}
    if isinstance(value, list):
        return [placed(one, folder) for one in value]
    return (value, folder) if isinstance(value, str) else None


def texts(value):
    if isinstance(value, tuple):
        return [value]
    parts = value.values() if isinstance(value, dict) else value if isinstance(value, list) else []
    return [text for part in parts for text in texts(part)]


def with_bases(path):
    """(the table of a TOML file over those of its bases, the paths of the bases)."""
    table, bases = {}, []
    while path is not None:
        with open(path, "rb") as stream:
            own = tomllib.load(stream)
        base = own.pop("base", None)
        table = merged(table, placed(own, path.parent))
        path = path.parent / base if isinstance(base, str) else None
        if path is not None:
            bases.append(path)
        if len(bases) > MOST_BASES:
            raise ValueError(f"{bases[0]}: found a base that is its own base")
    return table, bases


def of(path):
    """Paths of the files that a TOML file names, relative to the current folder as its own path is: its bases, artefacts (.h5, whether
    they exist or not), and every other text that is the path of a file."""
    path = pathlib.Path(path)
    if not path.is_file():
        return []
    table, bases = with_bases(path)
    named = [folder / text for text, folder in texts(table) if text.endswith(".h5") or ("." in text and (folder / text).is_file())]
    return sorted({os.path.normpath(one) for one in [*bases, *named]})


def of_dependency_file(path):
    """Paths in a dependency file that a stage wrote, as far as they still exist: each has a line of its own after the first."""
    path = pathlib.Path(path)
    lines = path.read_text(encoding="utf-8").splitlines()[1:] if path.is_file() else []
    return [name for name in (line.removesuffix(":") for line in lines) if os.path.isfile(name)]
