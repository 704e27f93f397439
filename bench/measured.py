# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds and peak memory of processes, and the peak rate of the machine."""
import multiprocessing
import os
import shutil
import statistics
import subprocess
import sys
import time

DGEMM = """
import statistics, time, numpy as np
a, b = np.random.rand(2, 2000, 2000)
def once():
    begin = time.monotonic(); a @ b; return time.monotonic() - begin
once(); print(2 * 2000**3 / statistics.median(once() for _ in range(7)))
"""


def run(command, folder, required=True, **environment):
    """Standard output, wall seconds and peak megabytes of a process. If it fails or is not installed the bench ends, or
    (required False) the result is None."""
    if not shutil.which(command[0]):
        missing = f"bench: {command[0]} is not installed"
        if required:
            sys.exit(missing)
        print(missing, file=sys.stderr)
        return None
    begin = time.monotonic()
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True,
                               env={**os.environ, **environment} if environment else None)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0 and required:
        sys.exit(f"bench: {command[0]} failed")
    return (output, time.monotonic() - begin, usage.ru_maxrss / 1e3) if status == 0 else None


def apart(function, *arguments):
    """Calls it in its own process: the memory of this one would count towards the peak of those it starts."""
    maker = multiprocessing.Process(target=function, args=arguments)
    maker.start()
    maker.join()
    if maker.exitcode != 0:
        sys.exit(f"bench: {function.__name__} failed")


def medians(command, folder, runs, fresh=(), **environment):
    """Output of the last run, median seconds, peak megabytes; None when a run fails. Files of `fresh` are
    deleted before each run."""
    found = []
    for _ in range(runs):
        for name in fresh:
            (folder / name).unlink(missing_ok=True)
        found.append(run(command, folder, required=False, **environment))
    if None in found:
        return None
    return found[-1][0], statistics.median(f[1] for f in found), max(f[2] for f in found)


def blas(threads):
    """One BLAS setting for all programs: OpenBLAS 0.3.21 uses its oldest kernel on CPUs that it does not recognise."""
    with open("/proc/cpuinfo") as file:
        flags = next((line.split() for line in file if line.startswith("flags")), [])
    kernel = "SKYLAKEX" if "avx512vl" in flags else "HASWELL" if "avx2" in flags else ""
    setting = {"OPENBLAS_NUM_THREADS": str(threads), "OMP_NUM_THREADS": str(threads),
               "CCX_NPROC_EQUATION_SOLVER": str(threads)}
    return {**setting, "OPENBLAS_CORETYPE": kernel} if kernel else setting


def dgemm_rate(folder, setting):
    """Floating point operations per second of a matrix product with that setting."""
    return float(run(["/usr/bin/python3", "-c", DGEMM], folder, **setting)[0])
