# SPDX-License-Identifier: GPL-3.0-or-later
"""Quantities of interest: numbers and curves taken from artefacts.

| take | from | own keys | what |
|---|---|---|---|
| frequency | modes, rom | number | that mode's frequency in the file's order, of a reduced model that of its own matrices, which its certificate covers up to half the cut-off [Hz] |
| line | field | sensor, at_hz | amplitude (peak) of the acceleration's line that is nearest to a frequency, of a channel by its label [m/s2] |
| slap_time | field | part, to_hz | of the liner's acceleration from 300 Hz to to_hz (without the key as far as the spectra reach, which is another quantity for each cut-off of the block): the first instant around firing TDC at which it reaches `part` of its largest value there, 0.75 without the key; 1: the instant of the largest, which jumps between peaks of about the same height (slap.py) [s] |
| slap_height, rings_until | field | to_hz | largest value of the same, and when it has rung out [m/s2, s] |
| third_octaves | field | of, from_hz, to_hz | curve of levels: of "sound", of panels/NAME (ERP) or of sensors/LABEL (acceleration); [dB] |
| power_dba | field | | sound power, of a mean over cycles with its standard error [dB(A) re 1 pW] |
| erp_dba | field | panel | equivalent radiated power of a panel, of a mean over cycles with its standard error [dB(A) re 1 pW] |
| order | run, field | of, order | RMS of half an engine order: of a history, of sensors/LABEL, panels/NAME, or "sound" |
| link_force | run | chain | largest tension of the joints of a chain over the last cycle [N] |
| loss | run | element | mean power that a force element loses over the last cycle (energy/terms) [W]: friction and film of piston_liner |
| cost | any | | seconds of the stage |
| dataset | any | path, reduce, column, last_cycle_only | any dataset or attribute (group@name), reduced to a number or kept as a curve |

reduce is one of first, last, min, max, largest (of magnitudes), range, mean, rms, curve. mean and rms of a history are over time: its rows are the steps of the
integration, not at equal times. A curve of it is at POINTS equal steps of the crank angle of its last cycle, or of its time.
"""
import dataclasses
import pathlib

import numpy as np

from clatter import fields
from clatter.artefact import BadArtefact, dataset, open_artefact, totals
from clatter.histories import crank_angle, has, time_weights
from clatter.modes import Modes
from clatter.rom import Rom
from .. import orders, slap, slap_rows
from ..keys.study_keys import TAKEN

POINTS = 1440
CYCLE_DEG = 720.0
DB = "dB"
EVERYTHING = 1e9     # Hz
THIRD = 10.0**0.1    # from one third octave to the next
REDUCTIONS = {
    "first": lambda x: x[0], "last": lambda x: x[-1], "min": np.min, "max": np.max, "largest": lambda x: np.max(np.abs(x)), "range": np.ptp,
}
MEANS = {"mean": lambda x, weights: weights @ x, "rms": lambda x, weights: np.sqrt(weights @ np.square(x))}


@dataclasses.dataclass
class Value:
    """A number, or a curve: values at `at`; of a number both have one entry. beyond: why the model does not state it; empty where it does. error:
    standard error of a mean, 0 of what is none."""
    values: np.ndarray
    at: np.ndarray
    beyond: str = ""
    error: float = 0.0

    def minus(self, other):
        """The difference where both are known; means of different runs are independent."""
        mine, others = self.common(other)
        if not len(mine):
            return Value(np.array([np.nan]), np.zeros(1))
        return Value(self.values[mine] - other.values[others], self.at[mine], error=float(np.hypot(self.error, other.error)))

    def common(self, other):
        """Indices of the entries that both have."""
        return np.intersect1d(np.round(self.at, 6), np.round(other.at, 6), return_indices=True)[1:]

    def product(self, other):
        """The sum of the products of the entries that both have."""
        mine, others = self.common(other)
        return float(self.values[mine] @ other.values[others])

    def plus(self, other):
        return self.minus(Value(-other.values, other.at, error=other.error))

    def times(self, factor):
        return Value(factor * self.values, self.at, error=abs(factor) * self.error)

    def size(self):
        """The largest magnitude."""
        return float(np.max(np.abs(self.values)))

    @property
    def is_number(self):
        return len(self.values) == 1

    def number(self):
        """With its sign; of a curve the entry of the largest magnitude."""
        return float(self.values[np.argmax(np.abs(self.values))]) if np.isfinite(self.values).all() else float("nan")


    def text(self, digits):
        """Of a number, with its standard error."""
        return f"{self.number():.{digits}g}{fields.error_text(self.error or np.nan)}"


def number(value):
    return Value(np.array([float(value)]), np.zeros(1))


@dataclasses.dataclass
class Quantity:
    """keys: those of `take`; exact: a Value, or None; relative: whether errors are relative; small: a change, as errors are given, that does not
    matter."""
    name: str
    file: str
    take: str
    keys: dict
    unit: str
    relative: bool
    small: float
    exact: Value = None

    def of(self, path):
        return extract(path, self.take, self.keys)


@dataclasses.dataclass
class Extractor:
    """take: function of an open file and the keys of a quantity, study_keys.TAKEN."""
    take: object
    unit: str


def frequency(file, number):
    wanted = number
    found = (Modes(file) if "frequency_hz" in file else Rom(file).modes()).frequency_hz
    if not 1 <= wanted <= len(found):
        raise BadArtefact(f"{file.filename}: found {len(found)} modes, expected mode {wanted}")
    limit = float(file["certificate"].attrs.get("accurate_to_hz", np.inf)) if "certificate" in file else np.inf
    beyond = f"{found[wanted - 1]:.4g} Hz of {limit:.4g} Hz" if found[wanted - 1] > limit else ""
    return Value(np.array([found[wanted - 1]]), np.zeros(1), beyond)


def line(file, sensor, at_hz):
    at = fields.piece(file, "cycle", *fields.pieces(file))
    path, column = fields.labelled(file, at, sensor)
    row = int(np.argmin(np.abs(dataset(file, f"{at}/frequency_hz") - at_hz)))
    return np.hypot(*(dataset(file, f"{path}/spectrum/acceleration_{part}")[row, column] for part in ("re", "im")))


def liner_signal(file, to_hz):
    """(time from firing TDC, acceleration of the liner, why it does not reach to_hz) of a field."""
    at = slap_rows.AT
    sensor = fields.pick_sensor(file, at, "liner") if at in file else None
    if not sensor:
        raise BadArtefact(f"{file.filename}: found no slap, expected a cycle with a sensor of the liner")
    hz = dataset(file, f"{at}/frequency_hz")
    beyond = f"spectra to {hz[-1]:.4g} Hz of {to_hz:.4g} Hz" if to_hz > 2.0 * hz[-1] - hz[-2] else ""
    return *slap.band_limited(file, sensor, at, to_hz=to_hz), beyond


def slap_time(file, part, to_hz):
    *signal, beyond = liner_signal(file, to_hz)
    return Value(np.array([slap.onset(*signal, part)]), np.zeros(1), beyond)


def slap_height(file, to_hz):
    *signal, beyond = liner_signal(file, to_hz)
    return Value(np.array([slap.peak(*signal)[1]]), np.zeros(1), beyond)


def rings_until(file, to_hz):
    *signal, beyond = liner_signal(file, to_hz)
    return Value(np.array([slap.rung_out(*signal)]), np.zeros(1), beyond)


def third_octaves(file, of, from_hz, to_hz):
    at = fields.piece(file, "cycle", *fields.pieces(file))
    kind, _, name = of.partition("/")
    if kind == "sensors":
        path, column = fields.labelled(file, at, name)
        levels = dataset(file, f"{path}/third_octave/acceleration_db")[:, column]
    else:
        levels = dataset(file, f"{at}/sound/third_octave/power_db" if kind == "sound" else f"{at}/panels/{name}/third_octave/erp_db")
    mid = dataset(file, f"{at}/third_octave/mid_hz")[:len(levels)]
    inside = (mid >= from_hz) & (mid <= to_hz)
    if not inside.any():
        raise BadArtefact(f"{file.filename}: found no third octave from {from_hz:g} to {to_hz:g} Hz")
    missing = to_hz < EVERYTHING and mid[-1] * THIRD <= to_hz
    return Value(levels[inside], mid[inside], f"third octaves to {mid[-1]:g} Hz of {to_hz:g} Hz" if missing else "")


def power_dba(file):
    at = fields.level_piece(file)
    found = fields.sound_power(file, at)
    if found is None:
        raise BadArtefact(f"{file.filename}: {at}/sound: found nothing, expected a field whose field.toml names a sound file")
    return mean(found.dba, found.error)


def erp_dba(file, panel):
    group = file[fields.panel(file, fields.level_piece(file), panel)]
    return mean(group.attrs["erp_dba"], fields.standard_error(group, "erp"))


def mean(value, error):
    """A number with its standard error, nan where there is none."""
    return dataclasses.replace(number(value), error=float(np.nan_to_num(error)))


def of_order(file, of, order):
    kind, _, name = of.partition("/")
    found = orders.of_sound(file) if of == "sound" else orders.of_panel(file, name) if kind == "panels" and name else \
        orders.of_field(file, name) if kind == "sensors" and name else orders.of_run(file, of)
    return orders.of_order(found[1], found[2], order)


def last_cycle(file, count):
    """Slice of the samples of the last complete cycle, all of them where there is none."""
    angle = crank_angle(file) if has(file, "crank_angle_deg") else np.zeros(0)
    if len(angle) != count or angle[-1] - angle[0] < CYCLE_DEG:
        return slice(None)
    return slice(int(np.searchsorted(angle, angle[-1] - CYCLE_DEG - 1e-6)), None)


def link_force(file, chain):
    group = file.get("history", {})
    found = [name for name in group if name.startswith(f"{chain}_tension_") and not name.endswith("_min")]
    if not found:
        raise BadArtefact(f"{file.filename}: history: found no {chain}_tension_..., expected a chain named {chain}")
    return max(np.max(values[last_cycle(file, len(values))]) for values in (dataset(file, f"history/{name}") for name in found))


def loss(file, element):
    lost, time, angle = (dataset(file, f"energy/{name}") for name in (f"terms/{element} lost", "time", "crank_angle_deg"))
    first = int(np.searchsorted(angle, angle[-1] - CYCLE_DEG - 1e-6)) if angle[-1] - angle[0] >= CYCLE_DEG else 0
    return -(lost[-1] - lost[first]) / (time[-1] - time[first])  # terms are works on the bodies


def of_dataset(file, path, reduce, column, last_cycle_only):
    group, at, name = path.partition("@")
    if at:
        if group not in file or name not in file[group].attrs:
            raise BadArtefact(f"{file.filename}: {group}: found no attribute {name}")
        return numbers_of(file, path, file[group].attrs[name])
    if path in file and not hasattr(file[path], "shape"):
        raise BadArtefact(f"{file.filename}: {path}: found a group with {', '.join(file[path])}, expected a dataset, or an attribute as {path}@name")
    values = numbers_of(file, path, dataset(file, path))
    if values.ndim == 2:
        if not 0 <= column < values.shape[1]:
            raise BadArtefact(f"{file.filename}: {path}: found {values.shape[1]} columns, expected column {column}")
        values = values[:, int(column)]
    if values.ndim > 2 or values.size == 0:
        raise BadArtefact(f"{file.filename}: {path}: found {' x '.join(map(str, values.shape))} values, expected a number, vector or table")
    values = np.atleast_1d(values)
    window = last_cycle(file, len(values)) if last_cycle_only else slice(None)
    if reduce in MEANS:
        return MEANS[reduce](values[window], weights(file, path, len(values), window))
    return REDUCTIONS[reduce](values[window]) if reduce != "curve" else curve(file, values, window)


def weights(file, path, count, window):
    """Of the mean over a dataset's rows: over time where its group, or one above, has their instants; else each counts alike."""
    for group in pathlib.PurePosixPath(path).parents:
        if f"{group}/time" in file and file[f"{group}/time"].shape == (count,):
            return time_weights(dataset(file, f"{group}/time")[window])
    return np.full(len(range(count)[window]), 1.0 / len(range(count)[window]))


def numbers_of(file, path, values):
    try:
        return np.asarray(values, float)
    except ValueError as error:
        raise BadArtefact(f"{file.filename}: {path}: found text, expected numbers") from error


def curve(file, values, window):
    """At POINTS equal steps of the crank angle or time of a history; of anything else by its rows."""
    for name in ("crank_angle_deg", "time"):
        if has(file, name) and file[f"history/{name}"].shape == values.shape:
            x = dataset(file, f"history/{name}")[window]
            grid = np.linspace(0.0, 1.0, POINTS + 1)
            return Value(np.interp(grid, (x - x[0]) / (x[-1] - x[0]), values[window]), grid)
    return Value(values[window], np.arange(len(values[window]), dtype=float))


TAKE = {
    "frequency": Extractor(frequency, "Hz"),
    "line": Extractor(line, "m/s2"),
    "slap_time": Extractor(slap_time, "s"),
    "slap_height": Extractor(slap_height, "m/s2"),
    "rings_until": Extractor(rings_until, "s"),
    "third_octaves": Extractor(third_octaves, DB),
    "power_dba": Extractor(power_dba, "dB(A)"),
    "erp_dba": Extractor(erp_dba, "dB(A)"),
    "order": Extractor(of_order, ""),
    "link_force": Extractor(link_force, "N"),
    "loss": Extractor(loss, "W"),
    "cost": Extractor(lambda file: totals(file)[0], "s"),
    "dataset": Extractor(of_dataset, ""),
}
COMMON = {"name", "file", "take", "unit", "error", "exact", "small"}
SMALL = 0.01       # relative change that does not matter
SMALL_DB = 0.1


def extract(path, take, keys):
    """The Value of an artefact; BadArtefact where it has none that is finite."""
    with open_artefact(path) as file:
        found = TAKE[take].take(file, **keys)
    found = found if isinstance(found, Value) else number(found)
    if not np.isfinite(found.values).all():
        raise BadArtefact(f"{path}: {take}: found {found.values[~np.isfinite(found.values)][0]}, expected a finite number")
    return found


def own_keys(where, entry):
    """(take, its keys with their defaults) of an entry that was checked."""
    take, found = entry["take"], {}
    known = TAKEN[take]
    for key in entry:
        if key not in known and key not in COMMON:
            raise BadArtefact(f"{where}.{key}: no key of {take}, which has {', '.join(known) or 'none of its own'}")
    for key, default in known.items():
        found[key] = entry.get(key, default)
        if found[key] is ...:
            raise BadArtefact(f"{where}.{key}: found nothing, {take} needs it")
    return take, found


def read(where, entry, folder):
    """The Quantity of a table [[quantity]] that was checked; `folder`: from which the files of `exact` are named."""
    take, keys = own_keys(where, entry)
    if not entry["file"].endswith(".h5") or "/" in entry["file"]:
        raise BadArtefact(f"{where}.file: found {entry['file']}, expected an artefact of the pipeline's folder, as slap.field.h5")
    unit = entry.get("unit", TAKE[take].unit)
    error = entry.get("error", "absolute" if unit.startswith(DB) or take in ("slap_time", "rings_until") or keys.get("reduce") == "curve" else "relative")
    small = entry.get("small", SMALL if error == "relative" else SMALL_DB if unit.startswith(DB) else None)
    return Quantity(entry["name"], entry["file"], take, keys, unit, error == "relative", small, exact(f"{where}.exact", entry.get("exact"), folder))


def exact(where, entry, folder):
    """A number, or what is taken from another file."""
    if entry is None:
        return None
    if not isinstance(entry, dict):
        return number(entry)
    take, keys = own_keys(where, entry)
    return extract(folder / entry["file"], take, keys)
