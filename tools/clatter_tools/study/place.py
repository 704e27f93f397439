# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter study --within --at`: proposals for another speed, load or clearance than that of the study, by a few runs there.

--at changes keys of the pipeline. The base is run there, and with it each setting that matters at the value before the base's: the differences along that
setting are taken to be as many times as large as that of these two runs is, but not less than half, as a small one may be an accident. Along the others they
are as many times as large as along the worst of these, but not smaller. What a proposal has coarser than the base is run there too before it is believed: a
difference is at least that of this run. All add in squares, as signs may be others there. The seconds of each stage are expected in proportion to
those of the base.
"""
import dataclasses
import tomllib

from clatter.errors import BadArtefact, Failed
from . import plan, run, variants
from .proposal import propose
from .quantities import Value
from .run import BASE

MATTERS = 0.1   # of the requested error: settings whose neighbours differ by less are not run there
LEAST = 0.5     # times the study's differences: smaller ones may be an accident


@dataclasses.dataclass
class Place:
    """Where proposals are proved: files that differ there ([] in the study's own scene), stages and value of the base; tried: {number of a setting:
    differences there over those in the study} of its neighbour; sizes: {variant: of its difference from the base there, of relative errors the same part
    of the study's reference as there of the base}."""
    changes: list
    stages: list
    base: Value
    tried: dict = dataclasses.field(default_factory=dict)
    sizes: dict = dataclasses.field(default_factory=dict)

    def times(self, study):
        """Along each setting; None in the study's own scene."""
        worst = max([1.0, *self.tried.values()])
        return [self.tried.get(number, worst) for number in range(len(study.plan.settings))] if self.changes else None


def place_of(study, quantity, within, jobs, changes=()):
    """The Place of changes, [((file, path of keys), value)], where the base and the neighbours that matter for an error of `within` are run; Failed where
    one cannot be made."""
    if not changes:
        return Place([], study.stages[BASE], study.values[quantity][BASE])
    found = those_that_matter(study, quantity, within)
    stages, values = values_there(study, quantity, [study.variants[one] for one in [BASE, *found]], changes, jobs)
    place = Place(list(changes), stages, values[0])
    learn(study, quantity, place, found, values[1:])
    return place


def learn(study, quantity, place, found, values):
    """What values of variants of the study at a Place say."""
    for variant, value in zip(found, values):
        place.sizes[variant] = study.scale(quantity) * difference(study.plan, quantity, value, place.base)
    for number, variant in neighbours(study, quantity).items():
        if variant in found:
            here = difference(study.plan, quantity, study.values[quantity][variant], study.values[quantity][BASE])
            place.tried[number] = max(LEAST, place.sizes[variant] / study.scale(quantity) / here)


def propose_there(study, quantity, within, seconds, jobs, place):
    """As propose(), at a Place: whatever the proposal has coarser than the base is run there before."""
    while True:
        best, least = propose(study, quantity, within, seconds, place.times(study), place.sizes)
        if best is None or not place.changes:
            return best, least
        found = [variant for number, variant in enumerate(best.variants) if variant not in place.sizes and is_coarser(study, quantity, number, variant)]
        if not found:
            return best, least
        values = values_there(study, quantity, [study.variants[one] for one in [BASE, *found]], place.changes, jobs)[1]
        learn(study, quantity, place, found, values[1:])


def is_coarser(study, quantity, number, variant):
    """Whether a variant of a setting is before the base."""
    found = study.lines[quantity][number].variants if number in study.lines[quantity] else []
    return variant != BASE and variant in found and (BASE not in found or found.index(variant) < found.index(BASE))


def difference(wanted, quantity, value, base):
    """The size of that of two values of a quantity, in the units of errors."""
    scale = base.size() if wanted.quantities[quantity].relative and base.size() > 0.0 else 1.0
    return value.minus(base).size() / scale


def neighbours(study, quantity):
    """{number of a setting: variant with its value before the base's, or else the one after it}, of the settings along which these differ from the base."""
    known, found = study.values[quantity][BASE], {}
    for number, line in study.lines[quantity].items():
        at = line.variants.index(BASE) if BASE in line.variants else len(line.variants)
        order = [*reversed(line.variants[:at]), *line.variants[at + 1:]]
        if order and study.values[quantity][order[0]].minus(known).size() > 0.0:
            found[number] = order[0]
    return found


def those_that_matter(study, quantity, within):
    """The neighbours that differ from the base by at least MATTERS of an error of `within`; the one with the largest difference if there is none."""
    known = study.values[quantity][BASE]
    sizes = {variant: difference(study.plan, quantity, study.values[quantity][variant], known) for variant in neighbours(study, quantity).values()}
    if not sizes:
        raise Failed(f"{study.plan.path}: --at: found no setting that changes {study.plan.quantities[quantity].name}, expected one")
    return [variant for variant, size in sizes.items() if size >= min(MATTERS * within, max(sizes.values()))]


def values_there(study, quantity, chosen, changes, jobs):
    """(stages of the first, values) of variants with changed files; Failed where one cannot be made."""
    made, artefacts = make_there(study, quantity, chosen, changes, jobs)
    values = [made.values(own)[quantity] for own in artefacts]
    missing = [one.name for one, value in zip(chosen, values) if value is None]
    if missing:
        raise Failed(f"{study.plan.path}: --at: the run there of {', '.join(missing)} cannot be made: see what its stage says above")
    return made.stages(artefacts[0]), values


def make_there(study, quantity, chosen, changes, jobs):
    """(Making, artefacts of each) of variants with changed files, as far as a quantity needs them; BadArtefact where the changes change nothing."""
    pipeline = run.pipeline_of(study.plan)
    made = run.Making(study.plan, pipeline, quantity)
    folders = [f"{one.folder}-there" if changes else one.folder for one in chosen]
    artefacts = [made.add(variants.changed_tables(study.plan, pipeline, study.variants[BASE].values, one, changes), folder)
                 for one, folder in zip(chosen, folders)]
    if changes and artefacts[0] == made.add({}):
        names = ", ".join(f"{file}:{'.'.join(path)}" for (file, path), _ in changes)
        raise BadArtefact(f"--at: found {names}, on which {study.plan.quantities[quantity].name} does not depend, expected a key that changes it")
    made.make(folders, artefacts, jobs)
    return made, artefacts


def elsewhere(wanted, texts):
    """[((file, path of keys), value)] of texts such as slap.run.toml:engine.speed_rpm=1500."""
    found = []
    for one in texts:
        key, equal, value = one.partition("=")
        try:
            parsed = tomllib.loads(f"value = {value}")["value"] if equal else None
        except tomllib.TOMLDecodeError:
            parsed = None
        if parsed is None:
            raise BadArtefact(f"--at: found {one!r}, expected a key of a file and its value, as slap.run.toml:engine.speed_rpm=1500")
        own = plan.key_of("--at", key.strip())
        if not (wanted.pipeline / own[0]).is_file():
            raise BadArtefact(f"--at: found {own[0]}, expected a file of {wanted.pipeline}")
        if any(own in setting.keys for setting in wanted.settings):
            raise BadArtefact(f"--at: found {key.strip()}, which is a setting of {wanted.path}, expected another key")
        found.append((own, parsed))
    return found
