# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/cluster.md shows the batch script that ranks_batch_test.py runs."""
import pathlib
import subprocess
import unittest

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"


class BatchScript(unittest.TestCase):
    def test_the_page_shows_the_file(self):
        text = (DOCS / "condense.sbatch").read_text()
        self.assertIn(f"```bash\n{text}```", (DOCS / "cluster.md").read_text())

    def test_the_shell_reads_it(self):
        done = subprocess.run(["bash", "-n", DOCS / "condense.sbatch"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
