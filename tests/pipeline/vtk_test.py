"""VTK's own cells find volumes and outward faces in an exported .vtu of every cell type."""
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import numpy as np  # noqa: E402
import stages  # noqa: E402

try:
    import vtk
except ImportError:
    vtk = None

# Nastran's cells: corners, and edges in the order of its middle nodes.
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
    grids, cells, place = [], [], 0
    for card, (corners, edges) in CELLS.items():
        for order in (1, 2):
            points = [np.array(corner, float) for corner in corners]
            if order == 2:
                points += [(points[a] + points[b]) / 2 for a, b in edges]
            first = len(grids) + 1
            grids += [f"GRID,{first + i},,{x + 2 * place},{y},{z}" for i, (x, y, z) in enumerate(points)]
            fields = [card, len(cells) + 1, 1, *range(first, first + len(points))]
            lines = [fields[:9]] + [["", *fields[k:k + 8]] for k in range(9, len(fields), 8)]
            cells.append("\n".join(",".join(map(str, line)) for line in lines))
            place += 1
    return "\n".join(["BEGIN BULK", *grids, *cells, "PSOLID,1,1", "MAT1,1,1.0,,0.3,1.0", "ENDDATA", ""])


@unittest.skipIf(vtk is None, "VTK (package python3-vtk9) is not installed")
class Vtk(unittest.TestCase):
    def test_every_face_of_every_cell_points_outward_with_its_middles_on_its_edges(self):
        stages.require_stages()
        folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-vtk-"))
        self.addCleanup(shutil.rmtree, folder)
        (folder / "cells.bdf").write_text(deck())
        done = stages.run_stage("mesh", "cells.bdf", "--units", "m-kg-s", "-o", "cells.mesh.h5",
                                "--export", "cells.vtu", folder=folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(folder / "cells.vtu"))
        reader.Update()
        grid = reader.GetOutput()
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
