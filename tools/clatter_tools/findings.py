# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of a report, taken from artefacts; "-": not in the file."""
import pathlib

import numpy as np

from clatter import artefact, fields
from clatter.histories import cylinders, last_cycle, of
from . import slap
from .weighting import SILENCE, loudest_peaks

RUN_HEAD = ["lateral [µm]", "tilt [mrad]", "min gap [µm]", "side force [kN]", "energy residue", "from cycle to cycle [µm]"]
NOTHING = "-"


def fe_size(fe):
    """Number of DoFs of the full model."""
    return int(fe["K"].attrs["shape"][0]) if "K" in fe else NOTHING


def reduced_size(fe_path):
    """Number of reduced coordinates in the .rom.h5 of the same name as an .fe.h5."""
    rom = pathlib.Path(str(fe_path).replace(".fe.h5", ".rom.h5"))
    if not rom.exists():
        return NOTHING
    with artefact.open_artefact(rom, "rom") as file:
        return len(file["M_rr"])


def mass(fe):
    """[mass in kg as text]."""
    return [f"{fe['mass'].attrs['mass']:.3f}" if "mass" in fe and "mass" in fe["mass"].attrs else NOTHING]


def spread(run, name, scale, window):
    """"low .. high" of a history over the last cycle."""
    if f"history/{name}" not in run:
        return NOTHING
    values = run[f"history/{name}"][()][window] * scale
    return f"{values.min():.1f} .. {values.max():.1f}"


def run_rows(run):
    """(cylinder, the cells of RUN_HEAD) for each cylinder; the name is empty where there is one without a name."""
    window = slice(None)
    if "history/crank_angle_deg" in run:
        window = last_cycle(artefact.dataset(run, "history/crank_angle_deg"))
    proved = artefact.certificate(run)
    residue = f"{proved['energy_residue']:.2e}" if "energy_residue" in proved else NOTHING
    rows = []
    for cylinder in cylinders(run, "piston_lateral") or [""]:
        gap = NOTHING
        if f"history/{of(cylinder, 'film_min')}" in run:
            gap = f"{run['history/' + of(cylinder, 'film_min')][()][window].min() * 1e6:.2f}"
        change = proved.get(f"periodicity_lateral_{cylinder}" if cylinder else "periodicity_lateral")
        rows.append((cylinder, [spread(run, of(cylinder, "piston_lateral"), 1e6, window),
                                spread(run, of(cylinder, "piston_tilt"), 1e3, window), gap,
                                spread(run, of(cylinder, "side_force"), 1e-3, window), residue,
                                NOTHING if change is None else f"{change * 1e6:.2f}"]))
    return rows


FIELD_HEAD = ["slap after FTDC [ms]", "rings until [ms]", "liner peak [m/s²]", "block peak [m/s²]",
              f"liner rms above {slap.HIGH_HZ / 1000:g} kHz [m/s²]", "sound power [dB(A) re 1 pW]", "ERP [dB(A) re 1 pW]"]
PEAKS = 5  # of a radiated power, that are named


def field_row(field):
    """The cells of FIELD_HEAD; peaks and times of accelerations above slap.FROM_HZ."""
    pieces = fields.pieces(field)
    at = f"analysis/{'cycle' if 'cycle' in pieces else pieces[0]}"
    sensors = {part: fields.pick_sensor(field, at, part) if "cycle" in pieces else None for part in ("liner", "block")}
    row = [NOTHING] * 5
    if sensors["liner"]:
        time, values = slap.band_limited(field, sensors["liner"], at)
        when, height = slap.peak(time, values)
        row[:3] = f"{when * 1e3:.2f}", f"{slap.rung_out(time, values) * 1e3:.2f}", f"{height:.3g}"
        row[4] = f"{slap.high_rms(field, sensors['liner'], at):.3g}"
    if sensors["block"]:
        row[3] = f"{slap.peak(*slap.band_limited(field, sensors['block'], at))[1]:.3g}"
    mean = fields.level_piece(field)
    sound = fields.sound_power(field, mean)
    return [*row, sound.level() if sound else NOTHING, fields.radiated_estimate(field, mean).level()]


PANEL_HEAD = ["panel", "area [m²]", "ERP [dB(A) re 1 pW]", "sound power [dB(A) re 1 pW]", "share, unweighted [%]"]
PANELS = "Sound power that leaves through each panel, of boundary elements, with what the other panels do to it"


def panel_rows(field):
    """Rows of PANEL_HEAD, the largest share first; none without the sound powers of panels. A panel may take up what others send, as a
    whole or A-weighted."""
    at = f"{fields.level_piece(field)}/panels"
    panels = [(name, panel.attrs) for name, panel in field.get(at, {}).items()
              if name not in ("skin", "exposed") and "sound_power_share" in panel.attrs]
    return [[name.replace("_", " "), f"{of['area_m2']:.3f}", f"{of['erp_dba']:.1f}",
             f"{of['sound_power_dba']:.1f}" if of["sound_power_share"] > 0.0 and of["sound_power_dba"] > SILENCE else "takes up",
             f"{100.0 * of['sound_power_share']:.1f}"]
            for name, of in sorted(panels, key=lambda one: -one[1]["sound_power_share"])]


def loudness(label, field):
    """(level [dB(A)], sentence) of what a field radiates over its cycle, the mean of its cycles, or its first piece: by its sound power, or else its
    ERP."""
    at = fields.level_piece(field)
    power = fields.radiated(field, at)
    frequency = artefact.dataset(field, f"{at}/frequency_hz")
    # In the band of the levels; the file has all lines.
    peaks = frequency[loudest_peaks(frequency, artefact.dataset(field, power.power), PEAKS, field.attrs.get("spectra_from_hz", 0.0))]
    bands = artefact.dataset(field, power.bands)
    band = artefact.text(artefact.dataset(field, f"{at}/third_octave/nominal")[int(np.argmax(bands))])
    lines = f", lines at {', '.join(f'{hz:.0f}' for hz in peaks)} Hz" if len(peaks) else ""
    return power.dba, f"{label}: {power.level()} dB(A) of {power.name} re 1 pW{cycles_text(field)}; loudest are the third octave of {band} Hz{lines}"


def cycles_text(field):
    """" (mean of 8 cycles)"; empty where a field has no such mean."""
    name, cycles = fields.mean_of_cycles(field)
    return f" (mean of {cycles} cycles)" if name else ""


def mesh_quality(file):
    """Measure, worst value, number and position of that cell, one row per measure; none if the mesh has no quality group."""
    rows = []
    for name in ("min_dihedral_deg", "scaled_jacobian"):
        if f"quality/{name}" in file:
            measure = file[f"quality/{name}"]
            position = " ".join(f"{1e3 * x:.1f}" for x in measure["worst_place"][()])
            rows.append([name, f"{measure.attrs['worst']:.3g}", str(measure.attrs["worst_label"]), position])
    return rows
