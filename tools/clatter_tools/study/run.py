# SPDX-License-Identifier: GPL-3.0-or-later
"""A study from its file to its numbers: what every variant gives and costs, lines along the settings, budgets."""
import dataclasses

from .. import artefact
from ..artefact import BadArtefact
from . import convergence, plan, store, variants
from .pipeline import Pipeline

BASE = 0  # number of the variant


class Failed(Exception):
    """The base of a study could not be made: one line for the user."""


@dataclasses.dataclass
class Stage:
    """An artefact of a variant: its name, seconds and peak memory [GiB] of its stage, processor seconds of its commands; for which of the
    quantities' files it is needed."""
    name: str
    seconds: float
    peak_gib: float
    processor: float
    needed_by: set


@dataclasses.dataclass
class Study:
    """values: by quantity, by variant (a Value, None where it is not there); stages: by variant; lines: by quantity {setting: Line};
    references and budgets: by quantity."""
    plan: plan.Plan
    variants: list
    values: list
    stages: list
    lines: list = dataclasses.field(default_factory=list)
    references: list = dataclasses.field(default_factory=list)
    budgets: list = dataclasses.field(default_factory=list)

    def cost(self, variant, quantity=None):
        """Seconds of the stages of a variant that a quantity needs, without one of all, by the plan's `cost`; nan where one is not known."""
        file = None if quantity is None else self.plan.quantities[quantity].file
        wanted = [getattr(one, self.plan.cost) for one in self.stages[variant] if file is None or file in one.needed_by]
        return sum(wanted) if wanted else float("nan")

    def error(self, quantity, variant):
        """Size of the total error, relative where the quantity says so; nan where the variant has no value."""
        value = self.values[quantity][variant]
        return float("nan") if value is None else self.scaled(quantity, value.minus(self.references[quantity]).size())

    def scaled(self, quantity, difference):
        """A difference of a quantity in the units of its errors."""
        return difference / self.scale(quantity)

    def scale(self, quantity):
        """The size of the reference where errors are relative, else 1."""
        size = self.references[quantity].size()
        return size if self.plan.quantities[quantity].relative and size > 0.0 else 1.0

    def size(self, quantity):
        """That of the reference, in the units of errors."""
        return self.scaled(quantity, self.references[quantity].size())


def make(path, jobs):
    """The Study of a study file: makes what is missing."""
    wanted = plan.read(path)
    targets = list(dict.fromkeys(one.file for one in wanted.quantities))
    pipeline = Pipeline(wanted.pipeline, targets)
    base = variants.base_values(wanted, pipeline)
    found = variants.variants_of(wanted, base)
    made = store.Store(pipeline, wanted.output)
    artefacts = []
    for one in found:
        files = store.VariantFiles(made, variants.changed_tables(wanted, pipeline, base, one))
        artefacts.append([files.artefact(target) for target in targets])
    check_settings(wanted, found, artefacts)
    if wanted.reuse:
        made.reuse(artefacts[BASE])
    made.prepare()
    print(f"{wanted.path}: {len(found)} variants, {len(made.made)} artefacts, {len(made.missing())} to be made", flush=True)
    if made.missing():
        made.make(jobs)
    for one, own in zip(found, artefacts):
        made.show(one.folder, own)
    missing = [one for one in artefacts[BASE] if not made.path(one).exists()]
    if missing:
        raise Failed(f"{wanted.path}: the base has no {missing[0].name}: see what its stage says above; the same command resumes")
    return numbers(wanted, found, made, artefacts, targets)


def check_settings(wanted, found, artefacts):
    """BadArtefact where a setting changes no artefact."""
    for number, setting in enumerate(wanted.settings):
        own = [k for k, one in enumerate(found) if one.setting == number]
        if own and all(artefacts[k] == artefacts[BASE] for k in own):
            files = ", ".join(dict.fromkeys(file for file, _ in setting.keys))
            raise BadArtefact(f"{wanted.path}: {setting.name}: found no quantity that depends on {files}, expected at least one")


def numbers(wanted, found, made, artefacts, targets):
    """Reads the artefacts."""
    values, stages = [], []
    for own in artefacts:
        files = {target: made.path(one) for target, one in zip(targets, own)}
        values.append([one.of(files[one.file]) if files[one.file].exists() else None for one in wanted.quantities])
        whole = all(path.exists() for path in files.values())
        stages.append(stages_of(made, own) if whole else [])
    study = Study(wanted, found, [list(one) for one in zip(*values)], stages)
    for quantity, own in enumerate(wanted.quantities):
        known = study.values[quantity]
        lines = {number: one for number in range(len(wanted.settings)) for one in [line_of(study, number, known)] if one}
        refined = next((known[k] for k, one in enumerate(found) if k != BASE and is_refined(wanted, one) and known[k] is not None), None)
        reference = convergence.total_reference(own.exact, lines, known[BASE], refined)
        study.lines.append(lines)
        study.references.append(reference)
        study.budgets.append(convergence.budget(lines, known[BASE], refined, reference))
    return study


def stages_of(made, own):
    """The stages of a variant, each once."""
    found = {one.folder: one for target in own for one in [*target.inputs.values(), target]}
    stages = []
    for one in found.values():
        needed_by = {target.name for target in own if one in [*target.inputs.values(), target]}
        if not one.name.endswith(".h5"):
            continue
        with artefact.open_artefact(made.path(one)) as file:
            stages.append(Stage(one.name, *artefact.totals(file), made.processor_seconds(one), needed_by))
    return stages


def is_refined(wanted, variant):
    return variant.values == tuple(setting.values[-1] for setting in wanted.settings)


def line_of(study, number, known):
    """The Line of a setting, None where its finest value or all others are missing."""
    setting, base = study.plan.settings[number], study.variants[BASE].values
    rows = []
    for k, value in enumerate(setting.values):
        values = base[:number] + (value,) + base[number + 1:]
        variant = next(j for j, one in enumerate(study.variants) if one.values == values)
        if known[variant] is not None:
            rows.append((variant, setting.sizes[k] if setting.sizes else None, known[variant]))
        elif k == len(setting.values) - 1:
            return None
    if len(rows) < 2 and rows[0][0] == BASE:
        return None
    ids, sizes, values = (list(one) for one in zip(*rows))
    return convergence.line(setting.reference, ids, sizes if setting.sizes else None, values, known[BASE])
