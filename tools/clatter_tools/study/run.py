# SPDX-License-Identifier: GPL-3.0-or-later
"""A study from its file to its numbers: what every variant gives and costs, lines along the settings, budgets."""
import dataclasses
import sys

from clatter import artefact
from clatter.errors import BadArtefact, Failed
from . import convergence, plan, store, variants
from .pipeline import Pipeline

BASE = 0  # number of the variant


@dataclasses.dataclass
class Stage:
    """An artefact of a variant: its name and that of its folder, seconds and peak memory [GiB] of its stage, processor seconds of its
    commands; for which of the quantities' files it is needed; what keeps its seconds from being compared (Store.condition)."""
    name: str
    folder: str
    seconds: float
    peak_gib: float
    processor: float
    needed_by: set
    condition: str = ""


def cost_of(wanted, stages, quantity=None):
    """Seconds of stages by the plan's `cost`: of those that a quantity needs, or all."""
    file = None if quantity is None else wanted.quantities[quantity].file
    found = [getattr(one, wanted.cost) for one in stages if file is None or file in one.needed_by]
    return sum(found) if found else float("nan")


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
        """Seconds of the stages of a variant that a quantity needs, without one of all; nan where one is not known."""
        return cost_of(self.plan, self.stages[variant], quantity)

    def compared_cost(self, variant, quantity=None):
        """The same; nan where it was not measured as that of others: costs are ranked by it."""
        return float("nan") if self.conditions(variant, quantity) else self.cost(variant, quantity)

    def affected(self, number=None):
        """Names of the artefacts that a setting, or without a number any, changes."""
        base = {one.name: one.folder for one in self.stages[BASE]}
        return {stage.name for one, stages in zip(self.variants, self.stages) if number in (None, one.setting) for stage in stages
                if base.get(stage.name) != stage.folder}

    def conditions(self, variant, quantity=None, number=None):
        """What keeps the seconds of a variant from being compared (Store.condition), by the stages that a setting, or without a number any, changes:
        the others are those of all variants. Processor seconds are compared whatever ran beside."""
        if self.plan.cost != "seconds":
            return []
        file, names = None if quantity is None else self.plan.quantities[quantity].file, self.affected(number)
        return sorted({one.condition for one in self.stages[variant] if one.condition and one.name in names and (file is None or file in one.needed_by)})

    def cost_of_setting(self, variant, quantity, number):
        """As compared_cost, of the stages that a setting changes; the others cost the same with all its values."""
        names = self.affected(number)
        own = [one for one in self.stages[variant] if one.name in names]
        return float("nan") if self.conditions(variant, quantity, number) else cost_of(self.plan, own, quantity)

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

    def lacking(self, quantity):
        """Numbers of the settings whose finest value could not be made: what is beyond the finest one that could is not seen."""
        base, known = self.variants[BASE].values, self.values[quantity]
        return [number for number, one in enumerate(self.plan.settings)
                if any(known[k] is None for k, own in enumerate(self.variants) if own.values == base[:number] + (one.values[-1],) + base[number + 1:])]

    def size(self, quantity):
        """That of the reference, in the units of errors."""
        return self.scaled(quantity, self.references[quantity].size())


def make(path, jobs):
    """The Study of a study file: makes what is missing."""
    wanted = plan.read(path)
    pipeline = pipeline_of(wanted)
    base = variants.base_values(wanted, pipeline)
    found = variants.variants_of(wanted, base)
    made = Making(wanted, pipeline)
    artefacts = [made.add(variants.changed_tables(wanted, pipeline, base, one), one.folder) for one in found]
    check_settings(wanted, found, artefacts)
    made.make([one.folder for one in found], artefacts, jobs)
    return numbers(wanted, found, made, artefacts)


def pipeline_of(wanted):
    return Pipeline(wanted.pipeline, list(dict.fromkeys(one.file for one in wanted.quantities)))


class Making:
    """The artefacts of variants: those of the quantities' files of each; of one quantity only where its number is given."""

    def __init__(self, wanted, pipeline, quantity=None):
        self.wanted, self.pipeline = wanted, pipeline
        self.targets = list(dict.fromkeys(one.file for one in wanted.quantities)) if quantity is None else [wanted.quantities[quantity].file]
        self.store = store.Store(pipeline, wanted.output)

    def add(self, changed, folder="base"):
        """[Made] of a variant with changed TOML files, {name: tables}; `folder`: that of the variant, which is said when an artefact has been made."""
        files = store.VariantFiles(self.store, changed, folder)
        return [files.artefact(target) for target in self.targets]

    def make(self, folders, artefacts, jobs):
        """Makes what is missing of variants, the base first; Failed where it cannot be made, BadArtefact where it has not what a quantity takes."""
        with self.store.alone():
            if self.wanted.reuse:
                self.store.reuse(artefacts[BASE])
            if self.wanted.cost == "processor":
                self.store.drop_unmeasured()
            self.store.prepare()
            print(f"{self.wanted.path}: {len(artefacts)} variants, {len(self.store.made)} artefacts, {len(self.store.missing())} to be made", flush=True)
            self.store.make(jobs, [one for one in artefacts[BASE] if not self.store.path(one).exists()])
            missing = [one for one in artefacts[BASE] if not self.store.path(one).exists()]
            if missing:
                raise Failed(f"{self.wanted.path}: the base has no {missing[0].name}: see what its stage says above; the same command resumes")
            self.values(artefacts[BASE])
            if self.store.missing():
                self.store.make(jobs)
            for folder, own in zip(folders, artefacts):
                self.store.show(folder, own)

    def values(self, own, folder=""):
        """[Value or None] of the quantities of a variant: None where its file could not be made or, with a message that names the variant's `folder`, has
        not what the quantity takes, which in the base (without a folder) is a BadArtefact."""
        files = {one.name: self.store.path(one) for one in own if self.store.path(one).exists()}
        return [self.value(one, files[one.file], folder) if one.file in files else None for one in self.wanted.quantities]

    def value(self, quantity, path, folder):
        try:
            return quantity.of(path)
        except BadArtefact as error:
            text = f"{self.wanted.path}: {quantity.name}{f', {folder}' if folder else ''}: {error}"
            if not folder:
                raise BadArtefact(text) from error
            print(text, file=sys.stderr)
            return None

    def stages(self, own):
        """The stages of a variant, each once; none where it is not complete."""
        if not all(self.store.path(one).exists() for one in own):
            return []
        found = {one.folder: one for target in own for one in [*target.inputs.values(), target] if one.name.endswith(".h5")}
        stages = []
        for one in found.values():
            needed_by = {target.name for target in own if one in [*target.inputs.values(), target]}
            with artefact.open_artefact(self.store.path(one)) as file:
                stages.append(Stage(one.name, one.folder, *artefact.totals(file), self.store.processor_seconds(one), needed_by,
                                    self.store.condition(one)))
        return stages


def check_settings(wanted, found, artefacts):
    """BadArtefact where a setting changes no artefact."""
    for number, setting in enumerate(wanted.settings):
        own = [k for k, one in enumerate(found) if one.setting == number]
        if own and all(artefacts[k] == artefacts[BASE] for k in own):
            files = ", ".join(dict.fromkeys(file for file, _ in setting.keys))
            raise BadArtefact(f"{wanted.path}: {setting.name}: found no quantity that depends on {files}, expected at least one")


def numbers(wanted, found, made, artefacts):
    """The Study of what was made."""
    values = [made.values(own, one.folder if k != BASE else "") for k, (one, own) in enumerate(zip(found, artefacts))]
    stages = [made.stages(own) for own in artefacts]
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


def is_refined(wanted, variant):
    return variant.values == tuple(setting.values[-1] for setting in wanted.settings)


def line_of(study, number, known):
    """The Line of a setting, of the values that could be made; None where there is one only."""
    setting, base = study.plan.settings[number], study.variants[BASE].values
    rows = []
    for k, value in enumerate(setting.values):
        values = base[:number] + (value,) + base[number + 1:]
        variant = next(j for j, one in enumerate(study.variants) if one.values == values)
        if known[variant] is not None:
            rows.append((variant, setting.sizes[k] if setting.sizes else None, known[variant]))
    if not rows or [one[0] for one in rows] == [BASE]:
        return None
    ids, sizes, values = (list(one) for one in zip(*rows))
    return convergence.line(setting.reference, ids, sizes if setting.sizes else None, values, known[BASE])
