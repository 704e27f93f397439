# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter export` for Gmsh and Nastran: .msh with data and .bdf as Gmsh and meshio read them, .pch by its columns."""
import pathlib
import tempfile
import unittest

import numpy as np
import synthetic_surface as ball

try:
    import gmsh
except ImportError:
    gmsh = None
try:
    import meshio
except ImportError:
    meshio = None


class Exported(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        ball.write(cls.folder / "ball.field.h5")
        cls.nodes, cls.triangles = ball.sphere()
        ball.export(cls.folder, "-o", "ball.msh")
        ball.export(cls.folder, "-o", "frames.msh", "--frames", "--linear", "--quantity", "velocity")
        ball.export(cls.folder, "-o", "ball.pch", "--quantity", "velocity,displacement")
        ball.export(cls.folder, "-o", "frames.pch", "--frames", "--linear")


class Readers(Exported):
    def opened_by_gmsh(self, name):
        if gmsh is None:
            self.skipTest("Gmsh (package python3-gmsh) is not installed")
        gmsh.initialize(["", "-v", "0"])
        self.addCleanup(gmsh.finalize)
        gmsh.open(str(self.folder / name))
        tags, places, _ = gmsh.model.mesh.getNodes()
        kinds, _, rows = gmsh.model.mesh.getElements(2)
        return tags, places.reshape(-1, 3), list(kinds), rows[0]

    def views(self):
        """{name: [(time, tags, values), ...]}"""
        names = [gmsh.option.getString(f"View[{k}].Name") for k in range(len(gmsh.view.getTags()))]
        found = {}
        for name, tag in zip(names, gmsh.view.getTags()):
            count = int(gmsh.option.getNumber(f"View[{gmsh.view.getIndex(tag)}].NbTimeStep"))
            steps = [gmsh.view.getModelData(tag, step) for step in range(count)]
            found[name] = [(time, own, np.array(values)) for _, own, values, time, _ in steps]
        return found

    def test_gmsh_reads_mesh_and_views_of_lines(self):
        tags, places, kinds, rows = self.opened_by_gmsh("ball.msh")
        np.testing.assert_array_equal(places[np.argsort(tags)], self.nodes)
        self.assertEqual(kinds, [9])
        np.testing.assert_array_equal(rows.reshape(-1, 6) - 1, self.triangles)
        views = self.views()
        self.assertEqual(sorted(views), ["normal_velocity_im", "normal_velocity_re", "velocity_im", "velocity_re"])
        for step, hz in enumerate(ball.FREQUENCIES):
            wanted = ball.line_velocity(self.nodes, step)
            area, _, flow = ball.integrals(self.nodes, self.triangles, wanted)
            (time, tags, real), (_, _, imag) = views["velocity_re"][step], views["velocity_im"][step]
            self.assertEqual(time, hz)
            np.testing.assert_allclose((real + 1j * imag)[np.argsort(tags)], wanted, atol=1e-9 * np.abs(wanted).max())
            (_, tags, real), (_, _, imag) = views["normal_velocity_re"][step], views["normal_velocity_im"][step]
            np.testing.assert_allclose((real + 1j * imag)[np.argsort(tags), 0] * area, flow, atol=1e-9 * np.abs(flow).max())

    def test_gmsh_reads_frames_on_linear_faces(self):
        _, places, kinds, rows = self.opened_by_gmsh("frames.msh")
        self.assertEqual((kinds, len(rows)), ([2], 12 * len(self.triangles)))
        self.assertGreater(ball.volume(self.nodes, rows.reshape(-1, 3).astype(int) - 1), 0)
        (name, steps), = self.views().items()
        self.assertEqual(name, "velocity")
        np.testing.assert_allclose([time for time, _, _ in steps], ball.TIMES)
        for step, (_, tags, values) in enumerate(steps):
            np.testing.assert_allclose(values[np.argsort(tags)], ball.frame_velocity(self.nodes, step), atol=1e-11)

    @unittest.skipIf(meshio is None, "meshio (package python3-meshio) is not installed")
    def test_meshio_reads_the_msh(self):
        mesh = meshio.read(self.folder / "ball.msh")
        np.testing.assert_array_equal(mesh.points, self.nodes)
        np.testing.assert_array_equal(mesh.cells_dict["triangle6"], self.triangles)
        self.assertIn("velocity_re", mesh.point_data)
        self.assertIn("normal_velocity_im", mesh.cell_data)

    def test_the_head_of_the_msh_has_the_conventions(self):
        head = (self.folder / "ball.msh").read_text().partition("$Nodes")[0]
        for words in ("peak amplitudes, x(t) = Re( X exp(+i 2 pi f t) )", "velocity m/s", "normals out of the solid", "frequency in Hz"):
            self.assertIn(words, head)

    @unittest.skipIf(meshio is None, "meshio (package python3-meshio) is not installed")
    def test_meshio_reads_the_bulk_data(self):
        for name, kind, faces in (("ball", "triangle6", self.triangles), ("frames", "triangle", None)):
            mesh = meshio.read(self.folder / f"{name}.bdf")
            np.testing.assert_allclose(mesh.points, self.nodes, rtol=1e-9)
            if faces is not None:
                np.testing.assert_array_equal(mesh.cells_dict[kind], faces)
            self.assertGreater(ball.volume(mesh.points, mesh.cells_dict[kind]), 0)

    def test_gmsh_reads_the_bulk_data(self):
        _, _, kinds, rows = self.opened_by_gmsh("ball.bdf")
        self.assertEqual(kinds, [9])
        np.testing.assert_array_equal(rows.reshape(-1, 6) - 1, self.triangles)


def read_punch(path):
    """[(heads, {node: numbers})] by Nastran's columns: I10, G, 3 E18.6, sequence number."""
    blocks, own = [], None
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if len(line) != 80 or int(line[72:]) != number:
            raise AssertionError(line)
        if line.startswith("$TITLE"):
            blocks.append(([], {}))
        if line.startswith("$"):
            blocks[-1][0].append(line[:72].rstrip())
        elif line.startswith("-CONT-"):
            own += [float(line[k:k + 18]) for k in (18, 36, 54)]
        else:
            if line[10:18] != "       G":
                raise AssertionError(line)
            own = blocks[-1][1].setdefault(int(line[:10]), [])
            own += [float(line[k:k + 18]) for k in (18, 36, 54)]
    return blocks


class Punch(Exported):
    def test_lines_are_sort1_with_real_and_imaginary_parts(self):
        blocks = read_punch(self.folder / "ball.pch")
        self.assertEqual([heads[3] for heads, _ in blocks], ["$VELOCITY", "$DISPLACEMENTS"] * 3)
        for step, hz in enumerate(ball.FREQUENCIES):
            wanted = ball.line_velocity(self.nodes, step)
            for (heads, values), factor in zip(blocks[2 * step:2 * step + 2], (1, 1 / (2j * np.pi * hz))):
                self.assertEqual(heads[4:6], ["$REAL-IMAGINARY OUTPUT", "$SUBCASE ID =           1"])
                self.assertEqual((heads[6][:12], float(heads[6][12:])), ("$FREQUENCY =", hz))
                self.assertIn("PEAK, EXP(+I 2 PI F T), SI", heads[2])
                self.assertEqual(list(values), list(range(1, len(self.nodes) + 1)))
                numbers = np.array(list(values.values()))
                np.testing.assert_array_equal(numbers[:, [3, 4, 5, 9, 10, 11]], 0)
                np.testing.assert_allclose(numbers[:, :3] + 1j * numbers[:, 6:9], wanted * factor, atol=1e-6 * np.abs(wanted * factor).max())

    def test_frames_are_real_output(self):
        blocks = read_punch(self.folder / "frames.pch")
        for step, (heads, values) in enumerate(blocks):
            self.assertEqual((heads[4], heads[6][:7], float(heads[6][7:])), ("$REAL OUTPUT", "$TIME =", ball.TIMES[step]))
            numbers = np.array(list(values.values()))
            np.testing.assert_allclose(numbers[:, :3], ball.frame_velocity(self.nodes, step), atol=1e-8)


if __name__ == "__main__":
    unittest.main()
