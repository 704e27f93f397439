# SPDX-License-Identifier: GPL-3.0-or-later
"""Effects of each run with their cost, and seconds, memory and size of each stage."""
from clatter import artefact
from ..report import STAGES


def collect(folder):
    return {"stages": stages(folder), "effects": [row for one in folder.with_run() for row in [effects(one)] if row]}


def stages(folder):
    """One row per artefact; its steps by falling seconds."""
    rows = []
    for stage in STAGES:
        for path in folder.files[stage]:
            with artefact.open_artefact(path) as file:
                seconds, peak = artefact.totals(file)
                steps = sorted(((name, float(spent)) for name, spent, _ in artefact.timing(file)), key=lambda step: -step[1])
            rows.append({"name": path.name, "stage": stage, "seconds": seconds, "peak_gib": peak, "mb": path.stat().st_size / 1e6,
                         "steps": steps})
    return rows


def effects(one):
    """(name, on or off, why, seconds) of what a run simulated."""
    if "effects/name" not in one.run:
        return None
    texts = [[artefact.text(value) for value in one.run[f"effects/{key}"][()]] for key in ("name", "state", "why")]
    total = artefact.totals(one.run)[0]
    return {"run": one.number, "rows": list(zip(*texts, one.run["effects/seconds"][()])), "total": total}
