# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of a slap that `clatter collect` puts into a sweep file, a row for each run."""
import numpy as np

from clatter import fields
from clatter.artefact import dataset
from . import slap

AT = "analysis/cycle"
SENSORS = ("liner", "block")
# Dataset in group slap: (unit, meaning).
NUMBERS = {
    "time": ("s", f"instant of the largest |acceleration| of the liner above {slap.FROM_HZ:g} Hz, from firing TDC"),
    "peak": ("m/s2", "that acceleration"),
    "rings_until": ("s", f"when its running rms has fallen to {slap.QUIET:g} of its peak, from firing TDC"),
    "high_rms": ("m/s2", f"rms of the liner around firing TDC above {slap.HIGH_HZ:g} Hz"),
    "block_peak": ("m/s2", "largest |acceleration| of the block, likewise"),
}


def of_field(field):
    """{name of NUMBERS: value, "mid_hz", "liner_db", "block_db": by third octave}; empty without a cycle or sensors of liner and block."""
    sensors = {part: fields.pick_sensor(field, AT, part) for part in SENSORS} if AT in field else {}
    if not sensors or not all(sensors.values()) or f"{AT}/third_octave/mid_hz" not in field:
        return {}
    signals = {part: slap.band_limited(field, sensor, AT) for part, sensor in sensors.items()}
    when, height = slap.peak(*signals["liner"])
    found = {"time": when, "peak": height, "rings_until": slap.rung_out(*signals["liner"]),
             "high_rms": slap.high_rms(field, sensors["liner"], AT), "block_peak": slap.peak(*signals["block"])[1]}
    found["mid_hz"] = dataset(field, f"{AT}/third_octave/mid_hz")
    for part in SENSORS:
        found[f"{part}_db"], _ = fields.acceleration_bands(field, sensors[part])
    return found


def fill(rows, put):
    """Writes the rows, which may be empty, by put(name, values, unit, meaning); nothing where all are."""
    known = [row for row in rows if row]
    if not known:
        return
    for name, (unit, meaning) in NUMBERS.items():
        put(f"slap/{name}", [row.get(name, np.nan) for row in rows], unit, meaning)
    widest = max((row["mid_hz"] for row in known), key=len)
    put("slap/mid_hz", widest, "Hz", "mid frequencies of the third octaves")
    for part in SENSORS:
        levels = np.full((len(rows), len(widest)), np.nan)
        for k, row in enumerate(rows):
            if row:
                levels[k, :len(row["mid_hz"])] = row[f"{part}_db"]
        put(f"slap/{part}_db", levels, "dB re 1e-6 m/s2", f"third octaves of the acceleration of the {part} over the cycle")
