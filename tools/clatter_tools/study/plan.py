# SPDX-License-Identifier: GPL-3.0-or-later
"""The study file: what it may say, and what is wrong with it."""
import dataclasses
import pathlib
import tomllib

from clatter.artefact import BadArtefact
from . import quantities
from ..keys import rows, study_keys
from ..parameters import slug

MOST_VALUES = 100


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
    rows.check(f"{path}", table, study_keys.STUDY)
    pipeline = path.parent / table.get("pipeline", ".")
    if not (pipeline / "Makefile").is_file():
        raise BadArtefact(f"{path}: pipeline: found no Makefile in {pipeline}, expected a folder with one")
    entries = {kind: table.get(kind, []) for kind in ("setting", "quantity", "effect")}
    for kind in (required, "quantity"):
        if not entries.get(kind, True):
            raise BadArtefact(f"{path}: found no [[{kind}]], expected at least one")
    check, reuse, cost = table.get("check", True), table.get("reuse", False), table.get("cost", "seconds")
    if reuse and cost != "seconds":
        raise BadArtefact(f"{path}: reuse = true needs cost = \"seconds\": of artefacts that are taken over no other cost is known")
    settings = [setting(f"{path}: setting[{k}]", one) for k, one in enumerate(entries["setting"])]
    wanted = [quantities.read(f"{path}: quantity[{k}]", one, path.parent) for k, one in enumerate(entries["quantity"])]
    effects = [effect(f"{path}: effect[{k}]", one) for k, one in enumerate(entries["effect"])]
    for kind, found in (("setting", settings), ("quantity", wanted), ("effect", effects)):
        names = [one.name for one in found]
        for name in names:
            if names.count(name) > 1:
                raise BadArtefact(f"{path}: found two tables [[{kind}]] named {name}, expected a name for each")
    slugs = [slug(one.name) for one in wanted]
    for one, own in zip(wanted, slugs):
        if slugs.count(own) > 1:
            raise BadArtefact(f"{path}: found two tables [[quantity]] whose pictures are {own}.png, as {one.name}: expected names that differ in letters and digits")
    keys = [key for one in settings for key in one.keys]
    for file, steps in keys:
        if keys.count((file, steps)) > 1:
            raise BadArtefact(f"{path}: found {file}:{'.'.join(steps)} twice, expected a key in one setting only")
    return Plan(path, pipeline, check, reuse, cost, settings, wanted, effects)


def setting(where, entry):
    keys = keys_of(where, entry)
    values = entry["values"]
    if not 1 <= len(values) <= MOST_VALUES:
        raise BadArtefact(f"{where}.values: found {values!r:.80}, expected 1 to {MOST_VALUES} values from coarse to fine")
    values = [value_of(f"{where}.values", one, len(keys)) for one in values]
    if len(set(values)) < len(values):
        raise BadArtefact(f"{where}.values: found a value twice, expected each once")
    base = value_of(f"{where}.base", entry["base"], len(keys)) if "base" in entry else None
    reference = entry.get("reference", "auto")
    sizes = entry.get("sizes")
    if sizes is None:
        sizes = step_sizes(values)
    elif len(sizes) != len(values) or any(a <= b for a, b in zip(sizes, sizes[1:])):
        raise BadArtefact(f"{where}.sizes: found {sizes!r:.80}, expected {len(values)} positive numbers that fall")
    if reference == "richardson" and (sizes is None or len(sizes) < 3):
        raise BadArtefact(f"{where}.reference: found richardson, expected at least three values with step sizes for it")
    return Setting(entry["name"], entry.get("unit", ""), keys, values, base, reference, sizes)


def effect(where, entry):
    """A table [[effect]]."""
    keys = keys_of(where, entry)
    if "off" not in entry and "on" not in entry:
        raise BadArtefact(f"{where}: give off, on or both: the value that switches the effect")
    return Effect(entry["name"], keys, *(switch_values(f"{where}.{to}", entry.get(to), len(keys)) for to in ("off", "on")))


def switch_values(where, value, count):
    """A value for each key of an effect, of any kind for a single key; None where there is none."""
    if value is None or count == 1:
        return None if value is None else [value]
    return list(value_of(where, value, count))


def keys_of(where, entry):
    """[(file, path of keys)] of `key` or `keys`."""
    texts = [entry["key"]] if "key" in entry else entry["keys"]
    if not texts:
        raise BadArtefact(f"{where}.keys: found none, expected texts such as slap.run.toml:accuracy.tolerance")
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


def value_of(where, value, count):
    """A value as a tuple with an entry for each key; one that is no list is for all of them."""
    entries = tuple(value) if isinstance(value, list) else (value,) * count
    if len(entries) != count or not all(rows.is_number(one) or isinstance(one, (str, bool)) for one in entries):
        raise BadArtefact(f"{where}: found {value!r:.80}, expected a number, text, true or false for each of the {count} keys")
    return entries


def step_sizes(values):
    """Of values with one number that changes: the numbers where they fall, their inverses where they rise; else None."""
    columns = [column for column in zip(*values) if len(set(column)) > 1]
    if not columns or any(column != columns[0] for column in columns) or not all(rows.is_number(one) and one > 0 for one in columns[0]):
        return None
    numbers = columns[0]
    if all(a > b for a, b in zip(numbers, numbers[1:])):
        return [float(one) for one in numbers]
    if all(a < b for a, b in zip(numbers, numbers[1:])):
        return [1.0 / one for one in numbers]
    return None
