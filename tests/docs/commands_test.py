# SPDX-License-Identifier: GPL-3.0-or-later
"""Sample commands of READMEs and documents.

Each is checked: its program, options, make targets and tests exist. Each in a block of a README is run as written,
on the beam of samples/ under the names that the README uses, or is named below with the test that runs it.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import commands
import repository

sys.path.insert(0, str(repository.SOURCE / "tests/cli"))
import stages  # noqa: E402

# Blocks that take long, or that need more than a folder: README, first words, and the test that runs the same.
ELSEWHERE = [("README.md", "make demo", "TruckDiesel"),
             ("README.md", "make check", None),  # this test is part of it
             ("README.md", "make build", None),  # the programs of this test
             ("README.md", "make -C samples/beam", "Beam"),
             ("modal/README.md", "clatter-modal shape", "WarmBore"),  # needs a bore
             ("recover/README.md", "clatter-recover listen", "Program"),  # needs a cycle
             ("samples/beam/README.md", "make CLATTER_BIN", "Beam"),
             ("samples/timing_drive/README.md", "make CLATTER_BIN", "TimingDriveBlock"),
             ("samples/truck_diesel/README.md", "make CLATTER_BIN", "TruckDiesel"),
             ("samples/truck_diesel/README.md", "../../tools/clatter report", "TruckDiesel")]
# Names of the user's part in a README, and the corresponding names of the beam.
NAMES = {"liner_2_bore": "y_max", "sensor_x": "sensor_tip"}

DECK = """*NODE, NSET=ALL
1, 0, 0, 0
2, 10, 0, 0
3, 10, 10, 0
4, 0, 10, 0
5, 0, 0, 10
6, 10, 0, 10
7, 10, 10, 10
8, 0, 10, 10
*ELEMENT, TYPE=C3D8, ELSET=CUBE
1, 1, 2, 3, 4, 5, 6, 7, 8
*MATERIAL, NAME=STEEL
*ELASTIC
210000, 0.3
*DENSITY
7.85E-9
*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL
*BOUNDARY
1, 1, 3
*STEP
*FREQUENCY
3
*END STEP
"""


def readme(command):
    return command.path.endswith("README.md")


def elsewhere(command):
    return [entry for entry in ELSEWHERE if entry[0] == command.path and command.text.startswith(entry[1])]


class Blocks(unittest.TestCase):
    def test_programs_options_targets_and_tests_exist(self):
        found = commands.all_commands()
        self.assertGreater(len([command for command in found if command.block]), 20)
        self.assertGreater(len(found), 80)
        wrong = [f"{command}: {', '.join(what)}" for command in found if (what := commands.errors_of(command))]
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))

    def test_samples_in_the_help_of_each_program_use_options_that_it_has(self):
        for stage in commands.STAGES:
            program = f"clatter-{stage}"
            texts = [commands.help_of(program), *(commands.help_of(program, name) for name in commands.commands_of(program))]
            if texts[0] is None:
                continue
            lines = "\n".join(texts).replace("\\\n", " ").splitlines()
            samples = [re.sub(r"^ *(samples?:)? *", "", line) for line in lines]
            samples = [line for line in samples if line.startswith(f"clatter-{stage} ")]
            with self.subTest(stage=stage):
                self.assertGreaterEqual(len(samples), len(texts))
                for sample in samples:
                    command = commands.Command("help", 0, commands.COMMENT.sub("", sample), True)
                    self.assertEqual(commands.errors_of(command), [], sample)

    def test_every_block_of_a_readme_is_run_or_named_with_what_runs_it(self):
        tests = {suite for suite, _ in repository.all_tests()}
        for readme_path, words, test in ELSEWHERE:
            with self.subTest(readme=readme_path, words=words):
                self.assertTrue(any(command.path == readme_path and command.text.startswith(words)
                                    for command in commands.all_commands()), "no such block any more")
                self.assertIn(test, tests | {None})
        for command in filter(readme, commands.all_commands()):
            if command.block and not elsewhere(command):
                self.assertRegex(command.text, r"^(clatter(-\w+)?|(\.\./)*tools/clatter) ", f"{command}: say in ELSEWHERE what runs it")

    def test_errors_are_reported(self):
        text = ("Run `clatter nonsense x.h5` or\n\n    make nonsense   # not\n    PRESET=dev ctest -L nonsense -R 'Xyzzy|HardB4'\n"
                "    cmake --preset nonsense\n    bench/nonsense.py --x\n    clatter info --nonsense \\\n        part.h5\n"
                "    build/release/tests/nonsense_test --gtest_filter='Nonsense*'\n    F = k x\n")
        found = commands.commands_in("README.md", text)
        self.assertEqual([what for command in found for what in commands.errors_of(command)], [
            "no target nonsense", "no test has the label nonsense", "no test is named like Xyzzy", "no preset nonsense",
            "no file bench/nonsense.py", "no option --nonsense", "no test program nonsense_test", "no command clatter nonsense"])
        self.assertEqual([command.line for command in found], [3, 4, 5, 6, 7, 9, 1])


class Run(stages.PipelineTest):
    """Every clatter command of a README's block, on the beam."""
    before = {}  # {text of a command: preparation for it}

    def setUp(self):
        super().setUp()
        bin_folder = self.folder / "programs"
        bin_folder.mkdir()
        for program in commands.STAGES:
            (bin_folder / f"clatter-{program}").symlink_to(commands.BIN / f"clatter-{program}")
        (bin_folder / "clatter").symlink_to(commands.SOURCE / "tools/clatter")
        self.environment = {**os.environ, "PATH": f"{bin_folder}:{os.environ['PATH']}"}

    def named(self, **files):
        """Copies of the beam's files under the names of a README: block_fe_toml="beam.fe.toml"."""
        for name, source in files.items():
            shutil.copy(self.folder / source, self.folder / name.replace("__", "."))

    def run_blocks(self, path):
        """Runs the blocks of one README in their order."""
        ran = 0
        for command in commands.all_commands():
            if command.path != path or not command.block or elsewhere(command):
                continue
            text = command.text
            for name, ours in NAMES.items():
                text = re.sub(rf"\b{name}\b", ours, text)
            self.before.get(command.text, lambda: None)()
            with self.subTest(command=str(command)):
                done = subprocess.run(["bash", "-c", text], cwd=self.folder, env=self.environment, capture_output=True,
                                      text=True, timeout=300)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                output = re.search(r" -o (\S+)", text)
                if output:
                    self.assertTrue((self.folder / output[1]).exists(), output[1])
            ran += 1
        self.assertGreater(ran, 0, f"{path} has no command any more")

    def test_mesh(self):
        stages.run_stage("mesh", "beam.mesh.toml", "-o", "x.mesh.h5", "--write-step", "part.step", folder=self.folder)
        self.run_blocks("mesh/README.md")

    def test_deck(self):
        (self.folder / "part.inp").write_text(DECK)
        self.run_blocks("mesh/deck/README.md")

    def test_assembly(self):
        self.named(block__mesh__h5="beam.mesh.h5", block__fe__toml="beam.fe.toml")
        stages.run_stage("condense", "export", "beam.rom.h5", "part.mtx", folder=self.folder)
        (self.folder / "part.fe.toml").write_text('[matrices]\nK = "part.K.mtx"\nM = "part.M.mtx"\ndofs = "part.dofs.tsv"\n')
        self.before = {"clatter-assembly beam.mesh.h5 -c beam.fe.toml -o beam.fe.h5": self.matrices_of_the_mesh,
                       "clatter-assembly -c engine.fe.toml -o engine.fe.h5": self.two_parts}
        self.run_blocks("assembly/README.md")

    def two_parts(self):
        """engine.fe.toml: two free beams, one beyond the other."""
        material = (self.folder / "beam.fe.toml").read_text().split("[damping]")[0]
        ends = "".join(f'[[nodes]]\nname = "{end}"\nsurface = "{end}"\n' for end in ("x_min", "x_max"))
        (self.folder / "half.fe.toml").write_text(material + ends)
        (self.folder / "half.rom.toml").write_text('boundary = ["x_min", "x_max"]\nfmax_hz = 4000.0\n')
        stages.run_stage("assembly", "beam.mesh.h5", "-c", "half.fe.toml", "-o", "half.fe.h5", folder=self.folder)
        stages.run_stage("condense", "half.fe.h5", "-c", "half.rom.toml", "-o", "half.rom.h5", folder=self.folder)
        parts = "".join(f'[[part]]\nname = "{name}"\nfile = "half.rom.h5"\n{more}' for name, more in
                        (("left", ""), ("right", 'system = "beyond"\n')))
        (self.folder / "engine.fe.toml").write_text(
            '[system.beyond]\norigin = [0.6, 0.0, 0.0]\nz = [0.0, 0.0, 1.0]\nx = [1.0, 0.0, 0.0]\n' + parts +
            '[[tie]]\nslave = "right_x_min"\nmaster = "left_x_max"\n')
        (self.folder / "engine.rom.toml").write_text('boundary = ["right_x_max"]\nfmax_hz = 1000.0\n')

    def matrices_of_the_mesh(self):
        """beam.fe.toml becomes a [matrices] of the free beam, rows as x y z of the mesh's nodes."""
        import h5py
        import scipy.io
        import scipy.sparse as sparse
        material = (self.folder / "beam.fe.toml").read_text().split("[damping]")[0]
        (self.folder / "free.fe.toml").write_text(material)
        stages.run_stage("assembly", "beam.mesh.h5", "-c", "free.fe.toml", "-o", "free.fe.h5", folder=self.folder)
        with h5py.File(self.folder / "free.fe.h5") as file:
            for name in "KM":
                group = file[name]
                lower = sparse.csc_matrix((group["data"][()], group["indices"][()], group["indptr"][()]), group.attrs["shape"])
                scipy.io.mmwrite(str(self.folder / f"{name}.mtx"), lower + sparse.tril(lower, -1).T, symmetry="symmetric")
        (self.folder / "beam.fe.toml").write_text('[matrices]\nK = "K.mtx"\nM = "M.mtx"\n')

    def test_modal(self):
        toml = self.folder / "beam.fe.toml"
        toml.write_text(toml.read_text() + '\n[[case]]\nname = "step_1"\nloads = { tip_force = 1.0 }\n')
        stages.run_stage("assembly", *self.command("assembly"), folder=self.folder)
        self.named(block__fe__h5="beam.fe.h5", block__rom__h5="beam.rom.h5")
        self.run_blocks("modal/README.md")

    def test_condense(self):
        self.named(block__fe__h5="beam.fe.h5", block__rom__toml="beam.rom.toml", part__fe__h5="beam.fe.h5",
                   part__rom__h5="beam.rom.h5")
        self.run_blocks("condense/README.md")

    def test_dynamics(self):
        self.named(slap__run__toml="step.run.toml", cam__run__toml="step.run.toml", drive__run__toml="step.run.toml",
                   valve__run__toml="step.run.toml", slap_rings__run__toml="step.run.toml")
        self.run_blocks("dynamics/README.md")
        self.run_blocks("dynamics/film/README.md")
        self.run_blocks("dynamics/ring/README.md")
        self.run_blocks("dynamics/chain/README.md")
        self.run_blocks("dynamics/shaft/README.md")
        self.run_blocks("dynamics/crank/README.md")
        self.run_blocks("dynamics/valve/README.md")

    def test_recover(self):
        self.named(slap__run__h5="step.run.h5", slap__field__toml="step.field.toml", block__rom__h5="beam.rom.h5")
        self.run_blocks("recover/README.md")

    def test_report(self):
        self.run_blocks("tools/clatter_tools/report_page/README.md")

    def test_each_readme_with_a_command_is_among_these(self):
        here = set(re.findall(r'run_blocks\("([\w/.]+)"\)', pathlib.Path(__file__).read_text()))
        wanted = {command.path for command in commands.all_commands() if readme(command) and command.block and not elsewhere(command)}
        self.assertEqual(wanted, here)


if __name__ == "__main__":
    unittest.main(verbosity=2)
