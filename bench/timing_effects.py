#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the effects of the timing drive cost, and what they change: samples/timing_drive with one effect left out or added at a time.

Each row is the sample's scene, three cycles at its speed, with a few lines changed: processor seconds per second of engine time,
coordinates, order 1.5 of the intake's speed, and the levels of orders 20 and 40 (the mesh of the chain with the crank sprocket) of the
acceleration beside the arm's pivot, energetic sum of its three directions. Needs the sample's block: make models in its folder.

A second table has the drive on the ground, with steps as long as 1 % in the peaks of its tensions allows: errors are differences from a
tenth of the tolerance, largest of the spans' peaks and of the largest of all joints, over the first cycle.
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

from page import markdown, write

ROOT = Path(__file__).resolve().parent.parent
SAMPLE = ROOT / "samples/timing_drive"
sys.path.insert(0, str(ROOT / "tools"))
from clatter_tools import orders  # noqa: E402

CHANNELS = [f"sensor_arm.{axis}" for axis in "xyz"]
SHOWN = (1.5, 20.0, 40.0)
CYCLES = 3  # of the sample's scene


def without_tables(text, kind, name):
    """The scene without the [[kind]] whose name begins so."""
    changed, count = re.subn(rf'\[\[{kind}\]\]\nname = "{name}[^"]*"\n(?:[^\[\n#][^\n]*\n)*', "", text)
    if count == 0:
        sys.exit(f"bench: drive.run.toml has no [[{kind}]] {name}")
    return changed


def replaced(text, old, new):
    if old not in text:
        sys.exit(f"bench: drive.run.toml has no {old}")
    return text.replace(old, new)


def full_valves(text):
    return replaced(text, 'model = "quasi_static"', 'model = "full"')


def no_valves(text):
    return "valve = []\n" + re.sub(r"\[\[valve\]\]\n(?:[^\[\n][^\n]*\n|\n)*", "", text)


def shafts(model):
    return lambda text: replaced(text, "loss_time_us = 2.0\n", f'loss_time_us = 2.0\nmodel = "{model}"\n')


def rigid_guide(text):
    text = without_tables(without_tables(text, "rigid_body", "guide"), "bushing", "guide")
    return replaced(text, '{ body = "guide", at_mm = [-152.5, -81.0, 157.5] }', '{ body = "block", set = "guide_bolt_1" }')


def tensioner(model):
    return lambda text: replaced(text, '[[tensioner]]\n', f'[[tensioner]]\nmodel = "{model}"\n')


def joints(key, value):
    return lambda text: re.sub(rf"(joint = .*{key} = )[\d.e+-]+", rf"\g<1>{value}", text)


EFFECTS = {
    "**the sample**: quasi-static valves, full camshafts, hydraulic tensioner, guide on its bolts": lambda text: text,
    "12 valves as bodies": full_valves,
    "no valves": no_valves,
    "camshafts in torsion only, on fixed axes": shafts("torsion"),
    "rigid camshafts on fixed axes": shafts("rigid"),
    "guide fixed to the block": rigid_guide,
    "chamber at constant pressure": tensioner("constant_pressure"),
    "constant tensioner force": tensioner("constant_force"),
    "no friction in the joints": joints("friction", "0.0"),
    "no clearance in the joints": joints("clearance_um", "0.0"),
}


def on_the_ground(text):
    """The scene without its block."""
    text = without_tables(text, "body", "block")
    text = re.sub(r'\[\[mount\]\]\n(?:[^\[\n][^\n]*\n)*', "", text)
    text = replaced(text, 'a = { body = "block", set = "tensioner" }', "a = { at_mm = [-152.5, 85.0, 160.0] }")
    text = re.sub(r'(?m)^(?:on|guide) = \{ body = "block".*\n', "", text)
    text = re.sub(r', on = \{ body = "block", set = "\w+" \}', "", text)
    text = re.sub(r'b = \{ body = "block", set = "\w+" \}', "b = { }", text)
    return re.sub(r"(?s)\[accuracy\].*?\n\n", "[accuracy]\ntolerance = TOLERANCE\ndisplacement_um = 100\nvelocity_m_s = 1\n\n", text)


GROUND = {
    "rigid camshafts on fixed axes": shafts("rigid"),
    "full camshafts": lambda text: text,
    "full camshafts, 12 valves": full_valves,
}
TOLERANCE = 1e-2  # of 0.1 mm and 1 m/s


def peaks(file):
    """Largest values of the spans' tensions and of all joints [N]."""
    names = [name for name in file["history"] if name.startswith("chain_tension_") and name != "chain_tension_min"]
    return np.array([np.abs(file[f"history/{name}"][()]).max() for name in names])


def ground_row(folder, binaries, name, text):
    path, run = folder / "ground.run.toml", folder / "ground.run.h5"
    found = []
    for tolerance in (TOLERANCE, 0.1 * TOLERANCE):
        one = replaced(text, "cycles = 3", "cycles = 1").replace("output_step_us = 20.0", "output_step_us = 5.0")
        path.write_text(one.replace("TOLERANCE", str(tolerance)).replace("largest_step_us = 10.0", "largest_step_us = 20.0"))
        seconds = call(name, binaries / "clatter-dynamics", path, "-o", run, "--quiet")
        with h5py.File(run) as file:
            time = file["history/time"]
            found.append((peaks(file), seconds / (time[-1] - time[0]), int(file["statistics"].attrs["accepted"]) / (time[-1] - time[0]),
                          len(file["end/eta"])))
    (values, seconds, steps, size), (right, *_) = found
    error = np.abs(values / right - 1.0).max()
    print(f"{name}: {seconds:.0f} s/s, {steps:.0f} steps/s, error {error:.2e}", file=sys.stderr, flush=True)
    return [name, str(size), f"{steps:.0f}", f"{100 * error:.2g} %", f"{seconds:.0f}"]


def call(name, *command):
    """Processor seconds of a program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"bench: {name}: {done.stderr.strip()}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def simulate(folder, binaries, name, text):
    """Runs one scene and recovers the sensor; its numbers."""
    path, run, field = (folder / f"drive.{kind}" for kind in ("run.toml", "run.h5", "field.h5"))
    path.write_text(replaced(text, '"block.rom.h5"', f'"{SAMPLE / "block.rom.h5"}"'))
    seconds = call(name, binaries / "clatter-dynamics", path, "-o", run, "--quiet")
    call(name, binaries / "clatter-recover", run, "-c", SAMPLE / "run-up.field.toml", "-o", field, "--quiet")
    with h5py.File(run) as file:
        rpm, order, rms, _ = orders.of_run(file, "chain_intake_speed")
        row = {"seconds": seconds / (CYCLES * 120.0 / rpm), "steps": int(file["statistics"].attrs["accepted"]),
               "coordinates": len(file["end/eta"]), SHOWN[0]: np.sqrt(2.0) * orders.of_order(order, rms, SHOWN[0])}
    with h5py.File(field) as file:
        channels = [orders.of_field(file, label) for label in CHANNELS]
        for cut in SHOWN[1:]:
            rms = np.sqrt(sum(orders.of_order(order, values, cut) ** 2 for _, order, values, _ in channels))
            row[cut] = orders.level(rms, "m/s2")
    print(f"{name}: {row}", file=sys.stderr, flush=True)
    return row


def table(rows):
    head = ["effects", "coordinates", "CPU s per s", "order 1.5 of the intake [rad/s]", "order 20 at the arm [dB]", "order 40 [dB]"]
    first = next(iter(rows.values()))
    body = []
    for name, row in rows.items():
        levels = [f"{row[cut]:.1f}" if row is first else f"{row[cut] - first[cut]:+.1f}" for cut in SHOWN[1:]]
        body.append([name, str(row["coordinates"]), f"{row['seconds']:.0f}", f"{row[SHOWN[0]]:.2f}", *levels])
    return markdown(head, body)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin")
    parser.add_argument("--write", action="store_true", help="put the table into docs/accuracy.md")
    options = parser.parse_args()
    if not (SAMPLE / "block.rom.h5").exists():
        sys.exit(f"bench: {SAMPLE}/block.rom.h5 is missing: make models there")
    text = (SAMPLE / "drive.run.toml").read_text()
    with tempfile.TemporaryDirectory() as scratch:
        rows = {name: simulate(Path(scratch), options.bin, name, change(text)) for name, change in EFFECTS.items()}
        ground = [ground_row(Path(scratch), options.bin, name, on_the_ground(change(text))) for name, change in GROUND.items()]
    lines = [*table(rows), "", *markdown(["the drive on the ground", "coordinates", "steps per s", "error of peaks", "CPU s per s"], ground)]
    print("\n".join(lines))
    if options.write:
        write("timing effects", lines)


if __name__ == "__main__":
    main()
