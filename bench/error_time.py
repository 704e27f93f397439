#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against time: the free truck-diesel block condensed with an increasing number of modes, and with its interface reduced.

Rows: Guyan; fixed-interface modes alone (--counts); the same with residual modes (--residual, and the sample's own
setting); the sample's setting with the patches of liner 4 reduced to interface modes (--interface). Of each: reduced
coordinates, seconds, processor seconds and peak memory of clatter-condense, and against the full model below --limit:

  frequency error  the largest of an elastic frequency of the free block
  FRF error        of the normal velocity at the centres of all outer faces, for a unit force on a patch of liner 4 (thrust
                   side) or on main bearing 4 (upwards): sqrt(integral |v - v_full|^2 / integral |v_full|^2) over area and Hz
  dB               the largest difference of a third octave of their mean square, force of white spectrum

The full model's response is superposed from its modes up to --reference-hz (clatter-modal, count proved); the contribution
of the others comes from solves with SciPy's sparse LU (frequency_response.left_out). Stiffness (1 + 0.02 i) K in both, that is 1 %
of critical at every resonance. The reference's own error is measured too: by omitting its modes above two thirds of that frequency, and
by the residual of the equation of motion.

Finished results stay in --folder and are reused by the next call; seconds are the least of all runs (--runs, --again).
"""
import argparse
import json
import resource
import sys
import tempfile
import tomllib
from pathlib import Path

import h5py
import numpy as np
import scipy.linalg
import scipy.sparse.linalg as sparse_linalg

import block
import error_time_figure
import frequency_response as frf
from full_model import FullModel
from measured import apart, run
from methods import names, sparse_of
from page import markdown, write

ROOT = Path(__file__).resolve().parent.parent
LOSS_FACTOR = 0.02
FROM_HZ, STEP = 50.0, 0.0025  # an eighth of a resonance's half-power width
CHECKED_HZ = (200.0, 1100.0, 2900.0)
PATCH = (0.0, 0.275)  # angle from the thrust side, height: where the skirt strikes


def grid(limit):
    return np.geomspace(FROM_HZ, limit, 1 + int(np.ceil(np.log(limit / FROM_HZ) / STEP)))


def force_rows(model):
    """Rows of the sets liner_4 and bearing_4 on which the forces act."""
    angle, height = (model[f"grids/liner_4/{name}"][()] for name in ("angle", "axial"))
    patch = np.abs(angle - PATCH[0]).argmin() * len(height) + np.abs(height - PATCH[1]).argmin()
    bearing = model["sets/bearing_4"]
    upwards = np.flatnonzero((bearing["is_rotation"][()] == 0) & (bearing["direction"][()][:, 2] == 1.0))[0]
    return [("liner_4", patch), ("bearing_4", upwards)]


def force_vectors(model, size):
    """Unit forces [N] as columns: on a coordinate, or on a displacement that interface modes reduce."""
    columns = []
    for name, row in force_rows(model):
        dof = model[f"sets/{name}/dofs"][row]
        columns.append(np.eye(1, size, dof)[0] if dof < size else model["combined"][dof - size])
    return np.column_stack(columns)


def outer_faces(fe):
    return fe["surfaces/outer/tri6"][()].astype(np.int64)


# The full model.

def make_reference(folder, options):
    """reference.npz: frequencies of the elastic modes below the limit, velocities for each force, own errors."""
    with h5py.File(folder / "block.fe.h5") as fe:
        K, M, T = (sparse_of(fe[name]) for name in "KMT")
        forces = force_vectors(fe, K.shape[0])
        outer = frf.normal_motion(fe["nodes"][()], outer_faces(fe)) @ T
    with h5py.File(folder / "block.modes.h5") as file:
        eigenvalues, rigid, own = file["eigenvalue"][()], file.attrs["rigid_modes"], file["frequency_hz"][()]
        nodal = file["shapes"][()].reshape(len(own), -1)
    shapes = sparse_linalg.splu(T).solve(nodal.T.astype(float)).T.copy()
    del nodal
    full = FullModel(outer, shapes, eigenvalues, K, M, -0.1 * eigenvalues[rigid], LOSS_FACTOR)
    hz = grid(options.limit)
    found, changes, residuals = [], [], []
    fewer = int(np.searchsorted(own, own[-1] * 2 / 3))
    for force in forces.T:
        found.append(2j * np.pi * hz * full.response(force, hz))
        changes.append(frf.relative_difference(2j * np.pi * hz * full.response(force, hz, fewer), found[-1], hz))
        residuals += [full.residual(force, at) for at in CHECKED_HZ]
    below = own[rigid:][own[rigid:] < options.limit]
    np.savez(folder / "reference.npz", hz=hz, own=below, rigid=rigid, modes=len(own), last=own[-1], velocities=found,
             change=max(changes), fewer=own[fewer - 1], residual=max(residuals))


# The reduced models.

def rows_of(options):
    """(key, series, what, lines of the .rom.toml in addition to the sample's boundary and skin)"""
    sample = tomllib.loads((block.SAMPLE / "block.rom.toml").read_text())
    as_sample = f"fmax_hz = {sample['fmax_hz']}\n"
    return ([("guyan", "guyan", "guyan", 'method = "guyan"\n')]
            + [(f"fixed_{n}", "fixed", f"{n} fixed-interface modes", f"count = {n}\nfrequency_error = 0.0\n")
               for n in options.counts]
            + [(f"residual_{n}", "residual", f"{n}, with residual modes", f"count = {n}\n") for n in options.residual]
            + [("sample", "residual", f"**to {sample['fmax_hz']:g} Hz, with residual modes** (the sample)", as_sample)]
            + [(f"interface_{n}", "interface", f"the sample, {n} interface modes of liner 4",
                f'{as_sample}[interface]\nsets = ["liner_4"]\nmodes = {n}\n') for n in options.interface])


def condense(folder, options, text):
    """block.rom.h5; the least seconds of the runs, the least of their processor seconds, peak GB."""
    sample = tomllib.loads((block.SAMPLE / "block.rom.toml").read_text())
    (folder / "block.rom.toml").write_text(f"boundary = {names(sample['boundary'])}\nskin = {names(sample['skin'])}\n{text}")
    command = [options.build.resolve() / "bin/clatter-condense", "block.fe.h5", "-c", "block.rom.toml", "-o", "block.rom.h5",
               "--quiet"]
    costs = []
    for _ in range(options.runs):
        before = processor_seconds()
        _, seconds, megabytes = run(command, folder)
        costs.append({"seconds": seconds, "processor_seconds": processor_seconds() - before, "gigabytes": megabytes / 1e3})
    return least(costs)


def least(costs):
    """On a shared machine the least is nearest to the cost of the work itself."""
    return {name: (max if name == "gigabytes" else min)(cost[name] for cost in costs) for name in costs[0]}


def processor_seconds():
    """Of all processes that have ended: hardly affected by other load and pauses of the machine."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def evaluate(folder, result):
    """Adds the errors of block.rom.h5 to the result and writes <key>.json."""
    reference = np.load(folder / "reference.npz")
    hz, own, rigid = reference["hz"], reference["own"], int(reference["rigid"])
    with h5py.File(folder / "block.fe.h5") as fe:
        nodes, faces = fe["nodes"][()], outer_faces(fe)
    with h5py.File(folder / "block.rom.h5") as rom:
        K, M = rom["K_rr"][()], rom["M_rr"][()]
        forces = force_vectors(rom, len(K))
        row = {tuple(node): k for k, node in enumerate(rom["skin/nodes"][()])}
        kept = np.array([row[tuple(node)] for node in nodes[faces].reshape(-1, 3)]).reshape(faces.shape)
        outer = frf.normal_motion(rom["skin/nodes"][()], kept) @ rom["skin/T"][()]
    eigenvalues, shapes = scipy.linalg.eigh(K, M)
    # By number: a reduced model misses no mode, and none of its modes is lower than that of the full one.
    frequencies = np.sqrt(np.maximum(eigenvalues, 0.0))[rigid:rigid + len(own)] / (2 * np.pi)
    eigenvalues[:rigid] = 0.0
    errors, levels = [], []
    for force, full in zip(forces.T, reference["velocities"]):
        found = 2j * np.pi * hz * frf.superposed(outer @ shapes, eigenvalues, shapes.T @ force, hz, LOSS_FACTOR)
        errors.append(frf.relative_difference(found, full, hz))
        levels.append(float(np.abs(frf.band_levels(found, hz) - frf.band_levels(full, hz)).max()))
    result |= {"coordinates": len(K), "frequency_error": float(np.abs(frequencies / own - 1).max()), "frf_error": errors,
               "decibels": max(levels)}
    (folder / f"{result['key']}.json").write_text(json.dumps(result))


def measure(folder, options):
    """Results by series and size; those already in the folder are measured again only with --again."""
    for key, series, what, text in rows_of(options):
        path = folder / f"{key}.json"
        if path.exists() and not options.again:
            continue
        print(f"bench: {what}", file=sys.stderr, flush=True)
        cost = condense(folder, options, text)
        if path.exists():
            before = json.loads(path.read_text())
            cost = least([cost, {name: before[name] for name in cost}])
        apart(evaluate, folder, {"key": key, "series": series, "what": what, **cost})
    results = [json.loads((folder / f"{row[0]}.json").read_text()) for row in rows_of(options)]
    series = list(error_time_figure.SERIES)
    return sorted(results, key=lambda result: (series.index(result["series"]), result["coordinates"]))


def prepare(folder, options):
    """Matrices, modes and reference of the full model, unless they are in the folder."""
    binaries = options.build.resolve() / "bin"
    if not (folder / "block.fe.h5").exists():
        block.make_mesh(folder, binaries, options.size_mm)
        block.assemble(folder, binaries, (block.SAMPLE / "block.fe.toml").read_text())
    if not (folder / "block.modes.h5").exists():
        run([binaries / "clatter-modal", "block.fe.h5", "--fmax-hz", str(options.reference_hz), "-o", "block.modes.h5",
             "--quiet"], folder)
    if not (folder / "reference.npz").exists():
        apart(make_reference, folder, options)


def table(results, folder, options):
    with h5py.File(folder / "block.fe.h5") as fe:
        size = fe["K"].attrs["shape"][0]
    full = np.load(folder / "reference.npz")
    unit = next(result["processor_seconds"] for result in results if result["key"] == "sample")
    rows = [[r["what"], str(r["coordinates"]), f"{r['seconds']:.0f}", f"{r['processor_seconds']:.0f}",
             f"{r['processor_seconds'] / unit:.2f}", f"{r['gigabytes']:.2f}",
             f"{r['frequency_error']:.1e}", *[f"{error:.1e}" for error in r["frf_error"]], f"{r['decibels']:.2g}"]
            for r in results]
    return [f"{size} DoF, {len(full['own'])} elastic modes below {options.limit:g} Hz. Reference: {full['modes']} modes to "
            f"{full['last']:.0f} Hz and the static response of the others; without those above {full['fewer']:.0f} Hz its FRFs "
            f"change by {full['change']:.0e}, and the equation of motion holds to {full['residual']:.0e} at "
            f"{', '.join(f'{at:g}' for at in CHECKED_HZ)} Hz.", ""] + markdown(
        ["modes", "coordinates", "seconds", "processor seconds", "of the sample's", "peak GB", "frequency error",
         "FRF error, force on liner 4", "on bearing 4", "third octaves [dB]"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--counts", type=int, nargs="*", default=[10, 20, 50, 100, 200, 500], help="fixed-interface modes")
    parser.add_argument("--residual", type=int, nargs="*", default=[50, 100, 300], help="the same, with residual modes")
    parser.add_argument("--interface", type=int, nargs="*", default=[10, 20, 40, 80], help="interface modes of liner 4")
    parser.add_argument("--limit", type=float, default=3000.0, help="errors are evaluated below this frequency [Hz]")
    parser.add_argument("--reference-hz", type=float, default=9000.0, help="modes of the reference [Hz]")
    parser.add_argument("--size-mm", type=float, help="of the elements (default: the sample's 30)")
    parser.add_argument("--runs", type=int, default=1, help="runs of each row; the least seconds count")
    parser.add_argument("--again", action="store_true", help="measure rows that are in --folder again: the least counts")
    parser.add_argument("--folder", type=Path, help="keep all files there (default: a temporary folder)")
    parser.add_argument("--build", default=ROOT / "build/release", type=Path)
    parser.add_argument("--write", action="store_true", help="table into docs/accuracy.md, picture docs/error_time.png")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="clatter-bench-") as scratch:
        folder = (options.folder or Path(scratch)).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        prepare(folder, options)
        results = measure(folder, options)
        lines = table(results, folder, options)
        print("\n".join(lines))
        if options.folder:
            error_time_figure.draw(results, options.limit, folder / "error_time.png")
        if options.write:
            write("error_time", lines)
            error_time_figure.draw(results, options.limit, ROOT / "docs/error_time.png")


if __name__ == "__main__":
    main()
