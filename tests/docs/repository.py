# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of the repository and the tests in them, for the tests of the documents."""
import ast
import pathlib
import re
import subprocess

SOURCE = pathlib.Path(__file__).resolve().parents[2]
NOT_OURS = {".git", "build", "__pycache__", ".cache"}


def files(*suffixes):
    """Every file of the repository with these endings, tracked or not ignored; without git all but build products."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=SOURCE, capture_output=True, text=True)
    if listed.returncode == 0 and listed.stdout:
        found = [SOURCE / line for line in listed.stdout.splitlines()]
    else:
        found = [path for path in SOURCE.rglob("*") if not NOT_OURS & set(path.relative_to(SOURCE).parts)]
    return sorted(path for path in found if path.suffix in suffixes and path.is_file())


def line_of(path, text, offset):
    """`file:line` of an offset in the text of a file."""
    return f"{path.relative_to(SOURCE)}:{text.count(chr(10), 0, offset) + 1}"


def google_tests(text):
    """[(suite, case)] of a C++ source."""
    return re.findall(r"^TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)", text, re.M)


def python_tests(text):
    """[(class, name)] of a Python test: methods test_ of each class of the file."""
    return [(node.name, item.name) for node in ast.parse(text).body if isinstance(node, ast.ClassDef)
            for item in node.body if isinstance(item, ast.FunctionDef) and item.name.startswith("test_")]


def all_tests():
    """{(suite or class, case or name): file}"""
    found = {}
    for path in files(".cpp", ".py"):
        if "tests" not in path.relative_to(SOURCE).parts:
            continue
        read = google_tests if path.suffix == ".cpp" else python_tests
        found.update({test: path for test in read(path.read_text())})
    return found
