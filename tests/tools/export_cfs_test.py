# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter export` for openCFS: the groups, datasets and attributes that openCFS's own reader asks for, read by h5py."""
import pathlib
import tempfile
import unittest

import h5py
import numpy as np
import synthetic_surface as ball


class OpenCfs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        ball.write(cls.folder / "ball.field.h5")
        cls.nodes, cls.triangles = ball.sphere()

    def exported(self, name, *arguments):
        ball.export(self.folder, "-o", name, *arguments)
        file = h5py.File(self.folder / name, "r")
        self.addCleanup(file.close)
        return file

    def test_the_mesh_has_one_region_and_the_panels_as_groups(self):
        mesh = self.exported("ball.cfs")["Mesh"]
        np.testing.assert_array_equal(mesh["Nodes/Coordinates"], self.nodes)
        np.testing.assert_array_equal(mesh["Elements/Connectivity"][()] - 1, self.triangles.astype(np.uint32))
        self.assertEqual(set(mesh["Elements/Types"]), {5})
        count = len(self.triangles)
        attributes = {name: int(value) for name, value in mesh["Elements"].attrs.items()}
        self.assertEqual(attributes, {"NumElems": count, "Num1DElems": 0, "Num2DElems": count, "Num3DElems": 0, "QuadraticElems": 1,
                                      "Num_TRIA3": 0, "Num_TRIA6": count})
        self.assertEqual((mesh.attrs["Dimension"], mesh["Nodes"].attrs["NumNodes"]), (3, len(self.nodes)))
        self.assertEqual(list(mesh["Regions"]), ["skin"])
        np.testing.assert_array_equal(mesh["Regions/skin/Elements"], np.arange(1, count + 1))
        np.testing.assert_array_equal(mesh["Regions/skin/Nodes"], np.arange(1, len(self.nodes) + 1))
        upper = np.flatnonzero(self.nodes[self.triangles[:, :3]].mean(axis=1)[:, 2] > 0)
        np.testing.assert_array_equal(mesh["Groups/upper/Elements"], upper + 1)
        self.assertEqual(mesh["Groups/upper"].attrs["Dimension"], 2)

    def test_lines_are_a_harmonic_sequence_step(self):
        file = self.exported("ball.cfs")
        results = file["Results/Mesh/MultiStep_1"]
        self.assertEqual((results.attrs["AnalysisType"], results.attrs["LastStepNum"], results.attrs["LastStepValue"]),
                         ("harmonic", 3, ball.FREQUENCIES[-1]))
        self.assertEqual(file["Results/Mesh"].attrs["ExternalFiles"], 0)
        description = results["ResultDescription"]
        for name, defined_on, entry, dofs in (("mechVelocity", 1, 3, [b"x", b"y", b"z"]), ("acouNormalVelocity", 4, 1, [b"-"])):
            own = description[name]
            self.assertEqual((own["DefinedOn"][0], own["EntryType"][0], own["NumDOFs"][0]), (defined_on, entry, len(dofs)))
            self.assertEqual((list(own["DOFNames"]), list(own["EntityNames"]), list(own["Unit"])), (dofs, [b"skin"], [b"m/s"]))
            np.testing.assert_array_equal(own["StepNumbers"], [1, 2, 3])
            np.testing.assert_array_equal(own["StepValues"], ball.FREQUENCIES)
        for step in range(3):
            group, wanted = results[f"Step_{step + 1}"], ball.line_velocity(self.nodes, step)
            self.assertEqual(group.attrs["StepValue"], ball.FREQUENCIES[step])
            nodal = group["mechVelocity/skin/Nodes"]
            np.testing.assert_array_equal(nodal["Real"][()] + 1j * nodal["Imag"][()], wanted)
            area, _, flow = ball.integrals(self.nodes, self.triangles, wanted)
            faces = group["acouNormalVelocity/skin/Elements"]
            self.assertEqual(faces["Real"].shape, (len(area), 1))
            np.testing.assert_allclose((faces["Real"][:, 0] + 1j * faces["Imag"][:, 0]) * area, flow, rtol=1e-12)
        self.assertIn(b"exp(+i 2 pi f t)", file["UserData/Conventions"][0])

    def test_frames_are_a_transient_one_on_linear_faces_too(self):
        file = self.exported("frames.cfs", "--frames", "--linear")
        results = file["Results/Mesh/MultiStep_1"]
        self.assertEqual(results.attrs["AnalysisType"], "transient")
        self.assertEqual(set(file["Mesh/Elements/Types"]), {4})
        self.assertEqual(file["Mesh/Elements"].attrs["Num_TRIA3"], 4 * len(self.triangles))
        for step in range(len(ball.TIMES)):
            nodal = results[f"Step_{step + 1}/mechVelocity/skin/Nodes"]
            self.assertEqual(list(nodal), ["Real"])
            np.testing.assert_array_equal(nodal["Real"][()], ball.frame_velocity(self.nodes, step))


if __name__ == "__main__":
    unittest.main()
