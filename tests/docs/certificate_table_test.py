# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter info` explains the certificate of a reduced model as docs/formats.md does, whose table is that of the C++ fields."""
import re
import unittest

import repository
from clatter_tools import certificate


def documented():
    """{name: (unit, meaning)} of the certificate's table of .rom.h5."""
    section = (repository.SOURCE / "docs/formats.md").read_text().split("\n## `.rom.h5`")[1].split("\n## ")[0]
    table = section.split("| `certificate` | unit | content |\n|---|---|---|\n")[1].split("\n\n")[0]
    rows = [re.fullmatch(r"\| `(\w+)` \| (.*?) ?\| (.*) \|", row) for row in table.splitlines()]
    return {row[1]: (row[2], row[3].replace("\\|", "|")) for row in rows}


class CertificateTable(unittest.TestCase):
    def test_info_has_the_names_units_and_meanings_of_the_document(self):
        printed = {name: (form.partition("}")[2].strip(), meaning)
                   for _, rows in certificate.GROUPS for name, form, meaning in rows}
        said = documented()
        self.assertGreater(len(said), 30)
        self.assertEqual(said.pop("certified")[0], "")  # printed as the verdict
        self.assertEqual(list(printed.items()), list(said.items()))


if __name__ == "__main__":
    unittest.main(verbosity=2)
