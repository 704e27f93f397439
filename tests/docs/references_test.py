# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/references.bib and the citations in sources, READMEs and documents agree.

What counts as a citation (text unwrapped, of C++ and CMake only comments):

- author and year: `Guyan 1965`, `Craig and Bampton (1968`, `Grimes, Lewis and Simon, 1994`, `Bank et al. 1985`,
  `Demmel and others 2006`, several years as in `Patir and Cheng 1978, 1979`;
- the same with the journal between: `Johnen, Remacle, Geuzaine, J. Comput. Phys. 233, 2013`, also with a
  title in quotes;
- a standard by its number: `ISO 1683`, `ISO/TS 7849`, `IEC 61260-1:2014`.

An entry belongs to a citation when its first author (or, of a standard, its `number`) and year are the same. Entries
with `keywords = {by name}` are cited by their authors without a year (textbooks, of which any edition will do), those
with `{by title}` by their title.

    references_test.py --list     prints every recognised citation with its files and lines
"""
import collections
import re
import sys
import unittest

import repository

BIB = repository.SOURCE / "docs/references.bib"
NAME = r"(?:(?:van|von|de) )?[A-Z](?:'[A-Z])?[a-zé]+(?:[A-Z][a-z]+)?(?:-[A-Z][a-z]+)?"
NAMES = rf"{NAME}(?:, {NAME})*(?:,? and {NAME}| et al\.| and others)?"
YEAR = r"(?:18|19|20)\d\d"
# Place of publication: a title in quotes, a book's title, a journal with its volume.
WORDS = r"(?:(?:[A-Z][\w'-]*\.?|\d+(?:th|st|nd|rd)?|of|the|and|for|to|in|[a-z]+-[a-z]+)[.,:]?(?:\([\d-]+\))?,? )"
WHERE = rf"(?:\"[^\"]{{5,140}}\",? (?:in )?{WORDS}{{0,14}}|(?:in )?{WORDS}{{1,14}})"
SHORT = re.compile(rf"\b(?P<names>{NAMES}),? \(?(?P<years>{YEAR}(?:, {YEAR})*)[a-z]?\b")
LONG = re.compile(rf"\b(?P<names>{NAMES}), (?=\"|[A-Z]|in [A-Z]){WHERE}\(?(?P<years>{YEAR})\b")
STANDARD = re.compile(r"\b(?P<body>ISO|IEC)(?:/TS)? (?P<number>\d{3,5}(?:-\d)?)\b")
# Words before a year that are no names.
NO_NAMES = {"Benchmarks", "Roundtable", "Debian", "Most", "Second", "Release", "January", "February", "March", "April", "May",
            "June", "July", "August", "September", "October", "November", "December"}


def prose(path, text):
    """The prose: comments of C++ and CMake, all of other files; line ends and comment marks become spaces."""
    if path.suffix in (".cpp", ".hpp"):
        text = re.sub(r"^(?:(?!//).)*$|^(?:(?!//).)*(?=//)", "", text, flags=re.M)
    elif path.suffix in (".cmake", ".txt"):
        text = re.sub(r"^(?:(?!#).)*$|^(?:(?!#).)*(?=#)", "", text, flags=re.M)
    text = re.sub(r"\n[ \t]*\n", "\n.\n", text)  # a paragraph ends a citation
    return re.sub(r"\s*\n[ \t]*(?://+<?|#|\*)?[ \t]*", " ", re.sub(r"^[ \t]*(?://+|#)[ \t]*", "", text, flags=re.M))


def citations(text):
    """[(first author or body, year or number, the words)] that the text cites."""
    found = []
    for pattern in (LONG, SHORT):
        def take(match):
            first = re.split(r", | and | et al", match["names"])[0]
            if first in NO_NAMES or first.upper() == first:
                return match[0]
            found.extend((first, year, match[0]) for year in re.findall(YEAR, match["years"]))
            return " ; "
        text = pattern.sub(take, text)
    found += [(match["body"], match["number"], match[0]) for match in STANDARD.finditer(text)]
    return found


def proses():
    """{file: its prose} of the repository, these tests left out."""
    return {str(path.relative_to(repository.SOURCE)): prose(path, path.read_text())
            for path in repository.files(".cpp", ".hpp", ".py", ".md", ".cmake", ".txt", "")
            if path.parent != repository.SOURCE / "tests/docs" and path.name != "LICENSE"}


def cited(texts):
    """{(first author, year): [(file, words)]} of what proses() returned."""
    found = collections.defaultdict(list)
    for path, text in texts.items():
        for first, year, words in citations(text):
            found[first, year].append((path, words))
    return found


def entries(text):
    """[{field: value}] of a .bib, with `key` and `kind`; ValueError with the line of a syntax error."""
    found = []
    for part in re.split(r"^@", text, flags=re.M)[1:]:
        head = re.match(r"(\w+)\{(\w+),\s*", part)
        if not head or part.count("{") != part.count("}"):
            raise ValueError(f"references.bib: '@{part.splitlines()[0]}': no key, or braces that do not match")
        fields = dict(re.findall(r"(\w+) = \{((?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*)\}", part[head.end():]))
        found.append({"kind": head[1], "key": head[2], **fields})
    return found


def first_author(entry):
    """Family name of the first author, or the body of a standard."""
    return entry.get("author", "").split(" and ")[0].split(",")[0]


def by_name(entry, text):
    """Whether the authors (or the title) of an entry are named in the text."""
    if entry.get("keywords") == "by title":
        return re.sub("[{}]", "", entry["title"]) in text.replace("*", "")
    families = [author.split(",")[0] for author in entry["author"].split(" and ")]
    return re.search(r"\b" + " and ".join(families), text) is not None


REQUIRED = {"article": ("author", "title", "journal", "year", "volume", "pages"), "book": ("author", "title"),
            "inproceedings": ("author", "title", "booktitle", "year"), "incollection": ("author", "title", "booktitle", "year"),
            "techreport": ("author", "title", "institution", "year"), "standard": ("author", "title", "number"),
            "manual": ("author", "title"), "misc": ("title",)}
NO_PAGES = {"gao2008", "chen2008", "ausas2009"}  # the journal numbers articles


def complaints(listed, found, text):
    """Inconsistencies, one sentence each: entries, {(first author, year): [(file, words)]}, all prose."""
    wrong, keys = [], collections.Counter(entry["key"] for entry in listed)
    wrong += [f"the key {key} comes {count} times" for key, count in keys.items() if count > 1]
    known = collections.defaultdict(list)
    for entry in listed:
        known[first_author(entry), entry.get("number" if entry["kind"] == "standard" else "year")].append(entry)
        missing = [field for field in REQUIRED[entry["kind"]] if field not in entry
                   and not (field == "pages" and entry["key"] in NO_PAGES)]
        if missing:
            wrong.append(f"{entry['key']} lacks {', '.join(missing)}")
    for (first, year), found_in in sorted(found.items()):
        if (first, year) not in known:
            wrong.append(f"{found_in[0][0]} cites '{found_in[0][1].strip()}', which has no entry of {first} {year}")
    wrong += [f"{entry['key']} is cited nowhere" for author_year, group in known.items() for entry in group
              if author_year not in found and not ("keywords" in entry and by_name(entry, text))]
    return wrong


class References(unittest.TestCase):
    def test_each_citation_has_an_entry_and_each_entry_is_cited(self):
        texts = proses()
        found = cited(texts)
        self.assertGreater(len(found), 80)
        wrong = complaints(entries(BIB.read_text()), found, " ".join(texts.values()))
        self.assertEqual(wrong, [], "\ndocs/references.bib:\n  " + "\n  ".join(wrong))

    def test_citations_are_recognised(self):
        for text, expected in {
                "(Guyan 1965)": [("Guyan", "1965")], "Craig and Bampton (1968)": [("Craig", "1968")],
                "Grimes, Lewis and Simon, 1994;": [("Grimes", "1994")], "Bank et al. 1985": [("Bank", "1985")],
                "Demmel and others 2006": [("Demmel", "2006")], "Patir and Cheng 1978, 1979": [("Patir", "1978"), ("Patir", "1979")],
                "Johnen, Remacle, Geuzaine, J. Comput. Phys. 233, 2013": [("Johnen", "2013")],
                'Klingner, Shewchuk, "Aggressive tetrahedral improvement", Proc. 16th Int. Meshing Roundtable (2007)': [("Klingner", "2007")],
                "L'Excellent 2001": [("L'Excellent", "2001")], "ISO/TS 7849": [("ISO", "7849")],
                "IEC 61260-1:2014": [("IEC", "61260-1")], "Lanczos, in 2016 steps; expected at most 2000": [],
                "OpenBLAS 2019": [], "29 June 2007": [], "found 1900": []}.items():
            with self.subTest(text=text):
                self.assertEqual([item[:2] for item in citations(text)], expected)

    def test_comments_are_unwrapped_and_code_is_not_read(self):
        source = repository.SOURCE / "x.hpp"
        text = "Guyan 1965;\n/// (Craig and\n/// Bampton 1968)\nx; // Liu\n// 1992"
        self.assertEqual([item[:2] for item in citations(prose(source, text))], [("Craig", "1968"), ("Liu", "1992")])

    def test_errors_are_reported(self):
        bib = ("@article{guyan1965,\n author = {Guyan, R.},\n title = {A {B} C}, journal = {J}, year = {1965},\n volume = {3}\n}\n"
               "@book{ocvirk,\n author = {Ocvirk, F.},\n title = {T}, keywords = {by name}\n}\n"
               "@standard{iso,\n author = {ISO},\n title = {T}, number = {1683}\n}\n")
        found = {("Liu", "1992"): [("a.hpp", "Liu 1992")], ("ISO", "1683"): [("b.hpp", "ISO 1683")]}
        self.assertEqual(complaints(entries(bib), found, "as Ocvirk says"), [
            "guyan1965 lacks pages", "a.hpp cites 'Liu 1992', which has no entry of Liu 1992", "guyan1965 is cited nowhere"])
        with self.assertRaisesRegex(ValueError, "braces that do not match"):
            entries("@book{a,\n title = {x\n}\n")


if __name__ == "__main__":
    if "--list" in sys.argv:
        for (first, year), found_in in sorted(cited(proses()).items()):
            print(f"{first} {year}: {found_in[0][1]}   [{', '.join(sorted({where for where, _ in found_in}))}]")
        sys.exit()
    unittest.main(verbosity=2)
