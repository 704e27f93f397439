# SPDX-License-Identifier: GPL-3.0-or-later
"""Prose of the documents is wrapped at 100 columns."""
import re
import unittest

import repository

COLUMNS = 100


def too_long(text):
    """Numbers of the lines of prose beyond 100 columns. Tables and blocks may be wide, and so may what cannot be divided."""
    found, fenced = [], False
    for number, line in enumerate(text.split("\n"), 1):
        fenced ^= line.removeprefix("> ").startswith("```")
        prose = not fenced and not re.match(r" *\||    ", line)
        divisible = " " in re.sub(r"`[^`]*`", "code", re.sub(r"^ *(- |\d+\. )?", "", line))
        if len(line) > COLUMNS and prose and divisible:
            found.append(number)
    return found


class Columns(unittest.TestCase):
    def test_documents_are_wrapped(self):
        # GitHub shows each line of a pull request's text as a line of its own.
        documents = [path for path in repository.files(".md") if ".github" not in path.parts]
        wrong = [f"{path.relative_to(repository.SOURCE)}:{number}" for path in documents for number in too_long(path.read_text())]
        self.assertEqual(wrong, [], f"wrap at {COLUMNS} columns:\n" + "\n".join(wrong))

    def test_long_lines_are_found_and_tables_and_blocks_are_left(self):
        words, code = "word " * 30, "`" + "code " * 30 + "`"
        text = f"{words}\n- {words}\n| {words}|\n    {words}\n{code}\n{code} and\n- {code}\n```\n{words}\n```\n> ```\n> {words}\n> ```\n{words[:99]}"
        self.assertEqual(too_long(text), [1, 2, 6])


if __name__ == "__main__":
    unittest.main(verbosity=2)
