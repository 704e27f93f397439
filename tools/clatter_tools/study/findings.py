# SPDX-License-Identifier: GPL-3.0-or-later
"""What a study says: a sentence for each setting and quantity, and tables as text."""
import math

from ..slaps import table
from . import convergence
from .run import BASE
from .store import BESIDE

SHOWN = 3       # points of a sentence
CLOSED = 2.0    # factor within which a budget is closed
NOTHING = 1e-6  # of a quantity: differences that are no effect of a setting
PART = 0.1      # of the budget: smaller changes along a setting are not called unsettled


def error_text(study, quantity, error):
    """"0.35 %", "0.2 dB(A)"."""
    own = study.plan.quantities[quantity]
    return f"{digits(100.0 * error)} %" if own.relative else f"{digits(error)} {own.unit}".rstrip()


def digits(value, sign=""):
    """Two digits, of larger numbers all before the point."""
    return f"{value:{sign}.2g}" if abs(value) < 99.5 else f"{value:{sign}.0f}"


def seconds_text(seconds):
    return f"{seconds:.0f} s" if seconds >= 10.0 else f"{seconds:.2g} s"


def points(study, quantity, number):
    """[(variant, seconds, error)] of a setting that nothing beats in both, the reference itself left out; by falling error. Seconds are of
    the stages that the setting changes."""
    line = study.lines[quantity].get(number)
    if line is None:
        return []
    rows = [(variant, study.cost_of_setting(variant, quantity, number), study.scaled(quantity, error.size())) for variant, error in zip(line.variants, line.errors)]
    rows = sorted((row for row in rows if row[2] > NOTHING * study.size(quantity) and math.isfinite(row[1])), key=lambda row: (row[1], row[2]))
    best, found = math.inf, []
    for row in rows:
        if row[2] < best:
            best = row[2]
            found.append(row)
    return found


def ruler(study, quantity, number):
    """(error, number) of the other setting with the largest error of the base; None without one."""
    others = [(study.scaled(quantity, part.size()), one) for one, part in study.budgets[quantity].parts if one != number]
    return max(others, default=None)


def sentence(study, quantity, number):
    """"tolerance: 0.5 % costs 14 s, 0.05 % costs 160 s; below 0.2 % the cell size dominates"."""
    setting, own = study.plan.settings[number], study.plan.quantities[quantity]
    found, left = points(study, quantity, number), not_compared(study, quantity, number)
    where = f"{setting.name}, {own.name}"
    if not found:
        why = "not known, no other value could be made" if number not in study.lines[quantity] else f"no seconds are compared: {left}" if left else \
            "no value changes it"
        return f"{where}: {why}"
    middle = next((row for row in found[1:-1] if row[0] == BASE), found[len(found) // 2])
    chosen = found if len(found) <= SHOWN else [found[0], middle, found[-1]]
    parts = [f"{error_text(study, quantity, error)} costs {seconds_text(seconds)} "
             f"({setting.label(study.variants[variant].values[number])}{', the base' if variant == BASE else ''})" for variant, seconds, error in chosen]
    other = ruler(study, quantity, number)
    end = ""
    if other and other[0] > found[-1][2]:
        name = study.plan.settings[other[1]].name
        end = f"; below {error_text(study, quantity, other[0])} {name} dominates" if other[0] < found[0][2] else \
            f"; {name} dominates throughout with {error_text(study, quantity, other[0])}"
    others = study.cost(BASE, quantity) - study.cost_of_setting(BASE, quantity, number)
    end += f"; {seconds_text(others)} of other stages" if math.isfinite(others) else ""
    return f"{where}: {', '.join(parts)}{end}{f'; not compared: {left}' if left else ''}"


def not_compared(study, quantity, number):
    """"0.4 (beside others), 0.2, the base (taken over)": values of a setting whose seconds were not measured as those of others; "" for none."""
    setting, line = study.plan.settings[number], study.lines[quantity].get(number)
    found = []
    for variant, error in zip(line.variants, line.errors) if line else ():
        why = study.conditions(variant, quantity, number)
        if why and study.scaled(quantity, error.size()) > NOTHING * study.size(quantity):
            found.append(f"{setting.label(study.variants[variant].values[number])}{', the base' if variant == BASE else ''} ({', '.join(why)})")
    return ", ".join(found)


def alike(study):
    """Why seconds are not compared, and how they are: a line; none where all are."""
    why = sorted({one for variant in range(len(study.variants)) for one in study.conditions(variant)})
    return [f"seconds of stages that were {' or '.join(f'measured {one}' if one == BESIDE else one for one in why)} are not compared with others: "
            "cost = \"processor\", or -j1 without reuse, measures alike"] if why else []


def sentences(study):
    return [sentence(study, quantity, number) for quantity in range(len(study.plan.quantities)) for number in range(len(study.plan.settings))]


def front(study, quantity):
    """Variants that no other one beats in both seconds and total error, by rising seconds."""
    costs = [study.compared_cost(k, quantity) for k in range(len(study.variants))]
    return convergence.pareto(costs, [study.error(quantity, k) for k in range(len(study.variants))])


def headline(study, quantity):
    """"sound power: 87.1 dB(A), total error 0.19 dB(A) for 156 s; film cells along dominates with 0.19 dB(A)"."""
    own, value = study.plan.quantities[quantity], study.values[quantity][BASE]
    known = f"{f'{value.text(4)} {own.unit}'.rstrip()}, " if value.is_number else ""
    parts = [(study.scaled(quantity, part.size()), study.plan.settings[number].name) for number, part in study.budgets[quantity].parts]
    error, name = max(parts, default=(0.0, ""))
    ruled = f"; {name} dominates with {error_text(study, quantity, error)}" if error > NOTHING * study.size(quantity) else ""
    return f"{own.name}: {known}total error {error_text(study, quantity, study.error(quantity, BASE))} for {seconds_text(study.cost(BASE, quantity))}{ruled}"


def headlines(study):
    """Of the base, a line for each quantity."""
    return [headline(study, quantity) for quantity in range(len(study.plan.quantities))]


def unsettled(study, quantity):
    """[(number of the setting, last change, the change before)] along which a quantity does not converge: the last refinement changes it by more than
    the one before."""
    budget, found = study.budgets[quantity], []
    largest = max([part.size() for _, part in budget.parts] + ([] if budget.refined is None else [budget.refined.size()]), default=0.0)
    for number, line in study.lines[quantity].items():
        changes = [one.minus(other).size() for one, other in zip(line.errors, line.errors[1:])]
        if len(changes) > 1 and changes[-1] > changes[-2] and changes[-1] > PART * largest and changes[-1] > NOTHING * study.references[quantity].size():
            found.append((number, changes[-1], changes[-2]))
    return found


def verdict(study, quantity):
    """Whether the budget of a quantity is closed, and along which settings it does not converge."""
    own, budget = study.plan.quantities[quantity], study.budgets[quantity]
    said = [f"does not converge along {study.plan.settings[number].name} (the last refinement changes it by {error_text(study, quantity, study.scaled(quantity, last))}, "
            f"the one before by {error_text(study, quantity, study.scaled(quantity, before))})" for number, last, before in unsettled(study, quantity)]
    if budget.refined is not None:
        ratio = budget.closure()
        small = own.small is not None and max(study.scaled(quantity, one.size()) for one in (budget.sum, budget.refined)) <= own.small
        if not math.isfinite(ratio):
            said.insert(0, "the run with everything refined shows no error")
        elif is_closed(ratio):
            said.insert(0, f"the budget is closed, sum over run {ratio:.2f}")
        elif small:
            said.insert(0, f"sum and run are both within {error_text(study, quantity, own.small)}")
        else:
            said.insert(0, f"the budget is open, sum over run {ratio:.2f}: {'' if said else 'the settings act on each other or the quantity jumps'}".rstrip(": "))
    said += beyond(study, quantity)
    said += [f"lacks the finest value of {study.plan.settings[number].name}, which could not be made: what is beyond the one before is not seen"
             for number in study.lacking(quantity)]
    return f"{own.name}: {'; it '.join(said) or 'no run with everything refined'}"


def beyond(study, quantity):
    """["is beyond what the model states with modes up to 300 Hz (565 Hz of 150 Hz)"] of the variants with which it is."""
    named = [f"{one.name} ({value.beyond})" for one, value in zip(study.variants, study.values[quantity]) if value is not None and value.beyond]
    return [f"is beyond what the model states with {', '.join(named)}"] if named else []


def is_closed(ratio):
    """Whether sum and refined run agree within the factor CLOSED; nan does not."""
    return 1.0 / CLOSED <= ratio <= CLOSED


def verdicts(study):
    return [verdict(study, quantity) for quantity in range(len(study.plan.quantities))]


def order_text(line):
    """"2.0 (Richardson)" or "finest"."""
    known = [one for one in line.orders if math.isfinite(one)]
    orders = ", ".join(f"{one:.2f}" if math.isfinite(one) else "-" for one in line.orders) if known else "-"
    return orders, "Richardson" if line.source == "richardson" else "finest"


def budget_rows(study, quantity):
    """The budget of the error of a quantity's base: rows of cells, the first is the head."""
    own, found = study.plan.quantities[quantity], study.budgets[quantity]
    rows = [[f"error of the base, {own.name}", "difference", "orders", "reference"]]
    for number, part in found.parts:
        orders, source = order_text(study.lines[quantity][number])
        rows.append([study.plan.settings[number].name, signed(study, quantity, part), orders, source])
    rows.append(["sum, from the finest values", signed(study, quantity, found.sum), "", ""])
    if found.refined is not None:
        rows.append(["a run with all of them", signed(study, quantity, found.refined), "", closure_text(found)])
    if own.exact is not None:
        rest = found.total
        for _, part in found.parts:
            rest = rest.minus(part)
        rows.append(["not of these settings", signed(study, quantity, rest), "", ""])
        rows.append(["against the exact value", signed(study, quantity, found.total), "", ""])
    return rows


def signed(study, quantity, difference):
    error = study.scaled(quantity, difference.number())
    return f"{100.0 * error:+.3g} %" if study.plan.quantities[quantity].relative else f"{error:+.3g} {study.plan.quantities[quantity].unit}"


def closure_text(found):
    """Whether the sum of the parts is what the refined run shows."""
    ratio = found.closure()
    if not math.isfinite(ratio):
        return "-"
    return f"sum / run {ratio:.2f}{'' if is_closed(ratio) else ': NOT CLOSED, the settings act on each other or the quantity jumps'}"


def variant_rows(study, quantity):
    """Value, total error and cost of all variants: rows of cells, the first is the head."""
    own = study.plan.quantities[quantity]
    rows = [[f"{own.name}{f' [{own.unit}]' if own.unit else ''}", "value", "total error", "seconds"]]
    for k, one in enumerate(study.variants):
        value = study.values[quantity][k]
        if value is None:
            rows.append([one.name, "missing", "", ""])
            continue
        shown = value.text(6) if value.is_number else f"{len(value.values)} values"
        rows.append([one.name, shown, error_text(study, quantity, study.error(quantity, k)), f"{study.cost(k, quantity):.3g}{seconds_note(study, k, quantity)}"])
    return rows


def seconds_note(study, variant, quantity):
    """" (beside others)", why the seconds of a variant are not compared; "" where they are."""
    why = study.conditions(variant, quantity)
    return f" ({', '.join(why)})" if why else ""


def report(study):
    """All lines that `clatter study` prints."""
    lines = [*headlines(study), ""]
    for quantity in range(len(study.plan.quantities)):
        for rows in (variant_rows(study, quantity), budget_rows(study, quantity)):
            lines += [*table(rows[0], rows[1:]), ""]
    return [*lines, *sentences(study), *alike(study), "", *verdicts(study)]
