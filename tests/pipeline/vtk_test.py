# SPDX-License-Identifier: GPL-3.0-or-later
"""VTK's cells have positive volumes and outward faces in an exported .vtu of every cell type."""
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    vtk = None

# Nastran's cells: corners, and edges in the order of its mid-side nodes.
CELLS = {
    "CTETRA": ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]),
    "CHEXA": ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
              [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 5), (2, 6), (3, 7), (4, 5), (5, 6), (6, 7), (7, 4)]),
    "CPENTA": ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)],
               [(0, 1), (1, 2), (2, 0), (0, 3), (1, 4), (2, 5), (3, 4), (4, 5), (5, 3)]),
    "CPYRAM": ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1)],
               [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)]),
}


def deck():
    """One linear and one quadratic cell of each kind, apart from one another."""
    grids, cells, offset = [], [], 0
    for card, (corners, edges) in CELLS.items():
        for order in (1, 2):
            points = [np.array(corner, float) for corner in corners]
            if order == 2:
                points += [(points[a] + points[b]) / 2 for a, b in edges]
            first = len(grids) + 1
            grids += [f"GRID,{first + i},,{x + 2 * offset},{y},{z}" for i, (x, y, z) in enumerate(points)]
            fields = [card, len(cells) + 1, 1, *range(first, first + len(points))]
            lines = [fields[:9]] + [["", *fields[k:k + 8]] for k in range(9, len(fields), 8)]
            cells.append("\n".join(",".join(map(str, line)) for line in lines))
            offset += 1
    return "\n".join(["BEGIN BULK", "$ clatter set 7 FEW & <OTHERS>", "SET1,7,1,5,9", *grids, *cells, "PSOLID,1,1", "MAT1,1,1.0,,0.3,1.0", "ENDDATA", ""])


def grid_of(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def arrays(data):
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


@unittest.skipIf(vtk is None, "VTK (package python3-vtk9) is not installed")
class Vtk(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-vtk-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "cells.bdf").write_text(deck())
        done = stages.run_stage("mesh", "cells.bdf", "--units", "m-kg-s", "-o", "cells.mesh.h5",
                                "--export", "cells.vtu", folder=cls.folder)
        if done.returncode:
            raise AssertionError(done.stderr)
        cls.grid = grid_of(cls.folder / "cells.vtu")

    def test_nodes_ids_sets_surfaces_and_regions_are_those_of_the_mesh(self):
        points, fields = arrays(self.grid.GetPointData()), arrays(self.grid.GetFieldData())
        cells = arrays(self.grid.GetCellData())
        with h5py.File(self.folder / "cells.mesh.h5") as mesh:
            np.testing.assert_array_equal(vtk_to_numpy(self.grid.GetPoints().GetData()), mesh["nodes"][()])
            np.testing.assert_array_equal(points["id"], mesh["node_ids"][()])
            self.assertEqual(list(mesh["node_sets"]), ["FEW & <OTHERS>"])
            for name, nodes in mesh["node_sets"].items():
                np.testing.assert_array_equal(np.flatnonzero(points[name]), nodes[()])
            self.assertEqual(list(mesh["surfaces"]), ["skin"])
            for kind, faces in mesh["surfaces/skin"].items():
                np.testing.assert_array_equal(fields[f"surface skin {kind}"], faces[()])
            names = [name.decode() for name in mesh["regions"][()]]
        self.assertEqual([int(fields[f"region {name}"][0]) for name in names], [0])
        np.testing.assert_array_equal(cells["region"], 0)
        self.assertEqual(sorted(cells["id"]), list(range(1, 9)))

    def test_every_face_of_every_cell_points_outward_with_mid_side_nodes_on_its_edges(self):
        grid = self.grid
        self.assertEqual(grid.GetNumberOfCells(), 8)
        for number in range(8):
            cell = grid.GetCell(number)
            centre = np.mean([cell.GetPoints().GetPoint(i) for i in range(cell.GetNumberOfPoints())], axis=0)
            for f in range(cell.GetNumberOfFaces()):
                face = cell.GetFace(f)
                points = np.array([face.GetPoints().GetPoint(i) for i in range(face.GetNumberOfPoints())])
                corners = {3: 3, 4: 4, 6: 3, 8: 4}[len(points)]
                normal = np.cross(points[1] - points[0], points[2] - points[0])
                with self.subTest(cell=cell.GetClassName(), face=f):
                    self.assertGreater(normal @ (points[:corners].mean(axis=0) - centre), 0)
                    for e in range(len(points) - corners):
                        np.testing.assert_allclose(points[corners + e], (points[e] + points[(e + 1) % corners]) / 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
