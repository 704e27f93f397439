# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter sweep`: scenes that change keys of another one, one for each combination of values or one parameter at a time, and their make rules."""
import decimal
import itertools
import math
import os
import pathlib
import re
import tomllib

from clatter.artefact import BadArtefact, CannotWrite, stem
from . import parameters, scene_keys
from .keys.schema_line import schema_line
from .whole_file import whole_file

MOST = 100_000  # scenes
KEYS = re.compile(r"""((?:[\w-]+|"[^"]*")(?:\.(?:[\w-]+|"[^"]*"))*)=(.+)""", re.S)

FRAGMENT = """# Written by `clatter sweep`: the runs and fields of {folder}/, for `include` after clatter.mk.
{name}_names := {names}
{name}_runs := $({name}_names:%={folder}/%.run.h5)
{name}_fields := $({name}_names:%={folder}/%.field.h5)
"""
DEPENDENCIES = "-include $(wildcard {folder}/*.h5.d)\n"
FIELDS = """{targets}: {folder}/%.field.h5: {folder}/%.run.h5 {field} $(clatter_recover)
	$(call clatter_run,recover) $< -c {field} -o $@ --depfile $@.d $(CLATTER_FLAGS)
"""


def add_arguments(command):
    """Declares the arguments of `clatter sweep`."""
    command.add_argument("base", metavar="base.run.toml", help="the scene that all others change")
    command.add_argument("keys", nargs="*", metavar="key=values",
                         help="1000:3000:50 (first, last, step), a,b,c, or one value; several keys give all combinations. "
                              "Entries of tables go by their name: drive.crank.speed_rpm=1000:6000:200")
    command.add_argument("--parameters", metavar="file.toml", help="parameters that are varied one at a time instead, after a scene of "
                         "the base itself (tools/clatter_tools/parameters.py); keys then have one value each, in all scenes")
    command.add_argument("-o", "--output", metavar="folder", help="of the scenes; default: the base's name with _sweep")
    command.add_argument("--field", metavar="file.toml", help="settings of clatter-recover for all runs; default: those that clatter.mk finds")


def number_range(text):
    """The numbers of "first:last:step", as they would be typed; None if it is no range."""
    try:
        first, last, step = (decimal.Decimal(part) for part in text.split(":"))
        if not all(part.is_finite() for part in (first, last, step)):
            return None
    except (ValueError, decimal.InvalidOperation):
        return None
    if step == 0 or (last - first) / step < 0:
        raise BadArtefact(f"{text}: the step does not lead from {first} to {last}")
    count = int((last - first) / step) + 1
    if count > MOST:
        raise BadArtefact(f"{text}: found {count} values, expected at most {MOST}")
    return [f"{first + k * step:f}" for k in range(count)]


def literal(text):
    """A value as TOML: what is no number, boolean, array, table or string in quotes becomes a string."""
    try:
        tomllib.loads(f"v = {text}")
        return text
    except tomllib.TOMLDecodeError:
        return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def parse(argument):
    """(key, texts of its values) of key=values."""
    found = KEYS.fullmatch(argument)
    if not found:
        raise BadArtefact(f"{argument}: expected key=values, as engine.speed_rpm=1000:3000:50")
    key, text = found.groups()
    values = number_range(text) or ([text] if text[0] in "[{\"'" else text.split(","))
    if len({same(value) for value in values}) < len(values) or "" in values:
        raise BadArtefact(f"{argument}: found a value twice or an empty one")
    if text[0] in "[{\"'" and literal(text) != text:
        raise BadArtefact(f"{argument}: not TOML, expected one value, or several without brackets and quotes, as {key}=a,b")
    return key, values


def value_of(text):
    """The value that a scene gets."""
    return tomllib.loads(f"v = {literal(text)}")["v"]


def same(text):
    """Of values that are the same the same: 1000, 1000.0 and 1e3."""
    value = value_of(text)
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else repr(value)


def check_keys(base, scenes):
    """BadArtefact for a key that scenes over `base` have not, and for a value that it cannot have; `scenes`: {key: text} of each."""
    known, table = scene_keys.scene(base), scene_keys.table_of_scenes()
    for key, text in dict.fromkeys(change for one in scenes for change in one.items()):
        if scene_keys.steps_of(key) == ["base"]:
            raise BadArtefact(f"base: found it as a key, expected another one: the base of the scenes is {base}")
        scene_keys.check(known, key, value_of(text), table)
    for one in scenes:
        for key, other in itertools.permutations(one, 2):
            steps = scene_keys.steps_of(other)
            if scene_keys.steps_of(key)[:len(steps)] == steps:
                raise BadArtefact(f"{key} and {other} exclude each other: one is a part of the other")


def file_names(combinations):
    """Of the values of each scene that are not the same in all: letters, digits, points and signs, joined by _."""
    varied = [k for k, values in enumerate(zip(*combinations)) if len(set(values)) > 1] or [0]
    names = ["_".join(re.sub(r"[^\w.+-]+", "-", values[k]).strip("-") for k in varied) for values in combinations]
    if len(set(names)) < len(names):
        raise BadArtefact("found values that give files the same name")
    return names


def without_schema(text):
    return re.sub(r"\A#:schema .*\n", "", text)


def write_changed(path, text):
    """Writes a file, complete or not at all, unless it has this text already but for its schema, so that make sees only what is new."""
    if path.exists() and without_schema(path.read_text(encoding="utf-8")) == without_schema(text):
        return
    with whole_file(path) as part:
        part.write_text(text, encoding="utf-8")


def scene_text(keys, values, title=None):
    """What a scene with these values has after the name of its base; keys of one table in one line each, as TOML's dotted keys."""
    changes = [f"{key} = {literal(value)}" for key, value in zip(keys, values)]
    first = "" if "title" in keys else f"title = {literal(title or ', '.join(changes))}\n"
    return first + "\n".join(changes) + "\n"


def read_keys(arguments):
    """(keys, the values of each scene) of all key=values: every combination."""
    if not arguments:
        raise BadArtefact("give key=values or --parameters")
    parsed = [parse(argument) for argument in arguments]
    keys = [key for key, _ in parsed]
    for key in keys:
        if keys.count(key) > 1:
            raise BadArtefact(f"{key}: found twice, expected each key once")
    count = math.prod(len(values) for _, values in parsed)
    if count > MOST:
        raise BadArtefact(f"found {count} combinations, expected at most {MOST}")
    return keys, list(itertools.product(*(values for _, values in parsed)))


def write_scenes(base, folder, texts, field, own_fields):
    """The scenes, {name: text of their changes by scene_text without its first line}, and the fragment; `own_fields`: {name: settings
    of clatter-recover} of scenes with others than `field`."""
    folder.mkdir(parents=True, exist_ok=True)
    first = f"base = {literal(os.path.relpath(base, folder))}\n"
    for name, text in texts.items():
        write_changed(folder / f"{name}.run.toml", schema_line("run.toml") + first + text)
    rules = FRAGMENT.format(name=folder.name, folder=folder, names=" ".join(texts))
    for settings in dict.fromkeys([field, *own_fields.values()] if field else own_fields.values()):
        same = [name for name in texts if own_fields.get(name, field) == settings]
        targets = f"$({folder.name}_fields)" if len(same) == len(texts) else " ".join(f"{folder}/{name}.field.h5" for name in same)
        rules += FIELDS.format(targets=targets, folder=folder, field=settings) if same else ""
    write_changed(folder / "sweep.mk", rules + DEPENDENCIES.format(folder=folder))


def write_files(base, folder, keys, combinations, field):
    """The scenes of all combinations; returns their number."""
    check_keys(base, [dict(zip(keys, values)) for values in combinations])
    names = file_names(combinations)
    write_scenes(base, folder, {name: scene_text(keys, values) for name, values in zip(names, combinations)}, field, {})
    return len(names)


def write_parameters(base, folder, file, keys, field):
    """The base and each value of each parameter of a file; `keys` have one value each, in all scenes. Returns the number of scenes."""
    names, combinations = read_keys(keys) if keys else ([], [()])
    if len(combinations) > 1:
        raise BadArtefact(f"{', '.join(keys)}: several values and --parameters exclude each other: give one of each key")
    scenes = parameters.scenes(parameters.read(file))
    check_keys(base, [dict(zip(names, combinations[0])), *(one.keys for one in scenes)])
    texts = {one.name: scene_text([*one.keys, *names], [*one.keys.values(), *combinations[0]], one.title) for one in scenes}
    write_scenes(base, folder, texts, field, {one.name: one.field for one in scenes if one.field})
    return len(texts)


def write_sweep(options):
    """`clatter sweep`: writes scenes and sweep.mk; prints what make can do with them."""
    base = pathlib.Path(options.base)
    if not base.is_file():
        raise BadArtefact(f"{base}: no such file, expected a scene, name.run.toml")
    folder = pathlib.Path(options.output or stem(base) + "_sweep")
    try:
        if options.parameters:
            count = write_parameters(base, folder, options.parameters, options.keys, options.field)
        else:
            count = write_files(base, folder, *read_keys(options.keys), options.field)
    except OSError as error:
        raise CannotWrite(f"{folder}: cannot be written: {error.strerror}") from error
    print(f"{folder}: {count} scene{'s' if count != 1 else ''}, and sweep.mk with $({folder.name}_runs) and $({folder.name}_fields) for a Makefile that "
          "includes it after clatter.mk")
