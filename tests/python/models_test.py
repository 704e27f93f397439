# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter.Rom, Modes and Model on the beam: against its full model, beam theory and hand calculations."""
import pathlib
import shutil
import sys
import unittest
import warnings

import numpy as np
from scipy.sparse.linalg import spsolve

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import clatter  # noqa: E402
import h5py  # noqa: E402
import stages  # noqa: E402
from clatter import model  # noqa: E402

LENGTH, WIDTH, HEIGHT, YOUNGS, DENSITY = 0.6, 0.04, 0.03, 210e9, 7850.0  # [m, Pa, kg/m3] of samples/beam
MASS = DENSITY * WIDTH * HEIGHT * LENGTH


def euler_bernoulli(height):
    """First frequency of the cantilever [Hz]: 1.8751^2 sqrt(E I / (rho A L^4)) / 2 pi."""
    return 1.875104**2 * np.sqrt(YOUNGS * height**2 / 12.0 / DENSITY) / LENGTH**2 / (2.0 * np.pi)


class Models(stages.PipelineTest):
    def open(self, name):
        found = clatter.open(self.folder / name)
        self.addCleanup(found.close)
        return found

    def reduced(self, changes, request):
        """The Rom of the beam with other texts in beam.fe.toml, {old: new}, and another rom.toml."""
        for old, new in changes.items():
            self.edit("beam.fe.toml", old, new)
        (self.folder / "beam.rom.toml").write_text(request)
        for stage in ("assembly", "condense"):
            done = stages.run_stage(stage, *self.command(stage), folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
        return self.open("beam.rom.h5")

    def free(self):
        support = '[[support]]\nsurface = "x_min"\n'
        return self.reduced({support: ""}, 'method = "craig-bampton"\nboundary = ["tip"]\nfmax_hz = 3000.0\n')

    def test_frequencies_of_a_reduced_model_are_those_of_the_full_model_and_of_theory(self):
        rom, modes = self.open("beam.rom.h5"), self.open("beam.modes.h5")
        below = modes.frequency_hz < rom.certificate["accurate_to_hz"]
        found = rom.modes(6).frequency_hz
        # The certificate's bound of the errors of the reduction, estimated.
        np.testing.assert_allclose(found[below], modes.frequency_hz[below], rtol=2.0 * rom.certificate["frequency_error_estimate"] + 1e-9)
        # Beam theory leaves out the clamp's constraint of the section: 0.5 %, see samples/beam.
        np.testing.assert_allclose(found[:2], [euler_bernoulli(HEIGHT), euler_bernoulli(WIDTH)], rtol=0.01)

    def test_shapes_have_unit_modal_mass_and_diagonal_stiffness(self):
        rom = self.open("beam.rom.h5")
        hz, shapes = rom.modes()
        size = len(hz)
        np.testing.assert_allclose(shapes.T @ rom.M @ shapes, np.eye(size), atol=1e-9)
        squared = (2.0 * np.pi * hz) ** 2
        np.testing.assert_allclose(shapes.T @ rom.K @ shapes, np.diag(squared), atol=1e-9 * squared[-1])

    def test_frf_is_that_of_the_full_model_below_the_cut_off(self):
        rom, full = self.open("beam.rom.h5"), self.open("beam.fe.h5")
        alpha, beta = full.damping
        hz = [20.0, 70.0, 500.0, 1500.0]  # accurate_to_hz is 2000
        force = full.loads["tip_force"]
        expected = []
        for omega in 2.0 * np.pi * np.array(hz):
            matrix = full.K * (1.0 + 1j * omega * alpha) + full.M * (1j * omega * beta - omega**2)
            expected.append(spsolve(matrix.tocsc(), force)[full.dofs("sensor_tip")])
        found = rom.frf("tip_force", "sensor_tip", hz)
        self.assertEqual(found.shape, (4, 3, 1))
        vertical = np.array(expected)[:, 2]
        # The truncated modes, all above 4000 Hz, have (1500 / 4000)^2 of their static share, which is nearly nothing of a displacement.
        np.testing.assert_allclose(found[:, 2, 0], vertical, rtol=1e-3)
        for quantity, power in (("velocity", 1), ("acceleration", 2)):
            np.testing.assert_allclose(rom.frf("tip_force", "sensor_tip.z", hz, quantity)[:, 0, 0],
                                       found[:, 2, 0] * (2j * np.pi * np.array(hz)) ** power)

    def test_damping_by_a_table_is_in_D_and_in_the_frf(self):
        rom = self.reduced({}, 'method = "craig-bampton"\nboundary = ["tip"]\nrows = ["sensor_tip"]\nfmax_hz = 2000.0\n'
                               "[[modal_damping]]\nhz = 50.0\nratio = 0.01\n[[modal_damping]]\nhz = 500.0\nratio = 0.03\n")
        hz, shapes = rom.modes()
        omega = 2.0 * np.pi * hz
        own = np.diag(shapes.T @ rom.D @ shapes)
        expected = 2.0 * np.clip(0.01 + 0.02 * (hz - 50.0) / 450.0, 0.01, 0.03) * omega + rom.attribute("alpha") * omega**2
        np.testing.assert_allclose(own, expected, rtol=1e-8)
        at = 2.0 * np.pi * 100.0
        direct = rom.T("sensor_tip") @ np.linalg.solve(rom.K + 1j * at * rom.D - at**2 * rom.M, rom.T("tip.z").T)
        np.testing.assert_allclose(rom.frf("tip.z", "sensor_tip", 100.0)[0], direct, rtol=1e-8, atol=1e-8 * abs(direct).max())

    def test_loss_factors_are_in_the_frf(self):
        recipe = 'method = "craig-bampton"\nboundary = ["tip"]\nrows = ["sensor_tip"]\nfmax_hz = 2000.0\n'
        path = shutil.copy(self.reduced({}, recipe).path, self.folder / "loss.rom.h5")
        with h5py.File(path, "r+") as file:
            file["loss"] = 0.05 * file["K_rr"][()] + 0.3 * np.diag(np.diag(file["K_rr"][()]))  # couples the modes
        rom = clatter.Rom(path)
        hz = np.array([40.0, 100.0])
        found = rom.frf("tip.z", "sensor_tip", hz, "velocity")
        for at, one in zip(2.0 * np.pi * hz, found):
            matrix = rom.K + 1j * rom.loss + 1j * at * rom.D - at**2 * rom.M
            direct = 1j * at * rom.T("sensor_tip") @ np.linalg.solve(matrix, rom.T("tip.z").T)
            np.testing.assert_allclose(one, direct, rtol=1e-8, atol=1e-8 * abs(direct).max())

    def test_static_response_and_rows_of_recovered_sets_are_those_of_the_full_model(self):
        rom = self.reduced({}, 'method = "craig-bampton"\nboundary = ["tip"]\nrows = ["sensor_tip"]\nfmax_hz = 1000.0\n')
        full = self.open("beam.fe.h5")
        q = spsolve(full.K.tocsc(), 100.0 * full.loads["tip_force"])
        found = rom.static({"tip_force": 100.0})
        for name in ("tip", "sensor_tip"):
            expected = q[full.dofs(name)]
            # Reduction by constraint modes is exact for a load on the boundary; rounding of a solve of condition 1e6.
            np.testing.assert_allclose(rom.T(name) @ found, expected, atol=1e-8 * abs(expected).max())
        np.testing.assert_array_equal(rom.T("sensor_tip.z", "tip")[0], rom.T("sensor_tip")[2])
        self.assertEqual(rom.T().shape, (9, len(rom.K)))
        np.testing.assert_allclose(rom.static(2.0 * rom.loads["tip_force"]), 0.02 * found)

    def test_mass_properties_are_those_of_the_bar(self):
        for name in ("beam.rom.h5", "beam.fe.h5"):
            mass, centre, inertia = self.open(name).mass_properties
            self.assertAlmostEqual(mass, MASS, delta=1e-9 * MASS)
            np.testing.assert_allclose(centre, [LENGTH / 2, WIDTH / 2, HEIGHT / 2], rtol=1e-9)
            sides = np.array([LENGTH, WIDTH, HEIGHT]) ** 2
            np.testing.assert_allclose(inertia, np.diag(MASS / 12.0 * (sides.sum() - sides)), atol=1e-9 * MASS)

    def test_a_part_that_nothing_holds_has_no_static_response(self):
        rom = self.free()
        self.assertEqual(rom.rigid_modes, 6)
        self.assertLess(rom.modes(6).frequency_hz.max(), 0.1)
        translations = rom.file["rigid"][:, :3]
        np.testing.assert_allclose(translations.T @ rom.M @ translations, MASS * np.eye(3), atol=1e-9 * MASS)
        for call, said in ((lambda: rom.static("tip_force"), "static: found 6 rigid motions, expected a part that supports hold"),
                           (lambda: rom.frf("tip.z", "tip.z", [0.0, 1.0]), "frf: found 0 Hz, expected another frequency")):
            with self.assertRaisesRegex(clatter.Refused, said):
                call()
        # Far below its first mode the body is a mass that the force turns: 1 / m + a^2 / I of the tip, at half the length from the centre.
        rigid = 1.0 / MASS + (LENGTH / 2) ** 2 / (MASS / 12.0 * (LENGTH**2 + HEIGHT**2))
        self.assertAlmostEqual(abs(rom.frf("tip.z", "tip.z", 1.0, "acceleration")[0, 0, 0]), rigid, delta=1e-3 * rigid)

    def test_a_mass_matrix_that_is_not_positive_definite_is_refused(self):
        for size in (0.0, 1e3):  # no mass, and off the diagonal more than on it
            with h5py.File(self.folder / "beam.rom.h5", "r+") as file:
                M = file["M_rr"][()]
                M[0, 0], M[0, 1], M[1, 0] = M[0, 0] * bool(size), size, size
                file["M_rr"][...] = M
            with self.assertRaisesRegex(clatter.Refused, "beam.rom.h5: M_rr: found a matrix that is not positive definite"), \
                    clatter.open(self.folder / "beam.rom.h5") as rom:
                rom.modes()
            (self.folder / "beam.rom.h5").write_bytes((self.master / "beam.rom.h5").read_bytes())

    def test_the_skin_moves_as_its_nodes_in_the_full_model(self):
        rom, modes = self.open("beam.rom.h5"), self.open("beam.modes.h5")
        self.assertEqual((rom.T_skin.shape, rom.skin_triangles.shape[1]), ((3 * len(rom.skin_nodes), len(rom.K)), 6))
        row = {tuple(x): k for k, x in enumerate(np.round(modes.nodes, 9))}
        own = [row[tuple(x)] for x in np.round(rom.skin_nodes, 9)]
        full = modes.shape(1)[own].ravel()
        reduced = rom.T_skin @ rom.modes(1).shapes[:, 0]
        # Single precision of the stored shapes, and the error of the first shape.
        self.assertAlmostEqual(abs(full @ reduced) / np.linalg.norm(full) / np.linalg.norm(reduced), 1.0, delta=1e-5)
        np.testing.assert_array_equal(modes.shapes[0], modes.shape(1))

    def test_matrices_are_the_same_without_scipy(self):
        full = self.open("beam.fe.h5")
        self.addCleanup(setattr, model, "csr_matrix", model.csr_matrix)
        with_scipy, stiff, model.csr_matrix = full.T, full.K, None
        alone = model.read_csr(full.file, "T")
        np.testing.assert_array_equal(np.diff(alone.indptr), with_scipy.getnnz(axis=1))
        x = np.random.default_rng(3).standard_normal(alone.shape[1])
        products = np.add.reduceat(np.append(alone.data * x[alone.indices], 0.0), alone.indptr[:-1]) * (np.diff(alone.indptr) > 0)
        np.testing.assert_allclose(products, with_scipy @ x, rtol=1e-12, atol=1e-14)
        stiffness = model.read_csr(full.file, "K")
        sums = np.bincount(np.repeat(np.arange(stiffness.shape[0]), np.diff(stiffness.indptr)), stiffness.data)
        np.testing.assert_allclose(sums, stiff @ np.ones(len(sums)), atol=1e-9 * abs(stiff).max())
        self.assertEqual(abs(stiff - stiff.T).max(), 0.0)

    def test_wrong_names_files_and_frequencies_are_refused_in_one_line(self):
        rom = self.open("beam.rom.h5")
        for call, said in ((lambda: rom.T("top"), r"beam.rom.h5: sets: found no top, expected one of sensor_tip, tip, or sensor_tip.x, .*"),
                           (lambda: rom.static("gas"), r"beam.rom.h5: loads: found no gas, expected one of tip_force"),
                           (lambda: rom.frf("tip", "tip", 10.0, "jerk"), "frf: quantity: found jerk, expected displacement, velocity, acc"),
                           (lambda: clatter.Rom(self.folder / "beam.mesh.h5"), "schema: found clatter/mesh/2, expected clatter/rom/1"),
                           (lambda: clatter.open(self.folder / "beam.mesh.h5"),
                            "schema: found clatter/mesh/2, expected that of fe, modes, rom, run, field, sound"),
                           (lambda: clatter.open(self.folder / "beam.rom.toml"), "not a readable HDF5 file"),
                           (lambda: clatter.open(self.folder / "gone.rom.h5"), "gone.rom.h5: no such file"),
                           (lambda: self.open("beam.modes.h5").shape(7), "found 6 modes, expected mode 7")):
            with self.subTest(said=said), self.assertRaisesRegex(clatter.Refused, said) as caught:
                call()
            self.assertNotIn("\n", str(caught.exception))
        with self.assertWarnsRegex(UserWarning, "2500 Hz: its modes are accurate to 2000 Hz"):
            rom.frf("tip.z", "tip.z", 2500.0)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            rom.frf("tip.z", "tip.z", 2000.0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
