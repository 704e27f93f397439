# SPDX-License-Identifier: GPL-3.0-or-later
"""Radiated power: panels with their spectra, third octaves and share."""
import numpy as np

from clatter import fields
from clatter.artefact import dataset, text
from ..plots.octaves import short

# What is shown of each panel: dataset of lines, of third octaves, A-weighted ones, attributes of totals, name and reference.
MEASURES = [
    {"key": "erp", "name": "equivalent radiated power (ERP)", "lines": "erp", "bands": "third_octave/erp_db",
     "bands_dba": "third_octave/erp_dba", "total": "erp_dba", "total_db": "erp_db", "reference": "1 pW"},
]

INSTANT_DEG = 0.5  # of the velocity over the cycle, of which each point is a mean


def collect(folder, pack):
    """Runs with their panels over the cycle, or the first window of a file without one."""
    runs = [read(one, pack) for one in folder.with_field()]
    return {"runs": runs, "measures": MEASURES} if runs else None


def read(one, pack):
    field = one.field
    at = fields.piece(field, "cycle", *fields.pieces(field))
    curve = lambda name: pack.add("curves", dataset(field, f"{at}/{name}"))  # noqa: E731
    angle = dataset(field, f"{at}/crank_angle_deg") if f"{at}/crank_angle_deg" in field else None
    every = 1 if angle is None else max(1, int(INSTANT_DEG / max(1e-9, float(angle[1] - angle[0]))))
    panels = []
    for name in sorted(field[f"{at}/panels"]) if f"{at}/panels" in field else []:
        panel = field[f"{at}/panels/{name}"]
        panels.append({"name": name, "label": name.replace("_", " "),
                       "area_m2": panel.attrs.get("area_m2"), "share": panel.attrs.get("share_of_skin"),
                       "mean": mean_of_cycles(field, f"panels/{name}", "erp"),
                       "instants": instants(pack, panel, every),
                       "measures": {row["key"]: measure(pack, panel, row) for row in MEASURES if row["lines"] in panel}})
    return {"run": one.number, "piece": at.rpartition("/")[2], "panels": panels, "frequency": curve("frequency_hz"),
            "rpm": field[at].attrs.get("speed_rpm"),
            "angle": None if angle is None else pack.add("curves", means(angle, every)),
            "time": pack.add("curves", 1e3 * means(dataset(field, f"{at}/time"), every)),
            "bands": {"lower": curve("third_octave/lower_hz"), "upper": curve("third_octave/upper_hz"),
                      "names": [short(text(name)) for name in dataset(field, f"{at}/third_octave/nominal")]}}


def means(values, every):
    """Means of so many values each; a rest at the end is left out."""
    return values[:len(values) // every * every].reshape(-1, every).mean(axis=1)


def instants(pack, panel, every):
    """Mean square normal velocity over the panel, over the cycle [m2/s2]."""
    name = "instant_mean_square_velocity"
    return pack.add("curves", means(panel[name][()], every)) if name in panel else None


def measure(pack, panel, row):
    """Power of each line [W], levels of bands, totals of a panel."""
    found = {"lines": pack.add("curves", panel[row["lines"]][()])}
    for key in ("bands", "bands_dba"):
        if row[key] in panel:
            found[key] = pack.add("curves", panel[row[key]][()])
    return {**found, "dba": panel.attrs.get(row["total"]), "db": panel.attrs.get(row["total_db"])}


def mean_of_cycles(field, of, level):
    """The level of a panel or the sound as a mean over cycles, where the field has one: {db, dba, error of dba, cycles}."""
    name, cycles = fields.mean_of_cycles(field)
    if name is None or f"analysis/{name}/{of}" not in field:
        return None
    group = field[f"analysis/{name}/{of}"]
    error = fields.standard_error(group, level)
    if np.isnan(error):  # of a power of 0
        return None
    return {"db": float(group.attrs[f"{level}_db"]), "dba": float(group.attrs[f"{level}_dba"]), "error": error, "cycles": cycles}
