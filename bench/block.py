# SPDX-License-Identifier: GPL-3.0-or-later
"""The free truck-diesel block at a given size: mesh, matrices, decks for others."""
import re
import sys
from pathlib import Path

import h5py
import numpy as np
import scipy.sparse as sp

from measured import run

ROOT = Path(__file__).resolve().parent.parent
SAMPLE = ROOT / "samples" / "truck_diesel"
SAMPLE_DOF, SAMPLE_MM = 111_771, 30.0  # result of block.mesh.toml, as first guess


def mesh_toml(size_mm, cylinders):
    text = re.sub(r"(?m)^cylinders\s*=.*$", f"cylinders = {cylinders}", (SAMPLE / "block.mesh.toml").read_text())
    return re.sub(r"(?m)^element_size_mm\s*=.*$", f"element_size_mm = {size_mm:.4g}", text) if size_mm else text


def cylinders_of(dof):
    """The walls of the sample's four cylinders need at least 110 000 DoFs: a smaller block has fewer cylinders."""
    return int(min(4, max(1, dof // 28_000)))


def fe_toml():
    """The materials without couplings: the same nodal matrices for all programs."""
    text = (SAMPLE / "block.fe.toml").read_text()
    return re.split(r"(?m)^# .*\n*\[\[contact\]\]|^\[\[contact\]\]", text)[0]


def make_mesh(folder, binaries, size_mm=None, cylinders=4):
    """block.mesh.h5 and block.inp; returns the number of displacements."""
    (folder / "block.mesh.toml").write_text(mesh_toml(size_mm, cylinders))
    run([binaries / "clatter-mesh", "block.mesh.toml", "-o", "block.mesh.h5", "--export", "block.inp", "--quiet"], folder)
    with h5py.File(folder / "block.mesh.h5") as mesh:
        return 3 * len(mesh["nodes"])


def make_mesh_of(folder, binaries, dof):
    """A mesh within about 6 % of `dof` displacements, by secant on log size against log count."""
    cylinders = cylinders_of(dof)
    tried = [(np.log(SAMPLE_MM), np.log(SAMPLE_DOF * cylinders / 4))]
    size, slope = SAMPLE_MM, -1.0
    for _ in range(7):
        size *= float(np.exp(np.clip((np.log(dof) - tried[-1][1]) / slope, -0.9, 0.9)))
        found = make_mesh(folder, binaries, size, cylinders)
        tried.append((np.log(size), np.log(found)))
        if abs(found / dof - 1.0) < 0.06:
            return found
        (x0, y0), (x1, y1) = tried[-2:]
        slope = float(np.clip((y1 - y0) / (x1 - x0), -3.0, -0.3)) if abs(x1 - x0) > 1e-6 else slope
    print(f"bench: {found} displacements is the nearest mesh to {dof}", file=sys.stderr)
    return found


def assemble(folder, binaries, toml, name="block"):
    (folder / f"{name}.fe.toml").write_text(toml)
    run([binaries / "clatter-assembly", "block.mesh.h5", "-c", f"{name}.fe.toml", "-o", f"{name}.fe.h5", "--quiet"], folder)


def save_npz(folder):
    """block.K.npz, block.M.npz, both triangles: for programs linked to another HDF5 than h5py."""
    with h5py.File(folder / "block.fe.h5") as model:
        for name in "KM":
            g = model[name]
            low = sp.csc_matrix((g["data"][()], g["indices"][()], g["indptr"][()]), shape=tuple(g.attrs["shape"]))
            sp.save_npz(folder / f"block.{name}.npz", (low + sp.tril(low, -1).T).tocsr(), compressed=False)


def deck(folder, name, step):
    """The exported mesh with the sample's materials and a step of CalculiX."""
    import tomllib
    lines = ["*INCLUDE, INPUT=block.inp"]
    for material, values in tomllib.loads(fe_toml())["material"].items():
        lines += [f"*MATERIAL, NAME={material}", "*ELASTIC", f"{values['E_gpa'] * 1e9}, {values['nu']}", "*DENSITY",
                  f"{values['rho']}"]
        lines += [f"*SOLID SECTION, ELSET={region}, MATERIAL={material}" for region in values["regions"]]
    (folder / f"{name}.inp").write_text("\n".join(lines + step) + "\n")


def ccx_frequencies(folder, name):
    text = (folder / f"{name}.dat").read_text()
    rows = re.findall(r"^\s+\d+\s+(\S+)\s+(\S+)\s+(\S+)\s+\S+\s*$", text.split("P A R T I C I P A T I O N")[0], re.M)
    return sorted(float(row[2]) for row in rows)


def clatter_frequencies(folder):
    with h5py.File(folder / "block.modes.h5") as file:
        return sorted(float(f) for f in file["frequency_hz"][:])
