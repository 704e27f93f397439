#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Run-up of the reference's timing drive: rigid cams, no block, no clearance in the joints, against the reference's small linear model
(three coordinates, spans that only pull, the same oil). Eight cycles a speed, the last one is compared: amplitude of order 1.5 of the
intake's speed, half of its peak to peak, forces in the joints. A second table has the clearance of the sample's joints.
"""
import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

import timing_scenes
from page import markdown, write

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from clatter_tools import orders  # noqa: E402

# rpm: order 1.5 and half peak to peak of the intake [rad/s], tight span [N] of the reference's small model
REFERENCE = {1000: (1.21, 2.7, "63-402"), 2000: (3.63, 4.5, "74-442"), 2600: (7.34, 8.7, "38-482"), 3000: (9.38, 9.0, "66-524"),
             3400: (11.86, 15.4, "34-605"), 3800: (11.62, 12.3, "92-549"), 4400: (10.72, 10.6, "124-486"),
             5200: (7.03, 9.0, "138-356"), 6000: (5.24, 6.0, "166-297")}
CYCLES, SAMPLE_S = 8, 5e-5
JOINTS = {"no clearance": (0.0, 1e7), "12.5 um, 1e7 N/m": (12.5, 1e7), "12.5 um, 1.25e7 N/m (the sample)": (12.5, 1.25e7)}


def simulate(folder, program, rpm, clearance, stiffness):
    """(order 1.5, half peak to peak [rad/s], tight span [N], greatest joint force [N]) of the last cycle."""
    path, run = folder / "drive.run.toml", folder / "drive.run.h5"
    time = f'cycle_of = "crank"\ncycles = {CYCLES}\noutput_step_us = {SAMPLE_S * 1e6}\nlargest_step_us = 20\n'
    path.write_text(timing_scenes.scene(rpm=rpm, time=time, clearance=clearance, stiffness=stiffness, start_deg=-360.0,
                                        accuracy="tolerance = 1e-2\ndisplacement_um = 100\nvelocity_m_s = 1\n"))
    done = subprocess.run([program, path, "-o", run, "--quiet"], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"bench: {rpm} rpm: {done.stderr.strip()}")
    with h5py.File(run) as file:
        _, order, rms, _ = orders.of_run(file, "chain_intake_speed", 1)
        samples = int(round(120.0 / rpm / SAMPLE_S))
        speed, tight, most = (file[f"history/chain_{name}"][-samples:] for name in ("intake_speed", "tension_guide_crank", "tension_max"))
    return np.sqrt(2.0) * orders.of_order(order, rms, 1.5), 0.5 * np.ptp(speed), tight, most.max()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin")
    parser.add_argument("--write", action="store_true", help="put the table into docs/accuracy.md")
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as scratch:
        for rpm, (order, half, tight) in REFERENCE.items():
            row = [str(rpm), f"{order:g} ({half:g})", tight]
            for clearance, stiffness in JOINTS.values():
                found = simulate(Path(scratch), options.bin / "clatter-dynamics", rpm, clearance, stiffness)
                row += [f"{found[0]:.2f} ({found[1]:.1f})"] + ([f"{found[2].min():.0f}-{found[2].max():.0f}"] if clearance == 0.0 else [])
            print(row, file=sys.stderr, flush=True)
            rows.append(row)
    first, *others = JOINTS
    lines = markdown(["rpm", "small model", "its tight span [N]", first, "tight span [N]", *others], rows)
    print("\n".join(lines))
    if options.write:
        write("timing speeds", lines)


if __name__ == "__main__":
    main()
