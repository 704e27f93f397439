# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter study --within`: the cheapest settings for a requested error, by what the study has measured, proved by a run.

Model: the differences from the references of the settings add up, and the seconds of each artefact are those of the base times a factor for each
setting. Along a setting whose differences fall steadily with one sign they add with their signs; a finest value that is its own reference has half of
the difference from the next coarser one, and between two tested values with step sizes there is one more candidate in the middle (of
logarithms), with interpolated difference and factors. Along any other setting a small difference is an accident of this scene: a value has the largest
difference of itself and all finer ones, the finest that of the last refinement, no value in between is proposed, and these differences, whose
signs say nothing, add in squares. Where the budget is closed and the refined run differs by more than the sum of its parts, everything is
multiplied by their ratio. Settings are chosen by the sum of all magnitudes. Errors are against the limit of all settings, not against an exact value.
Values with which the model does not state the quantity (a frequency above half the cut-off, bands above the spectra) are no candidates.

--at changes keys of the pipeline: another speed, load or clearance than that of the study. The base is run there, and with it each setting that
matters at the value before the base's: the differences along that setting are taken to be as many times as large as that of these two runs is, but not less
than half, as a small one may be an accident. Along the others they are as many times as large as along the worst of these, but not smaller. What a proposal
has coarser than the base is run there too before it is believed: a difference is at least that of this run. All add in squares, as signs may be others there. The seconds of each stage are expected in proportion to those of the base. The proof is a run there with the proposed settings against one with everything refined, of which the proposal has seen nothing.
Each proof is a row of proofs.csv in the study's folder; --markdown shows them.
"""
import csv
import dataclasses
import itertools
import math
import tomllib

import numpy as np

from ..artefact import BadArtefact
from . import convergence, findings, plan, results, run, variants
from .quantities import Value
from .run import BASE

MOST = 300_000  # combinations
SAME = 1.1      # times the seconds: less is noise
MATTERS = 0.1   # of the requested error: settings whose neighbours differ by less are not run in another scene
LEAST = 0.5     # times the study's differences: smaller ones in another scene may be an accident


@dataclasses.dataclass
class Candidate:
    """A value of a setting: its difference from the setting's reference, factors of the seconds by artefact, whether the sign of the difference
    can be relied on, and the variant that was tested with it, or with the next coarser value."""
    value: tuple
    difference: Value
    factors: dict
    signed: bool
    variant: int

    def at_least(self, size):
        """With a difference of at least that size."""
        own = self.difference.size()
        return self if own >= size else dataclasses.replace(self, difference=Value(np.full(1, size), np.zeros(1)), signed=False)

    def worse_than(self, other, scaled):
        """Whether another one has neither a larger error nor any larger factor."""
        names = {*self.factors, *other.factors}
        return other is not self and scaled(other.difference.size()) <= scaled(self.difference.size()) and \
            all(other.factors.get(name, 1.0) <= self.factors.get(name, 1.0) for name in names)


@dataclasses.dataclass
class Proposal:
    """values: of all settings; variants: tested with them, or with the next coarser ones; expected: error by the sum of the differences; most: sum of their
    magnitudes, in the units of errors; seconds; factors: of the seconds of the base's stages, by artefact."""
    values: tuple
    variants: tuple
    expected: float
    most: float
    seconds: float
    factors: dict


def candidates(study, quantity, number):
    """Those of a setting; of one whose line is not known the base only."""
    setting, line = study.plan.settings[number], study.lines[quantity].get(number)
    base = {stage.name: getattr(stage, study.plan.cost) for stage in study.stages[BASE]}
    matter = {stage.name for stage in study.stages[BASE] if study.plan.quantities[quantity].file in stage.needed_by} & study.affected(number)
    if line is None or not matter:
        zero = study.values[quantity][BASE].minus(study.values[quantity][BASE])
        return [Candidate(study.variants[BASE].values[number], zero, {}, True, BASE)]
    names, found, sizes = study.affected(number), [], []
    differences, steady = convergence.expected(line)
    stated = [k for k, variant in enumerate(line.variants) if not study.values[quantity][variant].beyond]
    for k in stated or range(len(differences)):
        variant = line.variants[k]
        factors = {stage.name: max(getattr(stage, study.plan.cost), 1e-9) / max(base[stage.name], 1e-9)
                   for stage in study.stages[variant] if stage.name in names}
        found.append(Candidate(study.variants[variant].values[number], differences[k], factors, steady, variant))
        sizes.append(setting.sizes[setting.values.index(found[-1].value)] if setting.sizes and found[-1].value in setting.values else None)
    return found + (between(found, sizes) if steady and None not in sizes else [])


def between(tested, sizes):
    """A candidate in the middle between neighbours whose values are the step sizes or their inverses."""
    found = []
    for one, other, h, finer in zip(tested, tested[1:], sizes, sizes[1:]):
        value = middle_value(one.value, other.value, h, finer)
        if value is None or not one.difference.is_number or one.value == other.value:
            continue
        pair = [float(part.difference.values[0]) for part in (one, other)]
        same = pair[0] * pair[1] > 0.0
        difference = math.copysign(math.sqrt(pair[0] * pair[1]), pair[0]) if same else 0.5 * (pair[0] + pair[1])
        factors = {name: math.sqrt(one.factors.get(name, 1.0) * other.factors.get(name, 1.0)) for name in {*one.factors, *other.factors}}
        found.append(Candidate(value, Value(one.difference.values * 0.0 + difference, one.difference.at), factors, True, one.variant))
    return found


def middle_value(one, other, h, finer):
    """The value between two whose numbers that change are proportional to the step sizes or their inverses; None where they are not, or
    where they are whole numbers without one between them."""
    found = []
    for a, b in zip(one, other):
        if a == b:
            found.append(a)
            continue
        if not plan.is_number(a) or not plan.is_number(b) or a * b <= 0 or \
                not any(math.isclose(a / b, ratio, rel_tol=1e-9) for ratio in (h / finer, finer / h)):
            return None
        middle = math.copysign(math.sqrt(a * b), a)
        if isinstance(a, int) and isinstance(b, int):
            middle = round(middle)
            if middle in (a, b):
                return None
        else:
            middle = float(f"{middle:.3g}")
        found.append(middle)
    return tuple(found)


def propose(study, quantity, within, seconds=math.inf, times=None, sizes=None):
    """(the cheapest Proposal whose error is at most `within`, in the units of errors, and whose seconds are at most `seconds`, of those that cost about
    the same the one with the smallest error; None where there is none, the one with the smallest error within the seconds, or of all). `times`: differences
    along each setting over those of the study, in another scene than the study's; `sizes`: of those from the base there, by variant."""
    signed, times = times is None, times or [1.0] * len(study.plan.settings)
    ratio = study.budgets[quantity].closure()
    more = 1.0 / ratio if findings.is_closed(ratio) and ratio < 1.0 else 1.0
    scaled = lambda difference: more * study.scaled(quantity, difference)  # noqa: E731
    lists = [[dataclasses.replace(one, difference=one.difference.times(times[number])).at_least((sizes or {}).get(one.variant, 0.0))
              for one in candidates(study, quantity, number)] for number in range(len(study.plan.settings))]
    lists = [[one for one in own if not any(one.worse_than(other, scaled) and not other.worse_than(one, scaled) for other in own)] for own in lists]
    if math.prod(map(len, lists)) > MOST:
        tested = [{value for value in setting.values} for setting in study.plan.settings]
        lists = [[one for one in own if one.value in values] or own for own, values in zip(lists, tested)]
    if math.prod(map(len, lists)) > MOST:
        raise run.Failed(f"{study.plan.path}: found {math.prod(map(len, lists))} combinations of values, expected at most {MOST}")
    file = study.plan.quantities[quantity].file
    base = [stage for stage in study.stages[BASE] if file in stage.needed_by]
    least, enough = None, []
    for chosen in itertools.product(*lists):
        most = scaled(sum(one.difference.size() for one in chosen))
        spent = seconds_by(study.plan, base, factors_of(base, chosen))
        key = (spent > seconds, most, spent)
        if least is None or key < least[0]:
            least = (key, chosen, most, spent)
        if most <= within and spent <= seconds:
            enough.append(((most, spent), chosen, most, spent))
    cheapest = min((one[3] for one in enough), default=0.0)
    best = min((one for one in enough if one[3] <= SAME * cheapest), key=lambda one: one[0], default=None)
    return tuple(proposal_of(scaled, base, one, signed) if one else None for one in (best, least))


def factors_of(stages, chosen):
    return {stage.name: math.prod(one.factors.get(stage.name, 1.0) for one in chosen) for stage in stages}


def seconds_by(wanted, stages, factors):
    """Seconds of stages of a base with the factors of other settings."""
    return sum(getattr(stage, wanted.cost) * factors[stage.name] for stage in stages)


def proposal_of(scaled, base, found, signed):
    _, chosen, most, spent = found
    total, squares = chosen[0].difference.times(0.0), 0.0
    for one in chosen:
        if one.signed and signed:
            total = total.plus(one.difference)
        else:
            squares += one.difference.size()**2
    return Proposal(tuple(one.value for one in chosen), tuple(one.variant for one in chosen), scaled(math.hypot(total.size(), math.sqrt(squares))), most, spent, factors_of(base, chosen))


@dataclasses.dataclass
class Place:
    """Where proposals are proved: files that differ there ([] in the study's own scene), stages of the base, its value and the reference of the quantity;
    tried: {number of a setting: differences there over those in the study} of its neighbour; sizes: {variant: of its difference from the base there, of
    relative errors the same part of the study's reference as there of the base}."""
    changes: list
    stages: list
    base: Value
    reference: Value
    tried: dict = dataclasses.field(default_factory=dict)
    sizes: dict = dataclasses.field(default_factory=dict)

    def times(self, study):
        """Along each setting; None in the study's own scene."""
        worst = max([1.0, *self.tried.values()])
        return [self.tried.get(number, worst) for number in range(len(study.plan.settings))] if self.changes else None


def place_of(study, quantity, jobs, changes=()):
    """The Place of changes, [((file, path of keys), value)], by runs there of the base and of everything refined; Failed where one cannot be made."""
    wanted, base = study.plan, study.variants[BASE].values
    known = study.values[quantity][BASE]
    refined = study.budgets[quantity].refined
    limit = convergence.total_reference(None, study.lines[quantity], known, None if refined is None else known.minus(refined))
    if not changes:
        return Place([], study.stages[BASE], known, limit)
    chosen = [variants.Variant("base", base), variants.Variant("refined", tuple(setting.values[-1] for setting in wanted.settings))]
    stages, (known, reference) = values_there(study, quantity, chosen, changes, jobs)
    for line in study.lines[quantity].values():
        reference = reference.minus(line.errors[-1])
    return Place(list(changes), stages, known, reference)


def values_there(study, quantity, chosen, changes, jobs):
    """(stages of the first, values) of variants with changed files; Failed where one cannot be made."""
    made, artefacts = make_there(study, quantity, chosen, changes, jobs)
    values = [made.values(own)[quantity] for own in artefacts]
    missing = [one.name for one, value in zip(chosen, values) if value is None]
    if missing:
        raise run.Failed(f"{study.plan.path}: --at: the run there of {', '.join(missing)} cannot be made: see what its stage says above")
    return made.stages(artefacts[0]), values


def try_there(study, quantity, jobs, place, found):
    """Runs variants of the study at a Place."""
    values = values_there(study, quantity, [study.variants[one] for one in [BASE, *found]], place.changes, jobs)[1]
    for variant, value in zip(found, values[1:]):
        place.sizes[variant] = study.scale(quantity) * difference(study.plan, quantity, value, place.base)
    for number, variant in neighbours(study, quantity).items():
        if variant in found:
            there, here = (difference(study.plan, quantity, *pair) for pair in ((values[1 + found.index(variant)], place.base),
                                                                               (study.values[quantity][variant], study.values[quantity][BASE])))
            place.tried[number] = max(LEAST, there / here)


def propose_there(study, quantity, within, seconds, jobs, place):
    """As propose(), at a Place: neighbours that matter are tried there before, and whatever the proposal has coarser than the base."""
    found = those_that_matter(study, quantity, within) if place.changes else []
    while True:
        if found:
            try_there(study, quantity, jobs, place, found)
        best, least = propose(study, quantity, within, seconds, place.times(study), place.sizes)
        if best is None or not place.changes:
            return best, least
        found = [variant for number, variant in enumerate(best.variants) if variant not in place.sizes and is_coarser(study, quantity, number, variant)]
        if not found:
            return best, least


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
        raise run.Failed(f"{study.plan.path}: --at: found no setting that changes {study.plan.quantities[quantity].name}, expected one")
    return [variant for variant, size in sizes.items() if size >= min(MATTERS * within, max(sizes.values()))]


def make_there(study, quantity, chosen, changes, jobs):
    """(Making, artefacts of each) of variants with changed files, as far as a quantity needs them; BadArtefact where the changes change nothing."""
    pipeline = run.pipeline_of(study.plan)
    made = run.Making(study.plan, pipeline, quantity)
    artefacts = [made.add(variants.changed_tables(study.plan, pipeline, study.variants[BASE].values, one, changes)) for one in chosen]
    if changes and artefacts[0] == made.add({}):
        names = ", ".join(f"{file}:{'.'.join(path)}" for (file, path), _ in changes)
        raise BadArtefact(f"--at: found {names}, on which {study.plan.quantities[quantity].name} does not depend, expected a key that changes it")
    made.make([f"{one.folder}-there" if changes else one.folder for one in chosen], artefacts, jobs)
    return made, artefacts


@dataclasses.dataclass
class Proof:
    """Of a run: its error in the units of errors, its seconds, and those expected there."""
    error: float
    seconds: float
    expected: float


def prove(study, quantity, proposal, jobs, place):
    """The Proof of a run with the proposed settings at a Place; Failed where it cannot be made."""
    wanted = study.plan
    chosen = [variants.Variant("base", study.variants[BASE].values), variants.Variant("proposed", proposal.values)]
    made, artefacts = make_there(study, quantity, chosen, place.changes, jobs)
    value = made.values(artefacts[1], "proposed")[quantity]
    if value is None:
        raise run.Failed(f"{wanted.path}: the proposed settings cannot be run: see what the stage says above")
    error = difference(wanted, quantity, value, place.reference)
    base = [stage for stage in place.stages if stage.name in proposal.factors]
    return Proof(error, run.cost_of(wanted, made.stages(artefacts[1]), quantity), seconds_by(wanted, base, proposal.factors))


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


@dataclasses.dataclass
class Request:
    """A quantity and an error, in percent or in the quantity's unit."""
    quantity: int
    error: float
    percent: bool

    def within(self, study):
        """The error in the units of errors."""
        if self.percent:
            return 0.01 * self.error * (1.0 if study.plan.quantities[self.quantity].relative else study.references[self.quantity].size())
        return study.scaled(self.quantity, self.error)


def requested(wanted, text):
    """The Request of "sound power 0.5", "sound power 0.5 dB(A)" or "height of the slap 2 %"; `wanted`: plan of the study."""
    for number, one in enumerate(wanted.quantities):
        rest = text.removeprefix(f"{one.name} ").strip()
        percent = rest.endswith("%")
        try:
            error = float(rest.removesuffix("%" if percent else one.unit).strip())
        except ValueError:
            continue
        if text.startswith(f"{one.name} ") and 0.0 < error < math.inf:
            return Request(number, error, percent)
    first = wanted.quantities[0]
    raise BadArtefact(f"--within: found {text!r}, expected a quantity and an error, as \"{first.name} 2 %\" or \"{f'{first.name} 0.5 {first.unit}'.rstrip()}\"; "
                      f"known: {', '.join(one.name for one in wanted.quantities)}")


def report(study, quantity, proposal):
    """Lines: the settings, what is expected."""
    lines = [f"{setting.name} = {setting.label(value)}{' (the base)' if value == base else ''}"
             for setting, value, base in zip(study.plan.settings, proposal.values, study.variants[BASE].values)]
    return [*lines, f"expected: an error of {findings.error_text(study, quantity, proposal.expected)} (at most "
            f"{findings.error_text(study, quantity, proposal.most)}), {findings.seconds_text(proposal.seconds)}"]


def answer(study, request, text, seconds, jobs, there=(), at=()):
    """`clatter study --within`: prints the proposal and its proof; `text` says the request, `at` what is changed there."""
    quantity, within = request.quantity, request.within(study)
    lacking = [study.plan.settings[number].name for number in study.lacking(quantity)]
    if lacking:
        raise run.Failed(f"{study.plan.path}: the finest value of {', '.join(lacking)} could not be made: errors are not known; see what its stage says above")
    place = place_of(study, quantity, jobs, there)
    best, least = propose_there(study, quantity, within, seconds, jobs, place)
    if at:
        said = ", ".join(f"{study.plan.settings[number].name} {times:.2g}" for number, times in place.tried.items())
        print(f"there, differences over those in the study: {said}", flush=True)
    if best is None:
        print("\n".join(["the nearest:", *report(study, quantity, least)]))
        raise run.Failed(f"{study.plan.path}: no settings of this study are within {findings.error_text(study, quantity, within)}"
                         f"{f' and {seconds:g} s' if math.isfinite(seconds) else ''}: add finer values, or ask for less")
    print("\n".join(report(study, quantity, best)), flush=True)
    proof = prove(study, quantity, best, jobs, place)
    print(f"the run{', ' if at else ''}{', '.join(at)}: {findings.error_text(study, quantity, proof.error)}, {findings.seconds_text(proof.seconds)}"
          f"{f' of {findings.seconds_text(proof.expected)} expected there' if at else ''}{'' if proof.error <= within else ': MORE THAN REQUESTED'}")
    keep_proof(study.plan, [text, ", ".join(at) or "the study's", ", ".join(f"{setting.name} {setting.label(value)}" for setting, value in zip(study.plan.settings, best.values)),
                            f"{findings.error_text(study, quantity, best.expected)} (at most {findings.error_text(study, quantity, best.most)}), {findings.seconds_text(proof.expected)}",
                            f"{findings.error_text(study, quantity, proof.error)}, {findings.seconds_text(proof.seconds)}",
                            f"{proof.error / best.expected:.2f}" if best.expected > 0.0 else "-", f"{proof.seconds / proof.expected:.2f}"])
    exact = study.plan.quantities[quantity].exact
    if exact is not None:
        rest = study.scaled(quantity, place_of(study, quantity, jobs).reference.minus(exact).size())
        print(f"beside the error of these settings: {findings.error_text(study, quantity, rest)} between the limit of all settings and the exact value")
    if proof.error > within:
        raise run.Failed(f"{study.plan.path}: found {findings.error_text(study, quantity, proof.error)}, more than the {findings.error_text(study, quantity, within)} "
                         "asked for: ask for less, or add values to the study")


PROOFS = ["request", "scene", "proposed", "expected", "the run", "error over expected", "seconds over expected"]


def read_proofs(wanted):
    """Rows of proofs.csv, the first is the head."""
    path = wanted.output / "proofs.csv"
    if not path.exists():
        return [PROOFS]
    with open(path, newline="", encoding="utf-8") as stream:
        return [PROOFS, *list(csv.reader(stream))[1:]]


def keep_proof(wanted, row):
    """Adds a row to proofs.csv, in place of one of the same request and scene; returns its path."""
    rows = [one for one in read_proofs(wanted) if one[:2] != row[:2]] + [row]

    def fill(part):
        with open(part, "w", newline="", encoding="utf-8") as stream:
            csv.writer(stream).writerows(rows)

    return results.whole(wanted.output / "proofs.csv", fill)
