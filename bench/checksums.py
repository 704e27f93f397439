#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What checksums of an artefact's numbers cost: 500 MB written to and read from HDF5 with different layouts and
checksums. Prints the table of docs/accuracy.md: seconds of one core (user and system), which a busy machine changes little.

usage: bench/checksums.py [megabytes] [folder]"""
import hashlib
import pathlib
import resource
import sys
import tempfile
import zlib

import h5py
import numpy as np

KIB = 1024
REPEATS = 3  # the fastest counts


def seconds(action):
    """CPU seconds of the fastest of some calls."""
    times = []
    for _ in range(REPEATS):
        begin = resource.getrusage(resource.RUSAGE_SELF)
        action()
        end = resource.getrusage(resource.RUSAGE_SELF)
        times.append(end.ru_utime - begin.ru_utime + end.ru_stime - begin.ru_stime)
    return min(times)


def layouts():
    """(name, options of create_dataset) of each layout."""
    yield "contiguous, no checksum", {}
    for kib in (128, 1024, 8192):
        yield f"chunks of {kib} KiB", {"chunks": (kib * KIB // 8,)}
        yield f"chunks of {kib} KiB, Fletcher32", {"chunks": (kib * KIB // 8,), "fletcher32": True}


def main(megabytes=500, folder=None):
    values = 1.0 / np.arange(1, int(megabytes) * 125_000 + 1)
    into = np.empty_like(values)
    rows = []
    with tempfile.TemporaryDirectory(dir=folder) as scratch:
        path = pathlib.Path(scratch) / "x.h5"

        def write(options):
            with h5py.File(path, "w", libver=("v110", "v110")) as file:
                file.create_dataset("x", data=values, **options)

        def read():
            with h5py.File(path) as file:
                file["x"].read_direct(into)

        for name, options in layouts():
            rows.append((name, seconds(lambda: write(options)), seconds(read)))
            if not np.array_equal(values, into):
                raise SystemExit(f"{name}: the numbers read differ from those written")
    for name, digest in (("SHA-256", lambda: hashlib.sha256(values).digest()), ("CRC-32 (zlib)", lambda: zlib.crc32(values))):
        extra = seconds(digest)
        rows.append((f"{name} of contiguous data, complete reads only", rows[0][1] + extra, rows[0][2] + extra))
    print(f"| {values.nbytes / 1e6:.0f} MB of doubles | write [s] | read [s] |\n|---|---|---|")
    for name, writing, reading in rows:
        print(f"| {name} | {writing:.2f} | {reading:.2f} |")


if __name__ == "__main__":
    main(*sys.argv[1:3])
