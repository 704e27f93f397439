# SPDX-License-Identifier: GPL-3.0-or-later
"""Parameters of a sweep that are varied one at a time: the file of `clatter sweep --parameters`.

`clatter keys parameters` lists its keys. {} in a key's text is the value; a text that is {} alone has the value's type. Paths are as seen from the folder of the scenes.
"""
import dataclasses
import pathlib
import re
import tomllib

from clatter.artefact import BadArtefact
from .keys import rows
from .keys.study_keys import PARAMETERS

MOST = 1000  # values of a parameter
BASE = "base"


@dataclasses.dataclass
class Parameter:
    name: str
    values: list
    keys: dict       # {key: text with {}}
    unit: str = ""
    base: object = None
    field: str = ""

    def label(self):
        return f"{self.name} [{self.unit}]" if self.unit else self.name

    def scene(self, value):
        """Name of the files of a value."""
        return f"{slug(self.name).strip('-')}_{slug(str(value))}"


@dataclasses.dataclass
class Scene:
    name: str
    title: str
    keys: dict       # {key: its TOML}
    field: str = ""


def slug(text):
    return re.sub(r"[^\w.+-]+", "-", text)


def read(path):
    """[Parameter] of a file; BadArtefact names what is wrong."""
    path = pathlib.Path(path)
    if not path.is_file():
        raise BadArtefact(f"{path}: no such file, expected [[parameter]] tables")
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise BadArtefact(f"{path}: not TOML: {error}") from error
    rows.check(f"{path}", table, PARAMETERS)
    if not table.get("parameter"):
        raise BadArtefact(f"{path}: found no [[parameter]], expected at least one")
    found = [parameter(f"{path}: parameter[{number}]", entry) for number, entry in enumerate(table["parameter"])]
    names = [scene.name for scene in scenes(found)]
    for name in names:
        if names.count(name) > 1:
            raise BadArtefact(f"{path}: found two scenes {name}, expected other names or values")
    return found


def parameter(where, entry):
    values = entry["values"]
    if not 1 <= len(values) <= MOST or not all(isinstance(value, (int, float, str)) and not isinstance(value, bool) for value in values):
        raise BadArtefact(f"{where}.values: found {values!r:.80}, expected 1 to {MOST} numbers or texts")
    if not entry["keys"]:
        raise BadArtefact(f"{where}.keys: found none, expected keys of the scene with {{}} for the value")
    return Parameter(**entry)


def scenes(parameters):
    """The base, then each value of each parameter."""
    found = [Scene(BASE, "base", {})]
    for one in parameters:
        for value in one.values:
            keys = {key: text.replace("{}", str(value)) for key, text in one.keys.items()}
            found.append(Scene(one.scene(value), f"{one.name} {value} {one.unit}".rstrip(), keys, one.field.replace("{}", str(value))))
    return found
