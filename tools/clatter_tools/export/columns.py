# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers as text, many rows at a time; lines of ASCII."""
import textwrap

import numpy as np

ROWS = 20_000  # at a time: bounds the memory of the text


def formatted(row_format, *columns):
    """Texts of blocks of rows: row_format % the numbers of one row of all columns (each rows x k, or a vector)."""
    columns = [np.asarray(column).reshape(len(column), -1) for column in columns]
    for begin in range(0, len(columns[0]), ROWS):
        block = np.column_stack([column[begin:begin + ROWS] for column in columns])
        yield (row_format * len(block)) % tuple(block.ravel().tolist())


def line(text, width=80):
    """One line of printable ASCII, at most `width` characters, never empty."""
    clean = "".join(c if " " <= c <= "~" else "?" for c in text)
    return clean[:width].strip() or "NONE"


def two_lines(text, width=80):
    """A text as two such lines."""
    return [line(part, width) for part in (*textwrap.wrap(text, width), "", "")[:2]]
