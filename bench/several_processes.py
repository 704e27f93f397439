#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One part by several processes (docs/cluster.md) on the block of the truck diesel. Tables (--tables):

  peers   50 modes of the sample's mesh by clatter-modal, by clatter-modal-mpi and by SLEPc with MUMPS, the same matrices, one
          and two ranks of one thread
  large   a million displacements to 300 boundary coordinates and 100 modes, certified: clatter-condense with one thread, and
          clatter-condense-mpi on two ranks with the factor on disk. 13 GB of memory, 13 GB of disk, half an hour

Processor seconds are user and system time of all ranks together; ranks that wait for each other spin, and are counted. Peak
memory is that of the largest process. Needs `make build-mpi`, for SLEPc the packages of bench/README.md.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy as np

import block
from measured import apart, run
from page import markdown

PEERS = Path(__file__).resolve().parent / "peers"
LARGE_MM, LARGE_ROWS, LARGE_PER_TURN = 7.85, 24, 40
# As root Open MPI asks for two confirmations; there may be fewer cores than ranks.
ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMP_NUM_THREADS": "1",
               "OPENBLAS_NUM_THREADS": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}


def timed(command, folder, ranks=0):
    """Standard output, wall seconds, processor seconds of all processes, peak GB of the largest; None when it fails."""
    launch = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] if ranks else []
    environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_CORETYPE"}  # programs choose
    begin = time.monotonic()
    process = subprocess.Popen([*launch, *map(str, command)], cwd=folder, stdout=subprocess.PIPE, text=True,
                               env={**environment, **ENVIRONMENT, "TMPDIR": str(folder)})
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        return None
    return output, time.monotonic() - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1e6


def figures(found):
    return [f"{found[1]:.0f}", f"{found[2]:.0f}", f"{found[3]:.2f}"]


def peers(folder, binaries, options):
    block.make_mesh(folder, binaries)
    block.assemble(folder, binaries, block.fe_toml())
    apart(block.save_npz, folder)
    arguments = ["block.fe.h5", "--count", str(options.modes), "-o", "block.modes.h5", "--quiet", "--threads", "1"]
    slepc = ["/usr/bin/python3", PEERS / "slepc_modes.py", str(options.modes), "1e-12"]
    rows = [("clatter-modal, count proved", [binaries / "clatter-modal", *arguments], 0)]
    for ranks in (1, 2):
        rows += [("clatter-modal-mpi, count proved", [binaries / "clatter-modal-mpi", *arguments], ranks),
                 ("SLEPc + MUMPS", slepc, ranks)]
    reference, table = None, []
    for name, command, ranks in rows:
        found = timed(command, folder, ranks)
        if found is None:
            table.append([name, str(ranks or ""), "failed", "", "", "", ""])
            continue
        hz = sorted(map(float, found[0].split())) if command is slepc else block.clatter_frequencies(folder)
        hz = np.array([f for f in hz if f > 1.0][:options.modes - 6])
        reference = hz if reference is None else reference
        table.append([name, str(ranks or ""), *figures(found), str(len(hz)), f"{np.abs(hz / reference - 1.0).max():.1e}"])
    return markdown(["program", "ranks", "seconds", "processor seconds", "peak GB", "elastic modes", "largest difference"], table)


def large_model(folder, binaries):
    """block.fe.h5 and block.rom.toml."""
    text = re.sub(r"(?m)^elements_per_turn\s*=.*$", f"elements_per_turn = {LARGE_PER_TURN}", block.mesh_toml(LARGE_MM, 4))
    (folder / "block.mesh.toml").write_text(text)
    run([binaries / "clatter-mesh", "block.mesh.toml", "-o", "block.mesh.h5", "--quiet"], folder)
    grid = re.sub(r"(?m)^rows\s*=.*$", f"rows = {LARGE_ROWS}", (block.SAMPLE / "block.fe.toml").read_text())
    block.assemble(folder, binaries, grid)
    text = (block.SAMPLE / "block.rom.toml").read_text().replace('"liner_4_axial",', "")
    text = re.sub(r"(?m)^fmax_hz\s*=.*$", "count = 100", text)
    (folder / "block.rom.toml").write_text(re.sub(r"(?m)^skin\s*=.*$", 'skin = ["liner_4_bore"]', text))


def reduced(path):
    with h5py.File(path) as file:
        certificate = file["certificate"].attrs
        return (file["fixed_interface_hz"][()], file["K_rr"][()], file["M_rr"][()], certificate["count_below"],
                certificate["certified"])


def large(folder, binaries, options):
    if not (folder / "block.fe.h5").exists():
        large_model(folder, binaries)
    arguments = ["block.fe.h5", "-c", "block.rom.toml", "--threads", "1"]
    rows = [("clatter-condense", [binaries / "clatter-condense", *arguments, "-o", "one.rom.h5"], 0, "one.rom.h5"),
            ("clatter-condense-mpi", [binaries / "clatter-condense-mpi", *arguments, "-o", "shared.rom.h5", "--memory-limit",
                                      str(options.memory_gib)], 2, "shared.rom.h5")]
    table, models = [], []
    for name, command, ranks, output in rows:
        (folder / output).unlink(missing_ok=True)  # its stored permutation would be reused
        found = timed(command, folder, ranks)
        if found is None:
            table.append([name, str(ranks or ""), "failed", "", "", "", "", ""])
            continue
        print(found[0], file=sys.stderr)
        models.append(reduced(folder / output))
        hz, K, M, count, certified = models[-1]
        n_b, first = len(K) - len(hz), models[0]
        difference = [np.abs(hz / first[0] - 1.0)[:100].max(),
                      *(np.abs((a - b)[:n_b, :n_b]).max() / np.abs(b[:n_b, :n_b]).max() for a, b in ((K, first[1]), (M, first[2])))]
        table.append([name, str(ranks or ""), *figures(found), f"{count:.0f}", f"{certified:.0f}",
                      " / ".join(f"{value:.1e}" for value in difference)])
    return markdown(["program", "ranks", "seconds", "processor seconds", "peak GB", "count by inertia", "certified",
                     "largest difference: frequency / K_bb / M_bb"], table)


TABLES = {"peers": peers, "large": large}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tables", nargs="+", choices=TABLES, default=list(TABLES))
    parser.add_argument("--modes", type=int, default=50, help="of `peers`")
    parser.add_argument("--memory-gib", type=float, default=4.5, help="of each rank in `large`: the factor goes to disk")
    parser.add_argument("--folder", type=Path, help="keeps the model of `large`; default: a scratch folder")
    parser.add_argument("--build", type=Path, default=block.ROOT / "build/release")
    options = parser.parse_args()
    binaries = options.build.resolve() / "bin"
    for table in options.tables:
        with tempfile.TemporaryDirectory(prefix="clatter-bench-") as scratch:
            folder = Path(options.folder if table == "large" and options.folder else scratch).resolve()
            folder.mkdir(parents=True, exist_ok=True)
            print("\n".join([f"{table}:", "", *TABLES[table](folder, binaries, options), ""]), flush=True)


if __name__ == "__main__":
    main()
