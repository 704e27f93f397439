# SPDX-License-Identifier: GPL-3.0-or-later
"""study.h5 (docs/formats.md) and study.csv of a study."""
import csv

import h5py
import numpy as np

from clatter.artefact import schema_of
from . import convergence, findings
from ..whole_file import whole_file


def write(study):
    """Both files into the study's folder, complete or not at all; returns their paths."""
    folder = study.plan.output
    return [whole(folder / "study.h5", lambda part: fill(study, part)), whole(folder / "study.csv", lambda part: write_rows(study, part))]


def whole(path, fill_part):
    """Writes a file by fill_part(its temporary path), complete or not at all; returns its path."""
    with whole_file(path) as part:
        fill_part(part)
    return path


def fill(study, path):
    with h5py.File(path, "w") as file:
        file.attrs["schema"] = np.bytes_(schema_of("study"))

        def put(name, values, unit, meaning):
            values = np.array([str(one).encode() for one in values]) if len(values) and isinstance(values[0], str) else np.asarray(values, float)
            one = file.create_dataset(name, data=values, fletcher32=values.size > 0)
            one.attrs["unit"], one.attrs["meaning"] = np.bytes_(unit.encode()), np.bytes_(meaning)

        plan = study.plan
        put("variant", [one.name for one in study.variants], "1", "variants, a row of values, errors and costs each")
        put("setting", [one.name for one in plan.settings], "1", "settings, a column of `value_of` each")
        put("value_of", [" | ".join(setting.label(value) for setting, value in zip(plan.settings, one.values)) for one in study.variants], "1",
            "values of the settings of each variant, separated by |")
        put("cost", [study.cost(k) for k in range(len(study.variants))], "s", f"{plan.cost} of all stages of a variant")
        names = list(dict.fromkeys(stage.name for own in study.stages for stage in own))
        put("stage/name", names, "1", "artefacts, columns of the other datasets of this group")
        for key, unit, meaning in (("seconds", "s", "of the stage"), ("processor", "s", "processor time of its commands"), ("peak_gib", "GiB", "largest memory")):
            put(f"stage/{key}", [[next((getattr(one, key) for one in own if one.name == name), np.nan) for name in names] for own in study.stages],
                unit, meaning)
        for quantity, own in enumerate(plan.quantities):
            fill_quantity(study, quantity, own, put)
        numbers, settings = range(len(plan.quantities)), range(len(plan.settings))
        put("said/quantity", [own.name for own in plan.quantities], "1", "quantities, a row of the texts of this group each")
        put("said/headline", findings.headlines(study), "1", "value, error and seconds of the base, what dominates")
        put("said/verdict", [findings.verdict(study, k) for k in numbers], "1", "whether the budget is closed")
        put("said/sentences", ["\n".join(findings.sentence(study, k, number) for number in settings) for k in numbers], "1",
            "what an error costs, a line for each setting")
        file.flush()


def fill_quantity(study, quantity, own, put):
    at = f"quantity/{own.name.replace('/', '-')}"
    known = study.values[quantity]
    width = max(len(one.values) for one in known if one)
    rows = np.full((len(known), width), np.nan)
    for k, one in enumerate(known):
        if one:
            rows[k, :len(one.values)] = one.values
    put(f"{at}/value", rows, own.unit, "by variant; of a curve its entries")
    put(f"{at}/at", max((one.at for one in known if one), key=len), "1", "abscissa of a curve")
    put(f"{at}/reference", study.references[quantity].values, own.unit, "what total errors are from")
    unit = "1" if own.relative else own.unit
    put(f"{at}/cost", [study.cost(k, quantity) for k in range(len(known))], "s", "of the stages that the quantity needs, by variant")
    put(f"{at}/error", [study.error(quantity, k) for k in range(len(known))], unit, "total error by variant")
    lines, found = study.lines[quantity], study.budgets[quantity]
    numbers = range(len(study.plan.settings))
    parts = dict(found.parts)
    nan = float("nan")
    put(f"{at}/order", [lines[k].order if k in lines else nan for k in numbers], "1", "observed order by setting, of its three finest values")
    put(f"{at}/source", [lines[k].source if k in lines else "none" for k in numbers], "1", "reference of a setting: richardson, finest")
    put(f"{at}/budget", [study.scaled(quantity, parts[k].number()) if k in parts else nan for k in numbers], unit, "error of the base by setting, with its sign")
    put(f"{at}/budget_sum", [study.scaled(quantity, found.sum.number())], unit, "sum of the base's differences from the finest values")
    put(f"{at}/budget_run", [nan if found.refined is None else study.scaled(quantity, found.refined.number())], unit, "base less the run with everything refined")
    front = findings.front(study, quantity)
    put(f"{at}/pareto", [float(k in front) for k in range(len(known))], "1",
        "1: no other variant is better in both seconds and total error; 0 also where the seconds are not compared")


def write_rows(study, path):
    with open(path, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        head = [f"{own.name} {what}" for own in study.plan.quantities for what in (f"[{own.unit}]" if own.unit else "value", "total error")]
        writer.writerow(["variant", *(one.name for one in study.plan.settings), "seconds", *head])
        for k, one in enumerate(study.variants):
            cells = []
            for quantity in range(len(study.plan.quantities)):
                value = study.values[quantity][k]
                cells += ["", ""] if value is None else [f"{value.number():.9g}" if value.is_number else "", f"{study.error(quantity, k):.6g}"]
            writer.writerow([one.name, *(setting.label(value) for setting, value in zip(study.plan.settings, one.values)), f"{study.cost(k):.6g}", *cells])

