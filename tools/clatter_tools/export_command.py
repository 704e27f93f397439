# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter export`: a field file for acoustic programs."""
import dataclasses
import os
import pathlib
import sys
import time

import numpy as np

from clatter.artefact import BadArtefact, open_artefact, text
from .export import acoustic_source, derived, field_source, formats, sensors
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
    command.add_argument("--histories", action="store_true", help="with --sensors: their histories in time instead")
    command.add_argument("--skin", choices=("body", "acoustic"), default="body", help="whose motion: of the body, or of the closed acoustic skin around it, "
                         "where the field.toml names a sound file; default: body")
    command.add_argument("--at", metavar="list", help="only these frequencies [Hz] or instants [s]: numbers and ranges low:high, "
                         "joined by commas; --at=-0.001:0.002 where the first is negative")
    command.add_argument("--quantity", metavar="names", help="velocity, displacement, acceleration, normal_velocity, joined by commas; "
                         "default: velocity, in .pvd, .cfs and .msh also normal_velocity, in NumCalc's folder and of the acoustic skin normal_velocity alone")
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


def stored_motion(file, kind, skin):
    """(surface, motion) of a skin as the file has them."""
    if skin == "acoustic":
        surface = acoustic_source.read_surface(file)
        return surface, acoustic_source.read_motion(file, surface)
    surface = field_source.read_surface(file)
    return surface, field_source.read_motion(file, kind, surface)


def motion_to_write(file, options, form, quantities):
    """(surface, motion) with everything that the options change."""
    present = field_source.kinds(file)
    kind = options.kind or (present[0] if present and options.skin == "body" else "lines")
    if kind == "frames" and not form.frames:
        raise BadArtefact("--frames: found a format that has lines only")
    if kind == "frames" and options.skin == "acoustic":
        raise BadArtefact("--frames: found --skin acoustic, which has lines only")
    surface, motion = stored_motion(file, kind, options.skin)
    motion = derived.with_time_derivatives(motion)
    for quantity in quantities:
        if quantity not in motion.quantities:
            raise BadArtefact(f"{file.filename}: {kind}/{quantity}: missing; {kind} have {', '.join(motion.quantities)}")
    if options.at:
        motion = derived.selected(motion, options.at)
    return derived.split(surface, motion) if options.linear or form.needs_linear else (surface, motion)


def chosen_of(file, motion, asked):
    """What a field file left out between the lowest and the highest line that is written; "" for frames, where it
    left out none, and where lines were `asked` for one by one."""
    at = f"analysis/{text(file['lines'].attrs.get('analysis', 'cycle'))}/frequency_hz" if "lines" in file else "none"
    if motion.kind != "lines" or at not in file or (asked and ":" not in asked):
        return ""
    hz = file[at][()]
    between = np.count_nonzero((hz >= min(motion.at) * (1.0 - 1e-9)) & (hz <= max(motion.at) * (1.0 + 1e-9)))
    return f" (of {between} in this range: [lines] from_hz, to_hz in field.toml store them all)" if between > len(motion.at) else ""


def write_motion(file, path, options, name, form):
    """Writes lines or frames; returns the paths and a summary."""
    quantities = formats.quantities_of(name, options.quantity, options.skin)
    surface, motion = motion_to_write(file, options, form, quantities)
    with WholeFiles() as files:
        form.write(files, path, surface, motion, Options(quantities, options.dataset), progress)
    return files.paths, (f"{len(motion.at)} {motion.kind}{chosen_of(file, motion, options.at)} of {', '.join(quantities)}, {len(surface.nodes)} nodes, "
                         f"{len(surface.triangles)} faces of {surface.triangles.shape[1]} nodes")


def write_sensors(file, path, options, name, form):
    """Writes spectra or histories of the sensors; returns the paths and a summary."""
    if form.write_sensors is None:
        raise BadArtefact(f"--sensors: found the format {name}, expected .unv or .csv")
    if options.at or options.linear or options.skin != "body":
        raise BadArtefact("--sensors: found --at, --linear or --skin, which are for the surface")
    quantities = formats.quantities_of(name, options.quantity)
    if len(quantities) != 1 or quantities[0] not in formats.NODAL:
        raise BadArtefact(f"--quantity {options.quantity}: expected one of {', '.join(formats.NODAL)} for --sensors")
    channels = sensors.read_channels(file, quantities[0], options.histories)
    with WholeFiles() as files:
        form.write_sensors(files, path, channels)
    kind, steps = ("spectra", "frequencies") if channels.is_spectrum else ("histories", "instants")
    return files.paths, f"{len(channels.labels)} {kind} of {quantities[0]}, {len(channels.at)} {steps} each"


def write_export(options):
    """`clatter export`: writes the files; prints what they contain."""
    if options.histories and options.kind != "sensors":
        raise BadArtefact("--histories needs --sensors")
    path, begin = pathlib.Path(options.output), time.monotonic()
    name, form = formats.of(path, options.format)
    with open_artefact(options.file, "field") as file:
        if path.exists() and os.path.samefile(path, options.file):
            raise BadArtefact(f"{path}: found the input, expected another output")
        write = write_sensors if options.kind == "sensors" else write_motion
        paths, summary = write(file, path, options, name, form)
    print(f"{path}: {summary}, {size_of(paths) / 1e6:.1f} MB, {time.monotonic() - begin:.1f} s")
