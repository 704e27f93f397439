# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter run`: brings a folder up to date by make, with a line a stage on a terminal, and sums up what was made."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

from clatter import pipeline
from clatter.errors import BadArtefact
from . import screen, summary

STAGE = pathlib.Path(__file__).resolve().parent / "stage.sh"


def add_arguments(one):
    one.add_argument("words", nargs="*", metavar="folder | target",
                     help="the folder with the Makefile, this one without it, then targets of make")
    one.add_argument("-j", "--jobs", type=int, default=1, metavar="N", help="number of stages that run in parallel")


def run(options):
    """`clatter run`; returns make's exit code, 3 when it was interrupted."""
    folder, *targets = options.words or ["."]
    if not (pathlib.Path(folder) / "Makefile").exists() and pathlib.Path("Makefile").exists():
        folder, targets = ".", options.words
    if not (pathlib.Path(folder) / "Makefile").exists():
        raise BadArtefact(f"{folder}: no Makefile; `clatter new` writes a folder with one, "
                          "or write one with `include $(shell clatter rules)`")
    if options.jobs < 1:
        raise BadArtefact(f"--jobs: found {options.jobs}, expected at least 1")
    command = ["make", "--no-print-directory", "-C", folder, f"-j{options.jobs}", *targets]
    began = time.time()
    code = watched(command) if sys.stdout.isatty() else plain(command)
    summary.print_made(pathlib.Path(folder), began)
    return code


def environment():
    """That of make, with the folder of the programs; without one the rules say what is missing, if they need it."""
    mesh = pipeline.find("clatter-mesh")
    return pipeline.environment(**({"CLATTER_BIN": os.path.dirname(os.path.abspath(mesh))} if mesh else {}))


def finished(make, tick=None):
    """Make's exit code, at its end; SIGTERM is passed on, and make passes it on to the stages."""
    signal.signal(signal.SIGTERM, lambda *_: make.terminate())
    while True:
        try:
            code = make.wait(timeout=None if tick is None else screen.TICK_S)
            return code if code >= 0 else 3
        except subprocess.TimeoutExpired:
            tick()
        except KeyboardInterrupt:  # the terminal has told make and the stages: they end by themselves
            continue


def plain(command):
    sys.stdout.flush()
    return finished(subprocess.Popen(command, env=environment()))


def watched(command):
    """On a terminal: stages have a line each, and what they print is shown where one fails or warns."""
    with tempfile.TemporaryDirectory(prefix="clatter-run-") as notes:
        own = environment()
        own["CLATTER_RUN"] = notes
        own["CLATTER_LAUNCH"] = f"sh '{STAGE}' {own.get('CLATTER_LAUNCH', '')}".strip()
        with open(os.path.join(notes, "make"), "wb") as output:
            make = subprocess.Popen([*command, "--silent"], env=own, stdout=output, stderr=subprocess.STDOUT)
        shown = screen.Screen(pathlib.Path(notes))
        code = finished(make, shown.tick)
        shown.tick(last=True)
        return code
