"""Numbers that a report shows, taken from artefacts; "-" stands for what a file does not hold."""
import pathlib

import numpy as np

from . import artefact, fields
from .histories import last_cycle

RUN_HEAD = ["lateral [µm]", "tilt [mrad]", "min film [µm]", "side force [kN]", "energy residue"]
NOTHING = "-"


def fe_size(fe):
    """Number of degrees of freedom of the full model."""
    return int(fe["K"].attrs["shape"][0]) if "K" in fe else NOTHING


def reduced_size(fe_path):
    """Number of reduced coordinates in the .rom.h5 beside an .fe.h5."""
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


def run_row(run):
    """The cells of RUN_HEAD."""
    angle = artefact.dataset(run, "history/crank_angle_deg")
    window = last_cycle(angle)
    film = NOTHING
    if "history/film_min" in run:
        film = f"{run['history/film_min'][()][window].min() * 1e6:.2f}"
    residue = artefact.certificate(run).get("energy_residue")
    return [spread(run, "piston_lateral", 1e6, window), spread(run, "piston_tilt", 1e3, window), film,
            spread(run, "side_force", 1e-3, window), NOTHING if residue is None else f"{residue:.2e}"]


FIELD_HEAD = ["slap after FTDC [ms]", "liner peak [m/s²]", "block peak [m/s²]", "ERP [dB(A) re 1 pW]"]
ONSET = 0.2  # the slap begins where the liner's acceleration first passes this part of its peak


def field_row(field):
    """The cells of FIELD_HEAD."""
    around = fields.piece(field, "ftdc", "cycle")
    peaks = {}
    onset = NOTHING
    for part in ("liner", "block"):
        sensor = fields.pick_sensor(field, around, part)
        if sensor is None:
            peaks[part] = NOTHING
            continue
        time, values = fields.acceleration(field, sensor, around)
        after = time >= 0
        peaks[part] = f"{np.abs(values[after]).max():.3g}"
        if part == "liner":
            onset = f"{slap_onset(time[after], np.abs(values[after])) * 1e3:.2f}"
    panel = field[fields.panel(field, fields.piece(field, "cycle", "ftdc"), "exposed", "skin")]
    return [onset, peaks["liner"], peaks["block"], f"{panel.attrs['erp_dba']:.1f}"]


def slap_onset(time, magnitude):
    """When |a| first passes ONSET of its peak [s]."""
    return time[np.argmax(magnitude >= ONSET * magnitude.max())]
