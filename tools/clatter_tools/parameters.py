# SPDX-License-Identifier: GPL-3.0-or-later
"""Parameters of a sweep that are varied one at a time: the file of `clatter sweep --parameters`.

    [[parameter]]
    name = "pin offset"                # of the scenes (pin-offset_0.5) and in tables and pictures
    unit = "mm"                        # optional
    base = 0.0                         # value of the base scene, for tables and pictures; optional
    values = [-0.5, 0.5]               # numbers or texts, at most 1000
    keys = { "engine.pin_offset_mm" = "{}", "piston.rom" = "../piston_offset{}.rom.h5" }
    field = "speeds.field.toml"        # optional: settings of clatter-recover for these runs

{} in a key's text is the value; a text that is {} alone has the value's type. Paths are as seen from the folder of the scenes.
"""
import dataclasses
import pathlib
import re
import tomllib

from .artefact import BadArtefact

KEYS = {"name", "unit", "base", "values", "keys", "field"}
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
    entries = table.get("parameter")
    if set(table) != {"parameter"} or not isinstance(entries, list) or not all(isinstance(one, dict) for one in entries):
        raise BadArtefact(f"{path}: found {', '.join(table) or 'nothing'}, expected [[parameter]] tables only")
    found = [parameter(path, number, entry) for number, entry in enumerate(entries)]
    names = [scene.name for scene in scenes(found)]
    for name in names:
        if names.count(name) > 1:
            raise BadArtefact(f"{path}: found two scenes {name}, expected other names or values")
    return found


def parameter(path, number, entry):
    where = f"{path}: parameter[{number}]"
    for key in entry:
        if key not in KEYS:
            raise BadArtefact(f"{where}.{key}: unknown key, expected one of {', '.join(sorted(KEYS))}")
    for key, kind in (("name", str), ("values", list), ("keys", dict), ("unit", str), ("field", str)):
        if key in entry and (not isinstance(entry[key], kind) or not entry[key]):
            raise BadArtefact(f"{where}.{key}: found {entry[key]!r}, expected a {kind.__name__} that is not empty")
    for key in ("name", "values", "keys"):
        if key not in entry:
            raise BadArtefact(f"{where}.{key}: not found, expected it")
    values = entry["values"]
    if len(values) > MOST or not all(isinstance(value, (int, float, str)) and not isinstance(value, bool) for value in values):
        raise BadArtefact(f"{where}.values: found {values!r:.80}, expected at most {MOST} numbers or texts")
    for key, value in entry["keys"].items():
        if not isinstance(value, str):
            raise BadArtefact(f"{where}.keys.{key}: found {value!r}, expected a text with {{}} for the value")
    return Parameter(**entry)


def scenes(parameters):
    """The base, then each value of each parameter."""
    found = [Scene(BASE, "base", {})]
    for one in parameters:
        for value in one.values:
            keys = {key: text.replace("{}", str(value)) for key, text in one.keys.items()}
            found.append(Scene(one.scene(value), f"{one.name} {value} {one.unit}".rstrip(), keys, one.field.replace("{}", str(value))))
    return found
