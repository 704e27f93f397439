# SPDX-License-Identifier: GPL-3.0-or-later
"""Piston slap of samples/truck_diesel and the timing drive of samples/timing_drive in variants that must not change their physics.

Reduced models are made again by each variant from the samples' meshes, as the sample's recipes say; the warm shapes of liner and skirt are those
of the sample."""
import re
import shutil
import sys
from pathlib import Path

import h5py
import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from clatter_tools import slap  # noqa: E402
from clatter import fields  # noqa: E402

import stability_models as models  # noqa: E402
import stability_numbers as numbers  # noqa: E402

TRUCK, DRIVE = ROOT / "samples" / "truck_diesel", ROOT / "samples" / "timing_drive"
AT = "analysis/cycle"
COMPARED_HZ = (450.0, 4500.0)  # third octaves of the liner, from 500 Hz to 4 kHz


def make(folder, binaries, variant, stage, source, settings, output):
    """Runs a stage unless its output is there: programs write complete files only."""
    if not (folder / output).exists():
        variant.stage(folder, binaries, stage, source, *(("-c", settings) if settings else ()), "-o", output)


def reduced(folder, binaries, variant, sample, part):
    """Makes part.fe.h5 and part.rom.h5 of a sample's mesh in the folder."""
    shutil.copy(sample / f"{part}.mesh.h5", folder / f"{part}.mesh.h5")
    if variant.permuted:
        models.permute(folder / f"{part}.mesh.h5")
    make(folder, binaries, variant, "assembly", f"{part}.mesh.h5", sample / f"{part}.fe.toml", f"{part}.fe.h5")
    make(folder, binaries, variant, "condense", f"{part}.fe.h5", sample / f"{part}.rom.toml", f"{part}.rom.h5")


def field(folder, binaries, variant, run):
    """Recovers the block's spectra of a run; path of the field."""
    (folder / "plain.field.toml").write_text('body = "block"\n')
    make(folder, binaries, variant, "recover", run, "plain.field.toml", "block.field.h5")
    return folder / "block.field.h5"


def model_numbers(folder, parts):
    """Mass, frequencies and counts of reduced models, and the digests of their files."""
    found, bits = {}, []
    for part in parts:
        of_part = {**numbers.mass_numbers(folder / f"{part}.fe.h5"), **numbers.reduced_numbers(folder / f"{part}.rom.h5")}
        found.update({f"{part}_{name}": value for name, value in of_part.items()})
        bits += [numbers.digest(folder / f"{part}.{kind}.h5") for kind in ("fe", "rom")]
    return {**found, "bits": np.array(bits)}


def model_differences(found, base, parts):
    worst = {"mass": 0.0, "reduced_hz": 0.0, "counts": True}
    for part in parts:
        worst["mass"] = max(worst["mass"], numbers.relative(found[f"{part}_mass"], base[f"{part}_mass"]),
                            numbers.largest(found[f"{part}_inertia"], base[f"{part}_inertia"]))
        worst["reduced_hz"] = max(worst["reduced_hz"], numbers.relative(found[f"{part}_reduced_hz"], base[f"{part}_reduced_hz"]))
        worst["counts"] &= bool(np.array_equal(found[f"{part}_counts"], base[f"{part}_counts"]))
    return worst


def run_slap(folder, binaries, variant, tolerance=None, cycles=1, model_folder=None):
    """One cycle of slap.run.toml with the models of `model_folder` (default: made in the folder)."""
    folder.mkdir(parents=True, exist_ok=True)
    found = {"bits": np.array([], str)}
    if model_folder is None:
        model_folder = folder
        for part in ("block", "piston"):
            reduced(folder, binaries, variant, TRUCK, part)
        found = model_numbers(folder, ("block", "piston"))
    accuracy = "" if tolerance is None else f"[accuracy]\ntolerance = {tolerance}\n"
    (folder / "slap.run.toml").write_text(f'base = "{TRUCK / "slap.run.toml"}"\n[time]\ncycles = {cycles}\n{accuracy}'
                                          f'[piston]\nrom = "{model_folder / "piston.rom.h5"}"\n[block]\nrom = "{model_folder / "block.rom.h5"}"\n')
    make(folder, binaries, variant, "dynamics", "slap.run.toml", None, "slap.run.h5")
    path = field(folder, binaries, variant, "slap.run.h5")
    with h5py.File(folder / "slap.run.h5") as run:
        angle, lateral = run["history/crank_angle_deg"][()], run["history/piston_lateral"][()]
    found["lateral"] = np.interp(np.linspace(-359.0, 359.0, 7181), angle, lateral)
    with h5py.File(path) as file:
        sensor = fields.pick_sensor(file, AT, "liner")
        found["slap"] = np.array(slap.peak(*slap.band_limited(file, sensor, AT)))
        mid, levels = file[f"{AT}/third_octave/mid_hz"][()], fields.acceleration_bands(file, sensor)[0]
        among = (mid > COMPARED_HZ[0]) & (mid < COMPARED_HZ[1])
        found["bands"] = np.column_stack([mid[among], levels[among]])
        found["erp"] = np.array([file[f"{AT}/panels/exposed"].attrs["erp_dba"]])
    found.update(numbers.energy_residue(folder / "slap.run.h5"))
    return with_bits(found, folder / "slap.run.h5", path)


def with_bits(found, run, field_path):
    found["bits"] = np.concatenate([found["bits"], [numbers.digest(run), numbers.digest(field_path)]])
    return found


def slap_differences(found, base):
    return {"lateral_um": numbers.absolute(found["lateral"], base["lateral"]) * 1e6,
            "instant_us": abs(found["slap"][0] - base["slap"][0]) * 1e6, "height": abs(found["slap"][1] / base["slap"][1] - 1),
            "bands_db": numbers.band_difference(found["bands"], base["bands"]), "erp_db": numbers.absolute(found["erp"], base["erp"]),
            "residue": numbers.absolute(found["residue"], base["residue"])}


def run_drive(folder, binaries, variant, tolerance=None, model_folder=None):
    """The timing drive from its equilibrium for a tenth of a second: three cycles, of which the last is recorded."""
    folder.mkdir(parents=True, exist_ok=True)
    found = {"bits": np.array([], str)}
    if model_folder is None:
        model_folder = folder
        reduced(folder, binaries, variant, DRIVE, "block")
        found = model_numbers(folder, ("block",))
    text = (DRIVE / "drive.run.toml").read_text().replace('rom = "block.rom.h5"', f'rom = "{model_folder / "block.rom.h5"}"')
    if tolerance is not None:
        text = re.sub(r"(?m)^tolerance = [\de.-]+", f"tolerance = {tolerance}", text)
    (folder / "drive.run.toml").write_text(text)
    make(folder, binaries, variant, "dynamics", "drive.run.toml", None, "drive.run.h5")
    path = field(folder, binaries, variant, "drive.run.h5")
    with h5py.File(folder / "drive.run.h5") as run:
        time, at = run["history/time"][()], np.linspace(*run["output/time"][()][[0, -1]], 2001)
        for name in ("chain_intake_speed", "chain_tension_max", "plunger_travel"):
            found[name] = np.interp(at, time, run[f"history/{name}"][()])
    with h5py.File(path) as file:
        found["erp"] = np.array([file[f"{AT}/panels/exposed"].attrs["erp_dba"]])
    found.update(numbers.energy_residue(folder / "drive.run.h5"))
    return with_bits(found, folder / "drive.run.h5", path)


def drive_differences(found, base):
    def of_range(name):
        return numbers.absolute(found[name], base[name]) / np.ptp(base[name])

    peak = np.abs(found["chain_tension_max"]).max() / np.abs(base["chain_tension_max"]).max()
    return {"speed": of_range("chain_intake_speed"), "tension": of_range("chain_tension_max"), "peak": abs(peak - 1),
            "plunger": of_range("plunger_travel"), "erp_db": numbers.absolute(found["erp"], base["erp"]),
            "residue": numbers.absolute(found["residue"], base["residue"])}
