# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter export` for ParaView: .pvd and .vtu as VTK and meshio read them."""
import pathlib
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np
import old_base64
import synthetic_surface as ball

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    vtk = None
try:
    import meshio
except ImportError:
    meshio = None


def arrays(data):
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


class Exported(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        ball.write(cls.folder / "ball.field.h5")
        cls.nodes, cls.triangles = ball.sphere()


@unittest.skipIf(vtk is None, "VTK (package python3-vtk9) is not installed")
class ParaView(Exported):
    def grids(self, name, *arguments):
        """[(value of the time slider, grid)] of an exported series."""
        ball.export(self.folder, "-o", f"{name}.pvd", *arguments)
        found = []
        for entry in ElementTree.parse(self.folder / f"{name}.pvd").getroot().findall("Collection/DataSet"):
            reader = vtk.vtkXMLUnstructuredGridReader()
            reader.SetFileName(str(self.folder / entry.get("file")))
            reader.Update()
            self.assertEqual(reader.GetErrorCode(), 0)
            found.append((float(entry.get("timestep")), reader.GetOutput()))
        return found

    def test_lines_have_complex_nodal_and_normal_velocities(self):
        grids = self.grids("lines")
        self.assertEqual([value for value, _ in grids], list(ball.FREQUENCIES))
        for step, (value, grid) in enumerate(grids):
            np.testing.assert_array_equal(vtk_to_numpy(grid.GetPoints().GetData()), self.nodes)
            self.assertEqual({grid.GetCellType(k) for k in range(grid.GetNumberOfCells())}, {vtk.VTK_QUADRATIC_TRIANGLE})
            np.testing.assert_array_equal(vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 6), self.triangles)
            points, cells, field = (arrays(data) for data in (grid.GetPointData(), grid.GetCellData(), grid.GetFieldData()))
            wanted = ball.line_velocity(self.nodes, step)
            np.testing.assert_array_equal(points["velocity_re"] + 1j * points["velocity_im"], wanted)
            area, _, flow = ball.integrals(self.nodes, self.triangles, wanted)
            np.testing.assert_allclose((cells["normal_velocity_re"] + 1j * cells["normal_velocity_im"]) * area, flow, rtol=1e-12)
            np.testing.assert_array_equal(cells["panel upper"], self.nodes[self.triangles[:, :3]].mean(axis=1)[:, 2] > 0)
            self.assertEqual(field["frequency_hz"][0], value)
        self.assertIn("peak amplitudes, x(t) = Re( X exp(+i 2 pi f t) )", (self.folder / "lines_1.vtu").read_bytes()[:600].decode("latin-1"))

    def test_vtk_finds_a_closed_surface_with_outward_normals(self):
        (_, grid), = self.grids("linear", "--linear", "--at", "100")
        surface = vtk.vtkGeometryFilter()
        surface.SetInputData(grid)
        mass = vtk.vtkMassProperties()
        mass.SetInputConnection(surface.GetOutputPort())
        self.assertEqual(grid.GetNumberOfCells(), 4 * len(self.triangles))
        self.assertTrue(0.9 < mass.GetVolume() / (4 / 3 * np.pi * ball.RADIUS**3) < 1)
        nodes = vtk_to_numpy(grid.GetPoints().GetData())
        self.assertGreater(ball.volume(nodes, vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3)), 0)

    def test_frames_are_real(self):
        grids = self.grids("frames", "--frames", "--at=-0.0003:0")
        np.testing.assert_allclose([value for value, _ in grids], ball.TIMES[:2])
        for step, (_, grid) in enumerate(grids):
            points = arrays(grid.GetPointData())
            self.assertEqual(sorted(points), ["velocity"])
            np.testing.assert_array_equal(points["velocity"], ball.frame_velocity(self.nodes, step))


@unittest.skipIf(meshio is None, "meshio (package python3-meshio) is not installed")
class Meshio(Exported):
    def setUp(self):
        patch = old_base64.patched()
        patch.start()
        self.addCleanup(patch.stop)

    def test_meshio_reads_the_same_numbers(self):
        ball.export(self.folder, "-o", "m.pvd", "--at", "250")
        mesh = meshio.read(self.folder / "m_1.vtu")
        np.testing.assert_array_equal(mesh.points, self.nodes)
        np.testing.assert_array_equal(mesh.cells_dict["triangle6"], self.triangles)
        np.testing.assert_array_equal(mesh.point_data["velocity_re"] + 1j * mesh.point_data["velocity_im"], ball.line_velocity(self.nodes, 1))
        self.assertEqual(mesh.field_data["frequency_hz"], [250.0])


if __name__ == "__main__":
    unittest.main()
