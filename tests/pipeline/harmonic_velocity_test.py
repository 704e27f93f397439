# SPDX-License-Identifier: GPL-3.0-or-later
"""Velocities of a periodic run, recovered at twenty lines, against direct harmonic solves of the full model."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import scipy.sparse as sparse  # noqa: E402
import scipy.sparse.linalg as sparse_linalg  # noqa: E402
import methods_test  # noqa: E402
import stages  # noqa: E402

LINES = 100.0 * np.arange(1, 21)  # [Hz], over the first two bending modes
PERIOD, PERIODS, STEP = 0.01, 9, 20e-6  # [s]; the start has decayed to 1e-6 after eight periods
# 1 N each, with phases that keep the peak of their sum low.
PHASES = np.exp(1j * np.pi * np.arange(20) ** 2 / 20)

MODEL = methods_test.MODEL.replace("ratio = 0.01", "ratio = 0.1")
RUN = f"""[time]
end_s = {PERIOD * PERIODS}
output_step_us = {STEP * 1e6}
largest_step_us = 2.0
[[body]]
name = "beam"
rom = "beam.rom.h5"
[[load]]
body = "beam"
load = "tip_force"
table = "force.csv"
interpolation = "cubic"
"""
FIELD = f"""body = "beam"
cycle = false
[spectrum]
to_hz = 2000.0
[[window]]
name = "period"
from_s = {PERIOD * (PERIODS - 1):.9f}
to_s = {PERIOD * PERIODS:.9f}
taper = "none"
[lines]
frequencies_hz = {LINES.tolist()}
[frames]
on = false
from_s = 0.0
to_s = {PERIOD}
step_s = {PERIOD}
"""


class HarmonicVelocity(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        folder = tempfile.TemporaryDirectory(prefix="clatter-harmonic-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        time = np.arange(0.0, PERIOD * PERIODS + 5e-6, 10e-6)
        force = np.real(np.exp(2j * np.pi * time[:, None] * LINES) @ PHASES)
        np.savetxt(cls.folder / "force.csv", np.column_stack([time, force]), "%.17g", ",",
                   header="time [s], force [N]", comments="")
        for name, text in (("beam.mesh.toml", methods_test.MESH), ("beam.fe.toml", MODEL), ("beam.run.toml", RUN), ("beam.field.toml", FIELD)):
            (cls.folder / name).write_text(text)
        cls.stage("mesh", "beam.mesh.toml", "-o", "beam.mesh.h5")
        cls.stage("assembly", "beam.mesh.h5", "-c", "beam.fe.toml", "-o", "beam.fe.h5")
        cls.exact = cls.direct()

    @classmethod
    def stage(cls, name, *arguments):
        done = stages.run_stage(name, *arguments, "--quiet", folder=cls.folder)
        if done.returncode:
            raise AssertionError(done.stdout + done.stderr)

    @classmethod
    def direct(cls):
        """{position in micrometres: velocities, lines x 3} by (K + i w D - w^2 M) u = f."""
        with h5py.File(cls.folder / "beam.fe.h5") as fe:
            K, M, T = methods_test.symmetric(fe["K"]), methods_test.symmetric(fe["M"]), fe["T"]
            T = sparse.csc_matrix((T["data"][()], T["indices"][()], T["indptr"][()]), shape=T.attrs["shape"])
            alpha, beta = fe["damping"].attrs["alpha"], fe["damping"].attrs["beta"]
            force, nodes = fe["loads/tip_force"][()], fe["nodes"][()]
        velocity = []
        for hz, phase in zip(LINES, PHASES):
            w = 2 * np.pi * hz
            dynamic = K * (1 + 1j * w * alpha) + (1j * w * beta - w**2) * M
            velocity.append(1j * w * (T @ sparse_linalg.spsolve(dynamic.tocsc(), force * phase)))
        velocity = np.array(velocity).reshape(len(LINES), -1, 3)
        return {key(at): velocity[:, i] for i, at in enumerate(nodes)}

    def recovered(self, fmax_hz):
        """Relative error of each line over the skin, with the modes of the basis up to a frequency."""
        (self.folder / "beam.rom.toml").write_text(
            f'method = "craig-bampton"\nboundary = ["tip"]\nfmax_hz = {fmax_hz}\n')
        self.stage("condense", "beam.fe.h5", "-c", "beam.rom.toml", "-o", "beam.rom.h5")
        self.stage("dynamics", "beam.run.toml", "-o", "beam.run.h5")
        self.stage("recover", "beam.run.h5", "-c", "beam.field.toml", "-o", "beam.field.h5")
        errors = []
        with h5py.File(self.folder / "beam.field.h5") as field:
            np.testing.assert_allclose(field["lines/frequency_hz"][()], LINES, rtol=1e-9)
            exact = np.array([self.exact[key(at)] for at in field["skin/nodes"][()]])
            for k in range(len(LINES)):
                found = field[f"lines/velocity_re/{k:05d}"][()] + 1j * field[f"lines/velocity_im/{k:05d}"][()]
                errors.append(np.linalg.norm(found - exact[:, k]) / np.linalg.norm(exact[:, k]))
            normal = field["lines/normal_velocity_re/00000"][()]
        self.assertGreater(np.abs(normal).max(), 0.0)
        return np.array(errors)

    def test_velocities_are_those_of_the_full_model_and_the_error_falls_with_the_basis(self):
        poor, rich = self.recovered(2000.0), self.recovered(12000.0)
        print(f"largest relative error of 20 lines: {poor.max():.2e} with modes to 2 kHz, {rich.max():.2e} to 12 kHz",
              file=sys.stderr)
        # Truncation, and time steps of 2 us: their error of second order is about (w h)^2 / 20 = 3e-5 at 2 kHz.
        self.assertLess(rich.max(), 1e-4)
        self.assertLess(rich.max(), 0.3 * poor.max())


def key(position):
    return tuple(np.rint(1e6 * np.asarray(position)).astype(int))


if __name__ == "__main__":
    unittest.main(verbosity=2)
