# SPDX-License-Identifier: GPL-3.0-or-later
"""The answer of `clatter study --within`: a proposal, and its proof.

The proof is a run with the proposed settings; with --at there, against one with everything refined, of which the proposal has seen nothing. Each proof
is a row of proofs.csv in the study's folder; --markdown shows them.
"""
import csv
import dataclasses
import math

from clatter.errors import BadArtefact, Failed
from . import convergence, findings, results, run, variants
from .place import difference, make_there, place_of, propose_there
from .proposal import seconds_by
from .run import BASE


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
    if place.changes:
        chosen.append(variants.Variant("refined", tuple(setting.values[-1] for setting in wanted.settings)))
    made, artefacts = make_there(study, quantity, chosen, place.changes, jobs)
    values = [made.values(own, one.name)[quantity] for one, own in zip(chosen, artefacts)]
    missing = [one.name for one, value in zip(chosen, values) if value is None]
    if missing:
        raise Failed(f"{wanted.path}: the run with the {' and the '.join(missing)} settings cannot be made: see what its stage says above")
    error = difference(wanted, quantity, values[1], limit_of(study, quantity, values[2] if place.changes else None))
    base = [stage for stage in place.stages if stage.name in proposal.factors]
    return Proof(error, run.cost_of(wanted, made.stages(artefacts[1]), quantity), seconds_by(wanted, base, proposal.factors))


def limit_of(study, quantity, refined=None):
    """The limit of all settings, in the study's scene or by a run elsewhere with everything refined."""
    known, lines = study.values[quantity][BASE], study.lines[quantity]
    if refined is None and study.budgets[quantity].refined is not None:
        refined = known.minus(study.budgets[quantity].refined)
    return convergence.total_reference(None, lines, known, refined)


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
        raise Failed(f"{study.plan.path}: the finest value of {', '.join(lacking)} could not be made: errors are not known; see what its stage says above")
    unlike = [one.name for k, one in enumerate(study.variants) if study.conditions(k, quantity)]
    if unlike:
        raise Failed(f"{study.plan.path}: --within: {findings.alike(study)[0]}; found {', '.join(unlike)}")
    place = place_of(study, quantity, within, jobs, there)
    best, least = propose_there(study, quantity, within, seconds, jobs, place)
    if at:
        said = ", ".join(f"{study.plan.settings[number].name} {times:.2g}" for number, times in place.tried.items())
        print(f"there, differences over those in the study: {said}", flush=True)
    if best is None:
        print("\n".join(["the nearest:", *report(study, quantity, least)]))
        raise Failed(f"{study.plan.path}: no settings of this study are within {findings.error_text(study, quantity, within)}"
                         f"{f' and {seconds:g} s' if math.isfinite(seconds) else ''}: add finer values, or allow a larger error")
    print("\n".join(report(study, quantity, best)), flush=True)
    proof = prove(study, quantity, best, jobs, place)
    print(f"the run{', ' if at else ''}{', '.join(at)}: {findings.error_text(study, quantity, proof.error)}, {findings.seconds_text(proof.seconds)}"
          f"{f' of {findings.seconds_text(proof.expected)} expected there' if at else ''}{'' if proof.error <= within else ': MORE THAN REQUESTED'}")
    proposed = ", ".join(f"{setting.name} {setting.label(value)}" for setting, value in zip(study.plan.settings, best.values))
    keep_proof(study.plan, [text, ", ".join(at) or "the study's", proposed, f"{findings.error_text(study, quantity, best.expected)} "
                            f"(at most {findings.error_text(study, quantity, best.most)}), {findings.seconds_text(proof.expected)}",
                            f"{findings.error_text(study, quantity, proof.error)}, {findings.seconds_text(proof.seconds)}",
                            f"{proof.error / best.expected:.2f}" if best.expected > 0.0 else "-", f"{proof.seconds / proof.expected:.2f}"])
    exact = study.plan.quantities[quantity].exact
    if exact is not None:
        rest = study.scaled(quantity, limit_of(study, quantity).minus(exact).size())
        print(f"beside the error of these settings: {findings.error_text(study, quantity, rest)} between the limit of all settings and the exact value")
    if proof.error > within:
        raise Failed(f"{study.plan.path}: found {findings.error_text(study, quantity, proof.error)}, more than the {findings.error_text(study, quantity, within)} "
                         "asked for: request a smaller error, or add values to the study")


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
