# SPDX-License-Identifier: GPL-3.0-or-later
"""What a pipeline's files are made of: make's database of rules, and the files that TOML files name."""
import dataclasses
import os
import pathlib
import re
import subprocess

from clatter.artefact import BadArtefact
from clatter.pipeline import environment
from . import plan, toml_text

TARGET = re.compile(r"^([^\s#:=]+):(?!=)\s*(.*)$")
VARIABLE = re.compile(r"^\S+\s*(:|\+|\?|!)?=|^(export|override|private)\s")
GIVEN = re.compile(r"^# (makefile|command line|environment|'override')[^\n]*\n(?:define ([^\s=]+)[^\n]*\n(.*?)\nendef$|([^\s:=]+) :?:?=[ ]?([^\n]*)$)", re.M | re.S)
WORD = re.compile(r"[\w.-]+")
NO_RESULT = {"CLATTER_LAUNCH", "CLATTER_FLAGS", "MAKEFLAGS", "MAKEFILE_LIST", "MAKECMDGOALS", "CURDIR", "SHELL"}  # variables that change no result


@dataclasses.dataclass
class Rule:
    """inputs: what the target is made of, in make's order; commands: as the Makefile has them, and the target's own variables; made: whether
    there are commands."""
    inputs: list
    commands: list
    made: bool = False


def database(folder, targets):
    """Text of make's database for these targets, every rule applied that they need; nothing is made."""
    done = subprocess.run(["make", "--no-print-directory", "-npBk", *targets], cwd=folder, text=True, capture_output=True,
                          env=environment(LC_ALL="C"), check=False)
    if done.returncode or "\n# Files\n" not in done.stdout:
        said = [line.rpartition("*** ")[2] for line in done.stderr.splitlines() if "*** " in line] or [done.stderr.strip() or "no rules"]
        raise BadArtefact(f"{folder}/Makefile: make cannot find out what {', '.join(targets)} need: {said[0]}")
    return done.stdout


def rules_of(text):
    """{target: Rule} of make's database."""
    rules, current = {}, None
    for line in text[text.index("\n# Files\n"):].splitlines():
        if line.startswith("\t"):
            if current is not None:
                current.made = True
                current.commands.append(line)
        elif not line:
            current = None
        elif (found := TARGET.match(line)) and VARIABLE.match(found[2]):
            rules.setdefault(found[1], Rule([], [])).commands.append(line)
        elif found:
            current = rules.setdefault(found[1], Rule([], []))
            current.inputs += [one for one in found[2].replace("|", " ").split() if one not in current.inputs]
    return rules


def variables_of(text):
    """{name: text of its value} of make's database, without those of make itself."""
    found = {}
    for kind, name, lines, short, value in GIVEN.findall(text[:text.index("\n# Files\n")]):
        if (name or short) not in NO_RESULT:
            found[name or short] = (kind == "environment", lines if name else value)
    return found


class Pipeline:
    """A folder with a Makefile, and the rules of what `targets` need."""

    def __init__(self, folder, targets):
        self.folder = pathlib.Path(folder)
        text = database(folder, targets)
        self.rules, self.variables = rules_of(text), variables_of(text)
        self.of_patterns = re.findall(r"^# ([^\s=]+ [:?+]?= .*)$", text[text.index("# Pattern-specific"):text.index("\n# Directories\n")], re.M)
        self.tables = {}
        for target in targets:
            if not self.is_made(target):
                raise BadArtefact(f"{self.folder}/Makefile: {target}: found no rule, expected one for each file of a quantity")
            self.require(target)

    def is_made(self, name):
        rule = self.rules.get(name)
        return rule is not None and rule.made

    def commands(self, name):
        """The commands of a target, and the variables that they name, directly or not: what they say, not where it is written."""
        found, queue = {}, ["\n".join([*self.of_patterns, *self.rules[name].commands])]
        own = queue[0]
        while queue:
            text = queue.pop()
            for word in WORD.findall(text):
                from_environment, value = self.variables.get(word, (True, None))
                if value is not None and word not in found and (not from_environment or f"$({word}" in text or f"${{{word}" in text):
                    found[word] = value
                    queue.append(value)
        return "\n".join([own, *(f"{word} = {value}" for word, value in sorted(found.items()))])

    def require(self, name):
        """BadArtefact for targets whose rules a study cannot use."""
        if "/" in name and self.is_made(name):
            raise BadArtefact(f"{self.folder}/Makefile: {name}: found a target in another folder, expected those of the pipeline's folder")
        for one in self.rules[name].inputs if self.is_made(name) else ():
            self.require(one)

    def table(self, name):
        """The tables of a TOML file of the folder; {} where it is none."""
        if name not in self.tables:
            path = self.folder / name
            self.tables[name] = plan.read_toml(path) if name.endswith(".toml") and path.is_file() else {}
        return self.tables[name]

    def named_by(self, tables):
        """Files of the folder, made or given, that the texts of a TOML file's tables name."""
        found = []
        for text in toml_text.texts_in(tables):
            if not text or "\n" in text or "\0" in text or len(text) > 1000:
                continue
            if self.is_made(text) or os.path.isfile(self.folder / text):
                found.append(text if os.path.isabs(text) else os.path.normpath(text))
        return list(dict.fromkeys(found))

    def base_value(self, file, path):
        """The value of a key in a TOML file or the scenes that it is based on; None where none of them has it."""
        seen = set()
        while file not in seen:
            seen.add(file)
            value = toml_text.value_at(self.table(file), path)
            base = self.table(file).get("base")
            if value is not None or not isinstance(base, str):
                return value
            file = os.path.normpath(base)
        return None
