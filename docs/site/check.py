# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports links of a folder of HTML pages that lead nowhere, and files that would be loaded from the network."""
import html
import posixpath
import re
import sys
from pathlib import Path
from urllib.parse import unquote

REFERENCE = re.compile(r'<(\w+)\b[^>]*?\s(?:href|src)="([^"]*)"')
ANCHOR = re.compile(r'<[^>]*?\s(?:id|name)="([^"]*)"')
EXTERNAL = re.compile(r"[a-z]+:")


def problems(root):
    """One sentence for each invalid link of the pages below `root`."""
    pages = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8", errors="replace")
             for path in sorted(Path(root).rglob("*.html"))}
    anchors = {page: {html.unescape(name) for name in ANCHOR.findall(text)} for page, text in pages.items()}
    found = []
    for page, text in pages.items():
        for tag, reference in sorted(set(REFERENCE.findall(text))):
            target = html.unescape(reference)
            if EXTERNAL.match(target):
                if tag != "a" and not target.startswith("javascript:"):
                    found.append(f"{page}: <{tag}> loads {target}")
                continue
            path, _, anchor = target.partition("#")
            to = posixpath.normpath(posixpath.join(posixpath.dirname(page), unquote(path))) if path else page
            if not (Path(root) / to).is_file():
                found.append(f"{page}: no file {target}")
            elif anchor and to in anchors and unquote(anchor) not in anchors[to] and anchor not in anchors[to]:
                found.append(f"{page}: no anchor {target}")
    return found


if __name__ == "__main__":
    wrong = problems(sys.argv[1])
    print("\n".join(wrong), file=sys.stderr)
    sys.exit(1 if wrong else 0)
