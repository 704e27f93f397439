#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Accuracy of the condensation methods on a part of samples/truck_diesel (after `make demo`).

First table: coordinates, seconds and the largest frequency error of the elastic modes below a limit, of the free part
and with one set held, both against clatter-modal on the full model. Second: the static response to a load at the skin's
nodes with one set held, against SciPy's sparse LU of the full stiffness, with and without the load's shape in the
basis. Third: interface modes of the contact grid, by mass and by patch areas: error of the film's pressure work and of
the frequencies.
"""
import argparse
import tempfile
from pathlib import Path

import h5py
import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as sparse_linalg

from measured import run

ROOT = Path(__file__).resolve().parent.parent
PARTS = {  # boundary, contact grid, load and the set held for it, frequency limit
    "piston": (["skirt", "pin"], "skirt", "gas", "pin", 7500.0),
    "block": (["liner_4", "liner_4_axial", "bearing_1", "bearing_2", "bearing_3", "bearing_4", "bearing_5", "mount_1",
               "mount_2", "mount_3", "mount_4", "sensor_liner", "sensor_block"], "liner_4", "head_4_gas", "mount_1", 3000.0),
}
RIGID_HZ = 1.0  # rigid motions of the free part lie below, the first elastic mode above 400 Hz


def names(words):
    return "[" + ", ".join(f'"{word}"' for word in words) + "]"


def sparse_of(group):
    shape = group.attrs["shape"]
    lower = sparse.csc_matrix((group["data"][()], group["indices"][()], group["indptr"][()]), shape=shape)
    if group.attrs["symmetric"] not in ("lower", b"lower"):
        return lower
    return (lower + sparse.tril(lower, -1).T).tocsc()


def error_text(found, full):
    shared = min(len(found), len(full))
    missing = f", {len(full) - shared} missing" if shared < len(full) else ""
    return f"{np.abs(found[:shared] / full[:shared] - 1).max():.1e}{missing}"


class Part:
    """One part in its own folder."""

    def __init__(self, folder, build, name):
        self.folder, self.build, self.name = folder, build, name
        self.fe = ROOT / f"samples/truck_diesel/{name}.fe.h5"
        self.boundary, self.grid, self.load, self.held, self.limit = PARTS[name]

    def condense(self, text):
        """Path of the reduced model and seconds of the process."""
        (self.folder / "part.rom.toml").write_text(f"boundary = {names(self.boundary)}\n{text}")
        program = self.build / "bin/clatter-condense"
        seconds = run([program, self.fe, "-c", "part.rom.toml", "-o", "part.rom.h5", "--quiet"], self.folder)[1]
        return self.folder / "part.rom.h5", seconds

    def frequencies(self, model, fixed=()):
        """Elastic frequencies [Hz] of the part below the limit, free or with sets held."""
        (self.folder / "part.modes.toml").write_text(f"fmax_hz = {1.02 * self.limit}\nfixed = {names(fixed)}\n")
        run([self.build / "bin/clatter-modal", model, "-c", "part.modes.toml", "-o", "part.modes.h5", "--quiet"], self.folder)
        with h5py.File(self.folder / "part.modes.h5") as file:
            found = np.sort(file["frequency_hz"][()])
        return found[found > RIGID_HZ]

    def methods(self):
        full, held_full = (found[found < self.limit] for found in (self.frequencies(self.fe),
                                                                   self.frequencies(self.fe, [self.held])))
        cases = {"guyan": 'method = "guyan"\n',
                 f"craig-bampton to {2 * self.limit:g} Hz, no residual modes": f"fmax_hz = {2 * self.limit}\nfrequency_error = 0\n",
                 f"craig-bampton to {2 * self.limit:g} Hz": f"fmax_hz = {2 * self.limit}\n",
                 f"craig-chang to {self.limit:g} Hz": f'method = "craig-chang"\nfmax_hz = {self.limit}\n'}
        print(f"{self.name}: below {self.limit:g} Hz {len(full)} elastic modes, {len(held_full)} with {self.held} held\n")
        print("| method | coordinates | seconds | largest frequency error, free | held |\n|---|---|---|---|---|")
        for what, text in cases.items():
            rom, seconds = self.condense("skin = []\n" + text)
            with h5py.File(rom) as file:
                size = file["M_rr"].shape[0]
            errors = [error_text(self.frequencies(rom), full), error_text(self.frequencies(rom, [self.held]), held_full)]
            print(f"| {what} | {size} | {seconds:.1f} | {errors[0]} | {errors[1]} |", flush=True)

    def static_full(self):
        """Nodal displacements of the full model under the load, held at one set."""
        with h5py.File(self.fe) as file:
            K, T = sparse_of(file["K"]), sparse_of(file["T"])
            f, held, nodes = file[f"loads/{self.load}"][()], file[f"sets/{self.held}/dofs"][()], file["nodes"][()]
        free = np.setdiff1d(np.arange(K.shape[0]), held)
        q = np.zeros(K.shape[0])
        q[free] = sparse_linalg.splu(K[free][:, free].tocsc()).solve(f[free])
        return nodes, (T @ q).reshape(-1, 3)

    def load_shapes(self):
        nodes, full = self.static_full()
        row = {tuple(node): k for k, node in enumerate(nodes)}
        print(f"\n{self.name} under {self.load}, {self.held} held, {len(nodes)} nodes\n")
        print("| basis | largest error at a skin node, relative to the largest displacement |\n|---|---|")
        for what, text in {"without": "", "with its load shape": f"load_shapes = {names([self.load])}\n"}.items():
            rom, _ = self.condense(f'fmax_hz = {2 * self.limit}\nskin = ["skin"]\n{text}')
            with h5py.File(rom) as file:
                K, f, held = file["K_rr"][()], file[f"loads/{self.load}"][()], file[f"sets/{self.held}/dofs"][()]
                free = np.setdiff1d(np.arange(len(f)), held)
                q = np.zeros(len(f))
                q[free] = np.linalg.solve(K[np.ix_(free, free)], f[free])
                skin, u = file["skin/nodes"][()], (file["skin/T"][()] @ q).reshape(-1, 3)
            same = [(k, row[tuple(node)]) for k, node in enumerate(skin) if tuple(node) in row]
            a, b = np.array(same).T
            error = np.linalg.norm(u[a] - full[b], axis=1).max() / np.linalg.norm(full, axis=1).max()
            print(f"| {what} | {error:.1e} |", flush=True)

    def interface(self, counts):
        print(f"\n{self.name}: interface modes of {self.grid}\n")
        print("| interface modes | film work, by mass | frequencies | film work, by area | frequencies |\n|---|---|---|---|---|")
        for count in counts:
            cells = []
            for weight in ("mass", "area"):
                rom, _ = self.condense(f'skin = []\nfmax_hz = {2 * self.limit}\nprove_count = false\n[interface]\n'
                                       f'sets = {names([self.grid])}\nmodes = {count}\nweight = "{weight}"\n')
                with h5py.File(rom) as file:
                    proved = file["certificate"].attrs
                    total = int(proved["interface_coordinates"])
                    cells += [f"{proved['interface_film_work_error']:.1e}", f"{proved['interface_frequency_error']:.1e}"]
            print(f"| {count} of {total} | " + " | ".join(cells) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--part", choices=PARTS, default="piston")
    parser.add_argument("--counts", type=int, nargs="+", default=[5, 10, 20, 30, 40], help="interface modes")
    parser.add_argument("--only", choices=("methods", "load_shapes", "interface"), help="one table")
    parser.add_argument("--build", default=ROOT / "build/release", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="clatter_bench_") as folder:
        part = Part(Path(folder), options.build.resolve(), options.part)
        for table in ("methods", "load_shapes", "interface"):
            if options.only in (None, table):
                part.interface(options.counts) if table == "interface" else getattr(part, table)()


if __name__ == "__main__":
    main()
