#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Stability of the numbers: the same physics by other threads, other numbers of nodes and cells, rotated, shifted, mirrored and scaled models, decks in
other units, other kernels of BLAS, programs of other compilers. Tables (--tables):

  beam       samples/beam through all six programs, all variants
  slap       one cycle of samples/truck_diesel/slap.run.toml; each variant makes both reduced models again
  drive      a tenth of a second of samples/timing_drive; the reduced model is that of the base, but for the permuted mesh
  tolerance  the slap by models of two kernels of BLAS at several tolerances: how far rounding grows, and what the integrator's error is

Each row has the largest differences from the base: the programs of --build with one thread. `--bin clang=build/clang/bin` adds the programs of another
build. Needs the samples' meshes (slap: `make -C samples/truck_diesel models`; drive: `make -C samples/timing_drive models`). Numbers are kept in
--folder, where an interrupted bench goes on. Half an hour of processor time, of which the beam takes a minute.
"""
import argparse
import re
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import stability_beam as beam
import stability_engines as engines
from page import markdown, write
from stability_beam import Variant

ROOT = Path(__file__).resolve().parent.parent
KERNELS = ("Haswell", "Zen", "Nehalem", "Prescott")
BASE = Variant("base")
TOLERANCES = (5e-4, 1e-4, 2e-5)  # of the slap, falling; the sample has the first
OTHER_KERNEL = "Haswell"


def builds(options):
    return [Variant(f"programs built by {name}", bin=Path(path).resolve()) for name, path in (word.split("=", 1) for word in options.bin)]


def variants(table, options):
    if table == "beam":
        return [*beam.threads(), *beam.motions(), *beam.units(), *beam.scales(), *map(beam.kernel, KERNELS), beam.reference_blas(), *builds(options)]
    few = [beam.threads()[0], beam.motions()[0], beam.kernel(OTHER_KERNEL), *builds(options)]
    return [*few, beam.threads()[1], beam.kernel(KERNELS[-1])] if table == "drive" else few  # old kernels take minutes to condense


def folder_of(options, table, variant):
    return options.folder / table / re.sub(r"[^a-z0-9]+", "_", variant.name.lower())


def numbers_of(options, table, variant):
    """The numbers of a variant: those that are kept, or of a new run; None, with a message, when a program fails."""
    folder = folder_of(options, table, variant)
    kept = folder / "numbers.npz"
    if not kept.exists():
        try:
            found = run(options, table, variant, folder)
        except beam.Failed as failure:
            print(f"{table}, {variant.name}: {failure}", file=sys.stderr, flush=True)
            return None
        np.savez(kept, **found)
        print(f"{table}, {variant.name}: done", file=sys.stderr, flush=True)
    with np.load(kept) as file:
        return dict(file)


def run(options, table, variant, folder):
    if table == "beam":
        changed = variant.permuted or variant.motion or variant.units
        return beam.run_beam(folder, options.binaries, variant, folder_of(options, table, BASE) / "beam.mesh.h5" if changed else None)
    if table == "slap":
        return engines.run_slap(folder, options.binaries, variant)
    own_model = variant is BASE or variant.permuted
    return engines.run_drive(folder, options.binaries, variant, model_folder=None if own_model else folder_of(options, table, BASE))


def count(value):
    return "0" if value == 0 else f"{value:.1e}".replace("e-0", "e-")


def same_bits(found, base, names):
    """Artefacts whose numbers have the same bits; the last ones of `names` when there are fewer."""
    same = [name for name, a, b in zip(names[-len(found["bits"]):], found["bits"], base["bits"][-len(found["bits"]):]) if a == b]
    return "all" if len(same) == len(found["bits"]) else ", ".join(same) or "none"


def table_of(options, table):
    base = numbers_of(options, table, BASE)
    if base is None:
        sys.exit("bench: the base failed")
    chosen = variants(table, options)
    with ThreadPoolExecutor(options.jobs) as lanes:
        results = list(lanes.map(lambda variant: numbers_of(options, table, variant), chosen))
    make_row, head = {"beam": (beam_row, BEAM_HEAD), "slap": (slap_row, SLAP_HEAD), "drive": (drive_row, DRIVE_HEAD)}[table]
    return markdown(head, [[variant.name, *make_row(found, base)] for variant, found in zip(chosen, results) if found])


BEAM_HEAD = ["beam: largest difference from the base", "same to the bit", "mass, centre, inertia", "six frequencies", "frequencies of the reduced model",
             "counts and proofs", "static displacement", "response at four frequencies", "displacement after the step", "energy residue (absolute)",
             "ERP", "third octaves [dB]"]


def beam_row(found, base):
    by = beam.beam_differences(found, base)
    return [same_bits(found, base, beam.ARTEFACTS), count(by["mass"]), count(by["full_hz"]), count(by["reduced_hz"]), "same" if by["counts"] else "other",
            count(by["static"]), count(by["response"]), count(by["tip"]), count(by["residue"]), count(by["erp"]), count(by["bands_db"])]


SLAP_HEAD = ["slap: largest difference from the base", "same to the bit", "mass, inertia", "frequencies of the reduced models", "counts and proofs",
             "steps", "lateral position [um]", "instant of the slap [us]", "its height", "third octaves [dB]", "ERP [dB(A)]", "energy residue (absolute)"]
SLAP_ARTEFACTS = ("block.fe", "block.rom", "piston.fe", "piston.rom", "run", "field")


def steps(found, base):
    return f"{found['steps'][0] - base['steps'][0]:+.0f} of {base['steps'][0]:.0f}"


def slap_row(found, base):
    models, by = engines.model_differences(found, base, ("block", "piston")), engines.slap_differences(found, base)
    return [same_bits(found, base, SLAP_ARTEFACTS), count(models["mass"]), count(models["reduced_hz"]), "same" if models["counts"] else "other",
            steps(found, base), count(by["lateral_um"]), count(by["instant_us"]), count(by["height"]), count(by["bands_db"]), count(by["erp_db"]),
            count(by["residue"])]


DRIVE_HEAD = ["timing drive: largest difference from the base", "same to the bit", "frequencies of the reduced model", "steps", "speed of the intake, of its range",
              "largest tension, of its range", "its peak", "plunger, of its range", "ERP [dB(A)]", "energy residue (absolute)"]
DRIVE_ARTEFACTS = ("block.fe", "block.rom", "run", "field")


def drive_row(found, base):
    by = engines.drive_differences(found, base)
    hz = count(engines.model_differences(found, base, ("block",))["reduced_hz"]) if "block_mass" in found else "that of the base"
    return [same_bits(found, base, DRIVE_ARTEFACTS), hz, steps(found, base), *(count(by[name]) for name in ("speed", "tension", "peak", "plunger", "erp_db", "residue"))]


def tolerance_table(options):
    """The slap at several tolerances by the models of two variants of the table `slap`."""
    pair = (BASE, beam.kernel(OTHER_KERNEL))
    for variant in pair:
        if numbers_of(options, "slap", variant) is None:
            sys.exit("bench: the models of the slap failed")

    def at(job):
        variant, tolerance = job
        folder = folder_of(options, f"tolerance/{tolerance:g}", variant)
        if not (folder / "numbers.npz").exists():
            found = engines.run_slap(folder, options.binaries, variant, tolerance, model_folder=folder_of(options, "slap", variant))
            np.savez(folder / "numbers.npz", **found)
        with np.load(folder / "numbers.npz") as file:
            return dict(file)

    jobs = [(variant, tolerance) for tolerance in TOLERANCES for variant in pair]
    with ThreadPoolExecutor(options.jobs) as lanes:
        found = list(lanes.map(at, jobs))
    finest, rows = found[-2], []  # of the base at the last tolerance
    for tolerance, one, other in zip(TOLERANCES, found[::2], found[1::2]):
        rounding, error = engines.slap_differences(other, one), engines.slap_differences(one, finest)
        rows.append([f"{tolerance:g}", f"{one['steps'][0]:.0f}, {other['steps'][0]:.0f}", count(rounding["lateral_um"]), count(error["lateral_um"]),
                     count(rounding["height"]), count(error["height"]), count(rounding["bands_db"]), count(error["bands_db"])])
    head = ["tolerance of a step", "steps", "lateral position [um]: between the kernels", "from the finest tolerance", "height of the slap: between the kernels",
            "from the finest", "third octaves [dB]: between the kernels", "from the finest"]
    return markdown(head, rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tables", nargs="+", default=["beam", "slap", "drive", "tolerance"], choices=["beam", "slap", "drive", "tolerance"])
    parser.add_argument("--folder", type=Path, default=Path(tempfile.gettempdir()) / "clatter-stability", help="numbers and artefacts are kept there (5 GB)")
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("--bin", nargs="+", default=[], metavar="NAME=DIR", help="programs of other builds")
    parser.add_argument("--jobs", type=int, default=1, help="variants that run beside each other")
    parser.add_argument("--write", action="store_true", help="put the tables into docs/accuracy.md")
    options = parser.parse_args()
    options.binaries, options.folder = options.build.resolve() / "bin", options.folder.resolve()
    for name in options.tables:
        lines = tolerance_table(options) if name == "tolerance" else table_of(options, name)
        print("\n".join(lines), flush=True)
        if options.write:
            write(f"stability_{name}", lines)


if __name__ == "__main__":
    main()
