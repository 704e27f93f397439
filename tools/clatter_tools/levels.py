# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter levels`: overall levels of a run, or over the speed of several, plain and A-weighted: sound power, radiated power of
panels, acceleration of sensors; of a mean over cycles with its standard error."""
import dataclasses

import numpy as np

from clatter.artefact import BadArtefact, open_artefact, schema_of, text
from . import orders
from .weighting import a_weight

@dataclasses.dataclass
class Curve:
    """One quantity, as sweep files name it: level [dB] and A-weighted level [dB] by crank speed [1/min]."""
    name: str
    points: dict  # {speed: (dB, dB(A), standard error [dB(A)], nan where there is none)}

    @property
    def is_power(self):
        return not self.name.startswith("sensors/")

    @property
    def reference(self):
        return "1 pW" if self.is_power else "1e-06 m/s²"

    def label(self):
        kind, _, name = self.name.partition("/")
        return "sound power" if kind == "sound" else f"ERP of {name}" if kind == "panels" else f"acceleration of {name}"

    def sorted(self):
        """(speeds, levels, A-weighted levels, standard errors of these)."""
        speeds = np.array(sorted(self.points))
        return (speeds, *np.array([self.points[speed] for speed in speeds]).T)


def add_arguments(command):
    """Declares the arguments of `clatter levels`."""
    command.add_argument("files", nargs="+", metavar="file.h5", help="field of a run, fields of runs at several speeds, or what `clatter collect` has made of them")
    command.add_argument("--sound", action="store_true", help="the sound power")
    command.add_argument("--panel", action="append", default=[], metavar="NAME", help="a panel's equivalent radiated power, as exposed")
    command.add_argument("--sensor", action="append", default=[], metavar="LABEL", help="a channel's acceleration, as sensor_arm.x")
    command.add_argument("--window", metavar="NAME", help="a window of the fields; default: the mean over cycles where there is one, else the cycle")
    command.add_argument("--where", action="append", default=[], metavar="KEY=VALUE", help="of the runs of a sweep those with this value of a key")
    command.add_argument("-o", "--output", default="levels.svg", metavar="picture", help="SVG or PNG; default %(default)s")


def of_acceleration(spectrum):
    """(dB, dB(A)) of all half orders but 0, each weighted at its frequency."""
    speed, order, rms, unit = spectrum
    power = (rms[1:] / orders.REFERENCE[unit]) ** 2
    sums = np.sum(power), np.sum(power * a_weight(order[1:] * speed / 60.0))
    return *(10.0 * np.log10(max(value, 1e-30)) for value in sums), np.nan


def of_field(field, name, window):
    """(speed, (dB, dB(A), standard error)) of a field file over its cycle or a window."""
    kind, _, one = name.partition("/")
    if kind == "sensors":
        spectrum = orders.of_field(field, one, window)
        return spectrum[0], of_acceleration(spectrum)
    speed = (orders.of_sound(field, window) if kind == "sound" else orders.of_panel(field, one, window))[0]
    at = orders.piece(field, window)
    group, level = (f"{at}/sound", "power") if kind == "sound" else (f"{at}/panels/{one}", "erp")
    found = field[group].attrs
    return speed, tuple(float(found.get(f"{level}_{what}", np.nan)) for what in ("db", "dba", "standard_error_dba"))


def of_sweep(sweep, name, where):
    """[(speed, (dB, dB(A), standard error))] of a sweep file."""
    spectra = orders.of_sweep(sweep, name, where)
    if name.startswith("sensors/"):
        return [(spectrum[0], of_acceleration(spectrum)) for spectrum in spectra]
    selected = orders.rows_where(sweep, where)
    error = f"{name}/standard_error_dba"
    columns = [sweep[key][()][selected] for key in ("speed_rpm", f"{name}/level_db", f"{name}/level_dba")]
    columns.append(sweep[error][()][selected] if error in sweep else np.full(len(columns[0]), np.nan))  # of an older file
    return [(float(speed), tuple(map(float, levels))) for speed, *levels in zip(*columns) if np.isfinite(levels[0])]


def read(path, names, where, window):
    """[(name, speed, levels)] of a file."""
    with open_artefact(path) as file:
        if text(file.attrs.get("schema", "")) == schema_of("sweep"):
            orders.refuse_window(file, window)
            return [(name, *point) for name in names for point in of_sweep(file, name, where)]
    with open_artefact(path, "field") as file:
        return [(name, *of_field(file, name, window)) for name in names]


def curves(options):
    """A curve of everything that the options name, in their order."""
    names = (["sound/power"] if options.sound else []) + [f"panels/{one}" for one in options.panel] + [f"sensors/{one}" for one in options.sensor]
    if not names:
        raise BadArtefact("levels: give --sound, --panel or --sensor")
    found = {name: Curve(name, {}) for name in names}
    for path in options.files:
        for name, speed, levels in read(path, names, options.where, options.window):
            speed = round(speed, 3)
            if found[name].points.setdefault(speed, levels)[:2] != levels[:2]:
                raise BadArtefact(f"levels: found two runs at {speed:g} rpm with different levels of {name}, expected one; --where selects")
    for curve in found.values():
        if not curve.points:
            raise BadArtefact(f"levels: found no run with {curve.name}, expected at least one")
    return list(found.values())


def write_levels(options):
    """`clatter levels`: the picture, and a table."""
    from .plots import levels, style  # which load matplotlib
    found = curves(options)
    style.apply()
    style.save(levels.picture(found), options.output)
    for curve in found:
        print(f"{curve.label()}, re {curve.reference}".replace("²", "2"))
        print(f"{'rpm':>8} {'dB':>8} {'dB(A)':>8}")
        for speed, plain, weighted, error in zip(*curve.sorted()):
            print(f"{speed:8.0f} {plain:8.1f} {weighted:8.1f}{'' if np.isnan(error) else f' +- {error:.2f}'}")
    print(options.output)
