#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What accuracy costs in piston slap: step tolerance, film grid and elastic effects against seconds.

Runs samples/truck_diesel/slap_10um.run.toml (its reduced models must exist: make demo) repeatedly, changes one
setting at a time, and compares each run with the finest of its table: the piston's position, the liner's acceleration
(above 300 Hz, without the block's shaking on its mounts). Two cycles per run, so that a table takes minutes; seconds
are those of the time stepping, as measured by clatter-dynamics.

--tables modes: the block condensed to lower and higher frequencies.
--tables large: the full sample at engine size, one and four pistons (slap_large.py). Its models take 10 GB, disk of 2 GB and
minutes; with --folder they are kept and made only once. One cycle per run.
"""
import argparse
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

ROOT = Path(__file__).resolve().parent.parent
SAMPLE = ROOT / "samples" / "truck_diesel"
sys.path.insert(0, str(ROOT / "tools"))
from clatter_tools import slap  # noqa: E402
from clatter import fields  # noqa: E402

import slap_large  # noqa: E402

AT = "analysis/cycle"
TOLERANCES = [2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5]
INEXACT_TOLERANCES = [1e-3, 5e-4, 2e-4, 1e-4, 5e-5]
GRIDS = [(10, 16), (10, 24), (10, 36), (10, 48), (6, 64), (10, 64), (20, 64), (10, 96), (10, 128), (10, 192)]
OIL_LAWS = """[contact.oil]
law = "walther"
walther_temperature_c = [40.0, 100.0]
walther_mm2_s = [108.0, 14.5]
density_kg_m3 = 860.0
height_mm = [100.0, 311.0]
temperature_c = [95.0, 115.0]
pressure_coefficient_1_gpa = 18.0
shear_rate_1_s = 1.0e6
shear_ratio = 0.6
"""
EFFECTS = {
    "rigid piston, rigid liner": '[piston]\nmodel = "rigid"\n[block]\nmodel = "rigid"\n',
    "rigid piston": '[piston]\nmodel = "rigid"\n',
    "no oil film": '[contact]\nlubrication = "none"\n',
    "no cavitation": "[contact]\ncavitation = false\n",
    "no friction": "[contact]\nfriction = false\n",
    "and oil remembered on the liner": slap_large.LINER_OIL,
    "and laws of the oil": OIL_LAWS,
    "shapes of full load": slap_large.shapes(10.0, SAMPLE),
    "all": "",
}


CUT_OFFS_HZ = [3000, 4500, 6000, 10000, 15000]  # of the modes of the block; frequencies hold to half of it
SLAP_TO_HZ = 3000.0  # up to which the sample's frequencies hold
BANDS_HZ = {"500 Hz to 3.2 kHz": (450, 3600), "4 and 5 kHz": (3600, 5600)}
LARGE_TOLERANCES = [2e-3, 1e-3, 5e-4]


def scene(folder, name, changes, base):
    """A scene that changes a few lines of another one."""
    text = f'base = "{base}"\ntitle = "{name}"\n'
    if "[time]" not in changes:
        text += "[time]\ncycles = 2\n"
    path = folder / f"{name}.run.toml"
    path.write_text(text + changes)
    return path


def simulate(folder, binaries, name, changes, recovered=True, base=SAMPLE / "slap_10um.run.toml", to_hz=None):
    """Runs one scene; its numbers as a dict. `to_hz`: of the acceleration; without it as far as the reduced models hold."""
    path = scene(folder, name, changes, base)
    run = folder / f"{name}.run.h5"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    call([binaries / "clatter-dynamics", path, "-o", run, "--quiet"])
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = {"name": name, "processor": after.ru_utime - before.ru_utime}
    with h5py.File(run) as file:
        result["steps"] = int(file["statistics"].attrs["accepted"])
        result["seconds"] = float(file["statistics"].attrs["total_seconds"])
        angle = file["history/crank_angle_deg"][()]
        lateral = file["history/piston_lateral" if "history/piston_lateral" in file else "history/c4_piston_lateral"][()]
        result["lateral"] = np.interp(np.linspace(angle[-1] - 719.0, angle[-1], 7200), angle, lateral)
    if recovered:
        field = folder / f"{name}.field.h5"
        call([binaries / "clatter-recover", run, "-c", field_settings(folder), "-o", field, "--quiet"])
        with h5py.File(field) as file:
            sensor = fields.pick_sensor(file, AT, "liner")
            result["time"], result["values"] = slap.band_limited(file, sensor, AT, to_hz=to_hz)
            result["bands"], _ = fields.acceleration_bands(file, sensor)
            mid = file[f"{AT}/third_octave/mid_hz"][()]
            result["mid_hz"], result["bands_compared"] = mid, (mid > 450) & (mid < 4500)
        field.unlink()
    run.unlink()
    return result


def field_settings(folder):
    """The sample's output without what needs the sound of its block, which is of one reduced model."""
    path = folder / "plain.field.toml"
    text = (SAMPLE / "field.toml").read_text()
    path.write_text(re.sub(r"(?m)^sound = .*$|^\[lines\]\nstrongest = .*$", "", text))
    return path


def reduced_block(folder, binaries, cut_off):
    """The sample's block with modes up to `cut_off` [Hz]; the lines of a scene that uses it."""
    text = (SAMPLE / "block.rom.toml").read_text()
    settings, rom = folder / f"block{cut_off}.rom.toml", folder / f"block{cut_off}.rom.h5"
    settings.write_text(re.sub(r"(?m)^fmax_hz = .*$", f"fmax_hz = {cut_off}", text))
    call([binaries / "clatter-condense", SAMPLE / "block.fe.h5", "-c", settings, "-o", rom, "--quiet"])
    return f'[block]\nrom = "{rom}"\n'


def print_modes(results):
    """Slap up to SLAP_TO_HZ and largest difference of the third octaves from the last result, by range."""
    print(f"\nmodes of the block, Hz       slap [m/s2] {' '.join(f'{name:>20s} [dB]' for name in BANDS_HZ)}")
    finest = results[-1]
    for result in results:
        cells = [f"{result['name']:28s}", f"{slap.peak(result['time'], result['values'])[1]:11.1f}"]
        for low, high in BANDS_HZ.values():
            at = (result["mid_hz"] > low) & (result["mid_hz"] < high)
            known = min(len(result["bands"]), len(finest["bands"]))  # fewer modes hold to lower bands
            at = at[:known]
            cells.append(f"{np.abs(result['bands'][:known] - finest['bands'][:known])[at].max() if at.any() else np.nan:25.2f}")
        print(" ".join(cells), flush=True)


def call(command, folder=None):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=folder)
    if done.returncode:
        sys.exit(f"bench: {done.stderr.strip()}")


def print_row(result, finest):
    shift = np.abs(result["lateral"] - finest["lateral"]).max() * 1e6
    cells = [f"{result['name']:28s}", f"{result['steps']:7d}", f"{result['seconds']:8.1f}", f"{result['processor']:9.1f}",
             f"{shift:12.3f}"]
    if "values" in result:
        when, height = slap.peak(result["time"], result["values"])
        cells += [f"{when * 1e3:9.3f}", f"{height:9.1f}"]
        if "values" in finest:
            levels = np.abs(result["bands"] - finest["bands"])[result["bands_compared"]].max()
            cells += [f"{levels:10.2f}"]
    print(" ".join(cells), flush=True)


def table(title, results, finest=None):
    """Prints the results relative to `finest`, or to the last one."""
    print(f"\n{title}\n{'':28s} {'steps':>7s} {'seconds':>8s} {'processor':>9s} {'lateral [um]':>12s} {'slap [ms]':>9s} {'[m/s2]':>9s} "
          f"{'bands [dB]':>10s}")
    for result in results:
        print_row(result, finest or results[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build" / "release" / "bin")
    parser.add_argument("--tables", nargs="+", choices=["tolerance", "grid", "effects", "modes", "large"],
                        default=["tolerance", "grid", "effects"])
    parser.add_argument("--folder", type=Path, help="of the large models, which are kept there; without it they are made anew")
    parser.add_argument("--pistons", type=int, nargs="+", choices=[1, 4], default=[1], help="of the large table")
    options = parser.parse_args()
    for part in ("block", "piston"):
        if not (SAMPLE / f"{part}.rom.h5").exists():
            sys.exit(f"bench: {SAMPLE / part}.rom.h5 is missing: make demo")
    print("differences are from the last row of each table: of the piston's lateral position, and the largest of the "
          "liner's\nthird octaves from 500 Hz to 4 kHz; slap: instant and height of the liner's acceleration")
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)

        def runs(names_and_changes, **more):
            return [simulate(folder, options.bin, name, changes, **more) for name, changes in names_and_changes]

        def tolerances(values, changes="", **more):
            return runs(((f"tolerance {value:g}", f"[accuracy]\ntolerance = {value:g}\n{changes}") for value in values), **more)

        if "tolerance" in options.tables:
            exact = tolerances(TOLERANCES)
            table("step tolerance", exact)
            table("step tolerance, free modes as the method moves them, against the last row above",
                  tolerances(INEXACT_TOLERANCES, "[time]\ncycles = 2\nexact_modes = false\n"), exact[-1])
        if "grid" in options.tables:
            table("film grid, cells around x along",
                  runs((f"grid {a} x {b}", f"[contact]\ncells_around = {a}\ncells_along = {b}\n") for a, b in GRIDS))
        if "effects" in options.tables:
            print("\neffects: cost of each (rigid liner: no block to recover)")
            results = runs(EFFECTS.items(), recovered=False)
            for result in results:
                print_row(result, results[-1])
        if "modes" in options.tables:
            print_modes(runs(((f"{hz}", reduced_block(folder, options.bin, hz)) for hz in CUT_OFFS_HZ), to_hz=SLAP_TO_HZ))
        if "large" in options.tables:
            kept = options.folder or folder
            kept.mkdir(parents=True, exist_ok=True)
            for pistons in options.pistons:
                base = slap_large.scene(kept.resolve(), options.bin, pistons)
                table(f"{pistons} piston(s), 600 patches and 300 modes in total, 1536 film cells a piston, mixed lubrication",
                      tolerances(LARGE_TOLERANCES, "[time]\ncycles = 1\n", recovered=False, base=base))


if __name__ == "__main__":
    main()
