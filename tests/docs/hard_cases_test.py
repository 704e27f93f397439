# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/hard-cases.md, the tests named after its cases, and the citations in the sources agree."""
import re
import sys
import unittest

import repository

sys.path.insert(0, str(repository.SOURCE / "tests/hard"))
from hard_list import CASE, HEAD, entries, listed, not_covered, sorting_key  # noqa: E402

LIST = repository.SOURCE / "docs/hard-cases.md"
# `hard case B3`, `hard cases G4, G9`, `Hard cases M1 to M5`, `(hard cases A4, C1, C2; H1)`
CITATION = re.compile(rf"\b[Hh]ard[- ]cases?\s+({CASE}(?:(?:,| and| to|;)\s+{CASE})*)\b")


def cases_of(test):
    """Cases in the name of a test."""
    return re.findall(rf"(?:\b|_)[Hh]ard({CASE})(?=_|\b|[A-Z])", ".".join(test))


def joined(text):
    """The text with its comments unwrapped, so that a citation may run over a line."""
    return re.sub(r"\n[ \t]*(?://+|#|\*)?[ \t]*", " ", text)


def citations(text):
    """Cases that a source cites."""
    return [case for match in CITATION.findall(joined(text)) for case in re.findall(CASE, match)]


def complaints(text, tests, cited):
    """Inconsistencies, one sentence each. `tests`: [(suite, case)], `cited`: {case: file that cites it}."""
    listed, without = entries(text), not_covered(text)
    known = {name for suite, case in tests for name in (suite, f"{suite}.{case}")}
    wrong = []
    for case, names in listed.items():
        if not re.fullmatch(CASE, case):
            wrong.append(f"the heading '{case}' does not begin with letters and a number")
        if not names:
            wrong.append(f"{case} names no test: say 'Tests: `Suite.Case`' or move it to '{HEAD[3:]}'")
        wrong += [f"{case} names the test {name}, which does not exist" for name in names if name not in known]
        if case in without:
            wrong.append(f"{case} has an entry and is in the table '{HEAD[3:]}' as well")
    for suite, name in sorted(tests):
        for case in cases_of((suite, name)):
            if not {suite, f"{suite}.{name}"} & set(listed.get(case, [])):
                wrong.append(f"the test {suite}.{name} is not named under {case}" if case in listed
                             else f"the test {suite}.{name} is named after {case}, which has no entry")
    wrong += [f"{path} cites hard case {case}, which is not in the list" for case, path in sorted(cited.items())
              if case not in listed and case not in without]
    return wrong


class HardCases(unittest.TestCase):
    def test_list_tests_and_citations_agree(self):
        cited = {}
        for path in repository.files(".cpp", ".hpp", ".py", ".md", ".txt", ".cmake", ".in"):
            if path != LIST and path.name != "hard_cases_test.py":
                cited.update({case: str(path.relative_to(repository.SOURCE)) for case in citations(path.read_text())})
        self.assertGreater(len(cited), 30)
        tests = repository.all_tests()
        self.assertGreater(len([test for test in tests if cases_of(test)]), 100)
        wrong = complaints(LIST.read_text(), tests, cited)
        self.assertEqual(wrong, [], "\ndocs/hard-cases.md:\n  " + "\n  ".join(wrong))

    def test_cases_come_once_and_in_order(self):
        text = LIST.read_text()
        heads = re.findall(rf"^### ({CASE})", text, re.M)
        self.assertEqual(heads, sorted(heads, key=sorting_key))
        self.assertEqual(len(heads), len(set(heads)))

    def test_every_entry_says_what_goes_wrong_and_what_must_happen(self):
        for entry in listed(LIST.read_text()):
            with self.subTest(case=entry.case):
                self.assertTrue(entry.title and entry.must)

    def test_whoever_names_the_file_names_the_one_in_docs(self):
        for path in repository.files(".cpp", ".hpp", ".py", ".md", ".txt", ".cmake"):
            text = path.read_text()
            for match in re.finditer(r"(\S*)hard-cases\.md", text):
                with self.subTest(line=repository.line_of(path, text, match.start())):
                    self.assertTrue(match[1].endswith("docs/") or path.parent == LIST.parent, match[0])

    def test_errors_are_reported(self):
        text = ("### A1 One\n\nTests: `HardA1`, `Gone.Case`\n\n### A2 Two\n\n### A4 Four\n\nTests: `HardA1`\n\n"
                "### AB12 Of two letters\n\nTests: `HardAB12_Two`\n\n"
                f"{HEAD}\n\n| case | |\n|---|---|\n| A3 | x |\n| A4 | y |\n")
        tests = [("HardA1", "Holds"), ("Other", "HardA2_Holds"), ("HardZ9Python", "test_it"),
                 ("Linking", "test_hardA3_x"), ("HardPlate", "test_of_bricks"), ("HardAB12_Two", "Holds"),
                 ("Late", "HardAB12_Too")]
        self.assertEqual(complaints(text, tests, {"A1": "a.cpp", "A3": "b.cpp", "B7": "c.cpp"}), [
            "A1 names the test Gone.Case, which does not exist",
            "A2 names no test: say 'Tests: `Suite.Case`' or move it to 'Not covered yet'",
            "A4 has an entry and is in the table 'Not covered yet' as well",
            "the test HardZ9Python.test_it is named after Z9, which has no entry",
            "the test Late.HardAB12_Too is not named under AB12",
            "the test Linking.test_hardA3_x is named after A3, which has no entry",
            "the test Other.HardA2_Holds is not named under A2",
            "c.cpp cites hard case B7, which is not in the list"])

    def test_citations_are_found_over_the_end_of_a_line(self):
        text = "/// dropped (hard\n/// case B3).\n# Hard cases M1 to M5, and (hard cases A4,\n# C1; H1, TD12) but no hard cases of T."
        self.assertEqual(citations(text), ["B3", "M1", "M5", "A4", "C1", "H1", "TD12"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
