# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of the oil film: pressure, fill, gap and contact pressure on the pads of the skirt, over the crank angle."""
import numpy as np

from clatter.artefact import dataset
from clatter.films import contacts
from clatter.histories import centred, last_cycle_of_fields

# Dataset, name, factor, unit, colours.
QUANTITIES = [
    ("pressure", "film pressure", 1e-6, "MPa", "viridis"),
    ("gap", "gap between skirt and liner", 1e6, "µm", "cividis"),
    ("fill", "share of the gap filled with oil", 1.0, "1", "viridis"),
    ("contact_pressure", "pressure of asperity contact", 1e-6, "MPa", "viridis"),
]


def collect(folder, pack):
    """Contacts (run, cylinder) with their pads; dry contacts have no fill and no film pressure."""
    found = [contact(one, group, cylinder, pack) for one in folder.with_run() for cylinder, group in contacts(one.run)]
    if not found:
        return None
    return {"contacts": found,
            "quantities": [{"key": key, "name": name, "unit": unit, "colours": colours}
                           for key, name, _, unit, colours in QUANTITIES]}


def contact(one, group, cylinder, pack):
    angle = dataset(one.run, f"{one.run['film'].name}/crank_angle_deg")
    last = np.arange(len(angle))[last_cycle_of_fields(angle)]
    degrees, order = centred(angle[last])
    pads = [pad(group[name], name, last[order], pack) for name in sorted(group, reverse=True)
            if "axial" in group[name]]
    return {"run": one.number, "cylinder": cylinder, "angle": pack.add("film", degrees), "pads": pads}


def pad(group, name, rows, pack):
    """Coordinates along the skirt [mm] and about the piston's axis [deg], and each quantity at each instant."""
    found = {"name": name, "axial": 1e3 * group["axial"][()], "angle": group["angle_deg"][()], "maps": {}}
    for key, _, factor, _, _ in QUANTITIES:
        if key in group:
            found["maps"][key] = pack.scaled("film", factor * group[key][()][rows])
    return found
