# SPDX-License-Identifier: GPL-3.0-or-later
"""Link targets exist, and so do files that CONTRIBUTING.md and others name without a folder."""
import re
import sys
import unittest

import repository

sys.path.insert(0, str(repository.SOURCE / "docs/site"))
from links import slug

# Documents that name files without their folders, so that moves do not touch them.
BY_NAME = ("CONTRIBUTING.md", "STYLE.md", "docs/design.md")
WRITTEN = {"fe.toml"}  # by programs, not in the repository


def anchors(text):
    return {slug(heading) for heading in re.findall(r"^#+ (.*)$", text, re.M)}


def links(text):
    """[(file or "", anchor or "")] of the links of a document that stay within the repository."""
    plain = re.sub(r"^```.*?^```|`[^`\n]*`", "", text, flags=re.M | re.S)
    found = re.findall(r"\]\(([^)\s]+)\)", plain)
    return [target.partition("#")[::2] for target in found if not re.match(r"[a-z]+:", target)]


def broken(path, text):
    """Errors in the links of a document, one sentence each."""
    wrong = []
    for file, anchor in links(text):
        target = path.parent / file
        if file and not target.exists():
            wrong.append(f"no file {file}")
        elif anchor and anchor not in anchors(target.read_text() if file else text):
            wrong.append(f"no heading #{anchor} in {file or path.name}")
    return wrong


def named_files(text):
    """File names with an extension of sources in backticks: `mount.cpp`, `abaqus_*_test.cpp`."""
    return re.findall(r"`([\w*./-]+\.(?:cpp|hpp|py|cmake|toml|mk|txt|yaml|bib|md))`", text)


class Links(unittest.TestCase):
    def test_links_lead_somewhere(self):
        wrong = [f"{path.relative_to(repository.SOURCE)}: {what}" for path in repository.files(".md")
                 for what in broken(path, path.read_text())]
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))

    def test_files_that_are_named_exist_somewhere(self):
        paths = [path.relative_to(repository.SOURCE) for path in repository.files(
            ".cpp", ".hpp", ".py", ".cmake", ".toml", ".mk", ".txt", ".yaml", ".bib", ".md")]
        for document in BY_NAME:
            text = (repository.SOURCE / document).read_text()
            missing = [name for name in named_files(text)
                       if name not in WRITTEN and not any(path.match(name) for path in paths)]
            self.assertEqual(missing, [], document)

    def test_broken_links_are_reported(self):
        text = "# A head\n[a](#a-head) [b](#none) [c](README.md) [d](gone.md#x) [e](README.md#none) [f](https://example.org)\n"
        self.assertEqual(broken(repository.SOURCE / "x.md", text),
                         ["no heading #none in x.md", "no file gone.md", "no heading #none in README.md"])
        self.assertEqual(named_files("`mount.cpp`, `a b.cpp`, `tests/x_*_test.py` and `fe.toml`"),
                         ["mount.cpp", "tests/x_*_test.py", "fe.toml"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
