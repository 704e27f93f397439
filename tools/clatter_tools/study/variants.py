# SPDX-License-Identifier: GPL-3.0-or-later
"""The variants of a study: which value each setting has, and the TOML files that say so."""
import copy
import dataclasses
import re

from clatter.artefact import BadArtefact
from . import toml_text
from .plan import step_sizes
from .. import scene_keys
from ..keys import files

BASE, REFINED = "base", "all refined"


@dataclasses.dataclass
class Variant:
    """values: of each setting, in their order; setting: number of the one that differs from the base, None in the base and where everything
    is refined."""
    name: str
    values: tuple
    setting: int = None

    @property
    def folder(self):
        return re.sub(r"[^\w.+=-]+", "-", self.name).strip("-.")


def base_values(plan, pipeline):
    """The value of each setting in the folder as it is. A setting whose values have step sizes gets it among its values."""
    found = tuple(base_of(plan, pipeline, one) for one in plan.settings)
    for setting, value in zip(plan.settings, found):
        insert(plan, setting, value)
    return found


def insert(plan, setting, value):
    """A value at its place between the values of a setting; BadArtefact where it is finer than the finest."""
    if value in setting.values or not setting.sizes or setting.sizes != step_sizes(setting.values):
        return
    for k in range(len(setting.values) + 1):
        values = setting.values[:k] + [value] + setting.values[k:]
        if step_sizes(values):
            if k == len(setting.values):
                raise BadArtefact(f"{plan.path}: {setting.name}: found {setting.label(value)} in the base, finer than the finest value {setting.label(values[-2])}, "
                                  "expected finer values than the base's")
            setting.values, setting.sizes = values, step_sizes(values)
            return


def base_of(plan, pipeline, setting):
    """From the files, or from the study file where they do not have the key."""
    found = []
    for number, (file, path) in enumerate(setting.keys):
        where = f"{plan.path}: {setting.name}: {file}"
        if not (pipeline.folder / file).is_file():
            raise BadArtefact(f"{where}: no such file in {pipeline.folder}")
        value = pipeline.base_value(file, path)
        if isinstance(value, (dict, list)):
            raise BadArtefact(f"{where}: {'.'.join(path)}: found a table or list, expected a number, text, true or false")
        if value is None and setting.base is None:
            raise BadArtefact(f"{where}: found no {'.'.join(path)}, expected it there, or its default as base of the setting")
        if value is None:
            check_new(where, pipeline.folder / file, path, setting, number)
        if value is not None and setting.base is not None and value != setting.base[number]:
            raise BadArtefact(f"{where}: {'.'.join(path)}: found {value}, expected {setting.base[number]} as base of the setting says")
        found.append(setting.base[number] if value is None else value)
    return tuple(found)


def check_new(where, file, path, setting, number):
    """BadArtefact for a key that is not in a file and that its program does not know, or does not know with the setting's values."""
    kind = file.name.removesuffix(".toml").rpartition(".")[2]
    table = files.read([kind])[0].get(kind) if kind in files.KINDS else None
    for value in (setting.base, *setting.values):
        try:
            scene_keys.check(scene_keys.scene(file), ".".join(map(toml_text.key_text, path)), value[number], table)
        except BadArtefact as error:
            raise BadArtefact(f"{where}: {error}") from error


def variants_of(plan, base):
    """The base, one setting at a time, and that with all of them at their finest; each combination of values once."""
    found = [Variant(BASE, base)]
    for number, setting in enumerate(plan.settings):
        for value in setting.values:
            values = base[:number] + (value,) + base[number + 1:]
            if values != base:
                found.append(Variant(f"{setting.name} {setting.label(value)}", values, number))
    refined = tuple(setting.values[-1] for setting in plan.settings)
    if plan.check and all(refined != one.values for one in found):
        found.append(Variant(REFINED, refined))
    for one in found:
        if sum(other.folder == one.folder for other in found) > 1:
            raise BadArtefact(f"{plan.path}: found two variants with the name {one.folder}, expected other names or values")
    return found


def changed_tables(plan, pipeline, base, variant, more=()):
    """{file: its tables} of the TOML files in which a variant differs from the base; `more`: [((file, path of keys), value)] of other changes."""
    found = {}
    for (file, path), value in more:
        toml_text.set_value(f"{plan.path}: {file}", found.setdefault(file, copy.deepcopy(pipeline.table(file))), path, value)
    for setting, value, before in zip(plan.settings, variant.values, base):
        for (file, path), own, old in zip(setting.keys, value, before):
            if own != old:
                tables = found.setdefault(file, copy.deepcopy(pipeline.table(file)))
                toml_text.set_value(f"{plan.path}: {setting.name}: {file}", tables, path, own)
    return found
