# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter export` to universal files, read by a parser written from the data set definitions alone (fixed columns), and by Gmsh."""
import pathlib
import tempfile
import unittest

import numpy as np
import synthetic_surface as ball

try:
    import gmsh
except ImportError:
    gmsh = None


def columns(line, *widths):
    """Fields of fixed width of one line."""
    ends = np.cumsum(widths)
    return [line[end - width:end] for width, end in zip(widths, ends)]


def integers(line):
    """I10 fields."""
    return [int(line[k:k + 10]) for k in range(0, len(line.rstrip("\n")), 10)]


def reals(line, width):
    """Fields of E or D format."""
    return [float(line[k:k + width].replace("D", "E")) for k in range(0, len(line.rstrip("\n")), width)]


def read_datasets(path):
    """[(number, lines)]"""
    found, own = [], None
    for line in path.read_text().splitlines():
        if line == "    -1":
            own = None if own is not None else []
            if own is not None:
                found.append(own)
        else:
            own.append(line)
    return [(int(lines[0]), lines[1:]) for lines in found]


def read_nodes(lines):
    """{number: position} of 2411: 4I10, then 1P3D25.16."""
    for line in lines[1::2]:
        assert len(line) == 75
    return {integers(head)[0]: reals(place, 25) for head, place in zip(lines[::2], lines[1::2])}


def read_elements(lines):
    """{number: (descriptor, nodes)} of 2412: 6I10, then 8I10."""
    return {integers(head)[0]: (integers(head)[1], integers(nodes)) for head, nodes in zip(lines[::2], lines[1::2])
            if integers(head)[5] == len(integers(nodes))}


def read_values(lines, head_fields):
    """{number: values} of records 14 and 15 of 2414, or 9 and 10 of 55: complex where the caller pairs them."""
    found, k = {}, 0
    while k < len(lines):
        head = integers(lines[k])
        assert len(head) == head_fields
        found[head[0]] = reals(lines[k + 1], 13)
        k += 2
    return found


def read_2414(lines):
    return {"name": lines[1], "location": int(lines[2]), "ids": lines[3:8], "kind": integers(lines[8]), "numbers": integers(lines[9]),
            "reals": reals(lines[11], 13), "values": read_values(lines[13:], 1 if int(lines[2]) == 1 else 2)}


def read_58(lines):
    head = columns(lines[5], 5, 10, 5, 10, 1, 10, 10, 4, 1, 10, 10, 4)
    form = columns(lines[6], 10, 10, 10, 13, 13, 13)
    axis = columns(lines[7], 10, 5, 5, 5, 1, 20, 1, 20)
    ordinate = columns(lines[8], 10, 5, 5, 5, 1, 20, 1, 20)
    values = np.concatenate([reals(line, 20) for line in lines[11:]])
    return {"ids": lines[:5], "function": int(head[0]), "node": int(head[6]), "direction": int(head[7]), "type": int(form[0]),
            "count": int(form[1]), "even": int(form[2]), "first": float(form[3]), "step": float(form[4]),
            "axis": (int(axis[0]), axis[7].strip()), "ordinate": (int(ordinate[0]), ordinate[7].strip()),
            "values": values[::2] + 1j * values[1::2] if int(form[0]) in (5, 6) else values}


class Universal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        ball.write(cls.folder / "ball.field.h5")
        cls.nodes, cls.triangles = ball.sphere()
        ball.export(cls.folder, "-o", "ball.unv", "--quantity", "velocity,normal_velocity")
        cls.datasets = read_datasets(cls.folder / "ball.unv")

    def exported(self, name, *arguments):
        ball.export(self.folder, "-o", name, *arguments)
        return read_datasets(self.folder / name)

    def test_units_nodes_and_elements_are_those_of_the_skin(self):
        self.assertEqual([number for number, _ in self.datasets[:4]], [164, 2411, 2412, 2467])
        units = self.datasets[0][1]
        self.assertEqual((int(units[0][:10]), reals(units[1], 25)), (1, [1, 1, 1]))
        nodes = read_nodes(self.datasets[1][1])
        self.assertEqual(list(nodes), list(range(1, len(self.nodes) + 1)))
        np.testing.assert_array_equal(np.array(list(nodes.values())), self.nodes)
        elements = read_elements(self.datasets[2][1])
        self.assertEqual(len(elements), len(self.triangles))
        self.assertEqual({kind for kind, _ in elements.values()}, {92})
        ring = np.array([ids for _, ids in elements.values()]) - 1
        np.testing.assert_array_equal(ring[:, [0, 2, 4, 1, 3, 5]], self.triangles)
        self.assertTrue(0.7 < ball.volume(self.nodes, ring[:, ::2]) / (4 / 3 * np.pi * ball.RADIUS**3) < 1)

    def test_panels_are_groups_of_elements(self):
        lines = self.datasets[3][1]
        head = integers(lines[0])
        self.assertEqual((head[7], lines[1]), (len(self.triangles), "skin"))
        rest = lines[2 + (len(self.triangles) + 1) // 2:]
        self.assertEqual(rest[1], "upper")
        members = [field for line in rest[2:] for field in integers(line)]
        self.assertEqual(set(members[::4]), {8})
        centre = self.nodes[self.triangles[:, :3]].mean(axis=1)
        self.assertEqual(members[1::4], list(np.flatnonzero(centre[:, 2] > 0) + 1))

    def test_2414_has_complex_peak_velocities_at_nodes_and_normal_ones_on_elements(self):
        results = [read_2414(lines) for number, lines in self.datasets if number == 2414]
        self.assertEqual([result["location"] for result in results], [1, 2] * 3)
        self.assertEqual([result["reals"][1] for result in results[::2]], list(ball.FREQUENCIES))
        for step, (nodal, faces) in enumerate(zip(results[::2], results[1::2])):
            self.assertEqual(nodal["kind"], [1, 5, 2, 11, 5, 3])
            self.assertEqual(faces["kind"], [1, 5, 1, 11, 5, 1])
            self.assertEqual(nodal["numbers"][7], step + 1)
            values = np.array(list(nodal["values"].values()))
            wanted = ball.line_velocity(self.nodes, step)
            np.testing.assert_allclose(values[:, ::2] + 1j * values[:, 1::2], wanted, atol=5e-6 * np.abs(wanted).max())
            area, _, flow = ball.integrals(self.nodes, self.triangles, wanted)
            normal = np.array(list(faces["values"].values()))
            np.testing.assert_allclose((normal[:, 0] + 1j * normal[:, 1]) * area, flow, atol=5e-6 * np.abs(flow).max())

    def test_the_wave_travels_where_it_should_and_the_head_says_by_which_convention(self):
        result = next(read_2414(lines) for number, lines in self.datasets if number == 2414)
        self.assertIn("peak amplitudes, x(t) = Re( X exp(+i 2 pi f t) )", result["ids"][1])
        self.assertIn("velocity in m/s", result["ids"][3])
        self.assertTrue(all(0 < len(line) <= 80 for line in result["ids"]))
        values = np.array([complex(v[0], v[1]) for v in result["values"].values()])  # x component
        along = self.nodes @ ball.WAVE
        first, last = np.argmin(along), np.argmax(along)
        lag = np.angle(values[last] / values[first])
        self.assertAlmostEqual(lag, -(along[last] - along[first]), delta=1e-4)  # the far node is later

    def test_55_has_the_same_values(self):
        datasets = self.exported("old.unv", "--dataset", 55, "--at", "250", "--quantity", "acceleration")
        (lines,) = [lines for number, lines in datasets if number == 55]
        self.assertEqual(integers(lines[5]), [1, 5, 2, 12, 5, 3])
        self.assertEqual(integers(lines[6]), [2, 1, 1, 1])
        self.assertEqual(reals(lines[7], 13), [250.0])
        values = np.array(list(read_values(lines[8:], 1).values()))
        wanted = 2j * np.pi * 250 * ball.line_velocity(self.nodes, 1)
        np.testing.assert_allclose(values[:, ::2] + 1j * values[:, 1::2], wanted, atol=5e-6 * np.abs(wanted).max())
        _, refused = ball.export(self.folder, "-o", "no.unv", "--dataset", 55, "--quantity", "normal_velocity", code=2)
        self.assertEqual(refused, "clatter: error: --dataset 55: found normal_velocity, expected quantities at nodes; 2414 has both\n")

    def test_frames_are_transient_and_real(self):
        results = [read_2414(lines) for number, lines in self.exported("frames.unv", "--frames") if number == 2414]
        self.assertEqual([result["reals"][0] for result in results], list(ball.TIMES))
        for step, result in enumerate(results):
            self.assertEqual(result["kind"], [1, 4, 2, 11, 2, 3])
            values = np.array(list(result["values"].values()))
            np.testing.assert_allclose(values, ball.frame_velocity(self.nodes, step), atol=1e-8)

    def test_linear_faces_are_thin_shells_of_three_nodes(self):
        elements = read_elements(dict(self.exported("linear.unv", "--linear"))[2412])
        self.assertEqual({kind for kind, _ in elements.values()}, {91})
        self.assertEqual(len(elements), 4 * len(self.triangles))

    def test_functions_58_are_the_sensors_spectra(self):
        datasets = self.exported("sensors.unv", "--sensors", "--quantity", "acceleration")
        places = read_nodes(dict(datasets)[2411])
        functions = [read_58(lines) for number, lines in datasets if number == 58]
        self.assertEqual([function["direction"] for function in functions], [1, 2, 3, 0, -6])
        for channel, function in enumerate(functions):
            self.assertEqual((function["function"], function["type"], function["even"]), (12, 6, 1))
            self.assertEqual((function["axis"], function["ordinate"]), ((18, "Hz"), (12, "rad/s2" if channel == 4 else "m/s2")))
            hz = function["first"] + function["step"] * np.arange(function["count"])
            np.testing.assert_allclose(hz, ball.SENSOR_HZ)
            np.testing.assert_allclose(function["values"], ball.sensor_spectrum("acceleration", channel), rtol=1e-11)
            self.assertIn("peak", function["ids"][1])
            np.testing.assert_array_equal(places[function["node"]], [0.1, 0, 0] if channel < 3 else [0, 0, -0.1])
        self.assertIn("direction 0.6 0 0.8", functions[3]["ids"][4])

    def test_functions_58_are_the_sensors_histories_on_request(self):
        datasets = self.exported("histories.unv", "--sensors", "--histories", "--quantity", "acceleration")
        functions = [read_58(lines) for number, lines in datasets if number == 58]
        self.assertEqual([function["direction"] for function in functions], [1, 2, 3, 0, -6])
        for channel, function in enumerate(functions):
            self.assertEqual((function["function"], function["type"], function["even"]), (1, 4, 1))
            self.assertEqual((function["axis"], function["ordinate"]), ((17, "s"), (12, "rad/s2" if channel == 4 else "m/s2")))
            self.assertEqual((function["count"], len(function["values"])), (31, 31))
            np.testing.assert_allclose(function["first"] + function["step"] * np.arange(31), ball.SENSOR_TIME, atol=1e-8)
            np.testing.assert_allclose(function["values"], ball.sensor_history("acceleration", channel), rtol=1e-11)
            self.assertIn("real values, time from crank angle 0", function["ids"][1])

    @unittest.skipIf(gmsh is None, "Gmsh (package python3-gmsh) is not installed")
    def test_gmsh_reads_the_mesh(self):
        gmsh.initialize(["", "-v", "0"])
        self.addCleanup(gmsh.finalize)
        gmsh.open(str(self.folder / "ball.unv"))
        tags, places, _ = gmsh.model.mesh.getNodes()
        np.testing.assert_allclose(places.reshape(-1, 3)[np.argsort(tags)], self.nodes, atol=1e-15)
        kinds, _, nodes = gmsh.model.mesh.getElements(2)
        self.assertEqual(list(kinds), [9])
        self.assertEqual({tuple(row) for row in nodes[0].reshape(-1, 6)}, {tuple(row) for row in self.triangles + 1})


if __name__ == "__main__":
    unittest.main()
