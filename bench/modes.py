#!/usr/bin/python3
"""The lowest modes of the free truck-diesel block: clatter-modal beside SciPy and CalculiX.

All three take the same tet10 mesh; SciPy takes clatter's own matrices. Seconds are wall time of the
whole process, median of the runs; memory is the largest resident set of the process.
"""
import argparse
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SAMPLE = ROOT / "samples" / "truck_diesel"
RIGID_HZ = 1.0  # below this a mode of the free block is a rigid one (the first elastic: hundreds of Hz)
# The rigid modes make K singular: SciPy and clatter shift below zero, CalculiX uses a shift of its own.
SCIPY = """
import sys, h5py, numpy as np, scipy.sparse as sp, scipy.sparse.linalg as la
f = h5py.File(sys.argv[1])
def matrix(name):
    g = f[name]
    low = sp.csc_matrix((g['data'][:], g['indices'][:], g['indptr'][:]), shape=tuple(g.attrs['shape']))
    return (low + sp.tril(low, -1).T).tocsc()
K, M = matrix('K'), matrix('M')
w, _ = la.eigsh(K, int(sys.argv[2]), M, sigma=-(2 * np.pi * 100.0) ** 2)
print(*np.sqrt(np.abs(np.sort(w))) / (2 * np.pi))
"""


def timed(command, folder):
    """Wall seconds, peak memory [GiB] and standard output of a command; ends the bench when it fails."""
    start = time.monotonic()
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    out, err = process.communicate()
    seconds = time.monotonic() - start
    if process.returncode != 0:
        sys.exit(f"bench: {command[0]} ended with {process.returncode}: {(err or out).strip()[-400:]}")
    return seconds, out


def with_memory(command):
    return ["/usr/bin/env", "time", "-f", "%M", "-o", "memory.txt"] + command


def measure(name, command, folder, runs, frequencies):
    samples, memory = [], 0.0
    for _ in range(runs):
        seconds, out = timed(with_memory(command), folder)
        samples.append(seconds)
        memory = max(memory, float((folder / "memory.txt").read_text().split()[-1]) / 1024**2)
    values = [f for f in frequencies(out) if f > RIGID_HZ]
    return name, statistics.median(samples), min(samples), max(samples), memory, values


def clatter_frequencies(folder):
    import h5py
    with h5py.File(folder / "block.modes.h5") as file:
        return sorted(float(f) for f in file["frequency_hz"][:])


def ccx_frequencies(folder):
    text = (folder / "block_frequency.dat").read_text()
    rows = re.findall(r"^\s+\d+\s+(\S+)\s+(\S+)\s+(\S+)\s+\S+\s*$", text.split("P A R T I C I P A T I O N")[0], re.M)
    return sorted(float(row[2]) for row in rows)


def write_ccx_deck(folder, fe_toml, count):
    """The exported mesh with the sample's materials and a *FREQUENCY step."""
    import tomllib
    config = tomllib.loads(fe_toml)
    lines = ["*INCLUDE, INPUT=block.inp"]
    for name, material in config["material"].items():
        lines += [f"*MATERIAL, NAME={name}", "*ELASTIC", f"{material['E_gpa'] * 1e9}, {material['nu']}",
                  "*DENSITY", f"{material['rho']}"]
        lines += [f"*SOLID SECTION, ELSET={region}, MATERIAL={name}" for region in material["regions"]]
    lines += ["*STEP", "*FREQUENCY", f"{count}", "*END STEP"]
    (folder / "block_frequency.inp").write_text("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dof-size", type=float, help="element_size_mm of the block (default: the sample's)")
    parser.add_argument("--count", type=int, default=50, help="modes, the six rigid ones included")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--bin", type=Path, default=ROOT / "build" / "release" / "bin")
    options = parser.parse_args()
    if not shutil.which("time"):
        sys.exit("bench: the program `time` is missing: apt install time")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        mesh = (SAMPLE / "block.mesh.toml").read_text()
        if options.dof_size:
            mesh = re.sub(r"(?m)^element_size_mm\s*=.*$", f"element_size_mm = {options.dof_size}", mesh)
        (folder / "block.mesh.toml").write_text(mesh)
        # Free and without couplings: the same nodal matrices for all three.
        fe_toml = (SAMPLE / "block.fe.toml").read_text()
        (folder / "block.fe.toml").write_text(re.split(r"(?m)^# .*\n*\[\[contact\]\]|^\[\[contact\]\]", fe_toml)[0])
        timed([options.bin / "clatter-mesh", "block.mesh.toml", "-o", "block.mesh.h5", "--export", "block.inp"], folder)
        timed([options.bin / "clatter-assembly", "block.mesh.h5", "-c", "block.fe.toml", "-o", "block.fe.h5"], folder)
        write_ccx_deck(folder, fe_toml, options.count)
        (folder / "scipy_modes.py").write_text(SCIPY)
        threads = str(os.cpu_count())
        os.environ.update(OMP_NUM_THREADS=threads, CCX_NPROC_EQUATION_SOLVER=threads)
        rows = [
            measure("clatter-modal, count proved",
                    [str(options.bin / "clatter-modal"), "block.fe.h5", "--count", str(options.count), "-o",
                     "block.modes.h5"], folder, options.runs, lambda _: clatter_frequencies(folder)),
            measure("SciPy eigsh", ["/usr/bin/python3", "scipy_modes.py", "block.fe.h5", str(options.count)], folder,
                    options.runs, lambda out: [float(f) for f in out.split()]),
            measure("CalculiX *FREQUENCY", ["ccx", "block_frequency"], folder, options.runs,
                    lambda _: ccx_frequencies(folder)),
        ]
    reference = rows[0][5]
    print(f"{'program':30s} {'median s':>9s} {'min':>7s} {'max':>7s} {'GiB':>6s} {'modes':>6s} {'largest difference':>20s}")
    for name, median, low, high, memory, values in rows:
        shared = min(len(values), len(reference))
        difference = max(abs(a / b - 1.0) for a, b in zip(values[:shared], reference[:shared]))
        print(f"{name:30s} {median:9.2f} {low:7.2f} {high:7.2f} {memory:6.2f} {len(values):6d} {difference:20.2e}")


if __name__ == "__main__":
    main()
