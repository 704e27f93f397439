# SPDX-License-Identifier: GPL-3.0-or-later
"""Orders over the crank speed, where the folder has runs at several speeds: Campbell diagram and order cuts."""
from clatter import chains, fields
from clatter.artefact import BadArtefact, dataset, text
from .. import orders

APART_RPM = 1.0  # speeds that are nearer are one


def collect(folder, pack):
    """Signals with their spectra at each speed; of two runs at one speed the first counts."""
    signals = {}
    for one in folder.runs:
        for name, spectrum in spectra(one):
            known = signals.setdefault(name, [])
            if all(abs(spectrum[0] - other[0]) >= APART_RPM for other in known):
                known.append(spectrum)
    found = []
    for name, known in sorted(signals.items(), key=lambda one: (one[0] != "sound power", one[0])):
        if len(known) < 2 or len({one[3] for one in known}) > 1:
            continue
        known.sort(key=lambda one: one[0])
        unit = known[0][3]
        found.append({"name": name, "unit": unit, "reference": orders.REFERENCE.get(unit), "axis": orders.level_name(unit),
                      "spectra": [{"rpm": float(rpm), "rms": pack.add("curves", rms)} for rpm, _, rms, _ in known]})
    return found or None


def spectra(one):
    """(name, (rpm, orders, RMS, unit)) of a run's sound power, radiated power, sensors and sprockets."""
    if one.field is not None and "analysis/cycle" in one.field and "order" in one.field["analysis/cycle"]:
        if "analysis/cycle/sound/power" in one.field:
            yield "sound power", orders.of_sound(one.field)
        for panel in ("exposed", "skin"):
            if f"analysis/cycle/panels/{panel}" in one.field:
                yield f"ERP, {panel}", orders.of_panel(one.field, panel)
                break
        for sensor in fields.sensor_names(one.field, "analysis/cycle"):
            for label in dataset(one.field, f"analysis/cycle/sensors/{sensor}/labels"):
                yield f"acceleration, {text(label)}", orders.of_field(one.field, text(label))
    if one.run is not None:
        for name in chains.names(one.run):
            over = one.run[f"chain/{name}/over"]
            for part in over:
                history = f"{name}_{part}_speed"
                if over[part].attrs["teeth"] > 0 and f"history/{history}" in one.run:
                    try:
                        yield f"speed, {part}", orders.of_run(one.run, history)
                    except BadArtefact:
                        continue  # shorter than a cycle
