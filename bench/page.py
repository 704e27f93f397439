# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables in docs/accuracy.md and other pages."""
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "accuracy.md"
sys.path.insert(0, str(ROOT / "tools"))
from clatter_tools.wrapped_lines import wrapped  # noqa: E402


def markdown(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(row) + " |" for row in rows]


def write(mark, lines, page=PAGE):
    """Puts the lines between <!-- mark --> and the next <!-- end --> of docs/accuracy.md, or of another page."""
    before, rest = page.read_text().split(f"<!-- {mark} -->\n", 1)
    after = rest.split("<!-- end -->", 1)[1]
    page.write_text(f"{before}<!-- {mark} -->\n" + "\n".join(wrapped(lines)) + f"\n<!-- end -->{after}")
