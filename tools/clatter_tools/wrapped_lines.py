# SPDX-License-Identifier: GPL-3.0-or-later
"""Text of Markdown documents in lines of at most 100 columns."""
import re
import textwrap

WIDTH = 100


def wrapped(lines):
    """Lines of prose and lists, wrapped; code in backticks is not divided, and tables and blocks stay as they are."""
    return [part for line in lines for part in (line_parts(line) if len(line) > WIDTH else [line])]


def line_parts(line):
    start = re.match(r"(\s*)(?:- |\d+\. )?", line)
    if line.startswith("|") or len(start[1]) >= 4:
        return [line]
    whole = re.sub(r"`[^`]*`", lambda code: code[0].replace(" ", "\xa0"), line[start.end():])
    parts = textwrap.wrap(whole, WIDTH, initial_indent=start[0], subsequent_indent=" " * start.end(),
                          break_long_words=False, break_on_hyphens=False)
    return [part.replace("\xa0", " ") for part in parts]
