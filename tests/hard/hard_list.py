# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/hard-cases.md as data: its entries, their texts and their tests."""
import dataclasses
import re

CASE = r"[A-Z]{1,2}\d+"
HEAD = "## Not covered yet"


@dataclasses.dataclass(frozen=True)
class Entry:
    """A case of the list: `B3`, `Dependent basis vectors`, its texts in Markdown, the names of its tests."""
    case: str
    title: str
    wrong: str
    must: str
    tests: tuple


def listed(text):
    """The entries in their order. One whose heading has no case has the entire heading as its case."""
    found = []
    for part in re.split(r"^### ", text.split(HEAD)[0], flags=re.M)[1:]:
        part = re.split(r"^## ", part, flags=re.M)[0]
        heading, _, body = part.partition("\n")
        case = re.match(rf"({CASE}) (\S.*)", heading)
        wrong = re.split(r"^(?:Must|Tests): ", body, flags=re.M)[0]
        found.append(Entry(case[1] if case else heading, case[2] if case else "", " ".join(wrong.split()),
                           " ".join(paragraph("Must", body).split()), tuple(re.findall(r"`([\w.]+)`", paragraph("Tests", body)))))
    return found


def paragraph(word, body):
    """The paragraph that begins with `word: `, without it."""
    found = re.search(rf"^{word}: (.*?)(?:\n\n|\n*\Z)", body, re.M | re.S)
    return found[1] if found else ""


def entries(text):
    """{case: [names of its tests]} of the list."""
    return {entry.case: list(entry.tests) for entry in listed(text)}


def not_covered(text):
    """Cases of the table at the end."""
    return re.findall(rf"^\| ({CASE}) \|", text.partition(HEAD)[2], re.M)


def sorting_key(case):
    """N9 is before N10."""
    letters, number = re.fullmatch(r"([A-Z]+)(\d+)", case).groups()
    return letters, int(number)
