# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of docs/validation.md that commands write: each is between <!-- name --> and <!-- end -->."""
import pathlib
import sys
import tempfile

from stage_run import SOURCE

sys.path.insert(0, str(SOURCE / "tools"))
from clatter_tools.wrapped_lines import wrapped  # noqa: E402

PAGE = SOURCE / "docs/validation.md"


def markdown(head, rows):
    """A table: `head` and each of `rows` are lists of words."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def put(name, text):
    """Replaces the table of that name by `text`."""
    before, rest = PAGE.read_text().split(f"<!-- {name} -->\n", 1)
    after = rest.split("<!-- end -->", 1)[1]
    lines = "\n".join(wrapped(text.split("\n")))
    PAGE.write_text(f"{before}<!-- {name} -->\n{lines}\n<!-- end -->{after}")


def finish(name, text, arguments):
    """Prints the table; --write among the arguments puts it into the page."""
    print(text)
    if "--write" in arguments:
        put(name, text)


def compared(cases, compare):
    """A row for each case (name, shows, limit, remark), with the values of compare(name, folder) in the middle;
    each in a separate folder."""
    rows = []
    for name, shows, limit, remark in cases:
        with tempfile.TemporaryDirectory(prefix="clatter-ccx-") as folder:
            rows.append((name, shows, *compare(name, pathlib.Path(folder)), limit, remark))
    return rows
