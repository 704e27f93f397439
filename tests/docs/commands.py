# SPDX-License-Identifier: GPL-3.0-or-later
"""Sample commands of READMEs and documents: found in their text, and checked without running them."""
import dataclasses
import fnmatch
import functools
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

import repository

SOURCE = repository.SOURCE
BIN = pathlib.Path(os.environ.get("CLATTER_BIN", SOURCE / "build/release/bin"))
sys.path.insert(0, str(SOURCE / "tools"))
# First words of what is a command here.
PROGRAM = re.compile(r"(clatter(-[a-z]+)?|(\.\./)*tools/clatter|make|ctest|cmake|git|ninja|pre-commit|/usr/bin/python3|"
                     r"(bench|tests/validate)/\w+\.py|build/release/\S+)(?=\s|$)")
STAGES = ("mesh", "assembly", "modal", "condense", "dynamics", "recover")
COMMENT = re.compile(r"\s+(#|//)\s.*$")


@dataclasses.dataclass
class Command:
    path: str    # of the document
    line: int
    text: str    # as written, without its comment
    block: bool  # in a separate block, not within a sentence

    def words(self):
        """Its words, without leading environment variables and placeholders."""
        words = shlex.split(self.text.replace("[", " ").replace("]", " "))
        while words and re.match(r"[A-Z_]+=", words[0]):
            words.pop(0)
        return [word for word in words if word != "..."]

    def __str__(self):
        return f"{self.path}:{self.line}: {self.text}"


def is_command(text):
    return PROGRAM.match(re.sub(r"^(?:[A-Z_]+=\S* )+", "", text)) is not None


def blocks(text):
    """[(line, text)] of the lines in blocks: indented by four, or fenced as shell or without a language."""
    found, fence = [], None
    lines = text.split("\n")
    for number, line in enumerate(lines, 1):
        if line.startswith("```"):
            fence = None if fence is not None else line[3:].strip()
        elif fence in ("", "sh", "bash", "shell") or (fence is None and re.match(r"    +\S", line)):
            found.append((number, line.strip()))
    return found


def commands_in(path, text):
    """All commands of a document; a line that ends in a backslash continues."""
    found, open_line = [], None
    for number, line in blocks(text):
        line = COMMENT.sub("", line)
        if open_line is not None:
            number, line = open_line[0], open_line[1] + " " + line
            open_line = None
        if line.endswith("\\"):
            open_line = number, line[:-1].strip()
        elif is_command(line):
            found.append(Command(path, number, line, True))
    for match in re.finditer(r"`([^`\n]+)`", re.sub(r"^```.*?^```", lambda m: "\n" * m[0].count("\n"), text, flags=re.M | re.S)):
        if is_command(match[1]) and " " in match[1]:
            found.append(Command(path, text.count("\n", 0, text.find(match[0])) + 1, match[1], False))
    return found


@functools.cache
def all_commands():
    return [command for path in repository.files(".md")
            for command in commands_in(str(path.relative_to(SOURCE)), path.read_text())]


@functools.cache
def help_of(program, *command):
    """Output of `clatter-mesh --help` or `clatter-mesh faces --help`; None if it is not built."""
    path = BIN / program
    if not path.exists():
        return None
    return subprocess.run([path, *command, "--help"], capture_output=True, text=True, timeout=60).stdout


def commands_of(program):
    """The commands that the help of a stage's program lists."""
    listed = re.search(r"^Commands \(.*\):\n((?:  .*\n)+)", help_of(program) or "", re.M)
    return re.findall(r"^  ([\w-]+)", listed[1], re.M) if listed else []


@functools.cache
def cmake_text():
    return "\n".join(path.read_text() for path in repository.files(".txt") if path.name == "CMakeLists.txt")


@functools.cache
def test_names():
    """Names in CTest, without the parameters of parameterised tests."""
    python = re.findall(r'clatter_python_test\((\w+) "?[\w\\;]+"?((?: \w+)*)\)', cmake_text())
    return ([f"{suite}.{case}" for suite, case in repository.all_tests() if case[:5] != "test_"]
            + ["_".join([file, *classes.split()]) for file, classes in python])


def options(words):
    return [word.split("=")[0] for word in words if re.match(r"--?[A-Za-z]", word)]


def unknown_options(words, text):
    return [f"no option {option}" for option in options(words) if not re.search(rf"(?<![\w-]){re.escape(option)}(?![\w-])", text)]


def look_at_stage(words):
    text = help_of(words[0])
    if words[0].removeprefix("clatter-") not in STAGES:
        return [f"no program {words[0]}"]
    if text is None:
        return []
    command = words[1:2] if words[1:2] and words[1] in commands_of(words[0]) else []
    return unknown_options(words[1:], help_of(words[0], *command))


def look_at_tool(words):
    from clatter_tools import command_line
    if len(words) < 2:
        return []
    text = command_line.parser().format_help()
    if not re.search(rf"^    {words[1]}(?: |$)", text, re.M):
        return [f"no command clatter {words[1]}"]
    return unknown_options(words[2:], help_of_tool(words[1]))


@functools.cache
def help_of_tool(command):
    return subprocess.run([sys.executable, SOURCE / "tools/clatter", command, "--help"], capture_output=True, text=True).stdout


def look_at_make(words, document):
    folder = SOURCE / document if (SOURCE / document).is_dir() else (SOURCE / document).parent
    rest = [word for word in words[1:] if "=" not in word]
    if "-C" in rest:
        at = rest.index("-C")
        folder = SOURCE / rest[at + 1]
        del rest[at:at + 2]
    makefile = next((path for path in (folder / "Makefile", SOURCE / "Makefile") if path.exists()), None)
    if makefile is None:
        return [f"no Makefile in {folder}"]
    rules = (SOURCE / "tools/clatter.mk").read_text()
    text = "\n".join([makefile.read_text(), (SOURCE / "Makefile").read_text(), rules])
    targets = re.findall(r"^([\w.%-]+(?: [\w.%-]+)*) *:(?!=)", text, re.M)
    names = {name for group in targets for name in group.split()}
    return [f"no target {word}" for word in rest if not word.startswith("-")
            and not any(fnmatch.fnmatch(word, name.replace("%", "*")) for name in names)]


def look_at_ctest(words):
    wrong = []
    for option, value in zip(words, words[1:]):
        if option == "-L" and not re.search(rf'LABELS? "?(?:\w+\\?;)*{value}\b', cmake_text() + (SOURCE / "cmake/stage.cmake").read_text()):
            wrong.append(f"no test has the label {value}")
        if option == "-R":
            wrong += [f"no test is named like {part}" for part in value.split("|")
                      if not any(re.search(part, name) for name in test_names())]
    return wrong


def look_at_cmake(words):
    presets = [item["name"] for item in json.loads((SOURCE / "CMakePresets.json").read_text())["configurePresets"]]
    wrong = [f"no preset {value}" for option, value in zip(words, words[1:]) if option == "--preset" and value not in presets]
    if "--target" in words:
        for target in words[words.index("--target") + 1:]:
            known = target in [f"clatter-{name}" for name in STAGES] or f"clatter_test({target} " in cmake_text()
            if not known:
                wrong.append(f"no target {target}")
    return wrong


def look_at_script(words):
    path = SOURCE / words[0]
    if not path.exists():
        return [f"no file {words[0]}"]
    family = "\n".join(other.read_text() for other in path.parent.glob("*.py"))
    return unknown_options(words[1:], family)


def look_at_python(words):
    rest = [word for word in words[1:] if not word.startswith("-")]
    path = SOURCE / rest[0]
    if not path.exists():
        return [f"no file {rest[0]}"]
    known = {name for test in repository.python_tests(path.read_text()) for name in (test[0], ".".join(test))}
    return [f"no test {word} in {rest[0]}" for word in rest[1:] if word not in known]


def look_at_test_program(words):
    name = words[0].rsplit("/", 1)[1]
    if f"clatter_test({name} " not in cmake_text():
        return [f"no test program {name}"]
    filters = [word.split("=", 1)[1] for word in words[1:] if word.startswith("--gtest_filter=")]
    return [f"no test is named like {text}" for text in filters
            if not any(fnmatch.fnmatch(test, text) for test in test_names())]


def errors_of(command):
    """Errors of a command, one sentence each: programs, options, targets, tests that do not exist."""
    words = command.words()
    program = words[0]
    if program.startswith("clatter-"):
        return look_at_stage(words)
    if program.endswith(("clatter", "tools/clatter")):
        return look_at_tool(words)
    if program == "make":
        return look_at_make(words, command.path)
    if program == "ctest":
        return look_at_ctest(words)
    if program == "cmake":
        return look_at_cmake(words)
    if program == "/usr/bin/python3":
        return look_at_python(words)
    if program.startswith("build/release/"):
        return look_at_test_program(words)
    if program.endswith(".py"):
        return look_at_script(words)
    return []
