# SPDX-License-Identifier: GPL-3.0-or-later
"""Methods of the condensation from TOML to files, compared with SciPy: own modes, load shapes, modal damping."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import scipy.linalg  # noqa: E402
import scipy.sparse as sparse  # noqa: E402
import scipy.sparse.linalg as sparse_linalg  # noqa: E402
import stages  # noqa: E402

MESH = 'name = "beam"\nkind = "box"\nlength_unit = "mm"\n[box]\nsize = [300.0, 40.0, 30.0]\nregion = "bar"\n' \
       '[mesh]\nelement_size_mm = 20.0\n'
MODEL = '''[material.steel]
regions = ["bar"]
E_gpa = 210.0
nu = 0.3
rho = 7850.0
[damping]
ratio = 0.01
at_hz = 270.0
[[support]]
surface = "x_min"
[[coupling]]
name = "tip"
surface = "x_max"
[[load]]
name = "tip_force"
kind = "force"
set = "tip"
force = [0.0, 0.0, 1.0]
unit = "N"
[[load]]
name = "top"
kind = "pressure"
surface = "z_max"
'''
RUN = '[time]\nend_s = 0.02\noutput_step_us = 20.0\nlargest_step_us = 10.0\n[[body]]\nname = "beam"\nrom = "beam.rom.h5"\n' \
      '[[load]]\nbody = "beam"\nload = "tip_force"\nvalue = 100.0\n'


def symmetric(group):
    lower = sparse.csc_matrix((group["data"][()], group["indices"][()], group["indptr"][()]), shape=group.attrs["shape"])
    return (lower + sparse.tril(lower, -1).T).tocsc()


class Methods(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        scratch = tempfile.TemporaryDirectory(prefix="clatter-methods-")
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        (cls.folder / "beam.mesh.toml").write_text(MESH)
        (cls.folder / "beam.fe.toml").write_text(MODEL)
        cls.stage("mesh", "beam.mesh.toml", "-o", "beam.mesh.h5")
        cls.stage("assembly", "beam.mesh.h5", "-c", "beam.fe.toml", "-o", "beam.fe.h5")
        with h5py.File(cls.folder / "beam.fe.h5") as fe:
            cls.K, cls.M = symmetric(fe["K"]), symmetric(fe["M"])
            T = fe["T"]
            cls.T = sparse.csc_matrix((T["data"][()], T["indices"][()], T["indptr"][()]), shape=T.attrs["shape"])
            cls.nodes, cls.top = fe["nodes"][()], fe["loads/top"][()]

    @classmethod
    def stage(cls, name, *arguments):
        done = stages.run_stage(name, *arguments, folder=cls.folder)
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)
        return done.stdout + done.stderr

    def condense(self, text):
        (self.folder / "beam.rom.toml").write_text('boundary = ["tip"]\n' + text)
        self.said = self.stage("condense", "beam.fe.h5", "-c", "beam.rom.toml", "-o", "beam.rom.h5")
        return h5py.File(self.folder / "beam.rom.h5")

    def test_own_modes_have_the_frequencies_that_scipy_finds_in_the_full_model(self):
        values = np.sort(sparse_linalg.eigsh(self.K, 20, self.M, sigma=0.0)[0])
        full = np.sqrt(values) / (2 * np.pi)
        fmax = 0.5 * (full[14] + full[15])
        with self.condense(f'method = "craig-chang"\nfmax_hz = {fmax}\n') as rom:
            values = scipy.linalg.eigh(rom["K_rr"][()], rom["M_rr"][()], eigvals_only=True)
            self.assertEqual(rom["certificate"].attrs["own_modes"], 15)
        found = np.sqrt(values) / (2 * np.pi)
        # Both solvers' residuals, squared, are below; rounding of K against the lowest mode is about 1e-9.
        self.assertLess(np.abs(found[:15] / full[:15] - 1).max(), 1e-8)

    def test_a_requested_accuracy_is_met_against_scipy_and_the_choice_is_reported(self):
        values = np.sort(sparse_linalg.eigsh(self.K, 20, self.M, sigma=0.0)[0])
        full = np.sqrt(values) / (2 * np.pi)
        wanted = 0.5 * (full[9] + full[10])
        with self.condense(f"accurate_to_hz = {wanted}\nfrequency_error = 0.005\n") as rom:
            values = scipy.linalg.eigh(rom["K_rr"][()], rom["M_rr"][()], eigvals_only=True)
        found = np.sqrt(values) / (2 * np.pi)
        self.assertLess(np.abs(found[:10] / full[:10] - 1).max(), 0.005)
        self.assertIn("chose a cut-off", self.said)

    def test_the_static_answer_to_a_load_in_the_basis_is_that_of_scipys_lu(self):
        full = (self.T @ sparse_linalg.splu(self.K).solve(self.top)).reshape(-1, 3)
        row = {tuple(node): k for k, node in enumerate(self.nodes)}
        errors = []
        for shapes in ("", 'load_shapes = ["top"]\n'):
            with self.condense(f"count = 3\n{shapes}") as rom:
                q = np.linalg.solve(rom["K_rr"][()], rom["loads/top"][()])
                skin, u = rom["skin/nodes"][()], (rom["skin/T"][()] @ q).reshape(-1, 3)
            same = np.array([(k, row[tuple(node)]) for k, node in enumerate(skin) if tuple(node) in row])
            self.assertGreater(len(same), 100)
            difference = u[same[:, 0]] - full[same[:, 1]]
            errors.append(np.linalg.norm(difference, axis=1).max() / np.linalg.norm(full, axis=1).max())
        self.assertGreater(errors[0], 1e-4)
        self.assertLess(errors[1], 1e-9)

    def test_free_vibration_dies_away_by_alpha_and_the_table_together(self):
        with self.condense("count = 10\n[[modal_damping]]\nhz = 100\nratio = 0.01\n[[modal_damping]]\nhz = 500\n"
                           "ratio = 0.05\n") as rom:
            M, K = rom["M_rr"][()], rom["K_rr"][()]
            alpha, force = rom.attrs["alpha"], 100.0 * rom["loads/tip_force"][()]
        self.assertIn("alpha and beta add to it", self.said)
        values, shapes = scipy.linalg.eigh(K, M)
        # The mode that the force moves most, alone: x'' + 2 zeta w x' + w^2 (x - x_s) = 0.
        k = np.argmax(np.abs(shapes.T @ force) / values)
        omega, still = np.sqrt(values[k]), shapes[:, k] @ force / values[k]
        zeta = np.interp(omega / (2 * np.pi), [100, 500], [0.01, 0.05]) + 0.5 * alpha * omega
        (self.folder / "step.run.toml").write_text(RUN)
        self.stage("dynamics", "step.run.toml", "-o", "step.run.h5")
        with h5py.File(self.folder / "step.run.h5") as run:
            time = run["output/time"][()]
            x = run["bodies/beam/q"][()] @ M @ shapes[:, k] - still
            v = run["bodies/beam/v"][()] @ M @ shapes[:, k]
        damped = omega * np.sqrt(1 - zeta**2)
        envelope = np.hypot(x, (v + zeta * omega * x) / damped)
        rate = -np.polyfit(time, np.log(envelope), 1)[0]
        # Steps of 10 us at a period of about 4 ms: second order leaves 1e-5 of the rate; tolerance 1e-3 of a step.
        self.assertAlmostEqual(rate / (zeta * omega), 1.0, delta=2e-3)


if __name__ == "__main__":
    unittest.main()
