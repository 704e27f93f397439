# SPDX-License-Identifier: GPL-3.0-or-later
"""The first section: what was found, in sentences and in the tables of `clatter report`."""
import numpy as np

from clatter import artefact, chains, fields
from .. import drive_findings, findings, slap
from ..weighting import loudest_peaks
from .certificates import GOOD

WORRIES = 12  # that are listed


def collect(folder, cards):
    """Sentences, tables, and how many certificates have something to say."""
    return {"loudest": [loudest(one) for one in folder.with_field()], "base": base(folder),
            "sentences": sound(folder) + drives(folder), "tables": tables(folder),
            "checks": {state: sum(card["state"] == state for card in cards) for state in ("good", "note", "bad")},
            "worries": worries(cards),
            "stale": stale(folder)}


def loudest_line(field):
    """Frequency [Hz] of the line with the largest A-weighted power; None where the spectrum has no peak."""
    at = fields.level_piece(field)
    frequency = artefact.dataset(field, f"{at}/frequency_hz")
    power = artefact.dataset(field, fields.radiated(field, at).power)
    lines = frequency[loudest_peaks(frequency, power, 1, field.attrs.get("spectra_from_hz", 0.0))]
    return float(lines[0]) if len(lines) else None


def loudest(one):
    """Of a run: its loudest third octave and line, and the panel from which most comes, with its share where the sound is known."""
    at = fields.level_piece(one.field)
    power = fields.radiated(one.field, at)
    band = artefact.text(artefact.dataset(one.field, f"{at}/third_octave/nominal")[int(np.argmax(artefact.dataset(one.field, power.bands)))])
    panels = {name: panel.attrs for name, panel in one.field[f"{at}/panels"].items() if name not in ("skin", "exposed")}
    key = "sound_power_share" if any("sound_power_share" in attrs for attrs in panels.values()) else "erp_dba"
    part = max((name for name in panels if key in panels[name]), key=lambda name: panels[name][key], default=None)
    return {"run": one.number, "band": band, "line": loudest_line(one.field), "part": part and part.replace("_", " "),
            "share": float(panels[part][key]) if part and key == "sound_power_share" else None}


def base(folder):
    """The run whose scene most other runs have as their base; None where there is none."""
    named = [name for one in folder.with_run() for name, _ in artefact.inputs(one.run)]
    others = {one.number: named.count(f"{one.stem}.run.toml") - 1 for one in folder.with_run()}
    found = max(others, key=others.get, default=None)
    return found if found is not None and others[found] > 0 else None


def worries(cards):
    """What certificates object to; the same objection to several is said once, for the first of them."""
    found = {}
    for card in cards:
        for state, text in card["sentences"]:
            if state != GOOD:
                found.setdefault(text, []).append(card["title"])
    said = [f"{titles[0]}{f' and {len(titles) - 1} more' if len(titles) > 1 else ''}: {text}" for text, titles in found.items()]
    return said[:WORRIES] + ([f"{len(said) - WORRIES} further remarks are among the certificates."] if len(said) > WORRIES else [])


def sound(folder):
    """The loudest and the quietest run, by sound power where the field has it, and the panel that moves most of the loudest."""
    levels = sorted(((*findings.loudness(one.label, one.field), one) for one in folder.with_field()), key=lambda row: row[0])
    if not levels:
        return []
    level, text, loudest = levels[-1]
    found = [f"{'Loudest: ' if len(levels) > 1 else ''}{text}."]
    if len(levels) > 1:
        found.append(f"Quietest: {levels[0][2].label}: {levels[0][0]:.1f} dB(A), {level - levels[0][0]:.1f} dB below it.")
    at = fields.level_piece(loudest.field)
    others = sorted(((float(panel.attrs["erp_dba"]), name) for name, panel in loudest.field[f"{at}/panels"].items()
                     if name not in ("skin", "exposed") and "erp_dba" in panel.attrs), reverse=True)
    if others:
        found.append(f"The strongest panel{' of the loudest run' if len(levels) > 1 else ''} by ERP is "
                     f"“{others[0][1].replace('_', ' ')}” with {others[0][0]:.1f} dB(A).")
    return found


def drives(folder):
    """Of chain drives: each run, of many only jumps; then what runs at several speeds show together."""
    found = []
    runs = [one for one in folder.with_run() if chains.names(one.run)]
    for one in runs:
        before = f"{one.label}: " if len(folder.runs) > 1 else ""
        sentences = [drive_findings.jump_text(one.run, name) for name in chains.names(one.run)] if folder.many else \
            drive_findings.sentences(one.run)
        found += [f"{before}{sentence}." for sentence in sentences if not folder.many or "JUMPED" in sentence]
    for name in sorted({name for one in runs for name in chains.names(one.run)}):
        same = [(one.run, name) for one in runs if name in chains.names(one.run)]
        found += [f"{name} at several speeds: {sentence}." for sentence in (drive_findings.critical_speed(same) if len(same) > 1 else [])]
    return found


def tables(folder):
    """(title, head, rows); a table without figures is left out."""
    rows, sensors, panels, parts, cells = [], [], [], [], []
    for one in folder.runs:
        if one.run is not None:
            rows += [[f"{one.label}, {cylinder}".rstrip(", "), *cells] for cylinder, cells in findings.run_rows(one.run)]
        if one.field is not None:
            sensors.append([one.label, *findings.field_row(one.field)])
            panels += [[f"{one.label}, {panel}", *cells] for panel, *cells in findings.panel_rows(one.field)]
    for path in folder.files["fe"]:
        with artefact.open_artefact(path, "fe") as file:
            parts.append([artefact.stem(path), findings.fe_size(file), findings.reduced_size(path), *findings.mass(file)])
    for path in folder.files["mesh"]:
        with artefact.open_artefact(path, "mesh") as file:
            cells += [[artefact.stem(path), *row] for row in findings.mesh_quality(file)]
    found = [("Runs, last cycle", ["run", *findings.RUN_HEAD], rows),
             (f"Accelerations above {slap.FROM_HZ:g} Hz around firing TDC, and power over the cycle", ["run", *findings.FIELD_HEAD], sensors),
             (findings.PANELS, [f"run, {findings.PANEL_HEAD[0]}", *findings.PANEL_HEAD[1:]], panels),
             ("Parts", ["part", "FE DoF", "reduced DoF", "mass [kg]"], parts),
             ("Worst cells of the meshes", ["part", "measure", "worst", "cell", "at [mm]"], cells)]
    return [one for one in (without_gaps(*table) for table in found) if len(one["head"]) > 1]


def without_gaps(title, head, rows):
    """A table without the columns in which no row has a figure."""
    kept = [k for k in range(len(head)) if k == 0 or any(row[k] != findings.NOTHING for row in rows)]
    return {"title": title, "head": [head[k] for k in kept], "rows": [[row[k] for k in kept] for row in rows]}


def stale(folder):
    """Inputs that have changed since an artefact was made of them."""
    found = []
    for paths in folder.files.values():
        for path in paths:
            with artefact.open_artefact(path) as file:
                found += [f"{path.name} was made of another {name}" for name, state in artefact.inputs(file) if state == "changed since"]
    return found
