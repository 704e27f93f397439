# SPDX-License-Identifier: GPL-3.0-or-later
"""Sound of boundary elements, where field files have it: power beside the ERP, pressure at microphones."""
from clatter import fields
from clatter.artefact import dataset, text
from ..plots.octaves import short
from .radiation import mean_of_cycles


def collect(folder, pack):
    """Runs whose field has the group `sound`."""
    runs = [found for found in (read(one, pack) for one in folder.with_field()) if found]
    return runs or None


def read(one, pack):
    field = one.field
    at = fields.piece(field, "cycle", *fields.pieces(field))
    if f"{at}/sound/power" not in field:
        return None
    sound, panel = field[f"{at}/sound"], field[fields.panel(field, at, "exposed", "skin")]
    curve = lambda values: pack.add("curves", values[()])  # noqa: E731
    time = dataset(field, f"{at}/time")
    return {"run": one.number, "rpm": field[at].attrs.get("speed_rpm"), "to_hz": float(sound.attrs["boundary_elements_to_hz"]), "frequency": curve(field[f"{at}/frequency_hz"]),
            "bands": {"lower": curve(field[f"{at}/third_octave/lower_hz"]), "upper": curve(field[f"{at}/third_octave/upper_hz"]),
                      "names": [short(text(name)) for name in dataset(field, f"{at}/third_octave/nominal")]},
            "db": float(sound.attrs["power_db"]), "dba": float(sound.attrs["power_dba"]), "power": curve(sound["power"]),
            "mean": mean_of_cycles(field, "sound", "power"),
            "power_bands": curve(sound["third_octave/power_db"]), "power_bands_dba": curve(sound["third_octave/power_dba"]),
            "erp": curve(panel["erp"]), "erp_bands": curve(panel["third_octave/erp_db"]), "erp_bands_dba": curve(panel["third_octave/erp_dba"]),
            "duration": float(len(time) * (time[1] - time[0])) if at.endswith("/cycle") else None,
            "microphones": [microphone(pack, name, group) for name, group in sound.get("microphones", {}).items()]}


def microphone(pack, name, group):
    """Pressure of each line [Pa], peak, up to the limit of the boundary elements; levels re 20 uPa."""
    return {"name": name, "db": float(group.attrs["pressure_db"]), "dba": float(group.attrs["pressure_dba"]),
            "lines": [pack.add("curves", group[f"pressure_{part}"][()]) for part in ("re", "im")],
            "bands": pack.add("curves", group["third_octave/pressure_db"][()])}
