# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the links of the documents, and the files that they name, lead in the site."""
import posixpath
import re

import navigation

COPIED = (".png", ".svg")  # files that the site contains as they are; all others have a page with their text
NAMED = re.compile(r"[\w./-]+\.(?:cpp|hpp|py|cmake|toml|mk|txt|md|csv|bib)|Makefile")


def slug(heading):
    """The anchor that GitHub makes of a heading."""
    text = re.sub(r"[`*]|\[|\]\([^)]*\)", "", heading.strip().lower())
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def slugs(headings):
    """The anchors of the headings of a page: a repeated one gets a number."""
    seen, found = {}, []
    for heading in map(slug, headings):
        count = seen[heading] = seen.get(heading, -1) + 1
        found.append(f"{heading}-{count}" if count else heading)
    return found


class Links:
    """Translates paths of the repository to paths of the site, and keeps those that the pages need.

    `files`: every path of the repository; `headers`: {header: its page of the C++ reference}."""

    def __init__(self, files, headers):
        self.files = set(files)
        self.headers = headers
        self.copied, self.sources = set(), set()

    def page(self, path):
        """The page of the site that shows a file or folder of the repository; None if there is no such file."""
        if posixpath.join(path, "README.md") in self.files:
            path = posixpath.join(path, "README.md")
        if path not in self.files:
            return None
        if path in navigation.documents():
            return navigation.page_of(path)
        if path in self.headers:
            return self.headers[path]
        if path.endswith(COPIED):
            self.copied.add(path)
            return path
        self.sources.add(path)
        return path + ".html"

    def href(self, document, target):
        """The href for the target of a Markdown link of a document; ValueError if the link leads nowhere."""
        if re.match(r"[a-z]+:", target) or target.startswith("#"):
            return target
        path, _, anchor = target.partition("#")
        page = self.page(posixpath.normpath(posixpath.join(posixpath.dirname(document), path)))
        if page is None:
            raise ValueError(f"{document}: no file {target}")
        return navigation.relative(navigation.page_of(document), page) + ("#" + anchor if anchor else "")

    def named(self, document, text):
        """The href for a file that a document names as code; None if `text` names none, or several.

        Paths begin at the document's folder, at the top folder, or, where one file only matches, anywhere."""
        if not NAMED.fullmatch(text):
            return None
        near = posixpath.normpath(posixpath.join(posixpath.dirname(document), text))
        found = [path for path in (near, text) if path in self.files] \
            or [path for path in self.files if path.endswith("/" + text)]
        if found[:1] == [document] or not found or (len(found) > 1 and found[0] not in (near, text)):
            return None
        return navigation.relative(navigation.page_of(document), self.page(found[0]))
