"""Numbers that a report shows, taken from artefacts; "-" stands for what a file does not hold."""
import pathlib

import numpy as np

from . import artefact

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
    window = slice(int(np.searchsorted(angle, angle[-1] - 720.0 - 1e-6)), None)
    film = NOTHING
    if "history/film_min" in run:
        film = f"{run['history/film_min'][()][window].min() * 1e6:.2f}"
    residue = artefact.certificate(run).get("energy_residue")
    return [spread(run, "piston_lateral", 1e6, window), spread(run, "piston_tilt", 1e3, window), film,
            spread(run, "side_force", 1e-3, window), NOTHING if residue is None else f"{residue:.2e}"]
