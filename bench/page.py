# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables in docs/accuracy.md and other pages."""
from pathlib import Path

PAGE = Path(__file__).resolve().parent.parent / "docs" / "accuracy.md"


def markdown(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(row) + " |" for row in rows]


def write(mark, lines, page=PAGE):
    """Puts the lines between <!-- mark --> and the next <!-- end --> of docs/accuracy.md, or of another page."""
    before, rest = page.read_text().split(f"<!-- {mark} -->\n", 1)
    after = rest.split("<!-- end -->", 1)[1]
    page.write_text(f"{before}<!-- {mark} -->\n" + "\n".join(lines) + f"\n<!-- end -->{after}")
