# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter study --markdown`: the tables of a study, of its effects and of its proposals for a document."""
import math

from . import effects as effects_of
from . import findings, proof


def table(rows):
    """Lines of a Markdown table: the first row is its head."""
    lines = ["| " + " | ".join(one.replace("|", "/") for one in row) + " |" for row in rows]
    return [lines[0], "|" + "---|" * len(rows[0]), *lines[1:]]


def study(study):
    """The budget of each quantity, what is not converged or closed, seconds and errors of the points that nothing beats."""
    return [*table(budget_rows(study)), "", *(f"- {one}." for one in findings.verdicts(study)), "", *table(cost_rows(study))]


def proofs(plan):
    """The proposals that were proved; [] without one."""
    rows = proof.read_proofs(plan)
    return table(rows) if len(rows) > 1 else []


def effects(effects):
    """The effects of a study's scenes."""
    return table(effects_of.rows(effects))


def budget_rows(study):
    """Errors of the base by setting, their sum, and the run with everything refined, a column for each quantity."""
    base = study.variants[findings.BASE].values
    rows = [["error of the base", *(one.name for one in study.plan.quantities)]]
    parts = [dict(one.parts) for one in study.budgets]
    for number, setting in enumerate(study.plan.settings):
        label = f"{setting.name} {setting.label(base[number])}, to {setting.label(setting.values[-1])}"
        rows.append([label, *(findings.signed(study, k, own[number]) if number in own else "-" for k, own in enumerate(parts))])
    rows.append(["sum", *(findings.signed(study, k, one.sum) for k, one in enumerate(study.budgets))])
    rows.append(["a run with all of them", *("-" if one.refined is None else findings.signed(study, k, one.refined) for k, one in enumerate(study.budgets))])
    ratios = [one.closure() for one in study.budgets]
    rows.append(["sum over run", *(f"{one:.2f}" if math.isfinite(one) else "-" for one in ratios)])
    return rows


def cost_rows(study):
    """Of each quantity the variants that no other one beats in both seconds and total error."""
    rows = [["quantity", "variant", "total error", "seconds"]]
    for k, own in enumerate(study.plan.quantities):
        for variant in findings.front(study, k):
            rows.append([own.name, study.variants[variant].name, findings.error_text(study, k, study.error(k, variant)), findings.seconds_text(study.cost(variant, k))])
    return rows
