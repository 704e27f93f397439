# SPDX-License-Identifier: GPL-3.0-or-later
"""The formats of a hand-off: what each may contain, and which one a path means."""
import dataclasses
from collections.abc import Callable

from clatter.artefact import BadArtefact
from . import cfs, msh, nastran, numcalc, sensors, table, unv, vtu

NODAL = ("velocity", "displacement", "acceleration")
ALL = (*NODAL, "normal_velocity")


@dataclasses.dataclass(frozen=True)
class Format:
    """suffix ("" : a folder), the quantities that it may hold and those that it holds by default, and its functions.

    write(files, path, surface, motion, options, progress); write_sensors(files, path, channels) or None.
    """
    suffix: str
    write: Callable
    allowed: tuple = ALL
    default: tuple = ("velocity",)
    frames: bool = True
    needs_linear: bool = False
    write_sensors: Callable | None = None


FORMATS = {
    "unv": Format(".unv", unv.write, write_sensors=sensors.write_unv),
    "numcalc": Format("", numcalc.write, ("normal_velocity",), ("normal_velocity",), frames=False, needs_linear=True),
    "vtu": Format(".pvd", vtu.write, default=("velocity", "normal_velocity")),
    "cfs": Format(".cfs", cfs.write, default=("velocity", "normal_velocity")),
    "msh": Format(".msh", msh.write, default=("velocity", "normal_velocity")),
    "pch": Format(".pch", nastran.write, NODAL),
    "csv": Format(".csv", table.write, write_sensors=sensors.write_table),
}


def of(path, name):
    """(name, Format) by the name, or by the path's suffix where it is None."""
    name = name or next((key for key, one in FORMATS.items() if one.suffix == path.suffix and one.suffix), None)
    if name is None:
        endings = ", ".join(one.suffix for one in FORMATS.values() if one.suffix)
        found = f"the ending {path.suffix!r}" if path.suffix else "no ending"
        raise BadArtefact(f"{path}: found {found}, expected {endings}, or --format numcalc")
    if path.suffix != FORMATS[name].suffix and FORMATS[name].suffix:
        raise BadArtefact(f"{path}: found the ending {path.suffix!r}, expected {FORMATS[name].suffix} for --format {name}")
    return name, FORMATS[name]


def quantities_of(name, requested, skin="body"):
    """The quantities to write: the requested ones, or the format's own; of the acoustic skin the normal velocity where it may be."""
    default = FORMATS[name].default
    if skin == "acoustic" and "normal_velocity" in FORMATS[name].allowed:
        default = ("normal_velocity",)
    chosen = tuple(requested.split(",")) if requested else default
    for quantity in chosen:
        if quantity not in FORMATS[name].allowed:
            raise BadArtefact(f"--quantity {requested}: found {quantity!r}, expected {', '.join(FORMATS[name].allowed)} for {name}")
    return tuple(dict.fromkeys(chosen))
