# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter export --format numcalc`, read as NumCalc reads its input: words of lines that do not begin with #."""
import pathlib
import tempfile
import unittest

import numpy as np
import synthetic_surface as ball


def words(path):
    """Lists of words of each line that NumCalc sees."""
    return [line.split() for line in path.read_text().splitlines() if line.strip() and not line.startswith("#")]


def read_input(path):
    """(frequency, counts of elements and nodes, air, paths, {element: velocity}) of an NC.inp."""
    lines = words(path)
    if lines[0][0] != "Mesh2HRTF" or lines[-1] != ["END"]:
        raise AssertionError(lines[0])
    curve = next(k for k, line in enumerate(lines) if line == ["0", "2"])
    main = [[float(word) for word in line] for line in lines[curve + 3:curve + 7]]
    nodes, elements, boundary = (lines.index([word]) for word in ("NODES", "ELEMENTS", "BOUNDARY"))
    velocity = {}
    for line in lines[boundary + 1:lines.index(["RETU"])]:
        if (line[0], line[2], line[4], line[6], line[8]) != ("ELEM", "TO", "VELO", "-1", "-1"):
            raise AssertionError(line)
        for element in range(int(line[1]), int(line[3]) + 1):
            velocity[element] = complex(float(line[5]), float(line[7]))
    return {"hz": float(lines[curve + 2][1]), "elements": int(main[0][1]), "nodes": int(main[0][2]), "groups": int(main[0][0]),
            "air": main[3][:2], "time_factor": main[3][2], "paths": (lines[nodes + 1][0], lines[elements + 1][0]), "velocity": velocity}


class NumCalc(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        ball.write(cls.folder / "ball.field.h5")
        cls.nodes, cls.triangles = ball.sphere()
        ball.export(cls.folder, "-o", "sound", "--format", "numcalc")
        cls.inputs = [read_input(path) for path in sorted((cls.folder / "sound").glob("line_*/NC.inp"))]
        cls.places, cls.elements = cls.mesh(cls.folder / "sound/line_0001", cls.inputs[0]["paths"])
        cls.velocity = [np.array([own["velocity"][k] for k in range(len(cls.elements))]) for own in cls.inputs]

    @staticmethod
    def mesh(folder, paths):
        """Nodes and elements by the paths in an NC.inp, relative to its folder."""
        nodes, elements = (words(folder / path) for path in paths)
        for lines in (nodes, elements):
            if int(lines[0][0]) != len(lines) - 1 or [int(line[0]) for line in lines[1:]] != list(range(len(lines) - 1)):
                raise AssertionError("numbers of lines")
        if {len(line) for line in elements[1:]} != {7}:
            raise AssertionError("not triangles")
        return np.array([line[1:] for line in nodes[1:]], float), np.array([line[1:4] for line in elements[1:]], int)

    def test_each_line_has_its_frequency_air_and_counts(self):
        np.testing.assert_allclose([own["hz"] for own in self.inputs], ball.FREQUENCIES)
        for own in self.inputs:
            self.assertEqual((own["elements"], own["nodes"], own["groups"]), (4 * len(self.triangles), len(self.nodes), 1))
            self.assertEqual((own["air"], own["time_factor"]), ([340.0, 1.2], 1.0))

    def test_the_surface_is_closed_outward_and_has_no_unused_node(self):
        np.testing.assert_allclose(self.places, self.nodes, atol=1e-12)
        self.assertTrue(0.9 < ball.volume(self.places, self.elements) / (4 / 3 * np.pi * ball.RADIUS**3) < 1)
        edges = np.concatenate([self.elements[:, [0, 1]], self.elements[:, [1, 2]], self.elements[:, [2, 0]]])
        self.assertEqual({tuple(edge) for edge in edges}, {tuple(edge[::-1]) for edge in edges})
        self.assertEqual(len(np.unique(self.elements)), len(self.nodes))

    def test_the_phase_is_conjugated(self):
        # With e^{-i w t} a wave that travels along k is exp(+i k . x): the phase of v_n / (direction . n) rises along k.
        a, b, c = np.moveaxis(self.places[self.elements], 1, 0)
        normal = np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        centre = (a + b + c) / 3
        facing = np.abs(normal @ ball.DIRECTION) > 0.5
        for step, velocity in enumerate(self.velocity):
            wave = np.conj(ball.AMPLITUDE) * (step + 1) * np.exp(1j * centre @ ball.WAVE) * (normal @ ball.DIRECTION)
            np.testing.assert_allclose(velocity[facing], wave[facing], rtol=0.12)  # flat quarters on a coarse sphere
            wrong = np.abs(velocity[facing] - np.conj(wave[facing])).max() / np.abs(wave).max()
            self.assertGreater(wrong, 0.3)
        self.assertIn("exp(-i 2 pi f t)", (self.folder / "sound/line_0001/NC.inp").read_text())

    def test_four_quarters_have_the_volume_flow_of_their_face(self):
        a, b, c = np.moveaxis(self.places[self.elements], 1, 0)
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
        for step, velocity in enumerate(self.velocity):
            flow = ball.integrals(self.nodes, self.triangles, ball.line_velocity(self.nodes, step))[2]
            np.testing.assert_allclose((np.conj(velocity) * area).reshape(-1, 4).sum(axis=1), flow, atol=1e-8 * np.abs(flow).max())

    def test_a_second_export_replaces_the_folder_and_no_other(self):
        ball.export(self.folder, "-o", "twice", "--format", "numcalc")
        ball.export(self.folder, "-o", "twice", "--format", "numcalc", "--at", "250")
        self.assertEqual([path.name for path in (self.folder / "twice").glob("line_*")], ["line_0001"])
        self.assertEqual(read_input(self.folder / "twice/line_0001/NC.inp")["hz"], 250.0)
        (self.folder / "mine").mkdir()
        (self.folder / "mine/letter").write_text("x")
        _, message = ball.export(self.folder, "-o", "mine", "--format", "numcalc", code=2)
        self.assertEqual(message, "clatter: error: mine: found a file or folder that clatter export did not write, expected a new name\n")
        self.assertEqual([path.name for path in (self.folder / "mine").iterdir()], ["letter"])

    def test_frames_are_refused(self):
        _, message = ball.export(self.folder, "-o", "no", "--format", "numcalc", "--frames", code=2)
        self.assertEqual(message, "clatter: error: --frames: found a format that has lines only\n")


if __name__ == "__main__":
    unittest.main()
