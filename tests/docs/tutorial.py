#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the pages of docs/tutorial: their files, their commands, and what these print.

    tests/docs/tutorial.py docs/tutorial/1-beam.md            compares
    tests/docs/tutorial.py docs/tutorial/1-beam.md --write    writes what the commands print now into the page, and its pictures

A page is run in a scratch folder, from top to bottom; a page with <!-- continues 4-piston-slap.md before "Heading" --> in the folder
that the other page has made before this heading. Its blocks are

- a file: a line with its name as code and a colon, an empty line, the block;
- ```console: commands after "$ ", continued after "> ", each followed by the lines that it prints on stdout. Progress and warnings
  go to stderr and are not shown. ~/clatter is the source tree.

No other block is allowed; a block may be in a quotation ("> "). `...` as a line stands for any lines, at the end of a line for the
rest of it. Comments before a block:

- <!-- tolerance 1e-2 -->: largest relative difference of the numbers in it, instead of 1e-3;
- <!-- exit code 2 -->: its last command ends with this code, and its messages on stderr are shown as well;
- <!-- needs clatter-condense-mpi -->: the block is left out where this program is missing, and the test then skips at its end.

Words are compared exactly, apart from the width of spaces between them. A number may differ by the tolerance or by one unit of its
last digit, a whole number only where a tolerance is given. A number below 1e-3 with an exponent is an error or a residue: it may be
ten times that of the page, or anything below 1e-6. What differs from machine to machine is not compared (UNSTEADY): durations,
memory, hashes, paths. A picture of the page is a file of the same name that one of its commands writes.
"""
import argparse
import dataclasses
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import repository

SOURCE = repository.SOURCE
BIN = pathlib.Path(os.environ.get("CLATTER_BIN", SOURCE / "build/release/bin"))
PROGRAMS = [f"clatter-{stage}" for stage in ("mesh", "assembly", "modal", "condense", "dynamics", "recover", "condense-mpi", "modal-mpi")]
LARGEST_PICTURE = 150_000  # bytes

ABSOLUTE = r"(?:file://)?(?<![\w.~*)-])/[\w.-]+/(?:[\w.-]+/)*"
UNSTEADY = [(re.compile(r"^seconds: .*"), "seconds:"),             # how a run's time is shared out
            (re.compile(r"\d+\.\d\d s\b"), "* s"),                 # durations have two decimals
            (re.compile(r"[\d.]+ (GiB|MiB|MB|kB)\b"), r"* \1"),
            (re.compile(r"sha256 [0-9a-f]+"), "sha256 *"),
            (re.compile(ABSOLUTE), "*/")]
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w]|\.\d)")
BLOCK = re.compile(r"(?:^`(?P<file>[\w./-]+)`:\n\n)?^(?P<quote>(?:> )?)```(?P<kind>.*)\n(?P<body>(?:(?P=quote).*\n)*?)^(?P=quote)```$", re.M)
CONTINUES = re.compile(r'<!-- continues (\S+) before "(.+)" -->')
IMAGE = re.compile(r"!\[[^\]]*\]\(([^)\s]+)\)")


class Differs(Exception):
    """A page that is not what its commands do; the message begins with its line."""


@dataclasses.dataclass
class Step:
    """A file to write, or a command with what it should print."""
    line: int           # of the page, from 1
    file: str = ""
    text: str = ""      # of the file, or the command
    printed: tuple = ()
    span: tuple = ()    # offsets of what is printed, in the page
    tolerance: float | None = None
    code: int = 0
    quote: str = ""     # before each line of a block in a quotation
    needs: str = ""     # a program without which it is left out


def steps_of(page):
    """The steps of a page's text, in order."""
    found, end = [], 0
    for block in BLOCK.finditer(page):
        line = page.count("\n", 0, block.start("body"))
        between, end = page[end:block.start()], block.end()
        marks = dict(re.findall(r"<!-- (tolerance|exit code|needs) (\S+) -->", between))
        if block["file"]:
            found.append(Step(line, file=block["file"], text=block["body"]))
        elif block["kind"] == "console":
            found += commands_of(block, line, marks)
        else:
            raise Differs(f"line {line}: this block is neither a file nor a console: it would not be run")
    if page[end:].count("```") or not found:
        raise Differs("the page has no block, or one that does not end")
    return found


def steps_before(path, page):
    """Those of the page that this one continues; none where it begins in an empty folder."""
    continued = CONTINUES.search(page)
    if not continued:
        return []
    other, heading, _ = (path.parent / continued[1]).read_text().partition(f"\n## {continued[2]}\n")
    if not heading:
        raise Differs(f"{continued[1]}: found no heading {continued[2]}, which this page names")
    return steps_of(other)


def commands_of(block, line, marks):
    found, quote, offset = [], block["quote"], block.start("body")
    tolerance = float(marks["tolerance"]) if "tolerance" in marks else None
    for number, text in enumerate(block["body"].splitlines(keepends=True), 1):
        bare = text.rstrip("\n").removeprefix(quote)
        if bare.startswith("$ "):
            found.append(Step(line + number, text=bare[2:], span=(offset + len(text),) * 2, tolerance=tolerance, quote=quote,
                              needs=marks.get("needs", "")))
        elif not found:
            raise Differs(f"line {line + number}: found output, expected a command after \"$ \"")
        elif bare.startswith("> ") and not found[-1].printed:
            found[-1].text += "\n" + bare[2:]
            found[-1].span = (offset + len(text),) * 2
        else:
            found[-1].printed += (bare,)
            found[-1].span = (found[-1].span[0], offset + len(text))
        offset += len(text)
    if found:
        found[-1].code = int(marks.get("exit code", 0))
    return found


def steady(line):
    for pattern, instead in UNSTEADY:
        line = pattern.sub(instead, line)
    return " ".join(line.split())


def words_and_numbers(line):
    return NUMBER.sub("\0", line), NUMBER.findall(line)


def close(expected, found, tolerance):
    if tolerance == float("inf"):
        return True
    if re.fullmatch(r"[-+]?\d+", expected):
        return abs(int(expected) - float(found)) <= (tolerance or 0) * abs(int(expected))
    value, other = float(expected), float(found)
    digits, _, exponent = expected.lower().partition("e")
    if exponent and abs(value) < 1e-3:
        return abs(other) <= max(10 * abs(value), 1e-6)
    unit = 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))
    # The last factor is for the rounding of this subtraction.
    return abs(value - other) <= max((tolerance or 1e-3) * abs(value), unit) * (1 + 1e-9)


def difference(expected, found, tolerance):
    """What is wrong with a line that was printed; None if nothing is."""
    expected, found = steady(expected), steady(found)
    if expected.endswith("..."):
        expected = expected.removesuffix("...").rstrip()
        start = re.match(f"(?:{NUMBER.pattern})".join(map(re.escape, NUMBER.split(expected))), found)
        found = start[0] if start else found
    (words, numbers), (other_words, other_numbers) = words_and_numbers(expected), words_and_numbers(found)
    if words != other_words:
        return f"expected: {expected}\n  found:    {found}"
    wrong = [(one, other) for one, other in zip(numbers, other_numbers) if not close(one, other, tolerance)]
    return None if not wrong else (f"expected: {expected}\n  found:    {found}\n  " +
                                   ", ".join(f"{other} instead of {one}" for one, other in wrong))


def compare(step, printed):
    """Raises Differs where the lines of a command are not those of the page."""
    expected, at = list(step.printed), 0
    for number, line in enumerate(expected):
        if line.strip() == "...":
            continue
        elided = number > 0 and expected[number - 1].strip() == "..."
        reasons = [difference(line, other, step.tolerance) for other in (printed[at:] if elided else printed[at:at + 1])]
        good = next((index for index, reason in enumerate(reasons) if reason is None), None)
        if good is None:
            detail = reasons[0] if len(reasons) == 1 else f"expected: {line}\n  found none like it in:\n    " + "\n    ".join(printed[at:])
            raise Differs(f"line {step.line}: $ {step.text}\n  {detail}")
        at += good + 1
    if at < len(printed) and not (expected and expected[-1].strip() == "..."):
        raise Differs(f"line {step.line}: $ {step.text}\n  printed as well:\n    " + "\n    ".join(printed[at:]))


def renewed(step, printed):
    """The lines for the page: those it has where only numbers changed, else everything that was printed, without absolute paths."""
    skeleton = dataclasses.replace(step, tolerance=float("inf"), printed=tuple(step.printed))
    lines, at = [], 0
    try:
        compare(skeleton, printed)
    except Differs:
        return [re.split(ABSOLUTE, line)[0].rstrip() + " ..." if re.search(ABSOLUTE, line) else line for line in printed]
    for number, line in enumerate(step.printed):
        if line.strip() == "...":
            lines.append(line)
            continue
        while difference(line, printed[at], float("inf")) is not None:
            at += 1
        numbers = iter(NUMBER.findall(printed[at]))
        same = difference(line, printed[at], None) is None
        lines.append(line if same else NUMBER.sub(lambda _: next(numbers), line) if line.rstrip().endswith("...") else printed[at])
        at += 1
    return lines


class Shell:
    """Commands in a scratch folder, each in the folder that the one before left."""

    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.folder = self.root / "work"
        home, programs = self.root / "home", self.root / "programs"
        for folder in (self.folder, home, programs):
            folder.mkdir()
        (home / "clatter").symlink_to(SOURCE)
        for program in PROGRAMS:
            if (BIN / program).exists():
                (programs / program).symlink_to(BIN / program)
        (programs / "clatter").symlink_to(SOURCE / "tools/clatter")
        caches = {"MPLCONFIGDIR": os.environ.get("MPLCONFIGDIR", str(pathlib.Path.home() / ".config/matplotlib"))}
        not_of_readers = ("MAKEFLAGS", "MAKELEVEL", "MFLAGS", "OPENBLAS_CORETYPE")  # of make check, and of machines that test
        own = {name: value for name, value in os.environ.items() if name not in not_of_readers}
        self.environment = {**own, **caches, "HOME": str(home), "PATH": f"{programs}:{os.environ['PATH']}",
                            "CLATTER_BIN": str(BIN), "PYTHONDONTWRITEBYTECODE": "1"}

    def lacks(self, program):
        return bool(program) and not shutil.which(program, path=self.environment["PATH"])

    def run(self, command):
        """(exit code, stdout, stderr)"""
        left = self.root / "folder"
        script = f"{command}\ncode=$?\npwd > '{left}'\nexit $code\n"
        done = subprocess.run(["bash", "-c", script], cwd=self.folder, env=self.environment, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=500)
        self.folder = pathlib.Path(left.read_text().strip()) if left.exists() else self.folder
        return done.returncode, done.stdout, done.stderr


def carry_out(shell, step):
    """The lines that a command printed, none of a file; Differs where its exit code is another one."""
    if step.file:
        file = shell.folder / step.file
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(step.text)
        return []
    code, printed, messages = shell.run(step.text)
    if code != step.code:
        raise Differs(f"line {step.line}: $ {step.text}\n  exit code {code}, expected {step.code}\n  "
                      + "\n  ".join((printed + messages).splitlines()[-20:]))
    lines = (printed + (messages if step.code else "")).splitlines()
    if any(line.startswith("$ ") for line in lines):
        raise Differs(f"line {step.line}: $ {step.text}\n  prints lines that begin with \"$ \", which a page takes for commands: indent them by sed")
    return lines


def save_small(made, picture):
    """A picture for the page: at most 1000 pixels wide, in 256 colours."""
    from PIL import Image  # comes with matplotlib
    image = Image.open(made).convert("RGB")
    image.thumbnail((1000, 2000))
    image.quantize(256).save(picture, optimize=True)


def check_pictures(path, page, root, write):
    for name in IMAGE.findall(page):
        made = next((file for file in sorted(root.glob("work/**/*.png")) if file.name == pathlib.Path(name).name), None)
        if made is None or made.read_bytes()[:4] != b"\x89PNG":
            raise Differs(f"no command of the page writes the picture {name}")
        if write:
            (path.parent / name).parent.mkdir(exist_ok=True)
            save_small(made, path.parent / name)
        if (path.parent / name).stat().st_size > LARGEST_PICTURE:
            raise Differs(f"{name} is larger than {LARGEST_PICTURE} bytes")


def run_page(path, write=False, keep=None):
    """Runs a page; Differs where it is not what its commands do. With `write` the page becomes what they do. Returns the programs that
    some of its commands need and that are missing."""
    path = pathlib.Path(path)
    page = path.read_text()
    steps, pieces, end, missing = steps_of(page), [], 0, set()
    with tempfile.TemporaryDirectory(prefix="clatter-tutorial-") as scratch:
        root = pathlib.Path(scratch)
        shell = Shell(root)
        for step in steps_before(path, page):
            carry_out(shell, step)
        for step in steps:
            if shell.lacks(step.needs):
                missing.add(step.needs)
                continue
            printed = carry_out(shell, step)
            if step.file:
                continue
            if write:
                pieces += [page[end:step.span[0]], "".join(f"{step.quote}{line}\n" for line in renewed(step, printed))]
                end = step.span[1]
            else:
                compare(step, printed)
        if keep:
            shutil.copytree(shell.root / "work", keep, dirs_exist_ok=True)
        if write:
            path.write_text("".join([*pieces, page[end:]]))
        check_pictures(path, page, root, write)
    return sorted(missing)


def main():
    line = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    line.add_argument("pages", nargs="+", metavar="page.md")
    line.add_argument("--write", action="store_true", help="write what the commands print now, and the pictures")
    line.add_argument("--keep", metavar="FOLDER", help="copy the files that the commands made to this folder")
    options = line.parse_args()
    for page in options.pages:
        try:
            run_page(page, options.write, options.keep)
        except Differs as error:
            sys.exit(f"{page}: {error}")


if __name__ == "__main__":
    main()
