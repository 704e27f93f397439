# SPDX-License-Identifier: GPL-3.0-or-later
"""Each message that docs/faq.md quotes is one that the sources print."""
import re
import unittest

import repository

PIECE = r'f?"(?:[^"\\\n]|\\.)*"'
LITERAL = re.compile(rf"{PIECE}(?:\s*{PIECE})*")
LEAST = 24         # characters of a literal besides its placeholders: shorter ones fit many messages
LEAST_SHARE = 0.3  # of the message: the rest are names and numbers


def messages(text):
    """The blocks ```text of the page, one message each."""
    return re.findall(r"^```text\n(.*?)\n```$", text, re.M | re.S)


def literals(text):
    """The texts of a C++ or Python source, adjacent ones joined."""
    for found in LITERAL.findall(text):
        yield re.sub(r"\\(.)", r"\1", "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', found)))


def fixed_words(literal):
    """The parts of a format string between its placeholders."""
    known = {"{{": "{", "}}": "}"}
    return re.sub(r"\{\{|\}\}|\{(?:[^{}]|\{[^{}]*\})*\}", lambda found: known.get(found[0], "\0"), literal).split("\0")


def prints(literal, message):
    """Whether a message may come from this format string: its fixed words are there in this order, and are much of it."""
    parts = fixed_words(literal)
    if len("".join(parts)) < max(LEAST, LEAST_SHARE * len(message)):
        return False
    at = 0
    for part in parts:
        at = message.find(part, at)
        if at < 0:
            return False
        at += len(part)
    return True


def unknown(quoted, sources):
    """The quoted messages that no source prints."""
    known = {literal for text in sources for literal in literals(text)}
    return [message for message in quoted if not any(prints(literal, message) for literal in known)]


class Questions(unittest.TestCase):
    def test_each_message_is_printed_by_a_source(self):
        quoted = messages((repository.SOURCE / "docs/faq.md").read_text())
        self.assertGreaterEqual(len(quoted), 25)
        ours = [path for path in repository.files(".cpp", ".hpp", ".py")
                if path.relative_to(repository.SOURCE).parts[0] not in ("tests", "docs", "bench", "samples")]
        self.assertEqual(unknown(quoted, [path.read_text() for path in ours]), [])

    def test_a_message_that_changed_is_found(self):
        source = 'throw InputError(fmt::format("{}: found {:g} modes below the limit, "\n  "expected at least {}", a, b, c));\n'
        good = "x.h5: found 3 modes below the limit, expected at least 4"
        self.assertEqual(unknown([good], [source]), [])
        for changed in (good.replace("below", "under"), good.replace("at least", "at most"), "found 3", good + " of this file" * 20):
            self.assertEqual(unknown([changed], [source]), [changed])
        self.assertEqual(list(literals(r'f"a \"{b}\"" "c"')), ['a "{b}"c'])
        self.assertEqual(fixed_words("{{{:.3g}}} of {x:{width}}"), ["{", "} of ", ""])


if __name__ == "__main__":
    unittest.main(verbosity=2)
