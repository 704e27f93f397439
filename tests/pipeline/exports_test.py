# SPDX-License-Identifier: GPL-3.0-or-later
"""A finished mesh is exported to every format without meshing again; MED is read back by its own library."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import old_base64  # noqa: E402
import stages  # noqa: E402
from vtk_test import deck  # noqa: E402

STEP = "-0000000000000000001-0000000000000000001"
# MED's cells (MED-fichier, reference elements): edges in the order of their mid-side nodes, and the volume of the
# corners when the lower face, seen from outside, is anticlockwise.
EDGES = {
    "TE4": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    "HE8": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
    "PE6": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
    "PY5": [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)],
}
LINEAR = {"TE4": "TE4", "T10": "TE4", "HE8": "HE8", "H20": "HE8", "PE6": "PE6", "P15": "PE6", "PY5": "PY5", "P13": "PY5"}
LOWER = {"TE4": 3, "HE8": 4, "PE6": 3, "PY5": 4}  # corners of the lower face
# Tetrahedra that fill each cell, by its corners in MED's order, all with the orientation of MED's tetrahedron.
PIECES = {
    "TE4": [(0, 1, 2, 3)],
    "PY5": [(0, 1, 2, 4), (0, 2, 3, 4)],
    "PE6": [(0, 1, 2, 5), (0, 1, 5, 4), (0, 4, 5, 3)],
    "HE8": [(0, 1, 2, 5), (0, 2, 3, 7), (0, 5, 7, 4), (2, 7, 5, 6), (0, 2, 7, 5)],
}


def signed_volumes(points, rows, linear):
    """Volume of each cell and the largest of its tetrahedra; rows: cells x nodes from 0 in the order of MED."""
    pieces = []
    for a, b, c, d in PIECES[linear]:
        x = points[rows[:, a]]
        pieces.append(np.einsum("ij,ij->i", np.cross(points[rows[:, b]] - x, points[rows[:, c]] - x), points[rows[:, d]] - x) / 6)
    return sum(pieces), np.max(pieces, axis=0)


class Exports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-exports-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "cells.bdf").write_text(deck())
        cls.mesh("cells.bdf", "--units", "m-kg-s", "-o", "cells.mesh.h5", "--export", "first.vtu", "--export", "first.bdf")
        (cls.folder / "cells.bdf").unlink()
        cls.mesh("export", "cells.mesh.h5", *[f"cells.{kind}" for kind in ("vtu", "med", "bdf", "msh", "nas")])

    @classmethod
    def mesh(cls, *arguments, code=0):
        done = stages.run_stage("mesh", *arguments, folder=cls.folder)
        if done.returncode != code:
            raise AssertionError(done.stderr)
        return done

    def test_a_finished_mesh_exports_what_the_run_exports(self):
        for kind in ("vtu", "bdf"):
            self.assertEqual((self.folder / f"first.{kind}").read_bytes(), (self.folder / f"cells.{kind}").read_bytes())
        self.assertGreater((self.folder / "cells.msh").stat().st_size, 1000)

    def test_no_output_and_no_export_is_refused(self):
        self.assertIn("--output is required", self.mesh("cells.mesh.h5", code=2).stderr)
        self.assertIn("output is required", self.mesh("export", "cells.mesh.h5", code=2).stderr)
        self.assertIn("`clatter-mesh export cells.mesh.h5 FILE`",
                      self.mesh("cells.mesh.h5", "-o", "x.mesh.h5", "--export", "y.vtu", code=2).stderr)
        self.assertIn(".med, .unv", self.mesh("export", "cells.mesh.h5", "y.docx", code=2).stderr)
        self.assertIn("pyramid", self.mesh("export", "cells.mesh.h5", "y.unv", code=2).stderr)
        self.assertFalse(list(self.folder.glob("y.*")))

    @unittest.skipIf(shutil.which("mdump") is None, "mdump (package libmed-tools) is not installed")
    def test_med_is_what_its_own_library_reads(self):
        done = subprocess.run(["mdump", "cells.med", "NODALE", "FULL_INTERLACE", "0"], cwd=self.folder, text=True,
                              capture_output=True, errors="replace")
        self.assertEqual(done.returncode, 0)
        self.assertNotIn("ERREUR", done.stdout + done.stderr)
        counts = dict(re.findall(r"Nombre de mailles de type (\w+) : (\d+)", done.stdout))
        self.assertEqual({kind: int(counts[f"MED_{kind}"]) for kind in
                          ("TETRA4", "TETRA10", "HEXA8", "HEXA20", "PENTA6", "PENTA15", "PYRA5", "PYRA13")},
                         dict.fromkeys(("TETRA4", "TETRA10", "HEXA8", "HEXA20", "PENTA6", "PENTA15", "PYRA5", "PYRA13"), 1))
        with h5py.File(self.folder / "cells.mesh.h5") as mesh:
            faces = {kind: len(rows) for kind, rows in mesh["surfaces/skin"].items()}
            names = [name.decode() for name in mesh["regions"][()]] + ["skin", *mesh["node_sets"]]
        for med, ours in {"TRIA3": "tri3", "TRIA6": "tri6", "QUAD4": "quad4", "QUAD8": "quad8"}.items():
            self.assertEqual(int(counts[f"MED_{med}"]), faces[ours])
        groups = [name.strip() for name in re.findall(r"gro = (.*)", done.stdout)]
        self.assertEqual(sorted(groups), sorted(names))

    def test_cells_of_med_have_meds_orientation_and_mid_side_nodes_on_their_edges(self):
        with h5py.File(self.folder / "cells.med") as med, h5py.File(self.folder / "cells.mesh.h5") as mesh:
            step = med[f"ENS_MAA/cells/{STEP}"]
            points = step["NOE/COO"][()].reshape(3, -1).T
            np.testing.assert_array_equal(points, mesh["nodes"][()])
            np.testing.assert_array_equal(step["NOE/NUM"][()], mesh["node_ids"][()])
            for kind, linear in LINEAR.items():
                x = points[step[f"MAI/{kind}/NOD"][()] - 1]
                corners = {"TE4": 4, "HE8": 8, "PE6": 6, "PY5": 5}[linear]
                with self.subTest(kind):
                    normal = np.cross(x[1] - x[0], x[2] - x[0])  # of the lower face: out of the cell
                    self.assertLess(normal @ (x[corners - 1] - x[0]) if linear in ("TE4", "PY5")
                                    else normal @ (x[LOWER[linear]] - x[0]), 0)
                    for middle, (a, b) in zip(x[corners:], EDGES[linear]):
                        np.testing.assert_allclose(middle, (x[a] + x[b]) / 2)
            families = med["FAS/cells"]
            node_family = step["NOE/FAM"][()]
            number = {families[f"NOEUD/{name}"].attrs["NUM"] for name in families["NOEUD"]}
            self.assertEqual(set(node_family[mesh["node_sets/FEW & <OTHERS>"][()]]), number)
            self.assertEqual(np.count_nonzero(node_family), len(mesh["node_sets/FEW & <OTHERS>"]))

    def test_every_cell_of_a_part_has_meds_orientation_and_all_of_them_its_volume(self):
        shutil.copy(stages.SOURCE / "samples/beam/beam.mesh.toml", self.folder)
        self.mesh("beam.mesh.toml", "-o", "beam.mesh.h5", "--export", "beam.med")
        for name, volume in {"beam": 0.6 * 0.04 * 0.03, "cells": 2 * (1 / 6 + 1 + 1 / 2 + 1 / 3)}.items():
            with h5py.File(self.folder / f"{name}.med") as med:
                step = med[f"ENS_MAA/{name}/{STEP}"]
                points, found = step["NOE/COO"][()].reshape(3, -1).T, 0.0
                for kind, linear in LINEAR.items():
                    if kind not in step["MAI"]:
                        continue
                    count = step[f"MAI/{kind}/NOD"].attrs["NBR"]
                    rows = step[f"MAI/{kind}/NOD"][()].reshape(-1, count).T - 1
                    cells, worst = signed_volumes(points, rows, linear)
                    with self.subTest(part=name, kind=kind):  # MED's cells are left-handed: Gmsh reverses them for MED, too
                        self.assertLess(worst.max(), 0)
                    found -= cells.sum()
            self.assertAlmostEqual(found / volume, 1, delta=1e-12)


# A cube, and beside it a sheet of two quadrilaterals and a triangle.
SHELLS = """BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
GRID,5,,0.,0.,1.
GRID,6,,1.,0.,1.
GRID,7,,1.,1.,1.
GRID,8,,0.,1.,1.
GRID,11,,0.,0.,2.
GRID,12,,1.,0.,2.
GRID,13,,2.,0.,2.
GRID,14,,0.,1.,2.
GRID,15,,1.,1.,2.
GRID,16,,2.,1.,2.
GRID,17,,3.,.5,2.
CHEXA,1,1,1,2,3,4,5,6,+
+,7,8
CQUAD4,21,2,11,12,15,14
CQUAD4,22,2,12,13,16,15,,.0005,+
+,,,.001,.001,.002,.002
CTRIA3,23,3,13,17,16
PSOLID,1,1
PSHELL,2,1,.002,1,,1
PSHELL,3,1,.003,1,,1
MAT1,1,2.1+11,,.3,7850.
ENDDATA
"""


class ShellExports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-shell-exports-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "sheet.bdf").write_text(SHELLS)
        cls.mesh("sheet.bdf", "--units", "m-kg-s", "-o", "sheet.mesh.h5")
        done = cls.mesh("export", "sheet.mesh.h5", *[f"out.{kind}" for kind in ("vtu", "msh", "med", "unv", "inp", "nas")])
        cls.warnings = done.stderr

    @classmethod
    def mesh(cls, *arguments):
        done = stages.run_stage("mesh", *arguments, folder=cls.folder)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        return done

    def test_a_thickness_that_a_format_does_not_have_is_named(self):
        lost = "2 shells have a thickness or an offset of their own"
        self.assertEqual([kind for kind in ("vtu", "msh", "med", "unv", "inp", "nas") if f"out.{kind}: {lost}" in self.warnings],
                         ["msh", "med", "unv", "inp"])

    def test_directions_of_materials_that_no_format_has_are_named(self):
        layers = SHELLS.replace("PSHELL,3,1,.003,1,,1", "MAT8,8,1.4+11,1.+10,.3,5.+9,5.+9,3.+9,1600.\nPCOMP,3,,,,,,,,+\n+,8,.003")
        (self.folder / "layers.bdf").write_text(layers)
        self.mesh("layers.bdf", "--units", "m-kg-s", "-o", "layers.mesh.h5")
        for kind in ("msh", "nas"):
            done = self.mesh("export", "layers.mesh.h5", f"layers.{kind}")
            self.assertIn("direction 1 of the material of 1 shells is not written", done.stderr)

    def test_decks_give_the_same_shells_again(self):
        def content(name):
            out = {}

            def add(path, one):
                if path.split("/")[0] in ("nodes", "node_ids", "regions", "cells", "shells", "surfaces", "node_sets"):
                    out.update({f"{path} {key}": value for key, value in one.attrs.items()})
                    if isinstance(one, h5py.Dataset):
                        out[path] = one[()]

            with h5py.File(self.folder / name) as file:
                file.visititems(add)
            return out

        wanted = content("sheet.mesh.h5")
        self.assertIn("shells/0/nodes", wanted)
        for kind in ("nas", "inp"):
            self.mesh(f"out.{kind}", "--units", "m-kg-s", "-o", f"{kind}.mesh.h5")
            found = content(f"{kind}.mesh.h5")
            keys = {path for path in wanted if kind == "nas" or path.split("/")[-1] not in ("thickness", "offset")}
            self.assertEqual(set(found), keys)
            for path in keys:
                with self.subTest(kind=kind, path=path):
                    np.testing.assert_array_equal(found[path], wanted[path])

    def test_other_readers_count_the_shells(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("meshio (package python3-meshio) is not installed")
        patch = old_base64.patched()
        patch.start()
        self.addCleanup(patch.stop)
        # In .msh a face of two groups is two elements: shells and the cube's faces are the skin, too.
        for kind, quads, triangles in (("vtu", 2, 1), ("msh", 10, 2), ("med", 8, 1), ("inp", 2, 1)):
            with self.subTest(kind):
                cells = meshio.read(self.folder / f"out.{kind}").cells
                self.assertEqual([sum(len(block.data) for block in cells if block.type == one)
                                  for one in ("quad", "triangle", "hexahedron")], [quads, triangles, 1])


if __name__ == "__main__":
    unittest.main(verbosity=2)
