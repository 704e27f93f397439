# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter export --skin acoustic`: the closed surface around the body in each format, read by the programs that read the others."""
import pathlib
import tempfile
import unittest

import h5py
import numpy as np
import synthetic_surface as ball
from clatter_tools.export import acoustic_source
from clatter_tools.export.surface import Surface
from export_command_test import table
from export_numcalc_test import read_input, words
from export_unv_test import read_2414, read_datasets, read_elements, read_nodes

try:
    import gmsh
except ImportError:
    gmsh = None
try:
    import meshio
except ImportError:
    meshio = None
try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    vtk = None


class Exported(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        ball.write(self.folder / "ball.field.h5")
        with h5py.File(self.folder / "ball.field.h5", "r+") as file:
            ball.write_acoustic(file)
        self.nodes, self.triangles = ball.acoustic_skin()
        self.area, self.normal = ball.flat_normals(self.nodes, self.triangles)

    def exported(self, name, *arguments):
        ball.export(self.folder, "--skin", "acoustic", "-o", name, *arguments)
        return self.folder / name

    def refused(self, *arguments):
        return ball.export(self.folder, "--skin", "acoustic", *arguments, code=2)[1].removeprefix("clatter: error: ").rstrip("\n")

    def assert_normal_velocity(self, values, step, digits=1e-9):
        """The values of each triangle, and so the volume flow of each."""
        wanted = ball.acoustic_velocity(step)
        np.testing.assert_allclose(values, wanted, atol=digits * np.abs(wanted).max())
        self.assertAlmostEqual(abs(np.sum(self.area * values) / np.sum(self.area * wanted)), 1.0, delta=100 * digits)


class Formats(Exported):
    def test_universal_files_have_it_on_elements(self):
        datasets = read_datasets(self.exported("skin.unv"))
        self.assertEqual([number for number, _ in datasets], [164, 2411, 2412, 2414, 2414, 2414])
        np.testing.assert_array_equal(np.array(list(read_nodes(datasets[1][1]).values())), self.nodes)
        elements = read_elements(datasets[2][1]).values()
        np.testing.assert_array_equal(np.array([ids for _, ids in elements]) - 1, self.triangles)
        for step, (_, lines) in enumerate(datasets[3:]):
            result = read_2414(lines)
            self.assertEqual((result["location"], result["reals"][1]), (2, ball.FREQUENCIES[step]))
            self.assertIn("acoustic skin of ball", result["ids"][0])
            values = np.array(list(result["values"].values()))
            self.assert_normal_velocity(values[:, 0] + 1j * values[:, 1], step, 5e-6)

    def test_numcalc_gets_a_closed_surface_with_the_conjugated_velocities(self):
        folder = self.exported("sound", "--format", "numcalc")
        nodes, elements = (np.array([line[1:4] for line in words(folder / name)[1:]], float) for name in ("Nodes.txt", "Elements.txt"))
        elements = elements.astype(int)
        np.testing.assert_allclose(nodes, self.nodes, atol=1e-12)
        edges = [tuple(edge) for row in elements for edge in (row[[0, 1]], row[[1, 2]], row[[2, 0]])]
        self.assertEqual(len(edges), len(set(edges)), "two triangles run along an edge in one direction")
        self.assertEqual(set(edges), {edge[::-1] for edge in edges})
        self.assertGreater(ball.volume(nodes, elements), 0.9 * 4 / 3 * np.pi * (1.1 * ball.RADIUS) ** 3)
        for step, path in enumerate(sorted(folder.glob("line_*/NC.inp"))):
            own = read_input(path)
            self.assertEqual((own["elements"], own["nodes"]), (len(self.triangles), len(self.nodes)))
            self.assert_normal_velocity(np.conj([own["velocity"][k] for k in range(len(elements))]), step)

    def test_a_table_has_centres_normals_and_areas(self):
        _, names, rows = table(self.exported("skin.csv", "--at", "250"))
        self.assertEqual(names[-2:], ["normal_velocity_re_m_s", "normal_velocity_im_m_s"])
        np.testing.assert_allclose(rows[:, 2:5], self.nodes[self.triangles].mean(axis=1), atol=1e-9)
        np.testing.assert_allclose(rows[:, 5:8], self.normal, atol=1e-8)
        np.testing.assert_allclose(rows[:, 8], self.area, rtol=1e-8)
        self.assert_normal_velocity(rows[:, 9] + 1j * rows[:, 10], 1, 1e-8)

    def test_opencfs_has_it_on_linear_elements(self):
        with h5py.File(self.exported("skin.cfs"), "r") as file:
            self.assertEqual(set(file["Mesh/Elements/Types"]), {4})
            np.testing.assert_array_equal(file["Mesh/Elements/Connectivity"][()] - 1, self.triangles)
            for step in range(3):
                own = file[f"Results/Mesh/MultiStep_1/Step_{step + 1}"]
                self.assertEqual(list(own), ["acouNormalVelocity"])
                faces = own["acouNormalVelocity/skin/Elements"]
                self.assert_normal_velocity(faces["Real"][:, 0] + 1j * faces["Imag"][:, 0], step)

    @unittest.skipIf(gmsh is None, "Gmsh (package python3-gmsh) is not installed")
    def test_gmsh_reads_it(self):
        gmsh.initialize(["", "-v", "0"])
        self.addCleanup(gmsh.finalize)
        gmsh.open(str(self.exported("skin.msh", "--at", "100")))
        kinds, _, rows = gmsh.model.mesh.getElements(2)
        self.assertEqual(list(kinds), [2])
        np.testing.assert_array_equal(rows[0].reshape(-1, 3) - 1, self.triangles)
        real, imag = (np.array(gmsh.view.getModelData(tag, 0)[2])[:, 0] for tag in gmsh.view.getTags())
        self.assert_normal_velocity(real + 1j * imag, 0)

    @unittest.skipIf(vtk is None, "VTK (package python3-vtk9) is not installed")
    def test_vtk_finds_it_closed_and_outward(self):
        self.exported("skin.pvd", "--at", "100")
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(self.folder / "skin_1.vtu"))
        surface = vtk.vtkGeometryFilter()
        surface.SetInputConnection(reader.GetOutputPort())
        edges = vtk.vtkFeatureEdges()
        edges.SetInputConnection(surface.GetOutputPort())
        edges.FeatureEdgesOff()
        edges.ManifoldEdgesOff()  # what remains: edges of one triangle, or of more than two
        edges.Update()
        self.assertEqual(edges.GetOutput().GetNumberOfCells(), 0)
        cells = reader.GetOutput().GetCellData()
        self.assert_normal_velocity(vtk_to_numpy(cells.GetArray("normal_velocity_re")) + 1j * vtk_to_numpy(cells.GetArray("normal_velocity_im")), 0)

    @unittest.skipIf(meshio is None, "meshio (package python3-meshio) is not installed")
    def test_punched_output_has_velocities_at_the_nodes_of_its_bulk_data(self):
        path = self.exported("skin.pch", "--at", "250")
        mesh = meshio.read(path.with_suffix(".bdf"))
        np.testing.assert_array_equal(mesh.cells_dict["triangle"], self.triangles)
        np.testing.assert_allclose(mesh.points, self.nodes, rtol=1e-9, atol=1e-12)
        lines = [line for line in path.read_text().splitlines() if not line.startswith("$")]
        values = np.array([[float(line[18 + 18 * k:36 + 18 * k]) for k in range(3)] for line in lines]).reshape(-1, 4, 3)
        velocity = values[:, 0] + 1j * values[:, 2]
        flow = np.einsum("f,fc,fc->", self.area, self.normal, velocity[self.triangles].mean(axis=1))
        wanted = np.sum(self.area * ball.acoustic_velocity(1))
        self.assertAlmostEqual(abs(flow / wanted - 1.0), 0.0, delta=1e-6)


class NodalVelocity(Exported):
    def test_a_pulsating_sphere_moves_along_its_radii(self):
        surface = Surface.flat(self.nodes, self.triangles, {})
        velocity = acoustic_source.nodal_velocity(surface, np.full(len(self.triangles), 2.0 - 1.0j))
        radius = self.nodes / np.linalg.norm(self.nodes, axis=1)[:, None]
        np.testing.assert_allclose(np.einsum("nc,nc->n", velocity, radius), 2.0 - 1.0j, rtol=0.1)  # 96 flat triangles
        flow = np.einsum("f,fc,fc->", self.area, self.normal, velocity[self.triangles].mean(axis=1))
        np.testing.assert_allclose(flow, (2.0 - 1.0j) * self.area.sum(), rtol=1e-13)


class Refusals(Exported):
    def test_a_file_without_acoustic_skin_says_what_it_needs(self):
        with h5py.File(self.folder / "ball.field.h5", "r+") as file:
            del file["acoustic"]
        self.assertEqual(self.refused("-o", "x.unv"), "ball.field.h5: acoustic: missing, expected the acoustic skin; it needs lines and "
                         'sound = "part.sound.h5" in the field.toml, and a sound file of this version of clatter')

    def test_frames_sensors_and_invalid_triangles_are_refused(self):
        self.assertEqual(self.refused("-o", "x.unv", "--frames"), "--frames: found --skin acoustic, which has lines only")
        self.assertEqual(self.refused("-o", "x.unv", "--sensors"), "--sensors: found --at, --linear or --skin, which are for the surface")
        with h5py.File(self.folder / "ball.field.h5", "r+") as file:
            file["acoustic/triangles"][0, 0] = len(self.nodes)
        self.assertEqual(self.refused("-o", "x.unv"), f"ball.field.h5: acoustic/triangles: found nodes outside of 0 to {len(self.nodes) - 1}")


if __name__ == "__main__":
    unittest.main()
