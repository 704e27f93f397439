# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter predict`: what a reduction by several processes will cost; `clatter-condense predict` under the name of the tools."""
import subprocess

from clatter.pipeline import program

PROGRAM = "clatter-condense"


def add_arguments(command):
    """Declares the arguments of `clatter predict`."""
    command.add_argument("model", metavar="part.fe.h5", help="assembled part")
    command.add_argument("--ranks", default="32", metavar="N", help="processes; default %(default)s")
    command.add_argument("-c", "--config", metavar="part.rom.toml", help="what to retain; without it nothing")
    command.add_argument("--gflops", metavar="RATE", help="of one core in a factorisation [1e9/s]; default: from a matrix product here")
    command.add_argument("--json", action="store_true", help="one line of JSON, with the counts of each rank")


def run(options):
    """Runs the stage's command; returns its exit code."""
    command = [program(PROGRAM), "predict", options.model, "--ranks", options.ranks]
    if options.config:
        command += ["-c", options.config]
    if options.gflops:
        command += ["--gflops", options.gflops]
    return subprocess.call([*command, "--json"] if options.json else command)
