# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter sweep`: scenes that change keys of another one, one for each combination of values, and their make rules."""
import decimal
import itertools
import math
import os
import pathlib
import re
import tomllib

from .artefact import BadArtefact, CannotWrite

MOST = 100_000  # scenes
KEYS = re.compile(r"""((?:[\w-]+|"[^"]*")(?:\.(?:[\w-]+|"[^"]*"))*)=(.+)""", re.S)

FRAGMENT = """# Written by `clatter sweep`: the runs and fields of {folder}/, for `include` after clatter.mk.
{name}_names := {names}
{name}_runs := $({name}_names:%={folder}/%.run.h5)
{name}_fields := $({name}_names:%={folder}/%.field.h5)
"""
DEPENDENCIES = "-include $(wildcard {folder}/*.h5.d)\n"
FIELDS = """$({name}_fields): {folder}/%.field.h5: {folder}/%.run.h5 {field} $(clatter_recover)
	$(CLATTER_LAUNCH) $(clatter_recover) $< -c {field} -o $@ --depfile $@.d $(CLATTER_FLAGS)
"""


def add_arguments(command):
    """Declares the arguments of `clatter sweep`."""
    command.add_argument("base", metavar="base.run.toml", help="the scene that all others change")
    command.add_argument("keys", nargs="+", metavar="key=values",
                         help="1000:3000:50 (first, last, step), a,b,c, or one value; several keys give all combinations. "
                              "Entries of tables go by their name: drive.crank.speed_rpm=1000:6000:200")
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
    if len(set(values)) < len(values) or "" in values:
        raise BadArtefact(f"{argument}: found a value twice or an empty one")
    return key, values


def file_names(combinations):
    """Of the values of each scene that are not the same in all: letters, digits, points and signs, joined by _."""
    varied = [k for k, values in enumerate(zip(*combinations)) if len(set(values)) > 1] or [0]
    names = ["_".join(re.sub(r"[^\w.+-]+", "-", values[k]).strip("-") for k in varied) for values in combinations]
    if len(set(names)) < len(names):
        raise BadArtefact("found values that give files the same name")
    return names


def write_changed(path, text):
    """Writes a file, complete or not at all, unless it has this text already, so that make sees only what is new."""
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    part = path.with_name(path.name + ".part")
    part.write_text(text, encoding="utf-8")
    os.replace(part, path)


def scene_text(base, keys, values):
    """A scene with these values; keys of one table in one line each, as TOML's dotted keys."""
    changes = [f"{key} = {literal(value)}" for key, value in zip(keys, values)]
    title = "" if "title" in keys else f"title = {literal(', '.join(changes))}\n"
    return f"base = {literal(base)}\n{title}" + "\n".join(changes) + "\n"


def read_keys(arguments):
    """(keys, the values of each scene) of all key=values: every combination."""
    parsed = [parse(argument) for argument in arguments]
    keys = [key for key, _ in parsed]
    for key in keys:
        if keys.count(key) > 1:
            raise BadArtefact(f"{key}: found twice, expected each key once")
    count = math.prod(len(values) for _, values in parsed)
    if count > MOST:
        raise BadArtefact(f"found {count} combinations, expected at most {MOST}")
    return keys, list(itertools.product(*(values for _, values in parsed)))


def write_files(base, folder, keys, combinations, field):
    """The scenes by name, and the fragment; returns the number of scenes."""
    names = file_names(combinations)
    folder.mkdir(parents=True, exist_ok=True)
    above = os.path.relpath(base, folder)
    for name, values in zip(names, combinations):
        write_changed(folder / f"{name}.run.toml", scene_text(above, keys, values))
    rules = FRAGMENT + (FIELDS if field else "") + DEPENDENCIES
    write_changed(folder / "sweep.mk", rules.format(name=folder.name, folder=folder, names=" ".join(names), field=field))
    return len(names)


def write_sweep(options):
    """`clatter sweep`: writes scenes and sweep.mk; prints what make can do with them."""
    base = pathlib.Path(options.base)
    if not base.is_file():
        raise BadArtefact(f"{base}: no such file, expected a scene, name.run.toml")
    keys, combinations = read_keys(options.keys)
    folder = pathlib.Path(options.output or base.name.split(".")[0] + "_sweep")
    try:
        count = write_files(base, folder, keys, combinations, options.field)
    except OSError as error:
        raise CannotWrite(f"{folder}: cannot be written: {error.strerror}") from error
    print(f"{folder}: {count} scenes, and sweep.mk with $({folder.name}_runs) and $({folder.name}_fields) for a Makefile that "
          "includes it after clatter.mk")
