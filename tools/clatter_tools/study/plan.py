# SPDX-License-Identifier: GPL-3.0-or-later
"""The study file: what it may say, and what is wrong with it."""
import dataclasses
import pathlib
import tomllib

from ..artefact import BadArtefact
from . import quantities

MOST_VALUES = 100
REFERENCES = ("auto", "finest", "richardson")
COSTS = ("seconds", "processor")
TOP = {"pipeline", "check", "reuse", "cost", "setting", "quantity", "effect"}
EFFECT = {"name", "key", "keys", "off", "on"}
SETTING = {"name", "unit", "key", "keys", "values", "base", "reference", "sizes"}


@dataclasses.dataclass
class Setting:
    """keys: [(file, path of keys)]; values: tuples with an entry for each key, from coarse to fine; sizes: of their steps, or None."""
    name: str
    unit: str
    keys: list
    values: list
    base: tuple
    reference: str
    sizes: list

    def label(self, value):
        """"10 mm", "10 x 64"."""
        return f"{' x '.join(shown(one) for one in value)} {self.unit}".strip()


@dataclasses.dataclass
class Effect:
    """keys: [(file, path of keys)]; off, on: lists of their values; None: it cannot be switched so."""
    name: str
    keys: list
    off: object
    on: object


@dataclasses.dataclass
class Plan:
    path: pathlib.Path
    pipeline: pathlib.Path
    check: bool
    reuse: bool
    cost: str
    settings: list
    quantities: list
    effects: list

    @property
    def output(self):
        """The folder of what the study makes: study/ for study.toml."""
        return self.path.parent / self.path.name.removesuffix(".toml")


def shown(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


def read_toml(path):
    """The tables of a TOML file; BadArtefact when it is none."""
    path = pathlib.Path(path)
    if not path.is_file():
        raise BadArtefact(f"{path}: no such file, expected a study with [[setting]] and [[quantity]]")
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise BadArtefact(f"{path}: not TOML: {error}") from error


def read(path, required="setting"):
    """The Plan of a study file; `required`: "setting" where it must have settings, else it may be without."""
    path = pathlib.Path(path)
    if path.suffix != ".toml":
        raise BadArtefact(f"{path}: found this name, expected one that ends in .toml")
    table = read_toml(path)
    check_keys(f"{path}", table, TOP)
    if not isinstance(table.get("pipeline", "."), str):
        raise BadArtefact(f"{path}: pipeline: found {table['pipeline']!r}, expected a folder as text")
    pipeline = path.parent / table.get("pipeline", ".")
    if not (pipeline / "Makefile").is_file():
        raise BadArtefact(f"{path}: pipeline: found no Makefile in {pipeline}, expected a folder with one")
    entries = {}
    for kind in ("setting", "quantity", "effect"):
        entries[kind] = table.get(kind, [])
        if not isinstance(entries[kind], list) or not all(isinstance(one, dict) for one in entries[kind]) or \
                (not entries[kind] and kind in (required, "quantity")):
            raise BadArtefact(f"{path}: found no [[{kind}]], expected at least one")
    cost = table.get("cost", COSTS[0])
    switches = {"check": table.get("check", True), "reuse": table.get("reuse", False)}
    for key, value in switches.items():
        if not isinstance(value, bool):
            raise BadArtefact(f"{path}: {key}: found {value!r}, expected true or false")
    if cost not in COSTS:
        raise BadArtefact(f"{path}: cost: found {cost!r}, expected {' or '.join(COSTS)}")
    if switches["reuse"] and cost != COSTS[0]:
        raise BadArtefact(f"{path}: reuse: found true beside cost = {cost!r}, expected cost = {COSTS[0]!r}: of artefacts that are taken over no other is known")
    settings = [setting(f"{path}: setting[{k}]", one) for k, one in enumerate(entries["setting"])]
    wanted = [quantities.read(f"{path}: quantity[{k}]", one, path.parent) for k, one in enumerate(entries["quantity"])]
    effects = [effect(f"{path}: effect[{k}]", one) for k, one in enumerate(entries["effect"])]
    for kind, found in (("setting", settings), ("quantity", wanted), ("effect", effects)):
        names = [one.name for one in found]
        for name in names:
            if names.count(name) > 1:
                raise BadArtefact(f"{path}: found two tables [[{kind}]] named {name}, expected a name for each")
    keys = [key for one in settings for key in one.keys]
    for file, steps in keys:
        if keys.count((file, steps)) > 1:
            raise BadArtefact(f"{path}: found {file}:{'.'.join(steps)} twice, expected a key in one setting only")
    return Plan(path, pipeline, switches["check"], switches["reuse"], cost, settings, wanted, effects)


def check_keys(where, table, known):
    for key in table:
        if key not in known:
            raise BadArtefact(f"{where}: {key}: unknown key, expected one of {', '.join(sorted(known))}")


def text_of(where, entry, key, default=None):
    """A text that is not empty."""
    value = entry.get(key, default)
    if not isinstance(value, str) or (not value and default is None):
        raise BadArtefact(f"{where}.{key}: found {value!r}, expected a text")
    return value


def setting(where, entry):
    check_keys(where, entry, SETTING)
    name, unit = text_of(where, entry, "name"), text_of(where, entry, "unit", "")
    keys = keys_of(where, entry)
    values = entry.get("values")
    if not isinstance(values, list) or not 1 <= len(values) <= MOST_VALUES:
        raise BadArtefact(f"{where}.values: found {values!r:.80}, expected 1 to {MOST_VALUES} values from coarse to fine")
    values = [value_of(f"{where}.values", one, len(keys)) for one in values]
    if len(set(values)) < len(values):
        raise BadArtefact(f"{where}.values: found a value twice, expected each once")
    base = value_of(f"{where}.base", entry["base"], len(keys)) if "base" in entry else None
    reference = entry.get("reference", REFERENCES[0])
    if reference not in REFERENCES:
        raise BadArtefact(f"{where}.reference: found {reference!r}, expected {', '.join(REFERENCES)}")
    sizes = entry.get("sizes")
    if sizes is None:
        sizes = step_sizes(values)
    elif not isinstance(sizes, list) or len(sizes) != len(values) or not all(is_number(one) and one > 0 for one in sizes) \
            or any(a <= b for a, b in zip(sizes, sizes[1:])):
        raise BadArtefact(f"{where}.sizes: found {sizes!r:.80}, expected {len(values)} positive numbers that fall")
    if reference == "richardson" and (sizes is None or len(sizes) < 3):
        raise BadArtefact(f"{where}.reference: found richardson, expected at least three values with step sizes for it")
    return Setting(name, unit, keys, values, base, reference, sizes)


def effect(where, entry):
    """A table [[effect]]."""
    check_keys(where, entry, EFFECT)
    keys = keys_of(where, entry)
    if "off" not in entry and "on" not in entry:
        raise BadArtefact(f"{where}: found neither off nor on, expected the value that switches the effect off, on, or both")
    return Effect(text_of(where, entry, "name"), keys, *(switch_values(f"{where}.{to}", entry.get(to), len(keys)) for to in ("off", "on")))


def switch_values(where, value, count):
    """A value for each key of an effect, of any kind for a single key; None where there is none."""
    if value is None or count == 1:
        return None if value is None else [value]
    return list(value_of(where, value, count))


def keys_of(where, entry):
    """[(file, path of keys)] of `key` or `keys`."""
    if ("key" in entry) == ("keys" in entry):
        raise BadArtefact(f"{where}: found {'both' if 'key' in entry else 'neither'} key and keys, expected one of them")
    texts = [entry["key"]] if "key" in entry else entry["keys"]
    if not isinstance(texts, list) or not texts or not all(isinstance(one, str) for one in texts):
        raise BadArtefact(f"{where}.keys: found {texts!r}, expected texts such as slap.run.toml:accuracy.tolerance")
    return [key_of(where, one) for one in texts]


def key_of(where, text):
    """(file, path of keys) of file.toml:a.b.c; a key in quotes may have points."""
    file, colon, path = text.partition(":")
    try:
        steps = steps_of(tomllib.loads(f"{path} = 0")) if colon else []
    except tomllib.TOMLDecodeError:
        steps = []
    if not file.endswith(".toml") or "/" in file or not steps:
        raise BadArtefact(f"{where}: found key {text}, expected a file of the pipeline's folder and a path of keys, "
                          "as slap.run.toml:accuracy.tolerance")
    return file, tuple(steps)


def steps_of(table):
    (key, below), = table.items()
    return [key, *(steps_of(below) if isinstance(below, dict) else [])]


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < float("inf")


def value_of(where, value, count):
    """A value as a tuple with an entry for each key; one that is no list is for all of them."""
    entries = tuple(value) if isinstance(value, list) else (value,) * count
    if len(entries) != count or not all(is_number(one) or isinstance(one, (str, bool)) for one in entries):
        raise BadArtefact(f"{where}: found {value!r:.80}, expected a number, text, true or false for each of the {count} keys")
    return entries


def step_sizes(values):
    """Of values with one number that changes: the numbers where they fall, their inverses where they rise; else None."""
    columns = [column for column in zip(*values) if len(set(column)) > 1]
    if not columns or any(column != columns[0] for column in columns) or not all(is_number(one) and one > 0 for one in columns[0]):
        return None
    numbers = columns[0]
    if all(a > b for a, b in zip(numbers, numbers[1:])):
        return [float(one) for one in numbers]
    if all(a < b for a, b in zip(numbers, numbers[1:])):
        return [1.0 / one for one in numbers]
    return None
