# SPDX-License-Identifier: GPL-3.0-or-later
"""A meshed bar as the elastic connecting rod of a slow engine: constant gas pressure shortens it by F L / (E A)."""
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402

LENGTH, SIDE, E = 0.210, 0.012, 210e9  # [m], [m], [Pa]
AREA, PRESSURE = 0.04 ** 2, 300e5  # of the piston's crown [m2], over ambient [Pa]
STEEL = '[material.steel]\nregions = ["solid"]\nE_gpa = 210.0\nnu = 0.3\nrho = 7850.0\n'
FILES = {
    "rod.mesh.toml": 'name = "rod"\nkind = "box"\n[box]\nsize = [12, 12, 210]\norigin = [-6, -6, 0]\n[mesh]\nelement_size_mm = 12\n',
    "rod.fe.toml": STEEL + '[[coupling]]\nname = "big_end"\nkind = "bearing"\nsurface = "z_min"\npoint = [0, 0, 0]\n'
                           '[[coupling]]\nname = "small_end"\nkind = "bearing"\nsurface = "z_max"\npoint = [0, 0, 0.210]\n',
    "rod.rom.toml": 'method = "craig-bampton"\nboundary = ["big_end", "small_end"]\nfmax_hz = 5000\ninertia_invariants = true\n',
    "piston.mesh.toml": 'name = "piston"\nkind = "box"\n[box]\nsize = [40, 40, 40]\norigin = [-20, -20, -20]\n[mesh]\nelement_size_mm = 20\n',
    "piston.fe.toml": STEEL + '[[coupling]]\nname = "pin"\nkind = "bearing"\nsurface = "z_min"\npoint = [0, 0, 0]\n'
                              '[[load]]\nname = "gas"\nkind = "pressure"\nsurface = "z_max"\n',
    "piston.rom.toml": 'method = "craig-bampton"\nboundary = ["pin"]\nfmax_hz = 80000\n',
    "gas.csv": "crank_angle [deg], pressure [bar]\n" + "".join(f"{deg}, 301\n" for deg in range(-360, 361, 10)),
    "slow.run.toml": """
[engine]
speed_rpm = 100.0
stroke_mm = 130.0
[rod]
model = "elastic"
length_mm = 210.0
rom = "rod.rom.h5"
[piston]
rom = "piston.rom.h5"
model = "rigid"
[gas]
table = "gas.csv"
[time]
cycles = 1
output_step_us = 1000.0
[accuracy]
tolerance = 1e-4
[small_end]
clearance_um = 0.0
[big_end]
clearance_um = 0.0
[contact]
bore_mm = 107.0
clearance_um = 0.0
lubrication = "none"
asperity_loss_factor = 0.5
""",
}


class ElasticRod(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-rod-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        for name, text in FILES.items():
            (cls.folder / name).write_text(text)
        for part in ("rod", "piston"):
            cls.run_stage("mesh", f"{part}.mesh.toml", "-o", f"{part}.mesh.h5")
            cls.run_stage("assembly", f"{part}.mesh.h5", "-c", f"{part}.fe.toml", "-o", f"{part}.fe.h5")
            cls.run_stage("condense", f"{part}.fe.h5", "-c", f"{part}.rom.toml", "-o", f"{part}.rom.h5")
        cls.run_stage("dynamics", "slow.run.toml", "-o", "slow.run.h5")

    @classmethod
    def run_stage(cls, *arguments):
        done = stages.run_stage(*arguments, "--quiet", folder=cls.folder)
        if done.returncode:
            raise AssertionError(f"{arguments}: {done.stderr}")

    def test_the_bar_is_shorter_by_its_compliance(self):
        with h5py.File(self.folder / "slow.run.h5") as run, h5py.File(self.folder / "rod.rom.h5") as rom:
            ends = [rom["sets"][name]["dofs"][2] for name in ("small_end", "big_end")]
            q, history = run["bodies/rod/q"][-1], run["history"]
            force = np.hypot(history["pin_force_y"][-1], history["pin_force_z"][-1])
        self.assertAlmostEqual(force / (PRESSURE * AREA), 1.0, delta=1e-3)  # upright, at rest but for the slow crank
        self.assertAlmostEqual((q[ends[1]] - q[ends[0]]) / (force * LENGTH / (E * SIDE ** 2)), 1.0, delta=1e-4)


if __name__ == "__main__":
    unittest.main()
