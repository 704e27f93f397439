# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the programs of several processes for tests, and compares reduced models."""
import os
import subprocess
import time

import h5py
import numpy as np
import scipy.linalg
import stages

# As root Open MPI asks for two confirmations; there are more ranks than cores here.
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMP_NUM_THREADS": "1",
               "OPENBLAS_NUM_THREADS": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
               "OMPI_MCA_mpi_yield_when_idle": "1"}
MPIRUN = ["mpirun", "--oversubscribe", "--bind-to", "none"]


def program(name):
    return [str(stages.BIN / f"clatter-{name}-mpi")]


def command(name, count, *arguments):
    return [*MPIRUN, "-n", str(count), *program(name), *map(str, arguments), "--threads", "1"]


def finish(words, folder, **environment):
    """Runs a command of several processes to its end; returns the finished process with its output. One that does not end is
    ended with its ranks: mpirun alone would leave them."""
    with subprocess.Popen(words, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          env={**ENVIRONMENT, **environment}) as process:
        try:
            output, errors = process.communicate(timeout=300)
        except subprocess.TimeoutExpired:
            process.terminate()  # which mpirun passes on
            process.communicate(timeout=60)
            raise
    return subprocess.CompletedProcess(words, process.returncode, output, errors)


def run(name, count, *arguments, folder, **environment):
    """Runs clatter-<name>-mpi on `count` ranks; returns the finished process with its output."""
    return finish(command(name, count, *arguments), folder, **environment)


def ranks_of(process, count):
    """Process ids of the ranks that mpirun started, when all are there."""
    children = []
    while len(children) < count and process.poll() is None:
        listed = subprocess.run(["pgrep", "-P", str(process.pid), "clatter"], capture_output=True, text=True)
        children = [int(word) for word in listed.stdout.split()]
    return children


def wait_until(condition, what, seconds=30.0):
    """AssertionError naming `what` when the condition does not become true."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(what)
        time.sleep(0.02)


def read(path):
    """The matrices, frequencies, loads, inertia forces, rows and certificate of a reduced model."""
    with h5py.File(path) as file:
        model = {name: file[name][()] for name in ("M_rr", "K_rr", "fixed_interface_hz")}
        model["T"] = file["skin/T"][()] if "skin/T" in file else np.zeros((0, len(model["M_rr"])))
        model["loads"] = {name: load[()] for name, load in file.get("loads", {}).items()}
        # Of a part with supports: the loads by accelerations of its frame.
        if "inertia_force" in file:
            model["loads"] |= {f"acceleration {k}": load for k, load in enumerate(file["inertia_force"][()].T)}
        model["boundary"] = len(model["M_rr"]) - len(model["fixed_interface_hz"])
        model["certificate"] = {name: float(value) for name, value in file["certificate"].attrs.items()}
        model["order"] = file["ordering/permutation"][()]
        inertia = file.get("inertia_invariants", {})
        model["inertia"] = {name: inertia[name][()] for name in inertia}
    return model


def with_signs_of(model, other):
    """The same model with the signs of the other's modes."""
    n_b = model["boundary"]
    sign = np.sign(np.sum(model["M_rr"][:n_b] * other["M_rr"][:n_b], axis=0))
    sign[:n_b] = 1.0
    squares = {name for name, values in model["inertia"].items() if name.startswith("product")}
    inertia = {name: sign[:, None] * values * sign if name in squares else values * sign if name != "place" else values
               for name, values in model["inertia"].items()}
    return {**model, "inertia": inertia, "M_rr": sign[:, None] * model["M_rr"] * sign, "K_rr": sign[:, None] * model["K_rr"] * sign,
            "T": model["T"] * sign, "loads": {name: load * sign for name, load in model["loads"].items()}}


def largest_difference(a, b):
    """Over the largest entry."""
    return np.abs(a - b).max() / np.abs(b).max() if b.size else 0.0


def frequencies(model):
    """Of the reduced model itself [Hz], ascending."""
    values = scipy.linalg.eigh(model["K_rr"], model["M_rr"], eigvals_only=True)
    return np.sqrt(np.maximum(values, 0.0)) / (2.0 * np.pi)
