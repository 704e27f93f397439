# SPDX-License-Identifier: GPL-3.0-or-later
"""The lines of docs/formats.md that read a sparse matrix work, and its tables list every name in an artefact."""
import os
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402


QUOTED, WORD = re.compile(r"`([^`]+)`"), re.compile(r"[\w<>/]+$")


def words(text):
    """Names and paths in backticks, with "*" for "<b>" and the like."""
    return [re.sub("<.*?>", "*", word) for word in QUOTED.findall(text) if WORD.match(word)]


class Document:
    """The tables of one kind of artefact in docs/formats.md: its paths, attributes and certificate."""

    def __init__(self, kind, text=(stages.SOURCE / "docs/formats.md").read_text()):
        sections = {re.match(r".*?$", part, re.M)[0]: part for part in text.split("\n## ")}
        own = next(part for head, part in sections.items() if head.startswith(f"`.{kind}.h5`"))
        every = sections["Common content"]
        self.attributes = set(words(own)) | set(words(every))
        self.paths, self.certificate = set(), set()
        tables = own.split("| `certificate` | unit | content |\n|---|---|---|\n")
        self.read(tables[0] + "".join(table.partition("\n\n")[2] for table in tables[1:]))
        for table in tables[1:]:
            self.certificate |= {words(row)[0] for row in table.partition("\n\n")[0].splitlines()}
        self.read(every)

    def read(self, text):
        for row in re.findall(r"^\| .*", text, re.M):
            objects, content = row.strip("| ").partition(" | ")[::2]
            others = re.search("as in the (mesh|FE model)", content)
            last = ""
            for name in QUOTED.findall(objects):
                name = re.sub("<.*?>", "*", name)
                last = last.rpartition("/")[0] + name if name.startswith("/") else name
                self.paths.add(last)
                self.paths |= {f"{last}/{word}" for word in words(content)}
                if others:
                    other = Document("mesh" if others[1] == "mesh" else "fe")
                    self.paths |= {path for path in other.paths if path.startswith(last.partition("/")[0])}
                    self.attributes |= other.attributes

    def says(self, path):
        """Whether a dataset or group of that path is in a table."""
        pattern = path.split("/")
        return any(len(known := documented.split("/")) >= len(pattern) and
                   all(a in ("*", b) for a, b in zip(known, pattern)) for documented in self.paths)


RING_MESH = """name = "ring"
kind = "cylinder"
[cylinder]
radius = 40.0
inner_radius = 30.0
length = 20.0
[mesh]
element_size_mm = 12.0
"""

RING = """
[material.iron]
regions = ["solid"]
E_gpa = 110.0
nu = 0.26
rho = 7200.0
expansion = 1.1e-5
conductivity = 48.0
[[support]]
surface = "bottom"
[[contact]]
name = "liner"
surface = "inner"
axis_point = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
zero_angle = [1.0, 0.0, 0.0]
axial = [0.0, 0.02]
rows = 1
[[contact.sector]]
centre_deg = 0.0
half_width_deg = 60.0
strips = 1
[[heat]]
name = "running"
[[heat.film]]
surface = "inner"
coefficient = 500.0
temperature_c = 400.0
[[heat.fixed]]
surface = "outer"
temperature_c = 90.0
[[load]]
name = "warm"
kind = "temperature"
heat = "running"
"""


class Formats(stages.PipelineTest):
    def test_the_three_lines_read_a_stiffness_matrix_that_scipy_can_use(self):
        code = re.search(r"```python\n(.*?)```", (stages.SOURCE / "docs/formats.md").read_text(), re.S)[1]
        self.assertEqual(len(code.strip().splitlines()), 3)
        fill = re.search(r"`(K = K \+ .*?)`", (stages.SOURCE / "docs/formats.md").read_text())[1]
        names = {}
        os.chdir(self.folder)
        self.addCleanup(os.chdir, "/")
        exec(code + fill, names)
        K = names["K"]
        self.assertAlmostEqual(abs(K - K.T).max(), 0.0)
        with h5py.File("beam.fe.h5") as model:
            load = model["loads/tip_force"][()]
        from scipy.sparse.linalg import spsolve
        deflection = load @ spsolve(K.tocsc(), load)
        # F L^3 / (3 E I) of the beam, b = 40, h = 30 mm, L = 600 mm: shear and the clamp's stiffness stay below 1 %.
        self.assertAlmostEqual(deflection, 0.6**3 / (3 * 210e9 * 0.04 * 0.03**3 / 12), delta=0.01 * deflection)

    def documented_schemas(self):
        row = re.search(r"\| attribute `schema` \| (.*?) \|", (stages.SOURCE / "docs/formats.md").read_text())[1]
        return set(re.findall(r"`(clatter/.*?)`", row))

    def test_every_artefact_says_what_the_document_promises_for_all(self):
        for path in sorted(self.folder.glob("*.h5")):
            with self.subTest(artefact=path.name), h5py.File(path) as file:
                kind = path.name.split(".")[1]
                schema = file.attrs["schema"].decode()
                self.assertEqual(schema.split("/")[1], kind)
                self.assertIn(schema, self.documented_schemas())
                self.assertIn("version", file.attrs)
                self.assertIn("config", file.attrs)
                self.assertEqual(len(file["inputs/path"]), len(file["inputs/sha256"]))
                self.assertGreater(len(file["inputs/path"]), 0)
                self.assertGreater(file["timing"].attrs["total_seconds"], 0)
                self.assertTrue(np.all(file["timing/seconds"][()] >= 0))

    def names(self, path):
        """(name, whether it is in the document) of all groups, datasets, attributes and certificate keys of a file."""
        document, found = Document(path.name.split(".")[1]), []

        def look(name, item):
            matrix, _, leaf = name.rpartition("/")
            if leaf in ("data", "indices", "indptr") and "format" in item.parent.attrs:
                return self.assertIn(matrix.rpartition("/")[2], {"K", "M", "T", "T_s", "K_sq", "K_ss", "M_sq"})
            if name == "certificate" or name.startswith("judged/"):
                known = [word.replace("*", "") for word in document.certificate]
                found.extend((f"{name}@{key}", any(key == word or "_" == word[-1] and key.startswith(word) for word in known))
                             for key in item.attrs)
                return None
            found.append((name, document.says(name)))
            sparse = {"format", "shape", "symmetric"} if "format" in item.attrs else set()
            found.extend((f"{name}@{key}", key in document.attributes | {"unit", "meaning"}) for key in set(item.attrs) - sparse
                         if not name.startswith("cases/"))  # named after the loads
            return None
        with h5py.File(path) as file:
            found.extend((f"@{key}", key in document.attributes) for key in file.attrs)
            file.visititems(look)
        return found

    def test_a_name_that_is_not_in_the_document_is_found(self):
        document = Document("fe")
        for path in ("K", "sets/tip/dofs", "supports/T_s", "materials/0/axes/frame", "timing/peak_gib"):
            self.assertTrue(document.says(path), path)
        for path in ("Q", "sets/tip/axis", "dofs", "loads/tip/force", "quality"):
            self.assertFalse(document.says(path), path)

    def warm_ring(self):
        """A ring with a temperature field, its statics and the shape of its bore."""
        (self.folder / "ring.mesh.toml").write_text(RING_MESH)
        (self.folder / "ring.fe.toml").write_text(RING)
        for stage, *arguments in (["mesh", "ring.mesh.toml", "-o", "ring.mesh.h5"],
                                  ["assembly", "ring.mesh.h5", "-c", "ring.fe.toml", "-o", "ring.fe.h5"],
                                  ["modal", "statics", "ring.fe.h5", "-o", "ring.static.h5"],
                                  ["modal", "shape", "ring.static.h5", "--surface", "inner", "-o", "ring.shape.h5"]):
            done = stages.run_stage(stage, *arguments, folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_every_name_in_an_artefact_is_in_the_document(self):
        stages.run_stage("modal", "statics", "beam.fe.h5", "-o", "beam.static.h5", folder=self.folder)
        stages.run_stage("mesh", "faces", "beam.mesh.toml", "-o", "beam.faces.h5", folder=self.folder)
        (self.folder / "beam.sound.toml").write_text("[grid]\nfrom_hz = 400\nto_hz = 800\n")
        stages.run_stage("recover", "sound", "beam.rom.h5", "-c", "beam.sound.toml", "-o", "beam.sound.h5", folder=self.folder)
        self.warm_ring()
        kinds = set()
        for path in sorted(self.folder.glob("*.h5")):
            with self.subTest(artefact=path.name):
                names = self.names(path)
                self.assertGreater(len(names), 10)
                self.assertEqual([name for name, documented in names if not documented], [])
                kinds.add(path.name.split(".")[1])
        self.assertEqual(kinds, {schema.split("/")[1] for schema in self.documented_schemas()})


if __name__ == "__main__":
    unittest.main(verbosity=2)
