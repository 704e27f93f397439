# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter doctor`: whether this machine and folder have what clatter needs, a line each, with the way out."""
import argparse
import ctypes
import dataclasses
import importlib.util
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import tempfile

from clatter import pipeline
from clatter.errors import BadArtefact
from .keys.schema_line import PACKAGE

STAGES = ("mesh", "assembly", "modal", "condense", "dynamics", "recover")
MODULES = {"numpy": "python3-numpy", "h5py": "python3-h5py", "scipy": "python3-scipy", "matplotlib": "python3-matplotlib"}
LEAST_GIB, LEAST_DISK_GB = 4.0, 5.0  # of which a part of some 100 000 DoFs, and its runs, take less


@dataclasses.dataclass
class Check:
    name: str
    status: str      # "ok", "warning": it works, with less; "missing": it does not work
    text: str
    remedy: str = ""

    def line(self):
        return f"{self.status:<8} {self.name:<9} {self.text}" + (f": {self.remedy}" if self.remedy else "")


def add_arguments(one):
    one.add_argument("folder", nargs="?", default=".", help="where results will be written; default: this one")
    one.add_argument("--json", action="store_true", help="one line of JSON")


def main(arguments):
    """The command alone, which needs Python only."""
    parser = argparse.ArgumentParser(prog="clatter doctor")
    add_arguments(parser)
    return run(parser.parse_args(arguments))


def run(options):
    """Prints all checks; returns 1 where something is missing, else 0."""
    folder = pathlib.Path(options.folder)
    if not folder.is_dir():
        raise BadArtefact(f"{folder}: no such folder")
    checks = [programs(), packages(), modules(), make(), blas(), memory(), threads(), disk(folder), permission(folder)]
    good = all(check.status != "missing" for check in checks)
    if options.json:
        print(json.dumps({"ok": good, "checks": [dataclasses.asdict(check) for check in checks]}))
    else:
        for check in checks:
            print(check.line())
    return 0 if good else 1


def programs():
    versions, missing = {}, []
    for stage in STAGES:
        try:
            path = pipeline.program(f"clatter-{stage}")
            done = subprocess.run([path, "--version"], capture_output=True, text=True, check=True)
            versions.setdefault(done.stdout.split()[-1], []).append(str(pathlib.Path(path).parent))
        except (BadArtefact, OSError, subprocess.CalledProcessError, IndexError):
            missing.append(f"clatter-{stage}")
    if missing:
        return Check("programs", "missing", ", ".join(missing),
                     "`make build` in the source tree, or install the package; CLATTER_BIN names their folder")
    places = ", ".join(sorted({place for found in versions.values() for place in found}))
    if len(versions) > 1:
        return Check("programs", "warning", f"versions {', '.join(sorted(versions))} in {places}", "install or build all six again")
    return Check("programs", "ok", f"six of version {next(iter(versions))} in {places}")


def listed(phases):
    """Debian packages of packages.txt with one of the phases."""
    lines = (PACKAGE.parent / "packages.txt").read_text(encoding="utf-8").splitlines()
    rows = [line.split() for line in lines if line.strip() and not line.startswith("#")]
    return [row[0] for row in rows if set(phases) & set(row[1].split(","))]


def packages():
    """Those that a source tree is built with; of an installation those that it runs with."""
    phases = ("build", "demo") if (PACKAGE.parents[1] / "CMakePresets.json").exists() else ("demo",)
    wanted = listed(phases)
    if not shutil.which("dpkg-query"):
        return Check("packages", "warning", "not a Debian system, so it is not known which are there",
                     f"it needs what Debian calls {' '.join(wanted)}")
    query = ["dpkg-query", "-W", "-f", "${Package} ${db:Status-Status}\n", *wanted]
    done = subprocess.run(query, capture_output=True, text=True, check=False)
    there = {line.split()[0] for line in done.stdout.splitlines() if line.endswith(" installed")}
    missing = [package for package in wanted if package not in there]
    if missing:
        return Check("packages", "missing", f"{len(missing)} of {len(wanted)}", f"apt-get install {' '.join(missing)}")
    return Check("packages", "ok", f"all {len(wanted)} of {' and '.join(phases)} are installed")


def modules():
    missing = [name for name in MODULES if importlib.util.find_spec(name) is None]
    if missing:
        return Check("Python", "missing", ", ".join(missing), f"apt-get install {' '.join(MODULES[name] for name in missing)}")
    return Check("Python", "ok", ", ".join(MODULES))


def make():
    path = shutil.which("make")
    return Check("make", "ok", path) if path else Check("make", "missing", "not in PATH", "apt-get install make")


def blas():
    """The library that clatter-modal is linked with and, of OpenBLAS, its kernel."""
    try:
        program = pathlib.Path(pipeline.program("clatter-modal"))
    except BadArtefact:
        return Check("BLAS", "warning", "not known without clatter-modal")
    # The one in bin of an installation may only choose between builds.
    builds = [program, *sorted(program.parent.parent.glob("libexec/clatter/*/clatter-modal"))]
    linked = "".join(subprocess.run(["ldd", build], capture_output=True, text=True, check=False).stdout for build in builds)
    found = re.search(r"=> (\S*libopenblas\S*)", linked)
    if not found:
        return Check("BLAS", "warning", "not OpenBLAS: factorisations are slow", "apt-get install libopenblas0-pthread")
    try:
        library = ctypes.CDLL(found[1])
        library.openblas_get_corename.restype = library.openblas_get_config.restype = ctypes.c_char_p
        kernel, version = library.openblas_get_corename().decode(), library.openblas_get_config().decode().split()[1]
    except (OSError, AttributeError, IndexError):
        return Check("BLAS", "warning", f"{found[1]} does not say its kernel")
    text = f"OpenBLAS {version}, kernel {kernel}"
    if os.environ.get("OPENBLAS_CORETYPE"):
        return Check("BLAS", "warning", f"{text}, forced by OPENBLAS_CORETYPE",
                     "unset it, or give --blas auto, for the best one of this CPU")
    return Check("BLAS", "ok", text)


def memory():
    numbers = dict(re.findall(r"^(\w+): +(\d+) kB", pathlib.Path("/proc/meminfo").read_text(), re.M))
    total, free = (int(numbers[name]) / 2**20 for name in ("MemTotal", "MemAvailable"))
    limit = resource.getrlimit(resource.RLIMIT_AS)[0]
    text = f"{free:.1f} of {total:.1f} GiB are free"
    if limit != resource.RLIM_INFINITY:
        free, text = min(free, limit / 2**30), f"{text}, a process gets {limit / 2**30:.1f} (ulimit -v)"
    if free < LEAST_GIB:
        return Check("memory", "warning", text,
                     f"large parts need more than {LEAST_GIB:g}; --memory-limit keeps the programs below a limit")
    return Check("memory", "ok", text)


def threads():
    cores = len(os.sched_getaffinity(0))
    asked = os.environ.get("OMP_NUM_THREADS")
    return Check("threads", "ok", f"{cores}" + (f", OMP_NUM_THREADS={asked}" if asked else ""))


def disk(folder):
    free = shutil.disk_usage(folder).free / 1e9
    if free < LEAST_DISK_GB:
        return Check("disk", "warning", f"{free:.1f} GB are free in {folder.resolve()}",
                     f"a sweep of many runs may need more than {LEAST_DISK_GB:g}")
    return Check("disk", "ok", f"{free:.0f} GB are free in {folder.resolve()}")


def permission(folder):
    try:
        with tempfile.TemporaryFile(dir=folder):
            return Check("folder", "ok", f"{folder.resolve()} can be written")
    except OSError as error:
        return Check("folder", "missing", f"{folder.resolve()} cannot be written, {error.strerror}", "choose a folder of your own")
