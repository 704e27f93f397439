#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the truck diesel in docs/validation.md and samples/truck_diesel/README.md, each between <!-- truck NAME --> and the next <!-- end -->.

Takes what the targets of its Makefile have made, and makes what is missing: study-paper and study-parameters (ten minutes on two cores), speeds
(twenty), whole and study-whole (thirty). The means of dry cycles, the entire skirt with 10 um and the engine with other curves of the head gasket
have no targets: they are run each time (five minutes).
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy as np

from page import ROOT, markdown, write

sys.path.insert(0, str(ROOT / "python"))
from clatter import fields  # noqa: E402
from clatter_tools import parameters, slap, slaps  # noqa: E402

SAMPLE = ROOT / "samples" / "truck_diesel"
README, VALIDATION = SAMPLE / "README.md", ROOT / "docs" / "validation.md"
CYCLE, MEAN = "analysis/cycle", "analysis/mean"
# Of a slap: an acceleration that is higher than this is one [m/s2].
A_SLAP = 100.0
MEAN_SCENE = "[time]\ncycles = 10\nrecord_cycles = 8\noutput_step_us = 50.0\n"
MEAN_FIELD = f"""body = "block"
sound = "{SAMPLE}/block.sound.h5"
[frames]
on = false
[[window]]
name = "mean"
cycles = 8
"""
# Curves of the head gasket: (what they are, how far the rings stand above the body [um], factor of the body's pressure).
CURVES = [("as `engine_whole`: rings stand 91 um above the body", 91.0, 1.0), ("rings level with the body", 0.0, 1.0),
          ("rings 150 um above the body", 150.0, 1.0), ("body three times as stiff", 91.0, 3.0), ("a third as stiff", 91.0, 1.0 / 3.0)]


def make(target, jobs=2):
    subprocess.run(["make", "-C", SAMPLE, f"-j{jobs}", target], check=True, stdout=subprocess.DEVNULL)


def stage(name, *arguments):
    done = subprocess.run([Path(os.environ["CLATTER_BIN"]) / f"clatter-{name}", *arguments, "--quiet"], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(done.stderr)


def variant(folder, name, base, toml="", field=SAMPLE / "speeds.field.toml"):
    """The field of a scene over one of the sample."""
    scene, run, out = (folder / f"{name}.{end}" for end in ("run.toml", "run.h5", "field.h5"))
    scene.write_text(f'base = "{SAMPLE / base}.run.toml"\n{toml}')
    stage("dynamics", scene, "-o", run)
    stage("recover", run, "-c", field, "-o", out)
    return out


class Field:
    """What the tables need of a field file."""

    def __init__(self, path, at=CYCLE):
        self.at = at
        with h5py.File(path) as file:
            self.dba = file[f"{at}/sound"].attrs["power_dba"]
            self.erp_dba = file[f"{at}/panels/exposed"].attrs["erp_dba"] if f"{at}/panels/exposed" in file else np.nan
            self.error_db = file[f"{at}/sound"].attrs.get("power_standard_error_dba", np.nan)
            sensors = {part: fields.pick_sensor(file, at, part) for part in ("liner", "block")}
            self.bands = {part: fields.acceleration_bands(file, sensor)[0] for part, sensor in sensors.items()}
            self.mid_hz = file[f"{at}/third_octave/mid_hz"][()]
            if at == CYCLE:
                liner = slap.band_limited(file, sensors["liner"], at)
                self.when, self.peak = slap.peak(*liner)
                self.quiet = slap.rung_out(*liner)
                self.block_peak = slap.peak(*slap.band_limited(file, sensors["block"], at))[1]

    def octaves(self, part, low, high):
        return self.bands[part][(self.mid_hz > low) & (self.mid_hz < high)]


def paper(_):
    make("study-paper")
    rows = []
    for row in sorted(slaps.rows_of(SAMPLE / "paper_oil/sweep.h5") + slaps.rows_of(SAMPLE / "paper_dry/sweep.h5"), key=lambda row: row.dba):
        oil, clearance = (row.name if "_" in row.name else f"none_{row.name}").split("_")
        strong = "**" if (oil, clearance) == ("6", "10") else ""
        times = [f"{1e3 * row.slap[name]:.2f}" if row.slap["peak"] > A_SLAP else "" for name in ("time", "rings_until")]
        heights = [f"{row.slap[name]:.0f}" for name in ("peak", "block_peak", "high_rms")]
        rows.append([f"{strong}{oil}{strong}", f"{strong}{clearance}{strong}", f"{row.dba:.1f}", *times, *heights])
    return markdown(["layer of oil [um]", "clearance [um]", "sound power [dB(A) re 1 pW]", "slap [ms]", "rings until [ms]", "liner peak [m/s2]",
                     "block peak [m/s2]", "liner above 2 kHz, rms [m/s2]"], rows)


def influences(_):
    make("study-parameters")
    rows = []
    for one in slaps.influences(slaps.rows_of(SAMPLE / "parameters/sweep.h5"), parameters.read(SAMPLE / "parameters.toml")):
        cells = [f"{value:g}: {row.dba:.1f} / {row.slap['peak']:.0f}" for value, row in zip(one.values, one.rows)]
        rows.append([one.parameter.label(), "; ".join(f"**{cell}**" if row.name == parameters.BASE else cell for cell, row in zip(cells, one.rows))])
    return markdown(["parameter", "values: sound power [dB(A) re 1 pW] / liner peak [m/s2]"], rows)


def dry(folder):
    """Without oil cycles do not repeat: means of eight."""
    make("all")
    (folder / "mean.field.toml").write_text(MEAN_FIELD)
    rows = []
    for oil, scene in (("slap", "slap_dry"), ("slap_10um", "slap_dry_10um")):
        with_oil = Field(SAMPLE / f"{oil}.field.h5")
        mean = Field(variant(folder, scene, scene, MEAN_SCENE, folder / "mean.field.toml"), MEAN)
        more = [mean.octaves(part, 900, 4500) - with_oil.octaves(part, 900, 4500) for part in ("liner", "block")]
        high = np.sqrt(np.sum(10 ** (mean.octaves("liner", 2000, 9e9) / 10)) / np.sum(10 ** (with_oil.octaves("liner", 2000, 9e9) / 10)))
        rows.append([oil, f"{with_oil.dba:.1f}", f"{mean.dba:.1f} ± {mean.error_db:.2f}", *(f"{one.min():.1f} to {one.max():.1f}" for one in more),
                     f"{high:.1f}"])
    return markdown(["scene", "with oil [dB(A) re 1 pW]", "without, mean of eight cycles", "liner, third octaves from 1 to 4 kHz, more [dB]", "block",
                     "liner, rms of the bands from 2.5 kHz on, times"], rows)


def engine(_):
    """The slap in the block alone and in the whole engine."""
    make("all")
    make("whole")
    found = [Field(SAMPLE / f"{scene}.field.h5") for scene in ("slap_10um", "engine_whole")]
    more = [found[1].octaves(part, 560, 3500) - found[0].octaves(part, 560, 3500) for part in ("liner", "block")]
    return markdown(["10 um of clearance, oil film", "block alone", "block, head, oil pan and covers"],
                    [["liner, largest", *(f"{one.peak:.0f} m/s2, {1e3 * one.when:.2f} ms" for one in found)],
                     ["rings until [ms]", *(f"{1e3 * one.quiet:.2f}" for one in found)],
                     ["block, largest [m/s2]", *(f"{one.block_peak:.0f}" for one in found)],
                     ["third octaves from 630 Hz to 3.15 kHz against the block alone [dB]: liner; block", "",
                      "; ".join(f"{one.min():.1f} to {one.max():.1f}" for one in more)],
                     ["sound power [dB(A) re 1 pW]", *(f"{one.dba:.1f}" for one in found)]])


def skirt(folder):
    """One film around the entire skirt against two pads."""
    make("all")
    make("slap_whole.field.h5")
    whole = variant(folder, "whole", "slap_whole", "[contact]\nminimum_warm_clearance_um = 10.0\n")
    found = [Field(path) for path in (SAMPLE / "slap.field.h5", SAMPLE / "slap_whole.field.h5", SAMPLE / "slap_10um.field.h5", whole)]
    gaps = []
    for path in (SAMPLE / "slap.run.h5", SAMPLE / "slap_whole.run.h5", SAMPLE / "slap_10um.run.h5", folder / "whole.run.h5"):
        with h5py.File(path) as file:
            gaps.append(1e6 * file["history/film_min"][()].min())
    off = [abs(found[k + 1].octaves("liner", 300, 5700) - found[k].octaves("liner", 300, 5700)).max() for k in (0, 2)]
    return markdown(["", "two pads of 80 degrees", "entire skirt, cut away", "pads, 10 um", "entire skirt, 10 um"],
                    [["cells", "2 x 10 x 64", "44 x 64", "", ""],
                     ["peak of the liner [m/s2], after firing TDC [ms]", *(f"{one.peak:.0f}, {1e3 * one.when:.2f}" for one in found)],
                     ["smallest gap [um]", *(f"{gap:.2f}" for gap in gaps)], ["sound power [dB(A)]", *(f"{one.dba:.2f}" for one in found)],
                     ["third octaves of the liner against the pads, at most [dB]", "", f"{off[0]:.1f}", "", f"{off[1]:.1f}"]])


def rod(folder):
    """Models of the connecting rod, all with the mass properties of the meshed one."""
    make("all")
    make("rod")
    same = "mass_kg = 2.193\ncentre_mm = 63.0\n"
    models = {"rigid": f"{same}inertia_kg_m2 = 0.01812\n", "elastic": f'rom = "{SAMPLE}/rod.rom.h5"\n', "two-mass": same, "massless": ""}
    rows, rigid = [], None
    for model, keys in models.items():
        found = Field(variant(folder, model, "slap_10um", f'[rod]\nmodel = "{model}"\n{keys}'))
        rigid = rigid or found
        with h5py.File(folder / f"{model}.run.h5") as file:
            angle, lateral, force = (file[f"history/{name}"][()] for name in ("crank_angle_deg", "piston_lateral", "side_force"))
            residue = file["certificate"].attrs["energy_residue"]
        after = np.flatnonzero((angle[1:] > 0.0) & (lateral[1:] * lateral[:-1] < 0.0))[0]
        more = found.bands["liner"] - rigid.bands["liner"]
        low, high = ((found.mid_hz > a) & (found.mid_hz < b) for a, b in ((300, 1100), (1100, 3500)))
        rows.append([f"`{model}`", f"{angle[after + 1]:.1f} deg", f"{1e-3 * abs(force[(angle > 0.0) & (angle < 60.0)]).max():.2f} kN",
                     "" if found is rigid else "; ".join(f"{more[part].min():+.1f} to {more[part].max():+.1f} dB" for part in (low, high)),
                     f"{found.dba:.1f}", f"{residue:.1e}"])
    return markdown(["`rod.model`", "piston crosses after firing TDC at", "peak side force after it", "liner, 315 Hz to 1 kHz; 1.25 to 3.15 kHz",
                     "sound power [dB(A)]", "energy residue"], rows)


def fired(_):
    make("fired")
    cases = {"all forces": "slap_fired", "slap: the skirt on liner 4": "fired_slap",
             "combustion: gas on the head, crank pin on bearings 4 and 5": "fired_combustion", "all forces, motored (`slap`)": "slap"}
    found = {name: Field(SAMPLE / f"{scene}.field.h5") for name, scene in cases.items()}
    return markdown(["motion of the block under", "sound power [dB(A) re 1 pW]", "ERP", "liner, largest [m/s2]"],
                    [[name, f"{one.dba:.1f}", f"{one.erp_dba:.1f}", f"{one.peak:.0f}"] for name, one in found.items()])


def speeds(_):
    make("speeds")
    chosen = range(1000, 3001, 500)
    rows = []
    for name, of in (("sound power", "dba"), ("ERP of the exposed faces", "erp_dba")):
        for um in (0, 10):
            rows.append([f"{name}, {um} um [dB(A) re 1 pW]", *(f"{getattr(Field(SAMPLE / f'speeds/{rpm}_{um}.field.h5'), of):.1f}" for rpm in chosen)])
    return markdown(["rpm", *map(str, chosen)], rows)


def pan(_):
    """Oil pan and its gasket in the whole engine: level, and what share of the sound power the parts send."""
    make("study-whole")
    rows = []
    for one in slaps.influences(slaps.rows_of(SAMPLE / "whole/sweep.h5"), parameters.read(SAMPLE / "parameters_whole.toml")):
        for value, row in zip(one.values, one.rows):
            with h5py.File(SAMPLE / f"whole/{row.name}.field.h5") as file:
                shares = {name: panel.attrs["sound_power_share"] for name, panel in file[f"{CYCLE}/panels"].items() if "sound_power_share" in panel.attrs}
            base = " (base)" if row.name == parameters.BASE else ""
            rows.append([f"{one.parameter.label()} {value:g}{base}", f"{row.dba:.1f}",
                         *(f"{100 * shares[name]:.0f}" for name in ("oil_pan", "block", "timing_cover", "head", "valve_cover"))])
    return markdown(["", "sound power [dB(A) re 1 pW]", "oil pan [%]", "block", "timing cover", "head", "valve cover"], rows)


def gasket(folder):
    """The shape of liner 4 by other curves of the head gasket, and the slap in the whole engine with it."""
    make("whole")
    text = (SAMPLE / "engine_bolts.fe.toml").read_text().replace('file = "head.rom.h5"', f'file = "{SAMPLE}/head.rom.h5"')
    before, body, after = re.match(r"(?s)(.*name = \"head_gasket\"\n)(.*?)(\n\[\[gasket\]\].*)", text).groups()
    rings = [float(one) for one in re.search(r"closure_um = \[(0\.0.*?)\]", after)[1].split(",")]
    pressures = [float(one) for one in re.search(r"pressure_mpa = \[(.*?)\]", body)[1].split(",")]

    def row(number):
        name, gap, factor = CURVES[number]
        at = folder / f"curve{number}"
        own = re.sub(r"closure_um = .*", f"closure_um = {[gap + ring for ring in rings]}", body)
        own = re.sub(r"pressure_mpa = .*", f"pressure_mpa = {[factor * pressure for pressure in pressures]}", own)
        at.with_suffix(".fe.toml").write_text(before + own + after)
        stage("assembly", SAMPLE / "block.mesh.h5", "-c", at.with_suffix(".fe.toml"), "-o", at.with_suffix(".fe.h5"))
        stage("modal", "statics", at.with_suffix(".fe.h5"), "--case", "assembly", "-o", at.with_suffix(".static.h5"))
        stage("modal", "shape", at.with_suffix(".static.h5"), "--surface", "liner_4_bore", "-o", at.with_suffix(".shape.h5"))
        shapes = "".join(f'[[contact.bore_shape]]\nfile = "{file}"\ncase = "{case}"\n'
                         for file, case in ((SAMPLE / "liner_4.shape.h5", "motored"), (at.with_suffix(".shape.h5"), "assembly")))
        field = Field(variant(folder, at.name, "engine_whole", "[time]\nfilm_every_deg = 0.0\n" + shapes, SAMPLE / "engine_whole.field.toml"))
        with h5py.File(at.with_suffix(".shape.h5")) as file:
            orders = 1e6 * (file["cases/assembly/order_re"][()] + 1j * file["cases/assembly/order_im"][()])
        return [name, f"{orders[:, 0].real.min():.0f} to {orders[:, 0].real.max():.0f}", f"{abs(orders[:, 2]).max():.1f}, {abs(orders[:, 4]).max():.1f}",
                f"{field.dba:.1f} dB(A)", f"{field.peak:.0f} m/s2, {1e3 * field.when:.2f} ms", f"{field.block_peak:.0f} m/s2"]

    with ThreadPoolExecutor(2) as two:
        rows = list(two.map(row, range(len(CURVES))))
    return markdown(["shape of liner 4 by the head bolts", "mean of a height [um]", "order 2, order 4, at most [um]", "sound power", "liner, largest",
                     "block"], rows)


TABLES = {"paper": (paper, VALIDATION), "parameters": (influences, VALIDATION), "dry": (dry, VALIDATION), "engine": (engine, VALIDATION),
          "fired": (fired, README), "rod": (rod, README), "skirt": (skirt, README), "speeds": (speeds, README), "pan": (pan, README), "gasket": (gasket, README)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", choices=TABLES, default=list(TABLES))
    parser.add_argument("--write", action="store_true", help="put the tables into the pages")
    options = parser.parse_args()
    os.environ.setdefault("CLATTER_BIN", str(ROOT / "build/release/bin"))
    for name in options.only:
        table, page = TABLES[name]
        with tempfile.TemporaryDirectory(prefix="clatter-truck-") as folder:
            lines = table(Path(folder))
        print("\n".join([f"{name}:", *lines, ""]), flush=True)
        if options.write:
            write(f"truck {name}", lines, page)


if __name__ == "__main__":
    main()
