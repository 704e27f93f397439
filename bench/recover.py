#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recovery of a synthetic part: expansion against the time of writing its bytes to disk, spectra and radiated
power without expansion against expansion of every step, and the memory of a skin whose rows T stay on disk.

The plain program writes the bytes of the expansion, one file of zeros by blocks of 1 MiB; both it and clatter-recover end
with fsync. Seconds are medians of complete processes; those of the expansion are the difference of two
processes, with and without it. The rows T of --large are random numbers in single precision's range, stored as double.
"""
import argparse
import hashlib
import os
import resource
import statistics
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy as np

from measured import apart, run

ROOT = Path(__file__).resolve().parent.parent
SPEED_RPM = 2000.0
NOTHING = "window = []\n[frames]\non = false\n[lines]\nstrongest = 0\n"
EVERY_STEP = """cycle = true
window = []
[frames]
from_s = 0
to_s = {end}
step_s = {step}
quantities = {quantities}
[lines]
strongest = 0
"""


def box_skin(n):
    """A unit cube with n x n squares a side, two quadratic triangles each: nodes, triangles (outward)."""
    ids, nodes, triangles = {}, [], []

    def node(at):
        if at not in ids:
            ids[at] = len(nodes)
            nodes.append(np.array(at) / (2.0 * n))
        return ids[at]

    for d in range(3):
        for end in (0, 2 * n):
            for i in range(0, 2 * n, 2):
                for j in range(0, 2 * n, 2):
                    def at(di, dj):
                        point = [0, 0, 0]
                        point[d], point[(d + 1) % 3], point[(d + 2) % 3] = end, i + di, j + dj
                        return node(tuple(point))
                    a, b, c, e = at(0, 0), at(2, 0), at(2, 2), at(0, 2)
                    mid = at(1, 1)
                    ab, bc, ce, ea = at(1, 0), at(2, 1), at(1, 2), at(0, 1)
                    if end:
                        triangles += [(a, b, c, ab, bc, mid), (a, c, e, mid, ce, ea)]
                    else:
                        triangles += [(a, c, b, mid, bc, ab), (a, e, c, ea, ce, mid)]
    return np.array(nodes), np.array(triangles, np.int32)


def make(folder, squares, r, steps):
    """part.rom.h5 and part.run.h5: `steps` samples of one cycle and its end."""
    nodes, triangles = box_skin(squares)
    random = np.random.default_rng(1)
    with h5py.File(folder / "part.rom.h5", "w") as f:
        f.attrs["schema"] = np.bytes_("clatter/rom/1")
        f.attrs["name"], f.attrs["method"] = np.bytes_("block"), np.bytes_("craig-bampton")
        f.attrs["n_boundary"] = np.int64(1)
        f.attrs["alpha"], f.attrs["beta"], f.attrs["valid_to_hz"] = 0.0, 0.0, 3000.0
        f["M_rr"] = f["K_rr"] = np.eye(r)
        f["rigid"], f["fixed_interface_hz"] = np.zeros((r, 6)), np.linspace(100.0, 6000.0, r - 1)
        mass = f.create_group("mass")
        mass["centre"], mass["inertia"], mass.attrs["mass"] = np.zeros(3), np.eye(3), 1.0
        f["skin/nodes"], f["skin/triangles"] = nodes, triangles
        f.create_group("certificate").attrs["certified"] = 1.0
        rows = max(131072 // (8 * r), 1)
        T = f.create_dataset("skin/T", (3 * len(nodes), r), "f8", chunks=(rows, r), fletcher32=True)
        block = rows * max(20_000_000 // (rows * r), 1)
        for first in range(0, 3 * len(nodes), block):
            count = min(block, 3 * len(nodes) - first)
            T[first:first + count] = random.standard_normal((count, r), np.float32)
    sha = hashlib.sha256()
    with open(folder / "part.rom.h5", "rb") as f:
        while data := f.read(1 << 20):
            sha.update(data)
    time_s = np.arange(steps + 1) * (120.0 / SPEED_RPM / steps)
    order = 1 + np.arange(r) % 90
    phase = 2 * np.pi * random.random(r)
    with h5py.File(folder / "part.run.h5", "w") as f:
        f.attrs["schema"] = np.bytes_("clatter/run/1")
        f["output/time"], f["output/crank_angle_deg"] = time_s, time_s * 6.0 * SPEED_RPM
        w = np.pi * order * SPEED_RPM / 60.0
        angle = time_s[:, None] * w + phase
        body = f.create_group("bodies/block")
        body["q"], body["v"], body["a"] = np.cos(angle) / w, -np.sin(angle), -np.cos(angle) * w
        body.attrs["rom"], body.attrs["rom_sha256"] = np.bytes_("part.rom.h5"), np.bytes_(sha.hexdigest())
    return len(nodes), len(triangles)


def write_plain(path, size):
    """Seconds to write `size` bytes and sync them."""
    block = bytes(1 << 20)
    begin = time.monotonic()
    with open(path, "wb", buffering=0) as f:
        for _ in range(size // len(block)):
            f.write(block)
        f.write(block[:size % len(block)])
        os.fsync(f.fileno())
    seconds = time.monotonic() - begin
    path.unlink()
    return seconds


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def recover(folder, build, config):
    """Wall seconds, peak megabytes and bytes of a recovery, the seconds of its steps, and its processor seconds."""
    before = processor_seconds()
    (folder / "part.field.toml").write_text(config)
    _, seconds, peak = run([build / "bin/clatter-recover", "part.run.h5", "-c", "part.field.toml", "-o", "part.field.h5", "--quiet"],
                           folder)
    path = folder / "part.field.h5"
    with h5py.File(path) as f:
        steps = dict(zip((s.decode() for s in f["timing/step"][()]), f["timing/seconds"][()]))
    size = path.stat().st_size
    path.unlink()
    return seconds, peak, size, steps, processor_seconds() - before


def compare(folder, build, squares, r, steps, runs):
    n_s, n_f = box_size(squares)
    apart(make, folder, squares, r, steps)
    end = 120.0 / SPEED_RPM
    every = EVERY_STEP.format(end=end, step=end / steps, quantities='["velocity", "normal_velocity"]')
    without, full, plain = [], [], []
    for _ in range(runs):  # in turns, because the machine's load changes
        without.append(recover(folder, build, NOTHING))
        full.append(recover(folder, build, every))
        plain.append(write_plain(folder / "plain.bin", full[-1][2] - without[-1][2]))
    median = lambda rows, k=0: statistics.median(row[k] for row in rows)  # noqa: E731
    expansion = median(full) - median(without)
    size = full[-1][2] - without[-1][2]
    spectra = statistics.median(row[3]["spectra and radiated power"] for row in without)
    forms = statistics.median(row[3]["normal velocity forms"] for row in without)
    print(f"| {n_s} | {n_f} | {r} | {steps} | {size / 1e9:.2f} | {expansion:.2f} | {median(full, 4) - median(without, 4):.2f} | {statistics.median(plain):.2f} | "
          f"{expansion / statistics.median(plain):.2f} | {median(without):.2f} | {forms:.2f} | {spectra:.2f} | "
          f"{(expansion + median(without)) / median(without):.1f} | {expansion / (forms + spectra):.1f} | {expansion / spectra:.0f} | "
          f"{max(row[1] for row in full):.0f} |", flush=True)


def box_size(n):
    return 24 * n * n + 2, 12 * n * n


def large(folder, build, squares, r, steps, frames):
    """Memory of a skin whose rows are on disk."""
    begin = time.monotonic()
    apart(make, folder, squares, r, steps)
    n_s, n_f = box_size(squares)
    print(f"{n_s} nodes x {r} coordinates, T {24 * n_s * r / 1e9:.2f} GB, {steps} steps; made in {time.monotonic() - begin:.0f} s", flush=True)
    end = 120.0 / SPEED_RPM
    every = '["displacement", "velocity", "acceleration", "normal_velocity"]'
    for name, config in (("spectra and power alone", NOTHING),
                         ("and displacement, velocity, acceleration, normal velocity of 73 steps",
                          EVERY_STEP.format(end=end, step=end / 72, quantities=every)),
                         (f"and velocities of {frames} steps",
                          EVERY_STEP.format(end=end, step=end / frames, quantities='["velocity"]'))):
        seconds, peak, size, laps, _ = recover(folder, build, config)
        print(f"{name}: {seconds:.0f} s, peak {peak:.0f} MB, file {size / 1e9:.2f} GB; " +
              ", ".join(f"{k} {v:.1f} s" for k, v in laps.items()), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("--sizes", nargs="+", default=["15:100:1440", "30:200:1440", "30:400:2880"], metavar="SQUARES:R:STEPS")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--large", action="store_true", help="100 000 nodes x 2 500 coordinates x 10 000 steps: 7 GB and minutes")
    parser.add_argument("--frames", type=int, default=10000, help="steps that --large expands (1.2 MB each)")
    parser.add_argument("--folder", type=Path, help="where the files are made, default a temporary folder")
    a = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=a.folder) as name:
        folder = Path(name)
        if a.large:
            return large(folder, a.build, 65, 2500, 10000, a.frames)
        print("| nodes | faces | r | steps | GB | expansion [s] | its processor time [s] | plain write [s] | ratio | process without expansion [s] | of it forms [s] | "
              "spectra and power [s] | process with / without | expansion / (forms + spectra) | expansion / spectra | peak [MB] |")
        print("|" + "--:|" * 16)
        for size in a.sizes:
            compare(folder, a.build, *map(int, size.split(":")), a.runs)


if __name__ == "__main__":
    sys.exit(main())
