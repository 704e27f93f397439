#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Condensation by several processes on blocks of the truck diesel. Tables (--tables):

  counts    predicted by `clatter-condense predict` and counted with MUMPS (bench/rank_counts/rank_counts.cpp): operations, entries
            of L, memory and messages by rank, for 1 to 32 ranks, of which most share a core
  scaling   seconds of processor by phase on one and two ranks
  growth    entries of L and operations from 30 000 to 2 million DoF, fitted; the largest measured factor against
            what the smaller ones predict; 5, 10 and 20 million DoF on 32 cores
  assembly  memory and seconds of clatter-mesh and clatter-assembly, and the same for 10 and 20 million DoF

Needs `make build-mpi` and `ninja -C build/release bench_programs`. Processor seconds, since the machine is shared; a rank
that waits for another is not counted (Open MPI yields). 3.2 GB for two million DoF; 7 GB for the factor of `growth`.
"""
import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

import block
from page import markdown, write

ROOT = Path(__file__).resolve().parent.parent
SIZES = [(30.0, 1), (30.0, 4), (15.0, 4), (9.85, 4), (7.0, 4), (5.8, 4)]  # element size [mm], cylinders
FACTORISED = (9.85, 4)  # 640 000 DoF: the factor that the smaller ones predict
FITTED = 3  # the largest sizes: the walls have more than one cell across
GFLOPS = 20.0  # of a core in a factorisation, for the table of seconds
MILLIONS = (5, 10, 20)
ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OPENBLAS_NUM_THREADS": "1",
               "OMP_NUM_THREADS": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_mpi_yield_when_idle": "1"}


def wide(count):
    """A number of six digits or more with blanks."""
    return f"{count:,.0f}".replace(",", " ")


def count_of(given):
    """A count as MUMPS gives it: negative ones are in millions."""
    return -1e6 * given if given < 0 else given


class Bench:
    def __init__(self, options):
        self.folder, self.bin = options.folder.resolve(), options.build.resolve() / "bin"
        self.counter = options.build.resolve() / "bench/librank_counts.so"

    def measured(self, command, folder):
        """Processor seconds and peak [MB] of a process."""
        process = subprocess.Popen([str(word) for word in command], cwd=folder, stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        if status:
            sys.exit(f"bench: {command[0]} failed")
        return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1e3

    def block(self, size, cylinders):
        """Folder with the assembled block; made.json has what its mesh and matrices cost."""
        folder = self.folder / f"{size:g}_{cylinders}"
        if (folder / "made.json").exists():
            return folder
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "block.mesh.toml").write_text(re.split(r"(?m)^# Surfaces of the heat flow", block.mesh_toml(size, cylinders))[0])
        couplings = [(kind, f"{kind}_{k + 1}") for kind, count in (("bearing", cylinders + 1), ("mount", 4)) for k in range(count)]
        (folder / "block.fe.toml").write_text(block.fe_toml() + "".join(
            f'[[coupling]]\nname = "{name}"\nkind = "{kind}"\nsurface = "{name}"\n\n' for kind, name in couplings))
        (folder / "block.rom.toml").write_text('method = "guyan"\nskin = []\nboundary = ["' + '", "'.join(name for _, name in couplings) + '"]\n')
        mesh = self.measured([self.bin / "clatter-mesh", "block.mesh.toml", "-o", "block.mesh.h5", "--quiet"], folder)
        fe = self.measured([self.bin / "clatter-assembly", "block.mesh.h5", "-c", "block.fe.toml", "-o", "block.fe.h5", "--threads", "1",
                            "--quiet"], folder)
        with h5py.File(folder / "block.fe.h5") as file:
            dofs, entries = int(file["K"].attrs["shape"][0]), len(file["K/indices"])
        (folder / "made.json").write_text(json.dumps({"dofs": dofs, "K_entries": entries, "mesh": mesh, "assembly": fe}))
        return folder

    def predicted(self, folder, ranks):
        done = subprocess.run([self.bin / "clatter-condense", "predict", "block.fe.h5", "-c", "block.rom.toml", "--ranks", str(ranks),
                               "--gflops", str(GFLOPS), "--json", "--quiet"], cwd=folder, capture_output=True, text=True, check=True)
        return json.loads(done.stdout.splitlines()[-1])

    def counted(self, folder, ranks):
        """Per rank the lines of rank_counts of a reduction by that many ranks; and its steps [s]."""
        prefix = folder / f"counts_{ranks}"
        done = subprocess.run(["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(ranks), "-x", f"LD_PRELOAD={self.counter}",
                               "-x", f"CLATTER_RANK_COUNTS={prefix}", str(self.bin / "clatter-condense-mpi"), "block.fe.h5", "-c",
                               "block.rom.toml", "-o", "counted.rom.h5", "--threads", "1", "--no-certificate"], cwd=folder,
                              env={**os.environ, **ENVIRONMENT}, capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"bench: clatter-condense-mpi on {ranks} ranks: {done.stderr.splitlines()[-1]}")
        return [[json.loads(line) for line in Path(f"{prefix}.{rank}").read_text().splitlines()] for rank in range(ranks)]


def job(lines, number):
    """The first call of MUMPS with that job (1 analysis, 2 factorisation, 3 solution) of one rank."""
    return next(line for line in lines if line["job"] == number)


def spread(values):
    return max(values) / np.mean(values)


def count_table(bench, size, counts):
    folder, rows = bench.block(*size), []
    for ranks in counts:
        said, lines = bench.predicted(folder, ranks), bench.counted(folder, ranks)
        factors = [job(of_rank, 2) for of_rank in lines]
        sent = [job(of_rank, 2)["mumps"]["bytes"] - job(of_rank, 1)["mumps"]["bytes"] for of_rank in lines]
        messages = [job(of_rank, 2)["mumps"]["messages"] - job(of_rank, 1)["mumps"]["messages"] for of_rank in lines]
        own = [of_rank[-1]["others"] for of_rank in lines]
        rows.append([str(ranks), f"{said['factor_flops'] / 1e9:.2f}, {sum(f['rinfo'][2] for f in factors) / 1e9:.2f}",
                     f"{spread(said['rank_flops']):.2f}, {spread([f['rinfo'][2] for f in factors]):.2f}",
                     f"{said['factor_entries'] / 1e6:.1f}, {sum(count_of(f['info'][26]) for f in factors) / 1e6:.1f}",
                     f"{spread(said['rank_entries']):.2f}, {spread([count_of(f['info'][26]) for f in factors]):.2f}",
                     f"{said['factor_gib'] * 1073.7:.0f}, {factors[0]['infog'][15]}, {max(f['info'][21] for f in factors)}",
                     f"{sum(said['rank_sent_gib']) * 1073.7:.0f}, {sum(sent) / 1e6:.0f}", wide(sum(messages)),
                     f"{sum(o['bytes'] for o in own) / 1e6:.0f}", wide(sum(o["messages"] for o in own)),
                     f"{max(of_rank[-1]['peak_kib'] for of_rank in lines[1:] or lines) / 1e3:.0f}"])
    dofs = json.loads((folder / "made.json").read_text())["dofs"]
    head = ["ranks", "Gflop: predicted, counted", "most / mean of a rank", "entries of L [1e6]", "most / mean",
            "MB of the largest rank for the factor: predicted, MUMPS's estimate, used", "MB sent in the factorisation", "messages",
            "MB sent by our vectors and matrices", "messages", "peak MB of a rank but the first"]
    return [f"{wide(dofs)} DoF:", ""] + markdown(head, rows)


def scaling_table(bench, sizes):
    rows = []
    for size in sizes:
        folder = bench.block(*size)
        dofs = json.loads((folder / "made.json").read_text())["dofs"]
        for ranks in (1, 2):
            lines = bench.counted(folder, ranks)
            blocks = [[line for line in of_rank if line["job"] == 3 and line["nrhs"] > 8] for of_rank in lines]
            solves = [max(line["processor_seconds"] * 64 / line["nrhs"] for line in of_rank) for of_rank in blocks]
            own = [of_rank[-1]["processor_seconds"] - of_rank[-1]["mumps_processor_seconds"] for of_rank in lines]
            factors = [job(of_rank, 2) for of_rank in lines]
            slowest = max(factor["processor_seconds"] for factor in factors)
            rows.append([wide(dofs), str(ranks), f"{max(job(of_rank, 1)['processor_seconds'] for of_rank in lines):.2f}", f"{slowest:.2f}",
                         f"{factors[0]['rinfo'][2] / slowest / 1e9:.0f}", f"{max(solves):.2f}",
                         f"{max(own):.2f}", f"{max(of_rank[-1]['processor_seconds'] for of_rank in lines):.2f}"])
    head = ["DoF", "ranks", "analysis [s]", "factorisation [s]", "Gflop/s of a rank", "64 solves [s]", "reading, order, products [s]", "all [s]"]
    return markdown(head, rows)


def fitted(sizes, values, at):
    """Exponent of a power law through the largest sizes, and its value at `at`."""
    slope, offset = np.polyfit(np.log(sizes[-FITTED:]), np.log(values[-FITTED:]), 1)
    return slope, float(np.exp(offset + slope * np.log(at)))


def growth_table(bench):
    found = [bench.predicted(bench.block(*size), 32) for size in SIZES]
    whole = [one for one, (_, cylinders) in zip(found, SIZES) if cylinders == 4]
    dofs = [one["dofs"] for one in whole]
    rows = [[wide(one["dofs"]), f"{one['factor_entries'] / 1e6:.1f}", f"{one['factor_flops'] / 1e9:.1f}", wide(one["largest_front"]),
             f"{one['factor_gib']:.2f}", f"{sum(one['rank_sent_gib']):.1f}", f"{one['count_gib']:.2f}"] for one in found]
    lines = markdown(["DoF", "entries of L [1e6]", "Gflop", "rows of the largest front", "GiB of a rank of 32 for the factor",
                      "GiB sent by all", "GiB to count"], rows)
    names = {"factor_entries": "entries of L", "factor_flops": "operations", "largest_front": "largest front"}
    exponents = {name: fitted(dofs, [one[name] for one in whole], 1.0)[0] for name in names}
    lines += ["", "Exponents of the last three: " + ", ".join(f"{names[name]} {exponents[name]:.2f}" for name in names) +
              " (nested dissection of a compact body: 4/3, 2 and 2/3)."]
    at = SIZES[1:].index(FACTORISED)
    guess = {name: fitted(dofs[:at], [one[name] for one in whole[:at]], dofs[at])[1] for name in ("factor_entries", "factor_flops")}
    text = (f"{wide(dofs[at])} DoF from the two smaller blocks of four cylinders: {guess['factor_entries'] / 1e6:.0f}e6 entries and "
            f"{guess['factor_flops'] / 1e9:.0f} Gflop; counted from its graph {whole[at]['factor_entries'] / 1e6:.0f}e6 and "
            f"{whole[at]['factor_flops'] / 1e9:.0f}")
    lines += ["", text + ".", ""]
    rows = []
    for million in MILLIONS:
        n = 1e6 * million
        fit = {name: fitted(dofs, [one[name] for one in whole], n)[1]
               for name in ("factor_entries", "factor_flops", "factor_gib", "matrices_gib", "model_gib", "analysis_gib", "factor_seconds", "solve_seconds")}
        steep = whole[-1]["factor_entries"] * (n / dofs[-1]) ** (4 / 3), whole[-1]["factor_flops"] * (n / dofs[-1]) ** 2
        rows.append([str(million), f"{fit['factor_entries'] / 1e9:.1f} to {steep[0] / 1e9:.1f}", f"{fit['factor_flops'] / 1e12:.0f} to {steep[1] / 1e12:.0f}",
                     f"{fit['factor_gib']:.1f}", f"{fit['matrices_gib']:.1f}", f"{fit['model_gib']:.1f}", f"{fit['analysis_gib']:.0f}",
                     f"{fit['factor_seconds']:.0f} to {fit['factor_seconds'] * steep[1] / fit['factor_flops']:.0f}", f"{fit['solve_seconds']:.1f}"])
    lines += markdown(["million DoF", "entries of L [1e9]", "Tflop", "GiB of a rank: factor", "K and M", "model", "GiB of rank 0 for order and analysis",
                       "seconds of a factorisation", "64 solves"], rows)
    return lines


def assembly_table(bench):
    made = [json.loads((bench.block(*size) / "made.json").read_text()) for size in SIZES]
    rows = [[wide(one["dofs"]), wide(one["K_entries"]), f"{one['mesh'][0]:.1f}", f"{one['mesh'][1]:.0f}", f"{one['assembly'][0]:.1f}",
             f"{one['assembly'][1]:.0f}", f"{one['assembly'][1] * 1e6 / one['dofs']:.0f}"] for one in made]
    whole = made[1:]
    dofs = [one["dofs"] for one in whole]
    for million in (10, 20):
        n = 1e6 * million
        fit = [fitted(dofs, [one[stage][k] for one in whole], n)[1] for stage in ("mesh", "assembly") for k in (0, 1)]
        entries = fitted(dofs, [one["K_entries"] for one in whole], n)[1]
        rows.append([f"{wide(n)}, predicted", wide(round(entries, -6)), f"{fit[0]:.0f}", f"{fit[1]:.0f}", f"{fit[2]:.0f}", f"{fit[3]:.0f}",
                     f"{fit[3] * 1e6 / n:.0f}"])
    return markdown(["DoF", "entries of K", "clatter-mesh s", "MB", "clatter-assembly s", "MB", "bytes of a DoF"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tables", nargs="+", default=["counts", "scaling", "growth", "assembly"],
                        choices=["counts", "scaling", "growth", "assembly"])
    parser.add_argument("--folder", type=Path, default=Path(tempfile.gettempdir()) / "clatter-predict", help="models are kept there (4 GB)")
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("--write", action="store_true", help="put the tables into docs/accuracy.md")
    options = parser.parse_args()
    bench = Bench(options)
    tables = {"counts": lambda: count_table(bench, SIZES[0], (2, 4, 8, 16, 32)) + [""] + count_table(bench, SIZES[1], (1, 2, 4, 8)),
              "scaling": lambda: scaling_table(bench, SIZES[1:3]),
              "growth": lambda: growth_table(bench),
              "assembly": lambda: assembly_table(bench)}
    for name in options.tables:
        lines = tables[name]()
        print("\n".join(lines), flush=True)
        if options.write:
            write(f"predict_{name}", lines)


if __name__ == "__main__":
    main()
