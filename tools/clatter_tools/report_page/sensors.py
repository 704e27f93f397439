# SPDX-License-Identifier: GPL-3.0-or-later
"""Sensors: time signals, spectra, third octaves, spectrograms of a field's cycle."""
import numpy as np

from clatter import fields
from clatter.artefact import dataset, text
from .. import slap
from ..plots.octaves import short

QUANTITIES = {"acceleration": "m/s²", "velocity": "m/s"}
STRETCH_S = 2e-3      # of a spectrogram's window: a ringing of 2 ms is resolved to 500 Hz
COLUMNS = 360         # of a spectrogram
RANGE_DB = 80.0       # below its largest level nothing is kept


def collect(folder, pack):
    """Runs whose field has sensors."""
    runs = [found for found in (read(one, pack) for one in folder.with_field()) if found]
    return {"runs": runs, "from_hz": slap.FROM_HZ} if runs else None


def read(one, pack):
    field = one.field
    at = fields.piece(field, "cycle", *fields.pieces(field))
    names = fields.sensor_names(field, at)
    if not names:
        return None
    curve = lambda name: pack.add("curves", dataset(field, f"{at}/{name}"))  # noqa: E731
    cycle = at.endswith("/cycle")
    time = dataset(field, f"{at}/time")
    found = {"run": one.number, "cycle": cycle, "time": pack.add("curves", time), "frequency": curve("frequency_hz"),
             "duration": float(len(time) * (time[1] - time[0])), "channels": [],
             "bands": {"lower": curve("third_octave/lower_hz"), "upper": curve("third_octave/upper_hz"),
                       "names": [short(text(name)) for name in dataset(field, f"{at}/third_octave/nominal")]}}
    if f"{at}/crank_angle_deg" in field:
        found["angle"] = curve("crank_angle_deg")
    for name in names:
        sensor = f"{at}/sensors/{name}"
        turning = dataset(field, f"{sensor}/is_rotation")
        found["channels"] += [channel(pack, field, at, sensor, k, cycle)
                              for k in range(len(dataset(field, f"{sensor}/labels"))) if not turning[k]]
    return found


def channel(pack, field, at, sensor, k, cycle):
    """Signals of a channel; of a complete cycle also the part above slap.FROM_HZ and a spectrogram of the acceleration."""
    found = {"label": fields.channel_name(field, sensor, k), "thrust": k == fields.channel(field, sensor)}
    for quantity, unit in QUANTITIES.items():
        if f"{sensor}/{quantity}" not in field:
            continue
        one = {"unit": unit, "signal": pack.add("curves", field[f"{sensor}/{quantity}"][:, k])}
        if f"{sensor}/spectrum/{quantity}_re" in field:
            one["lines"] = [pack.add("curves", field[f"{sensor}/spectrum/{quantity}_{part}"][:, k]) for part in ("re", "im")]
        if f"{sensor}/third_octave/{quantity}_db" in field:
            levels = field[f"{sensor}/third_octave/{quantity}_db"]
            one["bands"] = pack.add("curves", levels[:, k])
            one["reference"] = fields.reference(levels)
        found[quantity] = one
    if cycle and "acceleration" in found:
        found["spectrogram"] = spectrogram(pack, dataset(field, f"{at}/time"), field[f"{sensor}/acceleration"][:, k],
                                           dataset(field, f"{at}/frequency_hz")[-1])
    return found


def spectrogram(pack, time, values, to_hz):
    """Levels [dB re 1e-6 m/s²] of a periodic signal in Hann windows of STRETCH_S, columns of equal steps in time."""
    step = time[1] - time[0]
    count = max(16, int(round(STRETCH_S / step)))
    columns = min(COLUMNS, len(values))
    centre = np.arange(columns) * len(values) // columns
    index = (centre[:, None] + np.arange(count) - count // 2) % len(values)
    taper = np.hanning(count + 1)[:-1]
    padded = 2 * count
    lines = np.abs(np.fft.rfft(values[index] * taper, padded, axis=1)) * (2.0 / taper.sum())
    frequency = np.fft.rfftfreq(padded, step)
    kept = frequency <= to_hz
    level = 20.0 * np.log10(np.maximum(lines[:, kept] / np.sqrt(2.0), 1e-12) / 1e-6)
    top = float(level.max())
    return {"levels": pack.scaled("spectrograms", np.maximum(level, top - RANGE_DB), 8), "columns": columns,
            "frequency_step": float(frequency[1]), "rows": int(kept.sum()), "window_ms": 1e3 * count * step}
