#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What two releases of Debian say differently of the piston slap, and why: Gmsh's mesh, or compilers and libraries.

usage: bench/releases.py OTHER [--bin build/release/bin] [--scenes slap slap_10um ...] [--write]

Needs `make demo` on both releases (tools/in_debian makes the other); OTHER is samples/truck_diesel of the other one. Programs of this release run
each scene with the parts of this one, with all parts of the other one, and with one kind of part of the other one:

  block, piston   reduced models: modes, contact patches, sound
  bore, skirt     shapes of the warm and bolted parts, which the film's gap starts from

Differences are from this release's own run. The last column repeats the other release's run with this one's programs from the same parts: what
compilers and libraries change. Three minutes a scene. A second table compares the blocks: elastic frequencies, and the static compliance of each
contact patch of the liner, both of the free block.
"""
import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
import scipy.linalg

from page import markdown, write

ROOT = Path(__file__).resolve().parent.parent
SAMPLE = ROOT / "samples" / "truck_diesel"
sys.path.insert(0, str(ROOT / "tools"))
from clatter_tools import levels, slap, slap_rows  # noqa: E402
from clatter import fields  # noqa: E402

PARTS = {"block": ["block.rom.h5", "block.sound.h5"], "piston": ["piston.rom.h5"], "bore": ["liner_4.shape.h5", "liner_4_bolted.shape.h5"],
         "skirt": ["skirt.shape.h5"]}
SETTINGS = ["*.run.toml", "*.csv", "field.toml"]
AT = slap_rows.AT
TO_HZ = 3000.0  # up to which the sample's frequencies hold


def numbers(field):
    """Sound power [dB(A)], height [m/s2] and instant [ms] of the slap."""
    with h5py.File(field) as file:
        _, (_, power, _) = levels.of_field(file, "sound", None)
        time, values = slap.band_limited(file, fields.pick_sensor(file, AT, "liner"), AT)
    when, height = slap.peak(time, values)
    return power, height, when * 1e3


def run(scene, binaries, other, exchanged):
    """The numbers of a scene with these kinds of parts of the other release."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for pattern in SETTINGS:
            for path in SAMPLE.glob(pattern):
                shutil.copy(path, folder)
        for kind, names in PARTS.items():
            for name in names:
                (folder / name).symlink_to((other if kind in exchanged else SAMPLE) / name)
        for command in (["clatter-dynamics", f"{scene}.run.toml", "-o", "a.run.h5"],
                        ["clatter-recover", "a.run.h5", "-c", "field.toml", "-o", "a.field.h5"]):
            done = subprocess.run([binaries / command[0], *command[1:], "--quiet"], cwd=folder, capture_output=True, text=True)
            if done.returncode:
                sys.exit(f"bench: {done.stderr.strip()}")
        return numbers(folder / "a.field.h5")


def row(scene, binaries, other):
    base = run(scene, binaries, other, [])
    own, theirs = numbers(SAMPLE / f"{scene}.field.h5"), numbers(other / f"{scene}.field.h5")
    if abs(own[0] - base[0]) > 0.01:
        print(f"{scene}: {own[0]:.2f} dB(A) in {SAMPLE}, {base[0]:.2f} by {binaries}: make demo once more", file=sys.stderr)
    changed = {name: run(scene, binaries, other, kinds) for name, kinds in [("all", list(PARTS)), *((kind, [kind]) for kind in PARTS)]}
    cells = [scene, f"{base[0]:.2f}, {base[1]:.0f}, {base[2]:.2f}", f"{theirs[0]:.2f}, {theirs[1]:.0f}, {theirs[2]:.2f}"]
    for name, found in changed.items():
        cells.append(f"{found[0] - base[0]:+.2f}, {found[1] / base[1] - 1:+.0%}")
    cells.append(f"{theirs[0] - changed['all'][0]:+.2g}, {theirs[1] / changed['all'][1] - 1:+.1g}")
    return cells


def elastic(rom):
    """Elastic frequencies of the free block [Hz], and the static compliance of each contact patch by its elastic modes [m/N]."""
    with h5py.File(rom) as file:
        eigenvalues, shapes = scipy.linalg.eigh(file["K_rr"][()], file["M_rr"][()])
        rows = shapes[file["sets/liner_4/dofs"][()], 6:]
    return np.sqrt(eigenvalues[6:]) / (2 * np.pi), (rows**2 / eigenvalues[6:]).sum(axis=1)


def blocks(other):
    (hz, patches), (other_hz, other_patches) = (elastic(folder / "block.rom.h5") for folder in (SAMPLE, other))
    low = hz < TO_HZ
    ratio = other_patches / patches
    return markdown(["free block", "this release and the other"],
                    [[f"{low.sum()} elastic frequencies below {TO_HZ:g} Hz", f"differ by at most {abs(other_hz[low] / hz[low] - 1).max():.2%}"],
                     [f"static compliance of {len(ratio)} contact patches",
                      f"mean {ratio.mean() - 1:+.1%}, standard deviation {ratio.std():.0%}, {ratio.min() - 1:+.0%} to {ratio.max() - 1:+.0%}"]])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("other", type=Path, help="samples/truck_diesel of the other release, with its results")
    parser.add_argument("--bin", type=Path, default=ROOT / "build" / "release" / "bin", help="programs; default %(default)s")
    parser.add_argument("--scenes", nargs="+", default=["slap", "slap_10um", "slap_dry", "slap_dry_10um"])
    parser.add_argument("--write", action="store_true", help="put the table into docs/accuracy.md")
    options = parser.parse_args()
    missing = [path for names in PARTS.values() for name in names for path in (SAMPLE / name, options.other / name) if not path.exists()]
    if missing:
        sys.exit(f"bench: {missing[0]} is missing: make demo")
    head = ["scene", "this release: dB(A), m/s2, ms", "the other", *(f"{name} of the other" for name in ("all parts", *PARTS)), "programs of the other"]
    rows = []
    for scene in options.scenes:
        rows.append(row(scene, options.bin.resolve(), options.other.resolve()))
        print(" | ".join(rows[-1]), flush=True)
    lines = [*markdown(head, rows), "", *blocks(options.other)]
    print("\n".join(lines))
    if options.write:
        write("releases", lines)


if __name__ == "__main__":
    main()
