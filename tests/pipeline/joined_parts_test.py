# SPDX-License-Identifier: GPL-3.0-or-later
"""A part cut in two, each half condensed to the cut, and rejoined: the modes are those of the uncut part."""
import itertools
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import scipy.linalg  # noqa: E402
import stages  # noqa: E402


SIZE, CELLS, CUT = (0.30, 0.08, 0.06), (10, 4, 3), 4  # [m]; hex20 cells along x y z; cells before the cut
# Corners, then the mid-side nodes, on the half grid of a cell, in the order of C3D20.
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
FE = '[material.steel]\nregions = ["EALL"]\nE_gpa = 210.0\nnu = 0.3\nrho = 7850.0\n'
CUT_SET = '\n[[nodes]]\nname = "cut"\nnode_set = "CUT"\n'
SENSOR = '\n[[nodes]]\nname = "end"\nnode_set = "END"\n'


def deck(first, last):
    """The bar between two columns of cells; node sets CUT and END (one corner far from the cut)."""
    corner = np.array(CORNERS)
    offsets = np.vstack([corner, [(corner[a] + corner[b]) // 2 for a, b in EDGES]])
    ids, cells = {}, []
    for cell in itertools.product(range(first, last), range(CELLS[1]), range(CELLS[2])):
        cells.append([ids.setdefault(tuple(2 * np.array(cell) + o), len(ids) + 1) for o in offsets])
    pitch = np.array(SIZE) / (2 * np.array(CELLS))
    lines = ["*NODE"] + ["{}, {:.17g}, {:.17g}, {:.17g}".format(i, *(np.array(at) * pitch)) for at, i in ids.items()]
    lines += ["*ELEMENT, TYPE=C3D20, ELSET=EALL"]
    for number, cell in enumerate(cells, 1):
        lines += [", ".join(map(str, [number, *cell[:10]])) + ",", ", ".join(map(str, cell[10:]))]
    lines += ["*NSET, NSET=CUT"] + [str(i) for at, i in ids.items() if at[0] == 2 * CUT]
    end = 0 if first == 0 else 2 * CELLS[0]
    return "\n".join(lines + ["*NSET, NSET=END", str(ids[end, 0, 0])]) + "\n"


def coordinates(rom):
    """{(set, position in micrometres, direction): index} of the boundary coordinates, the boundary map of the file."""
    found = {}
    for name, dofs in rom["sets"].items():
        positions = np.rint(dofs["position"][()] * 1e6).astype(int)
        for j, position, direction in zip(dofs["dofs"][()], positions, dofs["direction"][()]):
            found[name, tuple(position), tuple(np.rint(direction).astype(int))] = j
    return found


def joined(paths):
    """K, M of reduced parts that share the coordinates of the set "cut" at equal positions."""
    parts, index, total = [], {}, 0
    for number, path in enumerate(paths):
        with h5py.File(path) as rom:
            at = np.full(len(rom["K_rr"]), -1)
            for key, j in coordinates(rom).items():
                at[j] = index.setdefault(key if key[0] == "cut" else (number, *key), len(index))
            parts.append((rom["K_rr"][()], rom["M_rr"][()], at))
    total = len(index)
    for _, _, at in parts:
        modal = np.flatnonzero(at < 0)
        at[modal] = np.arange(total, total + len(modal))
        total += len(modal)
    K, M = np.zeros((2, total, total))
    for K_rr, M_rr, at in parts:
        K[np.ix_(at, at)] += K_rr
        M[np.ix_(at, at)] += M_rr
    return K, M, len(index)


class JoinedParts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        scratch = tempfile.TemporaryDirectory(prefix="clatter-joined-")
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        for name, first, last in (("whole", 0, CELLS[0]), ("left", 0, CUT), ("right", CUT, CELLS[0])):
            (cls.folder / f"{name}.inp").write_text(deck(first, last))
            (cls.folder / f"{name}.fe.toml").write_text(FE + CUT_SET + SENSOR)
            cls.stage("mesh", f"{name}.inp", "--units", "m-kg-s", "-o", f"{name}.mesh.h5")
            cls.stage("assembly", f"{name}.mesh.h5", "-c", f"{name}.fe.toml", "-o", f"{name}.fe.h5")

    @classmethod
    def stage(cls, name, *arguments):
        done = stages.run_stage(name, *arguments, "--quiet", folder=cls.folder)
        if done.returncode:
            raise AssertionError(done.stderr)
        return done.stdout

    def condense(self, name, fmax_hz, more):
        (self.folder / "part.rom.toml").write_text(f'boundary = ["cut", "end"]\nfmax_hz = {fmax_hz}\n{more}skin = []\n')
        self.stage("condense", f"{name}.fe.h5", "-c", "part.rom.toml", "-o", f"{name}.rom.h5")
        with h5py.File(self.folder / f"{name}.rom.h5") as rom:
            return dict(rom["certificate"].attrs)

    def whole_hz(self, fmax_hz):
        self.stage("modal", "whole.fe.h5", "--fmax-hz", fmax_hz, "-o", "whole.modes.h5")
        with h5py.File(self.folder / "whole.modes.h5") as modes:
            return modes["frequency_hz"][()]

    def test_frequencies_of_the_joined_halves_are_within_what_their_certificates_state(self):
        for cutoff, more in ((35e3, ""), (40e3, ""), (60e3, ""), (40e3, "frequency_error = 0.0\n")):
            with self.subTest(cutoff=cutoff, more=more):
                certificates = [self.condense(name, cutoff, more) for name in ("left", "right")]
                self.assertTrue(all(c["frequency_error_modes"] > 0 for c in certificates))
                stated = max(c["frequency_error_joined"] for c in certificates)
                limit = min(c["accurate_to_hz"] for c in certificates)
                K, M, shared = joined([self.folder / f"{name}.rom.h5" for name in ("left", "right")])
                self.assertEqual(shared, 3 * (51 + 2))  # 51 nodes of the cut and a corner at either end
                found = np.sqrt(np.maximum(scipy.linalg.eigh(K, M, eigvals_only=True), 0.0)) / (2 * np.pi)
                uncut = self.whole_hz(limit)
                self.assertEqual(np.count_nonzero(uncut == 0.0), 6)
                self.assertGreater(len(uncut), 9)
                self.assertLess(found[5], 1e-3 * uncut[6])  # six rigid motions of the joined part, no hinge at the cut
                error = found[6:len(uncut)] / uncut[6:] - 1.0
                print(f"    cut-off {cutoff:.0f} Hz, {len(error)} modes: largest error {error.max():.2e}, stated {stated:.2e}",
                      file=sys.stderr)
                self.assertLess(error.max(), stated)
                self.assertGreater(error.min(), -1e-8)  # a basis can only stiffen
                # No spurious mode below the limit: the next one lies above it.
                self.assertGreater(found[len(uncut)], limit)

    def test_clatter_joins_them_as_the_sum_of_their_matrices(self):
        for name in ("left", "right"):
            self.condense(name, 40e3, "frequency_error = 0.0\n")
        K, M, _ = joined([self.folder / f"{name}.rom.h5" for name in ("left", "right")])
        expected = np.sqrt(np.maximum(scipy.linalg.eigh(K, M, eigvals_only=True), 0.0)) / (2 * np.pi)
        parts = "".join(f'[[part]]\nname = "{name}"\nfile = "{name}.rom.h5"\n' for name in ("left", "right"))
        (self.folder / "bar.fe.toml").write_text(parts + '[[tie]]\nslave = "right_cut"\nmaster = "left_cut"\n')
        (self.folder / "bar.rom.toml").write_text('boundary = ["left_cut"]\nfmax_hz = 30000.0\nskin = []\n')
        (self.folder / "Makefile").write_text("CLATTER_ASSEMBLIES := bar\ninclude $(CLATTER_RULES)/clatter.mk\n"
                                              "bar.fe.h5: left.rom.h5 right.rom.h5\n")
        stages.make(self.folder, f"CLATTER_RULES={stages.SOURCE / 'tools'}", "bar.rom.h5", "bar.compare.txt")
        with h5py.File(self.folder / "bar.fe.h5") as whole:
            group = whole["K"]
            self.assertEqual(group.attrs["shape"][0], len(K))
        self.stage("modal", "bar.fe.h5", "--count", 40, "-o", "bar.modes.h5")
        with h5py.File(self.folder / "bar.modes.h5") as modes:
            hz = modes["frequency_hz"][()]
        self.assertEqual(np.count_nonzero(hz == 0.0), 6)
        np.testing.assert_allclose(hz[6:], expected[6:40], rtol=1e-8)
        with h5py.File(self.folder / "bar.rom.h5") as reduced:
            self.assertLess(reduced["certificate"].attrs["mass_error"], 1e-9)
            self.assertLessEqual(reduced.attrs["valid_to_hz"], 40e3)

    def test_the_error_of_each_joined_frequency_is_stated(self):
        for name, cutoff in (("left", 50e3), ("right", 30e3)):
            self.condense(name, cutoff, "frequency_error = 0.0\njoined_error = true\n")
        parts = "".join(f'[[part]]\nname = "{name}"\nfile = "{name}.rom.h5"\n' for name in ("left", "right"))
        (self.folder / "bar.fe.toml").write_text(parts + '[[tie]]\nslave = "right_cut"\nmaster = "left_cut"\n')
        self.stage("assembly", "-c", "bar.fe.toml", "-o", "bar.fe.h5")
        lines = self.stage("modal", "bar.fe.h5", "--fmax-hz", 15e3, "-o", "bar.modes.h5")
        self.assertRegex(lines, r"Hz  residual \S+  parts \d\.\de-\d\d \(right\)")
        with h5py.File(self.folder / "bar.modes.h5") as modes:
            hz, errors = modes["frequency_hz"][()], modes["parts/errors"][()]
            self.assertEqual([name.decode() for name in modes["parts/names"][()]], ["left", "right"])
            worst = modes["certificate"].attrs["frequency_error_parts"]
        stated = errors.sum(axis=1)
        self.assertEqual(stated.max(), worst)
        exact = self.whole_hz(15.5e3)[:len(hz)]
        true = hz[6:] / exact[6:] - 1.0
        self.assertGreater(len(true), 9)
        print(f"    {len(true)} modes: true over stated error {(true / stated[6:]).min():.2f} to "
              f"{(true / stated[6:]).max():.2f}, largest {true.max():.2e}", file=sys.stderr)
        np.testing.assert_array_less(stated[6:], 2.0 * true + 1e-9)
        np.testing.assert_array_less(0.5 * true - 1e-9, stated[6:])
        # The second reduction adds its own error and keeps that of the parts.
        (self.folder / "bar.rom.toml").write_text('boundary = ["left_cut"]\nfmax_hz = 30000.0\nskin = []\n')
        self.stage("condense", "bar.fe.h5", "-c", "bar.rom.toml", "-o", "bar.rom.h5")
        with h5py.File(self.folder / "bar.rom.h5") as rom:
            within = hz <= rom["certificate"].attrs["accurate_to_hz"]
            np.testing.assert_allclose(rom["certificate"].attrs["frequency_error_parts"], stated[within].max(), rtol=0.02)

    def test_a_mesh_beside_a_reduced_part_goes_through_the_stages(self):
        self.condense("right", 50e3, "frequency_error = 0.0\njoined_error = true\n")
        (self.folder / "bar.fe.toml").write_text(FE + CUT_SET + '[[part]]\nname = "right"\nfile = "right.rom.h5"\n'
                                                 '[[tie]]\nslave = "right_cut"\nmaster = "skin"\n')
        self.stage("assembly", "left.mesh.h5", "-c", "bar.fe.toml", "-o", "bar.fe.h5")
        self.stage("modal", "bar.fe.h5", "--fmax-hz", 15e3, "-o", "bar.modes.h5", "--export", "bar.vtu")
        with h5py.File(self.folder / "bar.modes.h5") as modes:
            hz, stated = modes["frequency_hz"][()], modes["parts/errors"][()].sum(axis=1)
        true = hz[6:] / self.whole_hz(15.5e3)[6:len(hz)] - 1.0
        np.testing.assert_array_less(true, 2.0 * stated[6:] + 1e-9)
        (self.folder / "bar.rom.toml").write_text('boundary = ["cut"]\nfmax_hz = 30000.0\nskin = ["skin"]\n')
        self.stage("condense", "bar.fe.h5", "-c", "bar.rom.toml", "-o", "bar.rom.h5")
        self.assertIn("largest", self.stage("modal", "compare", "bar.fe.h5", "bar.rom.h5"))

    def test_more_than_the_parts_have_is_refused_and_modes_above_are_said(self):
        self.condense("left", 40e3, "")
        self.condense("right", 20e3, "")
        parts = "".join(f'[[part]]\nname = "{name}"\nfile = "{name}.rom.h5"\n' for name in ("left", "right"))
        (self.folder / "bar.fe.toml").write_text(parts + '[[tie]]\nslave = "right_cut"\nmaster = "left_cut"\n')
        self.stage("assembly", "-c", "bar.fe.toml", "-o", "bar.fe.h5")
        (self.folder / "bar.rom.toml").write_text('boundary = ["left_cut"]\naccurate_to_hz = 15000.0\nskin = []\n')
        refused = stages.run_stage("condense", "bar.fe.h5", "-c", "bar.rom.toml", "-o", "bar.rom.h5", folder=self.folder)
        self.assertEqual(refused.returncode, 3)
        self.assertIn("its 2 reduced parts are accurate to 10000 Hz", refused.stderr)
        done = stages.run_stage("modal", "bar.fe.h5", "--fmax-hz", 25e3, "-o", "bar.modes.h5", folder=self.folder)
        self.assertRegex(done.stderr, r"of \d+ modes lie above 20000 Hz, to which the reduced parts are valid")


if __name__ == "__main__":
    unittest.main(verbosity=2)
