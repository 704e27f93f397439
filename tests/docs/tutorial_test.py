# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of docs/tutorial do what they say: their commands are run, and what these print is compared (tutorial.py)."""
import pathlib
import re
import sys
import tempfile
import unittest

import repository
import tutorial

sys.path.insert(0, str(repository.SOURCE / "tests/cli"))
import stages  # noqa: E402

PAGES = repository.SOURCE / "docs/tutorial"


class Page(unittest.TestCase):
    name = ""

    def run_page(self):
        stages.require_stages()
        missing = tutorial.run_page(PAGES / self.name)
        if missing:
            self.skipTest(f"{self.name}: all but the commands that need {', '.join(missing)}, which make build-mpi builds")


class Beam(Page):
    name = "1-beam.md"

    def test_the_page_is_what_its_commands_do(self):
        self.run_page()


class CadPart(Page):
    name = "2-cad-part.md"

    def test_the_page_is_what_its_commands_do(self):
        self.run_page()


class Deck(Page):
    name = "3-deck.md"

    def test_the_page_is_what_its_commands_do(self):
        self.run_page()


class PistonSlap(Page):
    name = "4-piston-slap.md"

    def test_the_page_is_what_its_commands_do(self):
        self.run_page()


class TimingDrive(Page):
    name = "5-timing-drive.md"

    def test_the_page_is_what_its_commands_do(self):
        self.run_page()


class Sound(Page):
    name = "6-sound.md"

    def test_the_page_is_what_its_commands_do(self):
        self.run_page()


class Accuracy(Page):
    name = "7-accuracy.md"

    def test_the_page_is_what_its_commands_do(self):
        self.run_page()


class Cluster(Page):
    name = "8-cluster.md"

    def test_the_page_is_what_its_commands_do(self):
        self.run_page()


class WholeEngine(Page):
    name = "9-whole-engine.md"

    def test_the_page_is_what_its_commands_do(self):
        self.run_page()


class Pages(unittest.TestCase):
    def test_each_page_is_in_the_index_and_is_run_by_a_registered_test(self):
        registered = re.findall(r"clatter_python_test\(tutorial_test (?:pipeline|long) (\w+)\)",
                                (repository.SOURCE / "tests/docs/CMakeLists.txt").read_text())
        run = [kind.name for kind in Page.__subclasses__() if kind.__name__ in registered]
        pages = sorted(path.name for path in PAGES.glob("*.md") if path.name != "README.md")
        self.assertEqual(sorted(run), pages)
        self.assertEqual(sorted(re.findall(r"\]\((\d[\w-]+\.md)\)", (PAGES / "README.md").read_text())), pages)

    def test_each_picture_belongs_to_a_page(self):
        shown = {path.parent / name for path in PAGES.glob("*.md") for name in tutorial.IMAGE.findall(path.read_text())}
        self.assertEqual(sorted(shown), sorted(PAGES.glob("**/*.png")))


def console(*lines, before="", quote=""):
    return before + "".join(f"{quote}{line}\n" for line in ("```console", *lines, "```"))


class Runner(unittest.TestCase):
    """The runner itself, with pages that need no program of clatter."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="clatter-tutorial-test-")
        self.addCleanup(scratch.cleanup)
        self.page = pathlib.Path(scratch.name) / "page.md"

    def run_text(self, text, **options):
        self.page.write_text(text)
        return tutorial.run_page(self.page, **options)

    def assert_differs(self, text, *says):
        with self.assertRaises(tutorial.Differs) as caught:
            self.run_text(text)
        for part in says:
            self.assertIn(part, str(caught.exception))

    def test_a_page_that_is_right_passes(self):
        self.run_text("`a/b.txt`:\n\n```\none 1.5\ntwo\nthree\n```\n\n" +
                      console("$ cat a/b.txt", "one   1.5001", "...", "three", "$ cd a", "$ ls |", ">   sort", "b.txt") +
                      console("$ ls", "b.txt", quote="> "))

    def test_a_number_beyond_its_tolerance_fails(self):
        printed = "$ echo 440.02 Hz, 3 modes, residual 5e-8, error 2.5e-05, 12.34 s"
        self.run_text(console(printed, "440.03 Hz, 3 modes, residual 3e-10, error 1.0e-05, 77.10 s"))
        self.assert_differs(console(printed, "441.03 Hz, 3 modes, residual 5e-8, error 2.5e-05, 12.34 s"), "line 2", "440.02 instead of 441.03")
        self.run_text(console(printed, "441.03 Hz, 3 modes, residual 5e-8, error 2.5e-05, 12.34 s", before="<!-- tolerance 1e-2 -->\n"))
        self.assert_differs(console(printed, "440.02 Hz, 4 modes, residual 5e-8, error 2.5e-05, 12.34 s"), "3 instead of 4")
        self.assert_differs(console(printed, "440.02 Hz, 3 modes, residual 5e-8, error 2.0e-06, 12.34 s"), "2.5e-05 instead of 2.0e-06")

    def test_words_signs_and_lines_that_differ_fail(self):
        self.assert_differs(console("$ echo all is well", "all is good"), "expected: all is good", "found:    all is well")
        self.assert_differs(console("$ echo -1.0 dB", "1.0 dB"), "-1.0 instead of 1.0")
        self.assert_differs(console("$ echo one", "one", "two"), "expected: two")
        self.assert_differs(console("$ printf 'one\\ntwo\\n'", "one"), "printed as well", "two")
        self.assert_differs(console("$ printf 'one\\ntwo\\n'", "...", "three"), "expected: three")
        self.assert_differs(console("$ echo 7 modes in 3 s", "8 modes ..."), "7 instead of 8")
        self.assert_differs(console("$ echo 5 modes", "# modes"), "expected: # modes")
        self.run_text(console("$ echo '# 5 modes: 3 Hz'", "# 5 modes: ..."))

    def test_a_command_that_fails_or_should_have_failed_fails(self):
        self.assert_differs(console("$ echo oh no; exit 3"), "exit code 3, expected 0", "oh no")
        self.assert_differs(console("$ true", before="<!-- exit code 2 -->\n"), "exit code 0, expected 2")
        self.run_text(console("$ true", "$ echo bad key >&2; exit 2", "bad key", before="<!-- exit code 2 -->\n"))
        self.assert_differs(console("$ echo bad key >&2; exit 2", "good key", before="<!-- exit code 2 -->\n"), "good key")

    def test_a_block_that_needs_a_missing_program_is_left_out_and_said(self):
        left_out = console("$ no-such-program", "never", before="<!-- needs no-such-program -->\n")
        self.assertEqual(self.run_text(console("$ echo one", "one") + "\n" + left_out), ["no-such-program"])
        self.assertEqual(self.run_text(console("$ echo one", "one", before="<!-- needs bash -->\n")), [])
        self.assert_differs(console("$ echo one", "two", before="<!-- needs bash -->\n"), "expected: two")
        self.assert_differs(left_out + "\n" + console("$ echo one", "two"), "expected: two")

    def test_a_block_that_is_not_run_fails(self):
        self.assert_differs(console("$ true") + "\n```sh\nrm x\n```\n", "line 5", "neither a file nor a console")
        self.assert_differs("Words.\n", "no block")
        self.assert_differs("```console\n$ true\n", "does not end")
        self.assert_differs("```console\ntrue\n```\n", "expected a command")

    def test_a_page_continues_in_the_folder_of_another_one(self):
        (self.page.parent / "first.md").write_text("`a.txt`:\n\n```\none\n```\n\n" + console("$ cp a.txt b.txt", "what it prints is not compared") +
                                                   "\n## Later\n\n" + console("$ rm b.txt"))
        self.run_text('<!-- continues first.md before "Later" -->\n' + console("$ cat b.txt", "one"))
        self.assert_differs('<!-- continues first.md before "Never" -->\n' + console("$ true"), "first.md: found no heading Never")

    def test_a_picture_that_no_command_makes_fails(self):
        (self.page.parent / "a.png").write_bytes(b"\x89PNG")
        text = "![a](a.png)\n\n"
        self.run_text(text + console("$ printf '\\x89PNG' > a.png"))
        self.assert_differs(text + console("$ true"), "no command of the page writes the picture a.png")
        (self.page.parent / "a.png").write_bytes(bytes(tutorial.LARGEST_PICTURE + 1))
        self.assert_differs(text + console("$ printf '\\x89PNG' > a.png"), "a.png is larger")

    def test_write_renews_numbers_keeps_what_is_elided_and_makes_the_page_pass(self):
        commands = console("$ printf 'a 1.5\\nb 2.5 x\\nc 3.5 y\\n'", "a 1.0", "...", "c 3.0 ...",
                           "$ echo new words in /tmp/x/a.h5", "old words", "$ echo kept 2.0001", "kept 2.0", quote="> ")
        self.run_text("`n.txt`:\n\n```\nx\n```\n\n" + commands, write=True)
        self.assertIn("> a 1.5\n> ...\n> c 3.5 ...\n> $ echo new words in /tmp/x/a.h5\n> new words in ...\n"
                      "> $ echo kept 2.0001\n> kept 2.0\n> ```\n", self.page.read_text())
        tutorial.run_page(self.page)

    def test_lines_that_a_page_would_take_for_commands_are_refused(self):
        self.assert_differs(console("$ echo '$ rm'", "..."), "which a page takes for commands")


if __name__ == "__main__":
    unittest.main(verbosity=2)
