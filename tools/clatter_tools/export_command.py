# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter export`: a field file for acoustic programs."""
import dataclasses
import os
import pathlib
import sys
import time

from .artefact import BadArtefact, open_artefact
from .export import derived, field_source, formats, sensors
from .export.whole_files import WholeFiles

SECONDS_BETWEEN = 2.0  # progress lines


@dataclasses.dataclass(frozen=True)
class Options:
    """What a format is told besides the surface and its motion."""
    quantities: tuple
    dataset: int  # of universal files: 2414 or 55


def add_arguments(command):
    """Declares the arguments of `clatter export`."""
    command.add_argument("file", metavar="file.field.h5")
    command.add_argument("-o", "--output", required=True, metavar="out", help="file; its ending is the format: .unv, .pvd (with .vtu files), "
                         ".cfs (openCFS), .msh (Gmsh), .pch (Nastran, with .bdf), .csv; a folder with --format numcalc")
    command.add_argument("--format", choices=formats.FORMATS, help="default: by the ending of the output")
    kind = command.add_mutually_exclusive_group()
    kind.add_argument("--lines", dest="kind", action="store_const", const="lines",
                      help="complex lines over frequency; the default where the file has lines")
    kind.add_argument("--frames", dest="kind", action="store_const", const="frames", help="instants in time")
    kind.add_argument("--sensors", dest="kind", action="store_const", const="sensors", help="spectra of the sensors (.unv, .csv)")
    command.add_argument("--at", metavar="list", help="only these frequencies [Hz] or instants [s]: numbers and ranges low:high, "
                         "joined by commas; --at=-0.001:0.002 where the first is negative")
    command.add_argument("--quantity", metavar="names", help="velocity, displacement, acceleration, normal_velocity, joined by commas; "
                         "default: velocity, in .pvd, .cfs and .msh also normal_velocity, in NumCalc's folder normal_velocity alone")
    command.add_argument("--linear", action="store_true", help="write each 6-node triangle as four 3-node ones; always so for NumCalc")
    command.add_argument("--dataset", type=int, choices=(55, 2414), default=2414, help="of results in .unv; default: 2414")


def progress(count):
    """range(count) that reports on stderr now and then."""
    last = begin = time.monotonic()
    for k in range(count):
        yield k
        if time.monotonic() - last > SECONDS_BETWEEN:
            last = time.monotonic()
            print(f"clatter export: {k + 1} of {count} written, {last - begin:.0f} s", file=sys.stderr)


def size_of(paths):
    """Bytes of files and folders."""
    return sum(file.stat().st_size for path in paths for file in (path.rglob("*") if path.is_dir() else [path]) if file.is_file())


def motion_to_write(file, options, form, quantities):
    """(surface, motion) with everything that the options change."""
    present = field_source.kinds(file)
    kind = options.kind or (present[0] if present else "lines")
    if kind == "frames" and not form.frames:
        raise BadArtefact(f"--frames: found a format that has lines only")
    surface = field_source.read_surface(file)
    motion = derived.with_time_derivatives(field_source.read_motion(file, kind, surface))
    for quantity in quantities:
        if quantity not in motion.quantities:
            raise BadArtefact(f"{file.filename}: {kind}/{quantity}: missing; {kind} have {', '.join(motion.quantities)}")
    if options.at:
        motion = derived.selected(motion, options.at)
    return derived.split(surface, motion) if options.linear or form.needs_linear else (surface, motion)


def write_motion(file, path, options, name, form):
    """Writes lines or frames; returns the paths and a summary."""
    quantities = formats.quantities_of(name, options.quantity)
    surface, motion = motion_to_write(file, options, form, quantities)
    with WholeFiles() as files:
        form.write(files, path, surface, motion, Options(quantities, options.dataset), progress)
    return files.paths, (f"{len(motion.at)} {motion.kind} of {', '.join(quantities)}, {len(surface.nodes)} nodes, "
                         f"{len(surface.triangles)} faces of {surface.triangles.shape[1]} nodes")


def write_sensors(file, path, options, name, form):
    """Writes spectra of the sensors; returns the paths and a summary."""
    if form.write_sensors is None:
        raise BadArtefact(f"--sensors: found the format {name}, expected .unv or .csv")
    if options.at or options.linear:
        raise BadArtefact("--sensors: found --at or --linear, which are for the surface")
    quantities = formats.quantities_of(name, options.quantity)
    if len(quantities) != 1 or quantities[0] not in formats.NODAL:
        raise BadArtefact(f"--quantity {options.quantity}: expected one of {', '.join(formats.NODAL)} for --sensors")
    spectra = sensors.read_spectra(file, quantities[0])
    with WholeFiles() as files:
        form.write_sensors(files, path, spectra)
    return files.paths, f"{len(spectra.labels)} spectra of {quantities[0]}, {len(spectra.frequency)} frequencies each"


def write_export(options):
    """`clatter export`: writes the files; prints what they contain."""
    path, begin = pathlib.Path(options.output), time.monotonic()
    name, form = formats.of(path, options.format)
    with open_artefact(options.file, "field") as file:
        if path.exists() and os.path.samefile(path, options.file):
            raise BadArtefact(f"{path}: found the input, expected another output")
        write = write_sensors if options.kind == "sensors" else write_motion
        paths, summary = write(file, path, options, name, form)
    print(f"{path}: {summary}, {size_of(paths) / 1e6:.1f} MB, {time.monotonic() - begin:.1f} s")
