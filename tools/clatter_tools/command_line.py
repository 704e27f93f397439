# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `clatter`: one subcommand per task, exit codes like the stages' (0 done, 2 bad input, 3 interrupted, 4 file or disk error)."""
import argparse
import errno
import os
import pathlib
import subprocess
import sys

from clatter.errors import BadArtefact, CannotWrite, Failed
from clatter.pipeline import program
from . import collect, doctor, drive_command, export_command, fired_cycle, info, levels, motored_cycle, predict, report, slaps, sweep
from .integrity import is_damage
from .keys import command as keys_command
from .new import command as new
from .run import command as run
from .study import command as study

EPILOG = """the stages: clatter-mesh, clatter-assembly, clatter-modal, clatter-condense, clatter-dynamics,
clatter-recover; each has --help. A Makefile of ten lines includes the rules: include $(shell clatter rules)"""


class Version(argparse.Action):
    """`--version`: that of the stages, which come with the command."""
    def __call__(self, top, *_):
        done = subprocess.run([program("clatter-mesh"), "--version"], capture_output=True, text=True)
        print(done.stdout.replace("clatter-mesh", "clatter"), end="")
        top.exit(done.returncode)


def parser():
    top = argparse.ArgumentParser(prog="clatter", description=__import__("clatter_tools").__doc__, epilog=EPILOG)
    top.add_argument("--version", action=Version, nargs=0, help="print the version and exit")
    commands = top.add_subparsers(dest="command", required=True, metavar="command")
    one = commands.add_parser("new", help="write a folder that runs: from a sample, a CAD file or a deck")
    new.add_arguments(one)
    one = commands.add_parser("doctor", help="check packages, programs, BLAS, memory, disk: what is missing, and the way out")
    doctor.add_arguments(one)
    one = commands.add_parser("info", help="contents, inputs, certificate and cost of an artefact")
    one.add_argument("files", nargs="+", metavar="file.h5")
    one.add_argument("--config", action="store_true", help="print the resolved configuration instead")
    one.add_argument("--verify", action="store_true", help="check every number against its checksum instead")
    one = commands.add_parser("run", help="bring a folder's artefacts up to date (make)")
    run.add_arguments(one)
    one = commands.add_parser("report", help="print the results of the runs in a folder, or write them as a page")
    one.add_argument("folders", nargs="*", metavar="folder", help="default: this one; two with --html are shown side by side")
    one.add_argument("--html", action="store_true", help="write one page of HTML with plots and a 3-D view instead")
    one.add_argument("-o", "--output", metavar="page.html", help="of --html; default: report.html in the folder")
    one = commands.add_parser("plot", help="draw a picture from artefacts")
    one.add_argument("kind", help="kind of picture; 'list' names them")
    one.add_argument("files", nargs="*", metavar="file.h5")
    one.add_argument("-o", "--output", help="PNG or SVG file; default: kind.png")
    one.add_argument("--at", metavar="LIST", help="of film: crank angles of the maps [deg], as --at=-20,0,10")
    drive_command.add_arguments(commands)
    one = commands.add_parser("sweep", help="write scenes of all combinations of some values, and make rules of their runs")
    sweep.add_arguments(one)
    one = commands.add_parser("collect", help="put levels, orders and cost of all runs of a sweep into one file")
    collect.add_arguments(one)
    one = commands.add_parser("slaps", help="rank the slaps of sweeps, or show them by parameter")
    slaps.add_arguments(one)
    one = commands.add_parser("study", help="what accuracy costs: errors and seconds over settings of a pipeline")
    study.add_arguments(one)
    one = commands.add_parser("levels", help="draw overall levels of a run, or over the speed of several")
    levels.add_arguments(one)
    one = commands.add_parser("export", help="write a field file's surface motion for acoustic programs")
    export_command.add_arguments(one)
    one = commands.add_parser("motored-cycle", help="write the pressure table of a motored engine, for [gas] of a scene")
    motored_cycle.add_arguments(one)
    one = commands.add_parser("fired-cycle", help="write the pressure table of a fired engine, for [gas] of a scene")
    fired_cycle.add_arguments(one)
    one = commands.add_parser("predict", help="say what the reduction of a part by several processes will cost")
    predict.add_arguments(one)
    keys_command.add_arguments(commands)
    one = commands.add_parser("rules", help="print the path of clatter.mk, for `include`")
    one.add_argument("--snakemake", action="store_true", help="of clatter.smk instead, for a Snakefile")
    return top


def angles(text):
    """The crank angles of --at [deg from firing TDC]."""
    try:
        found = [float(part) for part in text.split(",")]
    except ValueError:
        found = []
    if not found or not all(-360.0 <= angle <= 360.0 for angle in found):
        raise BadArtefact(f"--at: found {text}, expected crank angles from -360 to 360 separated by commas")
    return found


def plot(kind, files, output, at):
    from . import plots  # matplotlib is slow to load
    if kind == "list":
        for name, picture in plots.PICTURES.items():
            print(f"{name:<16} {picture.__doc__.strip().splitlines()[0]}")
        return 0
    if kind not in plots.PICTURES:
        raise BadArtefact(f"plot: no picture named {kind}; known: {', '.join(plots.PICTURES)}")
    if at is not None and kind != "film":
        raise BadArtefact(f"--at: found it for {kind}, expected it for film only")
    plots.draw(kind, files, output or f"{kind}.png", **({} if at is None else {"at_deg": angles(at)}))
    return 0


def write_report(options):
    folder, *others = options.folders or ["."]
    if len(others) > (1 if options.html else 0):
        raise BadArtefact(f"report: found {1 + len(others)} folders, expected one, or two with --html")
    if not options.html:
        if options.output:
            raise BadArtefact(f"--output: found {options.output}, expected it with --html only")
        report.print_report(folder)
        return
    from . import report_page  # which loads matplotlib
    path = report_page.write_page(folder, options.output, *others)
    print(f"{path}: {path.stat().st_size / 1e6:.1f} MB")


def finish_standard_output():
    """Writes what is left for standard output; CannotWrite when it, or a line before, could not be written (hard case P16)."""
    try:
        sys.stdout.flush()
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # of what is left Python would complain at its end
        if not isinstance(error, BrokenPipeError):
            raise CannotWrite(f"standard output: cannot be written: {error.strerror}") from error


def main(arguments, rules):
    """Runs one command line; returns the exit code."""
    options = parser().parse_args(arguments)
    code = run_command(options, rules)
    if sys.stdout is None:
        return code
    try:
        finish_standard_output()
    except CannotWrite as error:
        if code == 0:
            print(f"clatter: error: {error}", file=sys.stderr)
            return 4
    return code


def run_command(options, rules):
    """Runs one command; returns the exit code."""
    try:
        if options.command == "new":
            new.write_new(options)
        elif options.command == "doctor":
            return doctor.run(options)
        elif options.command == "info":
            show = info.print_verified if options.verify else info.print_config if options.config else info.print_info
            for path in options.files:
                show(path)
        elif options.command == "run":
            return run.run(options)
        elif options.command == "report":
            write_report(options)
        elif options.command == "plot":
            return plot(options.kind, options.files, options.output, options.at)
        elif options.command == "drive":
            drive_command.write_pictures(options)
        elif options.command == "orders":
            drive_command.write_orders(options)
        elif options.command == "sweep":
            sweep.write_sweep(options)
        elif options.command == "collect":
            collect.write_collection(options)
        elif options.command == "slaps":
            slaps.write_slaps(options)
        elif options.command == "study":
            study.write_study(options)
        elif options.command == "levels":
            levels.write_levels(options)
        elif options.command == "export":
            export_command.write_export(options)
        elif options.command == "motored-cycle":
            motored_cycle.write_motored_cycle(options)
        elif options.command == "fired-cycle":
            fired_cycle.write_fired_cycle(options)
        elif options.command == "predict":
            return predict.run(options)
        elif options.command == "keys":
            keys_command.print_keys(options)
        elif options.command == "schema":
            keys_command.print_schema(options)
        elif options.command == "rules":
            print(pathlib.Path(rules).with_suffix(".smk") if options.snakemake else rules)
    except BadArtefact as error:
        print(f"clatter: error: {error}", file=sys.stderr)
        return 2
    except Failed as error:
        print(f"clatter: error: {error}", file=sys.stderr)
        return 3
    except CannotWrite as error:
        print(f"clatter: error: {error}", file=sys.stderr)
        return 4
    except BrokenPipeError:
        return 0
    except KeyboardInterrupt:
        return 3
    except (OSError, RuntimeError, KeyError) as error:
        if isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EFBIG, errno.EDQUOT):  # of files: CannotWrite
            print(f"clatter: error: standard output: cannot be written: {error.strerror}", file=sys.stderr)
            return 4
        if not is_damage(error):
            raise
        print(f"clatter: error: a file was damaged after it was written (clatter info --verify names the dataset): {error}",
              file=sys.stderr)
        return 2
    return 0
