"""The lines of docs/formats.md that read a sparse matrix do so."""
import os
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402


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


if __name__ == "__main__":
    unittest.main(verbosity=2)
