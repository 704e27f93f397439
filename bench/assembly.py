#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""K and M of tet10 blocks of growing size: clatter, numpy with SciPy (all cells at once, triplets
summed by coo_matrix), and with --calculix CalculiX (*FREQUENCY, SOLVER=MATRIXSTORAGE: it assembles and writes them).

Seconds of clatter and SciPy are those of the assembly alone, medians of the runs, of CalculiX those of the complete process; peak memory
is that of the complete process. The last column is the exponent of growth from the row before: 1 is linear.
"""
import argparse
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from measured import run
from tet_block import make, write_abaqus

ROOT = Path(__file__).resolve().parent.parent
SIZES = (9, 15, 19, 24, 30)
SCIPY = """
import sys, time, h5py, numpy as np, scipy.sparse as sp
with h5py.File(sys.argv[1]) as f:
    x = f["nodes"][()]
    cells = f["cells/0/nodes"][()].astype(np.int64)  # one region
begin = time.monotonic()
a, b = (5 - 5 ** .5) / 20, (5 + 3 * 5 ** .5) / 20
points = np.array([(a, a, a), (b, a, a), (a, b, a), (a, a, b)])
lam, mu, rho = 2.1e11 * .3 / (1.3 * .4), 2.1e11 / 2.6, 7850.
pairs = [(0, 1), (1, 2), (2, 0), (0, 3), (2, 3), (1, 3)]
slope = np.vstack([[-1, -1, -1], np.eye(3)])
n, dofs = len(cells), 3 * len(x)
K, M = np.zeros((n, 10, 3, 10, 3)), np.zeros((n, 10, 10))
corners = x[cells]
for p in points:
    L = np.append(1 - p.sum(), p)
    N = np.concatenate([L * (2 * L - 1), [4 * L[i] * L[j] for i, j in pairs]])
    dN = np.vstack([slope * (4 * L - 1)[:, None], [4 * (L[i] * slope[j] + L[j] * slope[i]) for i, j in pairs]])
    J = np.einsum("eni,nk->eik", corners, dN)
    w = np.linalg.det(J) / 24
    g = np.einsum("nk,eki->eni", dN, np.linalg.inv(J))
    H = np.einsum("e,eai,ebj->eaibj", w, g, g)
    K += lam * H + mu * H.transpose(0, 1, 4, 3, 2)
    K += mu * np.einsum("eakbk,ij->eaibj", H, np.eye(3))
    M += (rho * w)[:, None, None] * np.outer(N, N)
dof = (3 * cells[:, :, None] + np.arange(3)).reshape(n, 30).astype(np.int32)
rows, columns = np.broadcast_to(dof[:, :, None], (n, 30, 30)), np.broadcast_to(dof[:, None, :], (n, 30, 30))
K = sp.coo_matrix((K.ravel(), (rows.ravel(), columns.ravel())), shape=(dofs, dofs)).tocsc()
M = sp.coo_matrix((np.einsum("eab,ij->eaibj", M, np.eye(3)).ravel(), (rows.ravel(), columns.ravel())), shape=(dofs, dofs)).tocsc()
M.eliminate_zeros()
print(time.monotonic() - begin, K.nnz, M.nnz)
"""


def clatter_mesh(folder, cubes, build):
    make(write_abaqus, folder / "block.inp", cubes)
    subprocess.run([build / "bin/clatter-mesh", "block.inp", "--units", "m-kg-s", "-o", "block.mesh.h5", "--recipe",
                    "block.fe.toml", "--quiet"], cwd=folder, check=True)


def clatter(folder, build, runs):
    """DoFs, seconds, peak and matrix megabytes."""
    seconds = []
    for _ in range(runs):
        output, _, peak = run([build / "bench/assemble_mesh", "block.mesh.h5"], folder)
        dofs, _, pattern, assembly, size = output.split()
        seconds.append(float(pattern) + float(assembly))
    return int(dofs), statistics.median(seconds), peak, float(size) / 1e6


def scipy(folder, runs):
    seconds = []
    for _ in range(runs):
        output, _, peak = run([sys.executable, "-c", SCIPY, "block.mesh.h5"], folder)
        seconds.append(float(output.split()[0]))
    return statistics.median(seconds), peak


def calculix(folder):
    text = (folder / "block.inp").read_text()
    step = "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n1\n*END STEP\n"
    (folder / "matrices.inp").write_text(re.sub(r"\*STEP.*", step, text, flags=re.S))
    _, seconds, peak = run(["ccx", "matrices"], folder)
    return seconds, peak


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cubes", type=int, nargs="+", default=SIZES, help="cubes along an edge, each size")
    parser.add_argument("--runs", type=int, default=3, help="number of runs for the median")
    parser.add_argument("--calculix", action="store_true", help="CalculiX as well (minutes)")
    parser.add_argument("--build", default=ROOT / "build/release", type=Path, help="with target bench_programs built")
    options = parser.parse_args()
    build = options.build.resolve()
    os.environ.setdefault("OMP_NUM_THREADS", str(os.cpu_count()))
    peers = ["SciPy s", "MB"] + (["CalculiX s", "MB"] if options.calculix else [])
    print("| DoF | clatter s | peak MB | K and M MB | " + " | ".join(peers) + " | growth |")
    print("|---" * (5 + len(peers)) + "|")
    before = None
    for cubes in options.cubes:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            clatter_mesh(folder, cubes, build)
            dofs, seconds, peak, size = clatter(folder, build, options.runs)
            others = [f"{value:.4g}" for value in scipy(folder, options.runs)]
            if options.calculix:
                others += [f"{value:.4g}" for value in calculix(folder)]
        growth = f"{math.log(seconds / before[1]) / math.log(dofs / before[0]):.2f}" if before else ""
        print(f"| {dofs} | {seconds:.3f} | {peak:.0f} | {size:.0f} | " + " | ".join(others) + f" | {growth} |", flush=True)
        before = dofs, seconds


if __name__ == "__main__":
    main()
