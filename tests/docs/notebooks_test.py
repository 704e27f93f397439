# SPDX-License-Identifier: GPL-3.0-or-later
"""The notebooks of docs/tutorial/notebooks run in the folders that their pages make, and print the numbers that stand after #."""
import json
import os
import pathlib
import re
import sys
import tempfile
import unittest

import repository
import tutorial

sys.path.insert(0, str(repository.SOURCE / "tests/cli"))
import stages  # noqa: E402

try:
    import nbclient
    import nbformat
except ImportError:
    nbclient = None

FOLDER = repository.SOURCE / "docs/tutorial/notebooks"
NUMBER = re.compile(r"^print\(.*\) +# (-?[\d.]+)$", re.M)
TOLERANCE = 0.05  # meshes of other releases of gmsh differ, and runs by their last digits


def printed(cell):
    return "".join(one["text"] for one in cell["outputs"] if one["output_type"] == "stream").split("\n")


def wrong_numbers(notebook):
    """What executed cells print instead of the number after #."""
    found = []
    for cell in notebook["cells"]:
        if cell["cell_type"] != "code":
            continue
        lines = [line for line in "".join(cell["source"]).split("\n") if line.startswith("print(")]
        for line, text in zip(lines, printed(cell)):
            said = NUMBER.match(line)
            if said and not abs(float(text) - float(said[1])) <= TOLERANCE * abs(float(said[1])):
                found.append(f"{line}: {text}")
    return found


class Files(unittest.TestCase):
    def test_outputs_are_stripped_and_each_notebook_has_a_page_that_names_it(self):
        names = sorted(FOLDER.glob("*.ipynb"))
        self.assertEqual(len(names), 3)
        for path in names:
            for cell in json.loads(path.read_text())["cells"]:
                if cell["cell_type"] == "code":
                    self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None), path.name)
            self.assertIn(f"notebooks/{path.name}", (FOLDER.parent / f"{path.stem}.md").read_text())

    def test_a_wrong_number_is_found(self):
        cell = {"cell_type": "code", "source": "x = 2\nprint(x)   # 2\nprint(3 * x)   # 6.5", "outputs": [{"output_type": "stream", "text": "2\n6\n"}]}
        self.assertEqual(wrong_numbers({"cells": [cell]}), ["print(3 * x)   # 6.5: 6"])


@unittest.skipIf(nbclient is None, "python3-nbclient and python3-ipykernel are not installed")
class Notebooks(unittest.TestCase):
    def execute(self, name):
        stages.require_stages()
        with tempfile.TemporaryDirectory(prefix="clatter-notebook-") as scratch:
            folder = pathlib.Path(scratch) / "page"
            tutorial.run_page(FOLDER.parent / f"{name}.md", keep=folder)
            notebook = nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)
            for variable, value in {"PYTHONPATH": str(repository.SOURCE / "python"), "JUPYTER_RUNTIME_DIR": scratch, "IPYTHONDIR": scratch}.items():
                self.addCleanup(os.environ.__setitem__ if variable in os.environ else os.environ.pop, variable, os.environ.get(variable))
                os.environ[variable] = value
            # Raises where a cell does.
            nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(folder)}}).execute()
        self.assertEqual(wrong_numbers(notebook), [])
        pictures = [one for cell in notebook["cells"] if cell["cell_type"] == "code" for one in cell["outputs"] if "image/png" in one.get("data", {})]
        self.assertGreaterEqual(len(pictures), 2)

    def test_beam(self):
        self.execute("1-beam")

    def test_deck(self):
        self.execute("3-deck")

    def test_sound(self):
        self.execute("6-sound")


if __name__ == "__main__":
    unittest.main(verbosity=2)
