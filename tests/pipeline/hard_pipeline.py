# SPDX-License-Identifier: GPL-3.0-or-later
"""A small pipeline of all stages for the hard cases of files and processes: a coarse beam, and three cycles of a piston between dry walls."""
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402

STEEL = '[material.steel]\nregions = ["solid"]\nE_gpa = 210.0\nnu = 0.3\nrho = 7850.0\n'
FILES = {
    "piston.mesh.toml": 'name = "piston"\nkind = "box"\n[box]\nsize = [40, 40, 40]\norigin = [-20, -20, -20]\n[mesh]\nelement_size_mm = 20\n',
    "piston.fe.toml": STEEL + '[[coupling]]\nname = "pin"\nkind = "bearing"\nsurface = "z_min"\npoint = [0, 0, 0]\n'
                              '[[load]]\nname = "gas"\nkind = "pressure"\nsurface = "z_max"\n',
    "piston.rom.toml": 'method = "craig-bampton"\nboundary = ["pin"]\nfmax_hz = 80000\n',
    "gas.csv": "crank_angle [deg], pressure [bar]\n" + "".join(f"{deg}, {60 if abs(deg) < 50 else 20}\n" for deg in range(-360, 361, 10)),
    "cycles.run.toml": """
[engine]
speed_rpm = 3000.0
stroke_mm = 130.0
[rod]
length_mm = 210.0
mass_kg = 2.0
inertia_kg_m2 = 0.02
centre_mm = 60.0
[piston]
rom = "piston.rom.h5"
model = "rigid"
[gas]
table = "gas.csv"
[time]
cycles = 3
output_step_us = 500.0
[accuracy]
tolerance = 1e-3
[contact]
bore_mm = 107.0
clearance_um = 50.0
lubrication = "none"
asperity_loss_factor = 0.5
""",
    "Makefile": f"include {stages.SOURCE}/tools/clatter.mk\n.DEFAULT_GOAL := all\nall: beam.modes.h5 step.field.h5 cycles.run.h5\n"
                "step.run.h5: beam.rom.h5\ncycles.run.h5: piston.rom.h5\n",
}
ARTEFACTS = ("beam.mesh.h5", "beam.fe.h5", "beam.modes.h5", "beam.rom.h5", "step.run.h5", "step.field.h5", "piston.mesh.h5", "piston.fe.h5",
             "piston.rom.h5", "cycles.run.h5")
master = None  # the folder in which the pipeline has run


def write_sources(folder):
    """The beam's files with coarse cells, and FILES."""
    for path in (stages.SOURCE / "samples/beam").glob("*.toml"):
        shutil.copy(path, folder)
    mesh = folder / "beam.mesh.toml"
    mesh.write_text(mesh.read_text().replace("element_size_mm = 15.0", "element_size_mm = 40.0"))
    for name, text in FILES.items():
        (folder / name).write_text(text)


def make_master():
    """Runs the pipeline once in a process; call it in setUpModule()."""
    global master
    stages.require_stages()
    master = pathlib.Path(tempfile.mkdtemp(prefix="clatter-hard-"))
    unittest.addModuleCleanup(shutil.rmtree, master)
    write_sources(master)
    stages.make(master)


def numbers(path):
    """Every dataset of an artefact but times and hashes, which differ from run to run."""
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.__setitem__(name, item[()]) if isinstance(item, h5py.Dataset)
                        and not name.startswith(("timing", "inputs", "effects", "statistics")) else None)
    return found


class HardPipeline(stages.PipelineTest):
    """A test in a fresh copy of the finished pipeline."""

    @classmethod
    def setUpClass(cls):
        cls.master = master

    def assert_same_numbers(self, one, other):
        """All datasets are equal to the bit; returns how many."""
        found, expected = numbers(one), numbers(other)
        self.assertEqual(sorted(found), sorted(expected))
        for key, value in expected.items():
            np.testing.assert_array_equal(found[key], value, err_msg=f"{one.name}: {key}")
        return len(found)

    def refusal(self, stage, arguments, code=2, **options):
        """The one line of a stage that must end with `code`."""
        done = stages.run_stage(stage, *arguments, "--quiet", folder=self.folder, **options)
        self.assertEqual(done.returncode, code, f"clatter-{stage} {arguments}: {done.stderr}")
        lines = [line for line in done.stderr.strip().splitlines() if not line.startswith("warning: ")]
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertTrue(lines[0].startswith(f"clatter-{stage}: error: "), lines[0])
        return lines[0].partition("error: ")[2]
