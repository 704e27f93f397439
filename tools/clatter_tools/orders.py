# SPDX-License-Identifier: GPL-3.0-or-later
"""Order analysis: amplitudes of a signal over the crank angle, in bands half an engine order wide."""
import numpy as np

from clatter import fields
from clatter.artefact import BadArtefact, dataset, text
from clatter.chains import CYCLE_DEG, complete_cycles, crank_angle
from clatter.fields import labelled
from .weighting import a_weight

# References of levels in dB (ISO 1683); quantities of other units are shown as they are. A power is kept as its root, "W^0.5", whose
# squares add like those of an RMS; that of an A-weighted one is in "W(A)^0.5".
REFERENCE = {"m/s2": 1e-6, "m/s": 1e-9, "W^0.5": 1e-6, "W(A)^0.5": 1e-6}
LEVEL_NAME = {"W^0.5": "level [dB re 1 pW]", "W(A)^0.5": "level [dB(A) re 1 pW]"}


def whole_cycles(angle, wanted=None):
    """How many of the complete cycles at the end to analyse: the last third of them, at least one; 0: there is none."""
    complete = complete_cycles(angle)
    return min(complete, wanted or max(1, complete // 3))


def over_angle(angle, values, cycles):
    """The signal at equal steps of crank angle over the last cycles: piecewise linear between its samples, and so finely that
    each of them counts."""
    begin = angle[-1] - cycles * CYCLE_DEG
    samples = np.count_nonzero(angle >= begin)
    count = 1 << max(10, int(np.ceil(np.log2(2.0 * samples))))
    return np.interp(begin + np.arange(count) * (cycles * CYCLE_DEG / count), angle, values)


def half_orders(angle, values, cycles):
    """(orders 0, 0.5, 1, ..., RMS of the signal in the band of half an order around each) over the last cycles. A constant is
    in order 0, whose value is its size."""
    signal = over_angle(angle, values, cycles)
    lines = np.abs(np.fft.rfft(signal)) / len(signal)
    power = 2.0 * lines**2
    power[0] = lines[0] ** 2
    band = np.floor(np.arange(len(power)) / cycles + 0.5).astype(int)
    rms = np.sqrt(np.bincount(band, power))
    resolved = np.count_nonzero(angle >= angle[-1] - cycles * CYCLE_DEG) // (2 * cycles)  # below the samples' own Nyquist limit
    rms = rms[:max(2, min(len(rms), resolved))]
    return 0.5 * np.arange(len(rms)), rms


def of_run(run, name, cycles=None):
    """(speed [1/min], orders, RMS, unit) of a history of a run."""
    values = dataset(run, f"history/{name}")
    angle, time = crank_angle(run), dataset(run, "history/time")
    count = whole_cycles(angle, cycles)
    if count == 0:
        raise BadArtefact(f"{run.filename}: found {(angle[-1] - angle[0]) / CYCLE_DEG:.2g} cycles of {CYCLE_DEG:g} deg, "
                          "expected at least one for orders")
    first = int(np.searchsorted(angle, angle[-1] - count * CYCLE_DEG - 1e-6))
    rpm = (angle[-1] - angle[first]) / (time[-1] - time[first]) / 6.0
    return rpm, *half_orders(angle, values, count), text(run[f"history/{name}"].attrs.get("unit", ""))


def in_half_orders(order, power):
    """(orders 0, 0.5, 1, ..., RMS in the band of half an order around each) of mean squares by line."""
    band = np.floor(2.0 * order + 0.5).astype(int)
    rms = np.sqrt(np.bincount(band, power))
    return 0.5 * np.arange(len(rms)), rms


def piece(field, window):
    """Path of a window in a field file; without one of the mean over cycles where the file has it, else of the cycle."""
    found = list(field.get("analysis", {}))
    if window is not None and window not in found:
        raise BadArtefact(f"{field.filename}: analysis: found {', '.join(found) or 'none'}, expected {window}")
    return f"analysis/{window or fields.mean_of_cycles(field)[0] or 'cycle'}"


def refuse_window(sweep, window):
    """Sweep files have the cycles of their fields alone."""
    if window is not None:
        raise BadArtefact(f"{sweep.filename}: found a sweep file with --window {window}, expected fields: a sweep file has their cycles alone")


def of_field(field, label, window=None):
    """The same of the acceleration of a sensor's channel in a field file, by its label; over the cycle, or a window."""
    at = piece(field, window)
    sensor, channel = labelled(field, at, label)
    if f"{sensor}/spectrum/acceleration_power" in field:  # a mean over segments
        power = dataset(field, f"{sensor}/spectrum/acceleration_power")[:, channel]
    else:
        power = sum(dataset(field, f"{sensor}/spectrum/acceleration_{part}")[:, channel] ** 2 for part in ("re", "im")) / 2.0  # amplitudes are peaks
    return float(field[at].attrs["speed_rpm"]), *in_half_orders(dataset(field, f"{at}/order"), power), "m/s2"


def of_power(field, at, name, power):
    """The same of a power per line, whose root stands for the RMS."""
    lines = dataset(field, f"{at}/{name}/{power}")
    return float(field[at].attrs["speed_rpm"]), *in_half_orders(dataset(field, f"{at}/order"), lines), "W^0.5"


def of_panel(field, panel, window=None):
    """The same of the equivalent radiated power of a panel."""
    at = piece(field, window)
    if f"{at}/panels/{panel}" not in field:
        raise BadArtefact(f"{field.filename}: {at}/panels: found {', '.join(field[f'{at}/panels']) if at in field else 'none'}, expected {panel}")
    return of_power(field, at, f"panels/{panel}", "erp")


def of_sound(field, window=None):
    """The same of the sound power."""
    at = piece(field, window)
    if f"{at}/sound" not in field:
        raise BadArtefact(f"{field.filename}: {at}/sound: found nothing, expected a field whose field.toml names a sound file")
    return of_power(field, at, "sound", "power")


def rows_where(sweep, conditions):
    """Which rows of a sweep file have these values, ["contact.clearance_um=10"]."""
    wanted = np.ones(len(sweep["name"]), bool)
    for condition in conditions:
        key, _, value = condition.partition("=")
        if f"keys/{key}" not in sweep:
            raise BadArtefact(f"{sweep.filename}: keys: found {', '.join(sweep['keys'])}, expected {key}")
        values = dataset(sweep, f"keys/{key}")
        try:
            same = np.isclose(values, float(value), rtol=1e-9, atol=0.0) if values.dtype.kind == "f" else values == value.encode()
        except ValueError as error:
            raise BadArtefact(f"--where {condition}: found {value}, expected a number, as {key} has") from error
        if not same.any():
            raise BadArtefact(f"--where {condition}: found no such run; {key} is {', '.join(dict.fromkeys(map(shown, values)))}")
        wanted &= same
    return wanted


def shown(value):
    return text(value) if isinstance(value, bytes) else f"{value:g}"


def of_sweep(sweep, name, where=()):
    """Those of all runs of a sweep file that `where` selects; `name` as sensors/sensor_arm.x, panels/exposed,
    histories/chain_intake_speed."""
    if f"{name}/rms" not in sweep:
        kind = name.split("/")[0]
        raise BadArtefact(f"{sweep.filename}: found {', '.join(sweep[kind]) if kind in sweep else f'no {kind}'}, expected {name}")
    rows, unit = dataset(sweep, f"{name}/rms"), text(sweep[f"{name}/rms"].attrs["unit"])
    found = []
    selected = rows_where(sweep, where)
    for speed, rms in zip(dataset(sweep, "speed_rpm")[selected], rows[selected]):
        known = rms[~np.isnan(rms)]
        if len(known):
            found.append((float(speed), 0.5 * np.arange(len(known)), known, unit))
    return found


def a_weighted(spectrum):
    """A power's (speed [1/min], orders, RMS, unit) with the A-weighting of each half order's frequency."""
    speed, order, rms, unit = spectrum
    if unit != "W^0.5":
        raise BadArtefact(f"--a-weighting: found a quantity in {unit}, expected a power")
    return speed, order, rms * np.sqrt(a_weight(order * speed / 60.0)), "W(A)^0.5"


def fluctuation(rms):
    """RMS of all orders but 0."""
    return float(np.sqrt(np.sum(rms[1:] ** 2)))


def of_order(orders, rms, order):
    """RMS in the band of an order, a multiple of one half; nan beyond what was resolved."""
    index = int(round(2 * order))
    return float(rms[index]) if index < len(orders) else np.nan


def level(rms, unit):
    """In dB where the unit has a reference, else as it is."""
    return 20.0 * np.log10(np.maximum(rms, 1e-30) / REFERENCE[unit]) if unit in REFERENCE else rms


def level_name(unit):
    """Of an axis: "level [dB re 1e-06 m/s²]"."""
    pretty = unit.replace("m/s2", "m/s²")
    if unit in LEVEL_NAME:
        return LEVEL_NAME[unit]
    return f"level [dB re {REFERENCE[unit]:g} {pretty}, RMS]" if unit in REFERENCE else f"RMS [{pretty}]"


def peak_of(speeds, values):
    """The speed of the largest value, by a parabola through it and its neighbours, and that value."""
    order = np.argsort(speeds)
    x, y = np.asarray(speeds, float)[order], np.asarray(values, float)[order]
    top = int(np.nanargmax(y))
    if not 0 < top < len(x) - 1:
        return x[top], y[top]
    a, b, c = np.polyfit(x[top - 1:top + 2] - x[top], y[top - 1:top + 2], 2)
    if not a < 0.0:
        return x[top], y[top]
    at = float(np.clip(-0.5 * b / a, x[top - 1] - x[top], x[top + 1] - x[top]))
    return x[top] + at, c + b * at + a * at * at
