# SPDX-License-Identifier: GPL-3.0-or-later
"""Every source file names its licence in the first two lines; REUSE.toml covers the files that hold no comments."""
import unittest

import repository

LINE = "SPDX-License-Identifier: GPL-3.0-or-later"
COMMENTED = (".cpp", ".hpp", ".py", ".cmake", ".mk", ".toml", ".yml", ".yaml", ".cff", ".in", ".awk", ".css", ".svg")
NAMED = {"CMakeLists.txt", "Makefile", "Doxyfile", "setup", "clatter", "compare", "packages.txt", ".clang-format", ".clang-tidy"}


def lacks_line(path):
    return not any(LINE in line for line in path.read_text(encoding="utf-8").splitlines()[:2])


class Licence(unittest.TestCase):
    def test_every_source_file_names_the_licence(self):
        sources = [path for path in repository.files(*COMMENTED, "", ".txt") if path.suffix in COMMENTED or path.name in NAMED]
        self.assertGreater(len(sources), 500)
        lacking = [str(path.relative_to(repository.SOURCE)) for path in sources if lacks_line(path)]
        self.assertEqual(lacking, [], f"first line expected: '// {LINE}', or '# {LINE}'")


if __name__ == "__main__":
    unittest.main()
