# SPDX-License-Identifier: GPL-3.0-or-later
"""The site of `make docs`: it contains every document, and its links lead somewhere. Doxygen is not needed."""
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

import repository

sys.path.insert(0, str(repository.SOURCE / "docs/site"))
import check
import links
import navigation

HAS_MARKDOWN = importlib.util.find_spec("markdown_it") is not None
FILES = ["README.md", "docs/design.md", "docs/a.png", "samples/beam/README.md", "samples/beam/beam.fe.toml",
         "core/base/error.hpp", "mesh/a/sets.cpp", "mesh/b/sets.cpp"]
HEADERS = {"core/base/error.hpp": "api/error_8hpp.html"}


def relative_paths(*suffixes):
    return [path.relative_to(repository.SOURCE).as_posix() for path in repository.files(*suffixes)]


class Navigation(unittest.TestCase):
    def test_every_document_of_the_repository_is_in_the_navigation_once(self):
        documents = [path for path in relative_paths(".md") if not path.startswith(".github/")]
        self.assertIn("mesh/deck/README.md", documents)
        self.assertEqual(sorted(navigation.documents()), documents)

    def test_a_readme_is_the_index_of_its_folder(self):
        self.assertEqual([navigation.page_of(path) for path in ("README.md", "mesh/deck/README.md", "docs/design.md")],
                         ["index.html", "mesh/deck/index.html", "docs/design.html"])

    def test_the_navigation_is_relative_and_marks_its_own_page(self):
        shown = navigation.navigation("mesh/deck/index.html", [("a-head", "A < head")])
        self.assertIn('<a class="here" href="index.html">mesh/deck</a><ul><li><a href="#a-head">A &lt; head</a>', shown)
        self.assertIn('<a href="../../docs/design.html">', shown)
        self.assertEqual(shown.count('class="here"'), 1)


class Translation(unittest.TestCase):
    def setUp(self):
        self.links = links.Links(FILES, HEADERS)

    def test_documents_folders_anchors_and_files_are_translated(self):
        for document, target, href in [
                ("README.md", "docs/design.md#a-head", "docs/design.html#a-head"),
                ("docs/design.md", "../README.md", "../index.html"),
                ("README.md", "samples/beam", "samples/beam/index.html"),
                ("docs/design.md", "../samples/beam/beam.fe.toml", "../samples/beam/beam.fe.toml.html"),
                ("docs/design.md", "../core/base/error.hpp", "../api/error_8hpp.html"),
                ("docs/design.md", "a.png", "a.png"),
                ("docs/design.md", "#a-head", "#a-head"),
                ("docs/design.md", "https://example.org/x.md", "https://example.org/x.md")]:
            self.assertEqual(self.links.href(document, target), href)
        self.assertEqual((self.links.copied, self.links.sources), ({"docs/a.png"}, {"samples/beam/beam.fe.toml"}))

    def test_a_link_to_no_file_is_an_error(self):
        with self.assertRaisesRegex(ValueError, "README.md: no file docs/gone.md"):
            self.links.href("README.md", "docs/gone.md")

    def test_files_that_are_named_as_code_become_links_unless_several_match(self):
        self.assertEqual(self.links.named("samples/beam/README.md", "beam.fe.toml"), "beam.fe.toml.html")
        self.assertEqual(self.links.named("README.md", "error.hpp"), "api/error_8hpp.html")
        self.assertEqual(self.links.named("README.md", "a/sets.cpp"), "mesh/a/sets.cpp.html")
        for text in ("sets.cpp", "gone.cpp", "make docs", "README.md"):
            self.assertIsNone(self.links.named("README.md", text), text)

    def test_anchors_are_those_of_github(self):
        self.assertEqual(links.slugs(["Not covered yet", "`a_b`: (c) d", "[Link](x.md)", "Not covered yet"]),
                         ["not-covered-yet", "a_b-c-d", "link", "not-covered-yet-1"])


@unittest.skipUnless(HAS_MARKDOWN, "python3-markdown-it is not installed")
class Documents(unittest.TestCase):
    def test_headings_tables_code_and_links_of_a_document(self):
        import documents
        text = "# A *b*\n\n## C, d\n\n| x |\n|---|\n| [l](docs/design.md) `error.hpp` <y> |\n\n1. item:\n\n       code\n"
        title, sections, shown = documents.rendered("README.md", text, links.Links(FILES, HEADERS))
        self.assertEqual((title, sections), ("A b", [("c-d", "C, d")]))
        for part in ('<h2 id="c-d">', '<a href="docs/design.html">l</a> <a href="api/error_8hpp.html"><code>', "&lt;y&gt;",
                     "<pre><code>code"):
            self.assertIn(part, shown)

    def test_comments_are_not_shown(self):
        import documents
        text = "# A\n\n<!-- a mark -->\n| x |\n|---|\n| y |\n<!-- end -->\n\n> z\n>\n> <!-- exit code 2 -->\n"
        shown = documents.rendered("README.md", text, links.Links(FILES, HEADERS))[2]
        self.assertNotIn("!--", shown)
        self.assertIn("<table>", shown)

    def test_every_link_and_anchor_of_the_documents_leads_somewhere(self):
        import documents
        import make_site
        files = make_site.repository_files()
        translated = links.Links(files, {path: "api/" + path for path in files if path.endswith(".hpp")})
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for path in navigation.documents():
                page = root / navigation.page_of(path)
                page.parent.mkdir(parents=True, exist_ok=True)
                page.write_text(documents.rendered(path, (repository.SOURCE / path).read_text(), translated)[2])
            for path in [source + ".html" for source in translated.sources] + list(translated.copied):
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).touch()
            wrong = [line for line in check.problems(root) if "api/" not in line]
        self.assertEqual(wrong, [])


class Check(unittest.TestCase):
    def test_broken_links_and_network_resources_are_reported(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "a").mkdir()
            (root / "index.html").write_text(
                '<h1 id="x">x</h1><a href="a/b.html#y">b</a><a href="#x">x</a><a href="https://example.org">e</a>')
            (root / "a/b.html").write_text('<p id="y"><a class="c" href="../index.html#z">z</a><img src="gone.png">'
                                           '<script src="https://example.org/s.js"></script></p>')
            self.assertEqual(check.problems(root), ["a/b.html: no anchor ../index.html#z", "a/b.html: no file gone.png",
                                                    "a/b.html: <script> loads https://example.org/s.js"])


class HeaderFilter(unittest.TestCase):
    def filtered(self, text):
        command = ["awk", "-f", str(repository.SOURCE / "docs/site/headers.awk")]
        return subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout

    def test_comments_of_files_members_and_formulas_reach_doxygen_and_lines_keep_their_numbers(self):
        self.assertEqual(
            self.filtered("// SPDX\n#pragma once\n// Masses:\n//   m = rho V.\n#include <a>\n\n/// Law\n///   F = k <x>\n/// holds.\n"
                          "struct A {\n  double m = 1;  // [kg] < 2,\n                 // of all\n  int n;\n};\n"),
            "// SPDX\n/// @file\n/// Masses: @code{.unparsed}\n///   m = rho V. @endcode\n#include <a>\n\n/// Law @code{.unparsed}\n"
            "///   F = k <x>\n/// @endcode holds.\nstruct A {\n  double m = 1;  ///< [kg] \\< 2,\n                 ///< of all\n"
            "  int n;\n};\n")

    def test_angle_brackets_and_dashes_are_text_except_in_backticks_and_quotes(self):
        self.assertEqual(self.filtered("/// <name> with --json, `<name> --json` \"<a>\": a < b.\nint a;  \nint b = c--;\n"),
                         "/// \\<name> with \\--json, `<name> --json` \"<a>\": a \\< b.\nint a;  \nint b = c--;\n")

    def test_continuations_of_a_list_are_no_formulas(self):
        text = "/// Sum.\n/// @param x  n x 1,\n///           in N\n/// - item\n///   goes on\n"
        self.assertEqual(self.filtered(text), text)


if __name__ == "__main__":
    unittest.main(verbosity=2)
