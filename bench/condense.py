#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Modes and condensation of the free truck-diesel block compared with programs that Debian packages, on the same
matrices, with the same BLAS setting. Rows (--rows):

  modes        50 modes, 118 000 displacements: clatter (count proved or not), CalculiX, SciPy, SLEPc+MUMPS, its spectrum
               slicing (which counts), plain CHOLMOD+ARPACK (bench/cholmod_arpack.cpp)
  modes_large  100 modes to 1e-9, 635 000 displacements, without CalculiX and SciPy
  amls         1000 modes at 0.5 %, 1.3 million displacements, and the inertia counts at the last of them
  condense     2000 static coordinates and 500 modes, 660 000 displacements, 60 000 rows kept (deck, pan flange and
               bores); also CalculiX's *SUBSTRUCTURE at --substructure displacements (K alone)
  growth       fill, flops and seconds of one factorisation at 50 to 700 thousand displacements; below 112 thousand the
               block has fewer cylinders, since the walls of four need that many
  threads      seconds of a factorisation with one thread and with all (hard case C8)

Seconds are wall time of complete processes, median of the runs (SciPy and CalculiX: one); memory is the peak of the
process. "bound" is the flops of one factorisation (of two where the count is proved) over the measured rate of a matrix
product, without the solves.
Needs `ninja -C build/release bench_programs`, and for SLEPc the packages python3-slepc4py-real3.18 and
python3-petsc4py-real3.18 (its rows say "failed" without them).
"""
import argparse
import os
import re
import sys
import tempfile
from pathlib import Path

import h5py

import block
from measured import apart, blas, dgemm_rate, medians, run
from page import markdown, write

ROOT = Path(__file__).resolve().parent.parent
PEERS = Path(__file__).resolve().parent / "peers"
RIGID_HZ = 1.0  # below this a mode of the free block is a rigid one (the first elastic: hundreds of Hz)
THOUSANDS = {"modes": [118], "modes_large": [635], "amls": [1300], "condense": [660], "growth": [50, 100, 200, 400, 700],
             "threads": [100]}
PYTHON, TOLERANCE = "/usr/bin/python3", "1e-9"
SLOW = ("scipy", "calculix")  # minutes: run once
PITCH = 130.0  # of the cylinders along x [mm]


def words(output):
    return sorted(float(word) for word in output.split())


class Bench:
    def __init__(self, options, folder):
        self.options, self.folder = options, folder
        self.bin, self.bench = options.build.resolve() / "bin", options.build.resolve() / "bench"
        self.setting = blas(options.threads)
        self.rate = dgemm_rate(folder, self.setting)

    def selected(self, peer):
        return not self.options.peers or peer in self.options.peers

    def block(self, thousands):
        """Mesh and matrices of that size in the folder; returns the cost of one factorisation."""
        block.make_mesh_of(self.folder, self.bin, 1000 * thousands)
        block.assemble(self.folder, self.bin, block.fe_toml())
        return self.factor()

    def factor(self, threads=None):
        """{"dof", "entries", "flops", "analyse", "factor", "solve"} of K - sigma M."""
        threads = threads or self.options.threads
        output = run([self.bench / "factor_cost", "block.fe.h5", "64", str(threads)], self.folder, **blas(threads))[0]
        return dict(zip(("dof", "entries", "flops", "analyse", "factor", "solve"), map(float, output.split())))

    def head(self):
        return [f"{self.options.threads} threads, OPENBLAS_CORETYPE={self.setting.get('OPENBLAS_CORETYPE', 'own choice')}, "
                f"matrix product {self.rate / 1e9:.0f} GF/s, median of {self.options.runs}:", ""]

    # The rows.

    def programs(self, count, small):
        """(peer, name, command, reader of the frequencies); None: the command needs the last frequency."""
        (self.folder / "plain.modes.toml").write_text(f"count = {count}\nprove_count = false\n")
        block.deck(self.folder, "ccx", ["*STEP", "*FREQUENCY", str(count), "*END STEP"])
        clatter = [self.bin / "clatter-modal", "block.fe.h5", "--quiet", "-o", "block.modes.h5"]
        own = lambda _: block.clatter_frequencies(self.folder)
        theirs = lambda _: block.ccx_frequencies(self.folder, "ccx")
        rows = [("clatter", "clatter", [*clatter, "-c", "plain.modes.toml"], own),
                ("clatter-proved", "clatter, count proved", [*clatter, "--count", str(count)], own),
                ("slepc", "SLEPc + MUMPS", [PYTHON, PEERS / "slepc_modes.py", str(count), TOLERANCE], words),
                ("slicing", "the same, spectrum slicing", None, words),
                ("cholmod", "CHOLMOD + ARPACK, plain",
                 [self.bench / "cholmod_arpack", "block.fe.h5", str(count), TOLERANCE], words)]
        if small:
            rows += [("scipy", "SciPy eigsh, one run", [PYTHON, PEERS / "scipy_modes.py", str(count)], words),
                     ("calculix", "CalculiX *FREQUENCY, one run", ["ccx", "ccx"], theirs)]
        return [row for row in rows if self.selected(row[0])]

    def modes(self, thousands, small=True):
        cost = self.block(thousands)
        apart(block.save_npz, self.folder)
        count = self.options.modes or (50 if small else 100)
        reference, table = None, []
        for peer, name, command, read in self.programs(count, small):
            if command is None:
                if not reference:
                    continue
                # The interval ends between the last mode and the next.
                command = [PYTHON, PEERS / "slepc_modes.py", "0", TOLERANCE, str(1.0001 * reference[-1])]
            found = medians(command, self.folder, 1 if peer in SLOW else self.options.runs, **self.setting)
            if found is None:
                table.append([name, "failed", "", "", "", ""])
                continue
            output, seconds, peak = found
            hz = [f for f in read(output) if f > RIGID_HZ]
            reference = reference or hz
            difference = max((abs(a / b - 1) for a, b in zip(hz, reference)), default=float("nan"))
            factors = 2 if peer in ("clatter-proved", "slicing") else 1
            bound = "" if peer in SLOW else f"{factors * cost['flops'] / self.rate:.2f}"
            table.append([name, f"{seconds:.2f}", f"{peak / 1e3:.2f}", bound, str(len(hz)), f"{difference:.1e}"])
        return [f"{cost['dof']:.0f} displacements, {count} modes, the six rigid ones included; the first program's are the "
                "reference.", ""] + markdown(
            ["program", "seconds", "peak GB", "bound, seconds", "elastic modes", "largest difference"], table)

    def modes_large(self, thousands):
        return self.modes(thousands, small=False)

    def amls(self, thousands):
        dof = block.make_mesh_of(self.folder, self.bin, 1000 * thousands)
        block.assemble(self.folder, self.bin, block.fe_toml())
        count, accuracy = self.options.modes or 1000, 0.005
        (self.folder / "amls.modes.toml").write_text(
            f'count = {count}\nprove_count = false\neigen_solver = "amls"\naccuracy = {accuracy}\n')
        found = medians([self.bin / "clatter-modal", "block.fe.h5", "-c", "amls.modes.toml", "-o", "block.modes.h5", "--quiet",
                         "--memory-limit", str(self.options.memory)], self.folder, self.options.runs, **self.setting)
        if found is None:
            return ["failed"]
        with h5py.File(self.folder / "block.modes.h5") as file:
            last, error = file["frequency_hz"][-1], file["certificate"].attrs["frequency_error_estimate"]
        below = run([self.bench / "modes_below", "block.fe.h5", str(self.options.threads), str(last * (1 - accuracy)), str(last)],
                    self.folder, **self.setting)[0].split()
        return markdown(["displacements", "modes", "seconds", "peak GB", "largest error, estimated", "last [Hz]",
                         f"modes below it - {accuracy:.1%}", "modes below it"],
                        [[str(dof), str(count), f"{found[1]:.0f}", f"{found[2] / 1e3:.2f}", f"{error:.1e}", f"{last:.1f}", *below]])

    def condense(self, thousands):
        block.make_mesh_of(self.folder, self.bin, 1000 * thousands)
        count = self.options.modes or 500
        liners = range(1, block.cylinders_of(1000 * thousands) + 1)
        names = self.retain(liners)
        cost = self.factor()
        surfaces = ['"deck"', '"pan_flange"', *(f'"liner_{k}_bore"' for k in liners)]
        (self.folder / "block.rom.toml").write_text(
            f'boundary = [{", ".join(names)}]\ncount = {count}\nfrequency_error = 0.0\nskin = [{", ".join(surfaces)}]\n')
        command = [self.bin / "clatter-condense", "block.fe.h5", "-c", "block.rom.toml", "-o", "block.rom.h5", "--quiet"]
        table = []
        for name, more, factors in (("clatter, --no-certificate", ["--no-certificate"], 1), ("clatter, certified", [], 2)):
            # Remove the old file: its stored permutation would be reused.
            found = medians([*command, *more], self.folder, self.options.runs, ["block.rom.h5"], **self.setting)
            if found is None:
                table.append([name, f"{cost['dof']:.0f}", "", "failed", "", ""])
                continue
            with h5py.File(self.folder / "block.rom.h5") as rom:
                static, rows = rom.attrs["n_boundary"], len(rom["skin/T"])
            bound = (factors * cost["flops"] + 2 * static * cost["entries"]) / self.rate
            table.append([name, f"{cost['dof']:.0f}", f"{static} + {count} modes, {rows} rows", f"{found[1]:.1f}",
                          f"{found[2] / 1e3:.2f}", f"{bound:.1f}"])
        if self.selected("calculix"):
            table.append(self.substructure())
        return markdown(["program", "DoF", "reduced to", "seconds", "peak GB",
                         "bound, seconds: factors and one sweep of the static columns"], table)

    def retain(self, liners):
        """Assembles with patches on the liners, bearings and mounts: about --static coordinates. Names in quotes."""
        sets = [f"bearing_{k}" for k in range(1, len(liners) + 2)] + [f"mount_{k}" for k in range(1, 5)]
        toml = block.fe_toml() + "".join(
            f'\n[[coupling]]\nname = "{name}"\nkind = "{name.split("_")[0]}"\nsurface = "{name}"\n' for name in sets)
        # Two sectors of ten strips on each liner.
        rows = max(1, round((self.options.static - 6 * len(sets)) / (20 * len(liners))))
        for k in liners:
            x = PITCH * (k - (len(liners) + 1) / 2)
            toml += (f'\n[[contact]]\nname = "liner_{k}"\nsurface = "liner_{k}_bore"\naxis_point = [{x}, 0.0, 0.0]\n'
                     "axis = [0.0, 0.0, 1.0]\nzero_angle = [0.0, 1.0, 0.0]\naxial = [115.0, 315.0]\n"
                     f"rows = {rows}\n")
            toml += "".join(f"[[contact.sector]]\ncentre_deg = {centre}\nhalf_width_deg = 60.0\nstrips = 10\n"
                            for centre in (0.0, 180.0))
        block.assemble(self.folder, self.bin, toml)
        return [f'"{name}"' for name in [f"liner_{k}" for k in liners] + sets]

    def substructure(self):
        """CalculiX's *SUBSTRUCTURE GENERATE at a smaller size: K alone, for as many coordinates of the deck's first nodes."""
        dof = block.make_mesh_of(self.folder, self.bin, 1000 * self.options.substructure)
        text = (self.folder / "block.inp").read_text().split("*NODE", 1)[1].split("*ELEMENT", 1)[0]
        nodes = re.findall(r"^\s*(\d+),", text, re.M)
        # Without a *BOUNDARY card the installed 2.20 ends with a corrupted heap.
        held, kept = nodes[:3], nodes[3:3 + self.options.static // 3]
        step = ["*BOUNDARY", *[f"{node}, 1, 3" for node in held], "*NSET, NSET=KEPT", *[f"{node}," for node in kept],
                "*STEP", "*SUBSTRUCTURE GENERATE", "*RETAINED NODAL DOFS, SORTED=NO", "KEPT, 1, 3",
                "*SUBSTRUCTURE MATRIX OUTPUT, STIFFNESS=YES, OUTPUT FILE=USER DEFINED, FILE NAME=kept",
                "*END STEP"]
        block.deck(self.folder, "sub", step)
        found = medians(["ccx", "sub"], self.folder, 1, **self.setting)
        name = "CalculiX *SUBSTRUCTURE: K alone (2.20 prints it uncondensed, docs/validation.md)"
        if found is None or not (self.folder / "kept.mtx").exists():
            return [name, str(dof), f"{3 * len(kept)}", "failed", "", ""]
        return [name, str(dof), f"{3 * len(kept)}", f"{found[1]:.1f}", f"{found[2] / 1e3:.2f}", ""]

    def growth(self, *thousands):
        table = []
        for size in thousands:
            c = self.block(size)
            table.append([f"{c['dof']:.0f}", f"{c['entries'] / 1e6:.1f}", f"{c['flops'] / 1e9:.0f}", f"{c['analyse']:.2f}",
                          f"{c['factor']:.2f}", f"{c['flops'] / c['factor'] / 1e9:.0f}", f"{c['flops'] / self.rate:.2f}",
                          f"{c['solve']:.2f}", f"{64 * 4 * c['entries'] / c['solve'] / 1e9:.1f}"])
        return markdown(["DoF", "entries of L [1e6]", "Gflop", "order [s]", "factor [s]", "GF/s", "bound [s]",
                         "64 solves [s]", "GF/s"], table)

    def threads(self, thousands):
        self.block(thousands)
        table = []
        for count in sorted({1, self.options.threads}):
            c = self.factor(count)
            table.append([str(count), f"{c['dof']:.0f}", f"{c['factor']:.2f}", f"{c['solve']:.2f}"])
        return markdown(["threads", "DoF", "factor [s]", "64 solves [s]"], table)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rows", nargs="+", choices=THOUSANDS, default=["modes"])
    parser.add_argument("--sizes", nargs="+", type=float, help="thousands of displacements instead of those above")
    parser.add_argument("--peers", nargs="+", choices=["clatter", "clatter-proved", "slepc", "slicing", "cholmod", "scipy", "calculix"],
                        help="only these (default: all that are installed)")
    parser.add_argument("--modes", type=int, help="number of modes instead of those above")
    parser.add_argument("--static", type=int, default=2000, help="static coordinates of the row condense, about")
    parser.add_argument("--substructure", type=float, default=50, help="thousands of displacements for CalculiX's *SUBSTRUCTURE")
    parser.add_argument("--memory", type=float, default=21, help="memory limit of the row amls [GiB]")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--build", default=ROOT / "build/release", type=Path, help="with target bench_programs built")
    parser.add_argument("--write", action="store_true", help="put the tables into docs/accuracy.md")
    options = parser.parse_args()
    if not (options.build / "bench/factor_cost").exists():
        sys.exit(f"bench: {options.build}/bench/factor_cost is missing: ninja -C {options.build} bench_programs")
    with tempfile.TemporaryDirectory(prefix="clatter-bench-") as folder:
        bench = Bench(options, Path(folder))
        for row in options.rows:
            lines = bench.head()
            sizes = options.sizes or THOUSANDS[row]
            tables = [bench.growth(*sizes)] if row == "growth" else [getattr(bench, row)(size) for size in sizes]
            for table in tables:
                lines += table + [""]
            print(f"## {row}\n" + "\n".join(lines))
            if options.write:
                write(f"condense_{row}", lines[:-1])


if __name__ == "__main__":
    main()
