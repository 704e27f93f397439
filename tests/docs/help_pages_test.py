# SPDX-License-Identifier: GPL-3.0-or-later
"""Man pages and the completion of bash are what `make help-pages` writes from the programs' help."""
import subprocess
import unittest

import commands
import repository
from clatter_tools import help_pages

TOOLS = repository.SOURCE / "tools"
HELP = """Does one thing.
Usage: clatter-x [OPTIONS] part

Positionals:
  part TEXT REQUIRED          what is read
                              and how

Options:
  -h,--help                   Print this
  --a-very-long-option-name TEXT
                              its meaning

Commands (each has --help):
  list                        Lists it.

.a line that troff would take for a request
"""


class Pages(unittest.TestCase):
    def test_the_pages_are_those_of_the_programs(self):
        if not (commands.BIN / "clatter-mesh").exists():
            self.skipTest("the programs are not built")
        for path, text in help_pages.pages(TOOLS).items():
            with self.subTest(page=path):
                self.assertEqual((TOOLS / path).read_text(), text, "make help-pages writes it again")

    def test_help_is_taken_apart(self):
        summary, usage, sections, free = help_pages.parts_of(HELP)
        self.assertEqual((summary, usage), ("Does one thing.", "clatter-x [OPTIONS] part"))
        self.assertEqual(sections["Positionals"], [["part TEXT REQUIRED", "what is read and how"]])
        self.assertEqual(sections["Options"], [["-h,--help", "Print this"], ["--a-very-long-option-name TEXT", "its meaning"]])
        self.assertEqual(sections["Commands"], [["list", "Lists it."]])
        self.assertEqual(help_pages.block(free), ".PP\n.nf\n\\&.a line that troff would take for a request\n.fi\n")

    def test_every_command_is_described_by_hand_too(self):
        page = (TOOLS / "man/clatter.1").read_text().partition(".SH DESCRIPTION")[2].partition(".SH OPTIONS")[0]
        for name in help_pages.commands():
            self.assertIn(f".B {help_pages.roff(name)}\n", page)

    def test_no_line_of_a_page_is_an_unknown_request(self):
        known = {"TH", "SH", "SS", "TP", "PP", "B", "I", "BR", "IR", "RB", "RI", "br", "nf", "fi", '\\"'}
        for path in (TOOLS / "man").glob("*.1"):
            for line in path.read_text().splitlines():
                if line[:1] in (".", "'"):
                    self.assertIn(line[1:].split(" ")[0], known, f"{path.name}: {line}")


class Completion(unittest.TestCase):
    def complete(self, *words):
        script = (f"source '{TOOLS}/completion/clatter'; COMP_WORDS=({' '.join(map(repr, words))}); COMP_CWORD={len(words) - 1}; _clatter; "
                  "echo \"${COMPREPLY[@]}\"")
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_commands_options_and_choices_are_completed(self):
        self.assertEqual(self.complete("clatter", "do"), ["doctor"])
        self.assertEqual(self.complete("tools/clatter", "ne"), ["new"])
        self.assertEqual(self.complete("clatter", "new", "--k"), ["--kind"])
        self.assertEqual(self.complete("clatter", "new", "--kind", ""), ["part", "slap", "drive"])
        self.assertIn("run", self.complete("clatter", "schema", "r"))
        self.assertEqual(self.complete("clatter", "info", "x"), [])  # bash completes files then


if __name__ == "__main__":
    unittest.main(verbosity=2)
