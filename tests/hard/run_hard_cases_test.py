# SPDX-License-Identifier: GPL-3.0-or-later
"""`make hard`: which tests it runs for an entry, what it says about them, and when it fails."""
import contextlib
import io
import json
import math
import pathlib
import sys
import tempfile
import textwrap
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import hard_list  # noqa: E402
import jobs  # noqa: E402
import observations  # noqa: E402
import results  # noqa: E402
import run_hard_cases  # noqa: E402

LIST = """# Hard cases

## A. Letters

### A1 One <thing> that is `wrong`

It goes [wrong](https://example.org/a).

Must: it is right,
in two lines.

Tests: `HardA1`, `Other.HardA1_Holds`

### A2 Two

Must: it is refused.

Tests: `HardA2`

## B. Others

### B10 Ten

Must: ten.

Tests: `Gone`

## Not covered yet

| case | | |
|---|---|---|
| C1 | x | y |
"""


def google(choice, program="/bin/unit", labels=("hard",)):
    """A GoogleTest case as CTest lists it."""
    return {"name": choice, "command": [program, f"--gtest_filter={choice}", "--gtest_also_run_disabled_tests"],
            "properties": [{"name": "LABELS", "value": list(labels)}, {"name": "TIMEOUT", "value": 30.0},
                           {"name": "WORKING_DIRECTORY", "value": "/tmp"}]}


class List(unittest.TestCase):
    def test_entries_have_texts_and_tests(self):
        one, two, ten = hard_list.listed(LIST)
        self.assertEqual((one.case, one.title, one.must), ("A1", "One <thing> that is `wrong`", "it is right, in two lines."))
        self.assertEqual(one.wrong, "It goes [wrong](https://example.org/a).")
        self.assertEqual(one.tests, ("HardA1", "Other.HardA1_Holds"))
        self.assertEqual((two.wrong, ten.case, hard_list.not_covered(LIST)), ("", "B10", ["C1"]))

    def test_selection_by_case_and_by_letters(self):
        entries = hard_list.listed(LIST)
        self.assertEqual([one.case for one in run_hard_cases.chosen(entries, ["B", "A2"])], ["A2", "B10"])
        self.assertEqual(len(run_hard_cases.chosen(entries, [])), 3)
        with self.assertRaisesRegex(ValueError, "no case B1, C"):
            run_hard_cases.chosen(entries, ["A", "B1", "C"])


class Figures(unittest.TestCase):
    def test_margins_by_hand(self):
        for text, margin in (("error: 2e-13 (at most 1e-09)", 5000.0), ("MAC: 0.99 (at least 0.9)", 1.1), ("error: 0 (at most 1)", math.inf),
                             ("drift: -3 (at most 1)", math.inf), ("sum: -2 (at most -1)", None), ("error: nan (at most 1)", None),
                             ("error: 2 (at most inf)", math.inf), ("refused: file: 3 (of 4)", None)):
            with self.subTest(text=text):
                found = observations.margin(text)
                self.assertEqual(found, None) if margin is None else self.assertAlmostEqual(found, margin)

    def test_the_figure_nearest_to_its_limit_comes_first(self):
        seen = observations.observations("noise\n[ observed ] a: 1 (at most 10)\nx[ observed ] refused: b\n"
                                         "[ observed ] c: 3 (at least 2)\n[ observed ] a: 1 (at most 10)\n")
        self.assertEqual([one.text for one in seen], ["a: 1 (at most 10)", "refused: b", "c: 3 (at least 2)"])
        self.assertEqual(observations.tightest(seen).text, "c: 3 (at least 2)")
        self.assertEqual(observations.tightest(seen[1:2]).text, "refused: b")
        self.assertIsNone(observations.tightest([]))

    def test_names_of_scratch_folders_are_left_out(self):
        seen = observations.observations(f"[ observed ] refused: {tempfile.gettempdir()}/clatter-x1/small/a.h5: full, /data/b.h5\n")
        self.assertEqual(seen[0].text, "refused: a.h5: full, /data/b.h5")

    def test_margins_are_short(self):
        self.assertEqual([observations.margin_text(value) for value in (1.25, 47.3, 2e5, math.inf, None)],
                         ["1.2", "47", "2e+05", "no limit near", ""])


class Jobs(unittest.TestCase):
    def test_one_process_for_each_program_with_the_cases_of_the_entry(self):
        listed = [google("HardA1.One"), google("HardA1.Two"), google("Sizes/Other.HardA1_Holds/3"), google("HardA1/1.Typed"),
                  google("HardA10.No"), google("HardA1.Late", program="/bin/late", labels=("long",))]
        registered = [jobs.registered(one) for one in listed]
        found, missing = jobs.jobs_of(("HardA1", "Other.HardA1_Holds", "Gone"), registered)
        self.assertEqual([job.command for job in found],
                         [("/bin/unit", "--gtest_filter=HardA1.One:HardA1.Two:HardA1/1.Typed:Sizes/Other.HardA1_Holds/3"),
                          ("/bin/late", "--gtest_filter=HardA1.Late")])
        self.assertEqual(missing, ["Gone"])
        self.assertEqual(len(jobs.jobs_of(("HardA1",), registered, with_long=False)[0]), 1)

    def test_python_files_run_the_classes_that_ctest_registered(self):
        with tempfile.TemporaryDirectory() as scratch:
            script = pathlib.Path(scratch) / "some_test.py"
            script.write_text("class HardA1:\n    def test_x(self): pass\n    def test_y(self): pass\nclass Late:\n    def test_z(self): pass\n")
            listed = [{"name": "x", "command": ["/usr/bin/python3", "-B", str(script), "-v", "HardA1"],
                       "properties": [{"name": "ENVIRONMENT", "value": ["A=b"]}]}]
            registered = [jobs.registered(one) for one in listed]
        found, missing = jobs.jobs_of(("HardA1.test_y", "Late"), registered)
        self.assertEqual(found[0].command[2:], (str(script), "HardA1.test_y"))
        self.assertEqual((found[0].environment, missing), (("A=b",), ["Late"]))

    def test_counts_of_both_kinds_of_tests(self):
        for output, code, ran, skipped, failed in (
                ("[==========] 3 tests from 2 test suites ran. (4 ms total)\n[  SKIPPED ] 1 test, listed below:\n", 0, 2, 1, False),
                ("Ran 4 tests in 0.1s\n\nOK (skipped=4)\n", 0, 0, 4, False), ("Ran 4 tests in 0.1s\n\nFAILED (failures=1, skipped=1)\n", 1, 3, 1, True),
                ("not built\n", jobs.SKIPPED, 0, 0, False), ("Segmentation fault\n", -11, 0, 0, True)):
            with self.subTest(output=output):
                found = jobs.outcome(output, code)
                self.assertEqual((found.ran, found.skipped, found.failed), (ran, skipped, failed))

    def test_a_process_that_does_not_end_is_stopped(self):
        stuck = jobs.run(jobs.Job(("/bin/sh", "-c", "echo begun; sleep 60"), (), "/", 0.5, ()))
        self.assertTrue(stuck.failed)
        self.assertIn("begun\n\nstopped after 0 s", stuck.output)


class Run(unittest.TestCase):
    """The runner on the list above, with test files of its own."""

    def run_list(self, first, *arguments):
        """(exit code, lines, folder) of a run in which the test of A1 does `first`."""
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        folder = pathlib.Path(scratch.name)
        (folder / "docs").mkdir()
        (folder / "tools/clatter_tools/page").mkdir(parents=True)
        (folder / "tools/clatter_tools/page/page.css").write_text("td { color: red; }")
        (folder / "docs/hard-cases.md").write_text(LIST.replace("`Gone`", "`HardA2`"))
        script = folder / "some_test.py"
        script.write_text(textwrap.dedent(f"""
            import unittest
            class HardA1(unittest.TestCase):
                def test_x(self):
                    {first}
            class Other(unittest.TestCase):
                def test_HardA1_Holds(self):
                    print("[ observed ] refused: a | <b>")
            class HardA2(unittest.TestCase):
                def test_z(self):
                    pass
            unittest.main()
            """))
        registered = [jobs.registered({"name": "x", "command": ["/usr/bin/python3", "-B", str(script)], "properties": []})]
        said = io.StringIO()
        with mock.patch.object(run_hard_cases, "SOURCE", folder), contextlib.redirect_stdout(said), \
                mock.patch.object(jobs, "registered_tests", lambda build: registered), \
                mock.patch.object(hard_list, "paragraph", lambda word, body, old=hard_list.paragraph:
                                  old(word, body).replace("Other.HardA1_Holds", "Other.test_HardA1_Holds")):
            code = run_hard_cases.main([str(folder), "--jobs", "2", "--output", str(folder / "out"), *arguments])
        return code, said.getvalue().splitlines(), folder

    def test_a_line_for_each_case_and_a_page(self):
        code, lines, folder = self.run_list('print("[ observed ] error: 2 (at most 8)")')
        self.assertEqual(code, 0, lines)
        self.assertRegex(lines[0], r"^A1   One <thing> that is `wrong`  \|  error: 2 \(at most 8\)  \|  margin 4  \|  ok  \d+\.\d s$")
        self.assertRegex(lines[1], r"^A2   Two  \|  held, 1 test  \|  ok ")
        self.assertEqual(lines[-1], "3 cases, 3 held, 4 tests")
        found = json.loads((folder / "out/hard.json").read_text())
        self.assertEqual([one["case"] for one in found], ["A1", "A2", "B10"])
        self.assertEqual((found[0]["margin"], len(found[0]["observed"]), found[0]["must"]), (4.0, 2, "it is right, in two lines."))
        page = (folder / "out/index.html").read_text()
        for text in ("One &lt;thing&gt; that is `wrong`", "refused: a | &lt;b&gt;", "error: 2 (at most 8), margin 4", "It goes wrong."):
            self.assertIn(text, page)
        self.assertNotRegex(page, r'(?:src|href)="(?!data:)')

    def test_a_test_that_fails_makes_the_run_fail_and_is_shown(self):
        code, lines, folder = self.run_list('self.fail("it fell over")')
        self.assertEqual(code, 1)
        self.assertIn("FAILED", lines[0])
        self.assertTrue(any("it fell over" in line for line in lines))
        self.assertEqual(lines[-1], "3 cases, 2 held, 4 tests; failed: A1")

    def test_a_case_of_which_no_test_ran_fails(self):
        code, lines, _ = self.run_list('self.skipTest("not here")', "--cases", "B")
        self.assertEqual(code, 0)
        entry = hard_list.listed(LIST)[1]
        self.assertEqual(results.result(entry, [jobs.Outcome(0, 2, False, "")], [], 1.0).trouble, "no test ran, 2 skipped")
        self.assertEqual(results.result(entry, [], ["HardA2"], 0.0).trouble, "no test is registered for HardA2")
        self.assertEqual(results.result(entry, [jobs.Outcome(1, 0, False, "")], [], 1.0).trouble, "")


if __name__ == "__main__":
    unittest.main(verbosity=2)
