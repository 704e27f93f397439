# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs clatter's programs. What one refuses is an exception with its own line: Refused (exit code 2), Failed (3), CannotWrite (4)."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

from .errors import BadArtefact, CannotWrite, Failed, Refused

HERE = pathlib.Path(__file__).resolve()
# Of the source tree: programs, and the command clatter; of an installation, whose package is share/clatter/clatter.
BESIDE = (HERE.parents[2] / "build/release/bin", HERE.parents[2] / "tools", HERE.parents[3] / "bin")
RAISED = {2: Refused, 3: Failed, 4: CannotWrite}
SAID = re.compile(r"^clatter(?:-\w+)*: error: (.*)$", re.M)


def find(name):
    """The path of a program as `program` says, or None."""
    beside = pathlib.Path(sys.argv[0]).resolve().parent
    folders = [os.environ.get("CLATTER_BIN", beside), beside, *BESIDE]
    return next((str(path) for folder in folders if (path := pathlib.Path(folder) / name).is_file()), shutil.which(name))


def program(name) -> str:
    """The path of a program: in CLATTER_BIN, beside the running one, in the source tree or the installation of this package, or in PATH."""
    found = find(name)
    if found is None:
        raise BadArtefact(f"{name} was not found beside this program or in PATH; build it (make build)")
    return found


def environment(**more):
    """That of make: its own variables are those of a fresh start, CLATTER_BIN is absolute, and PATH finds the command clatter of these
    tools, whose rules a Makefile includes."""
    found = {key: value for key, value in os.environ.items() if key not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL", "MAKEOVERRIDES")}
    if found.get("CLATTER_BIN"):
        found["CLATTER_BIN"] = os.path.abspath(found["CLATTER_BIN"])
    own, other = find("clatter"), shutil.which("clatter")
    if own and not (other and os.path.samefile(own, other)):
        found["PATH"] = os.pathsep.join([os.path.dirname(own), found.get("PATH", "")])
    return {**found, **more}


def call(command, folder="."):
    """Runs a command in a folder; returns what it wrote to standard output, or raises its error. Warnings go to standard error."""
    done = subprocess.run([str(one) for one in command], cwd=folder, env=environment(), text=True, capture_output=True, check=False)
    if done.returncode:
        said = SAID.findall(done.stderr)
        codes = [int(code) for code in re.findall(r"^make: \*\*\* .*Error (\d+)$", done.stderr, re.M)] or [done.returncode]
        lines = [*said, *done.stderr.strip().splitlines()[:1], f"{command[0]}: ended with {done.returncode}"]
        raise RAISED.get(codes[0], Failed)(lines[0])
    print(done.stderr, end="", file=sys.stderr)
    return done.stdout


def run(stage, *arguments, folder=".", **options) -> dict:
    """Runs clatter-<stage> in a folder; returns its results, the members of --json (docs/formats.md).

        pipeline.run("mesh", "beam.mesh.toml", output="beam.mesh.h5")
        pipeline.run("modal", "statics", "beam.fe.h5", output="beam.static.h5", case="weight")

    stage: mesh, assembly, modal, condense, dynamics or recover; arguments: a command of the program, and files; options: those of
    --help, with _ for -: verify=2000 is --verify 2000, True an option without a value, a list one that is repeated."""
    command = [program(f"clatter-{stage}"), *arguments, "--json", "--quiet"]
    for name, value in options.items():
        option = f"--{name.replace('_', '-')}"
        command += [option] if value is True else [f"{option}={one}" for one in (value if isinstance(value, (list, tuple)) else [value])]
    return json.loads(call(command, folder).splitlines()[-1])


def make(*targets, folder=".", jobs=1, files=("Makefile",)) -> None:
    """Brings files of a folder up to date by its Makefile, several stages at a time with jobs."""
    if not all(pathlib.Path(folder, file).exists() for file in files):
        raise BadArtefact(f"{folder}: no Makefile; write one with `include $(shell clatter rules)`")
    programs = pathlib.Path(program("clatter-mesh")).resolve().parent
    names = [word for file in files for word in ("-f", file)]
    call(["make", "--no-print-directory", f"-j{jobs}", f"CLATTER_BIN={programs}", "CLATTER_FLAGS=--quiet", *names, *targets], folder)


def sweep(base, values, folder=".", output=None, field=None, jobs=1) -> dict:
    """Runs a scene with other values, every combination of several keys; returns {name of the scene: path of its run}.

        pipeline.sweep("step.run.toml", {"time.end_s": [0.02, 0.04]})

    base: the scene, in `folder`, whose Makefile, if it has one, makes the reduced models; values: {"table.key": [values]};
    output: folder of the scenes below `folder` (default: the scene's name with _sweep); field: settings by which clatter-recover
    makes a field of each run, beside it. Scenes that are up to date are not repeated."""
    output = output or f"{pathlib.Path(base).name.split('.')[0]}_sweep"
    keys = [f"{key}={','.join(map(str, own if isinstance(own, (list, tuple)) else [own]))}" for key, own in values.items()]
    call([program("clatter"), "sweep", base, *keys, "-o", output, *(["--field", field] if field else [])], folder)
    rules = pathlib.Path(folder, output, "sweep.mk").read_text(encoding="utf-8")
    names = re.search(r"^\S+_names := (.*)$", rules, re.M)[1].split()
    own = "Makefile" if pathlib.Path(folder, "Makefile").exists() else call([program("clatter"), "rules"]).strip()
    make(*(f"{output}/{name}.{kind}.h5" for name in names for kind in (("run", "field") if field else ("run",))),
         folder=folder, jobs=jobs, files=(own, f"{output}/sweep.mk"))
    return {name: pathlib.Path(folder, output, f"{name}.run.h5") for name in names}
