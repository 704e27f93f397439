# SPDX-License-Identifier: GPL-3.0-or-later
"""The layout in docs/design.md is that of the folders."""
import re
import unittest

import repository

FOLDERS = ("core", "mesh", "assembly", "modal", "condense", "dynamics", "recover")


def drawn(text):
    """{stage: folders below it} of the block after '## 2. The layout'."""
    block = re.search(r"^## 2\. The layout$.*?\n\n((?:    [^\n]*\n)+)", text, re.M | re.S)[1]
    layout, stage = {}, None
    for line in block.splitlines():
        head, below = re.fullmatch(r"    (\w*)/? +(.*)", line).groups()
        stage = layout.setdefault(head, set()) if head else stage
        for name, inner in re.findall(r"(\w+)/(?:\{([^}]*)\})?", below):
            stage |= {name, *(f"{name}/{folder}" for folder in inner.split(",") if folder)}
    return layout


class Layout(unittest.TestCase):
    def test_every_folder_is_drawn_and_none_that_is_not_there(self):
        layout = drawn((repository.SOURCE / "docs/design.md").read_text())
        for stage in FOLDERS:
            folder = repository.SOURCE / stage
            there = {str(p.parent.relative_to(folder)) for p in folder.rglob("*.[ch]pp")} - {"."}
            with self.subTest(stage=stage):
                self.assertEqual(layout[stage], there)

    def test_a_missing_folder_is_seen(self):
        self.assertEqual(drawn("## 2. The layout\n\ntext\n\n    core/   base/ sparse/{factor,eigen}\n    mesh/   cad/\n            part/\n"),
                         {"core": {"base", "sparse", "sparse/factor", "sparse/eigen"}, "mesh": {"cad", "part"}})


if __name__ == "__main__":
    unittest.main(verbosity=2)
