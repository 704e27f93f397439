# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter study --within`: the cheapest settings for a requested error, by what the study has measured, proved by a run (proof.py).

Model: the differences from the references of the settings add up, and the seconds of each artefact are those of the base times a factor for each
setting. Along a setting whose differences fall steadily with one sign they add with their signs; a finest value that is its own reference has half of
the difference from the next coarser one, and between two tested values with step sizes there is one more candidate in the middle (of
logarithms), with interpolated difference and factors. Along any other setting a small difference is an accident of this scene: a value has the largest
difference of itself and all finer ones, the finest that of the last refinement, no value in between is proposed, and these differences, whose
signs say nothing, add in squares. Where the budget is closed and the refined run differs by more than the sum of its parts, everything is
multiplied by their ratio. Settings are chosen by the sum of all magnitudes. Errors are against the limit of all settings, not against an exact value.
Values with which the model does not state the quantity (a frequency above half the cut-off, bands above the spectra) are no candidates.
"""
import dataclasses
import itertools
import math

import numpy as np

from ..keys.rows import is_number
from . import convergence, findings, plan, run
from .quantities import Value
from .run import BASE

MOST = 300_000  # combinations
SAME = 1.1      # times the seconds: less is noise


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
        if not is_number(a) or not is_number(b) or a * b <= 0 or \
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
    expected = scaled(math.hypot(total.size(), math.sqrt(squares)))
    return Proposal(tuple(one.value for one in chosen), tuple(one.variant for one in chosen), expected, most, spent, factors_of(base, chosen))
