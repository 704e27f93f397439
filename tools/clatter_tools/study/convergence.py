# SPDX-License-Identifier: GPL-3.0-or-later
"""Orders, limits, errors and the budget of a study's quantities."""
import dataclasses

import numpy as np

from .quantities import Value

ORDERS = (0.2, 12.0)     # in which an order is looked for
SAME_ORDER = 0.25        # largest relative difference of two orders that agree
BETTER = 0.99            # of another error
NOISE = 1e-9             # of a value: smaller differences have no order


def order_of(h, q):
    """p of Q(h) = Q* + C h^p through three values; nan where there is none in ORDERS (Richardson 1911, Roache 1998)."""
    first, second = q[0] - q[1], q[1] - q[2]
    if first * second <= 0.0 or min(abs(first), abs(second)) <= NOISE * max(map(abs, q)):
        return float("nan")

    def excess(p):  # rises with p for h[0] > h[1] > h[2]
        scaled = [(one / h[0]) ** p for one in h]
        return (scaled[0] - scaled[1]) / (scaled[1] - scaled[2]) - first / second

    low, high = ORDERS
    if excess(low) > 0.0 or excess(high) < 0.0:
        return float("nan")
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) < 0.0 else (low, middle)
    return 0.5 * (low + high)


def limit_of(h, q, p):
    """Q* of the two finest values with the order p."""
    return q[-1] - (q[-2] - q[-1]) / ((h[-2] / h[-1]) ** p - 1.0)


@dataclasses.dataclass
class Line:
    """A quantity along a setting: variants by number from coarse to fine, the reference Q* and where it is from ("richardson" or
    "finest"), the orders of all triples, errors Q - Q* of the variants and of the base."""
    variants: list
    reference: Value
    source: str
    orders: list
    errors: list
    base_error: Value

    @property
    def order(self):
        return self.orders[-1] if self.orders else float("nan")


def line(wanted, variants, sizes, values, base):
    """The Line of variants with values that are known (a Value each), from coarse to fine, and of the base's value; `wanted`: reference of
    the setting; `sizes`: of the steps, or None."""
    orders, reference, source = [], values[-1], "finest"
    if sizes and all(one.is_number for one in values):
        numbers = [float(one.values[0]) for one in values]
        orders = [order_of(sizes[k:k + 3], numbers[k:k + 3]) for k in range(len(numbers) - 2)]
        if wanted != "finest" and is_clean(orders, wanted):
            reference, source = Value(np.array([limit_of(sizes, numbers, orders[-1])]), np.zeros(1)), "richardson"
    return Line(variants, reference, source, orders, [one.minus(reference) for one in values], base.minus(reference))


def expected(line):
    """([difference to expect with each value of a Line], whether they fall steadily with one sign)."""
    sizes, zero = [one.size() for one in line.errors], NOISE * line.reference.size()
    changes = [one.minus(other) for one, other in zip(line.errors, line.errors[1:])]
    if max(sizes) <= zero:
        return line.errors, True
    steady = len(changes) > 1 and all(one.product(other) > 0.0 for one, other in zip(changes, changes[1:])) \
        and changes[-1].size() <= changes[-2].size() and all(a >= b for a, b in zip(sizes, sizes[1:]))
    rest = changes[-1] if line.source == "finest" and changes else line.errors[-1]  # of the finest value
    if steady:
        return [*line.errors[:-1], rest.times(0.5) if line.source == "finest" else rest], True
    found, largest = [], rest.size()
    for one in reversed([*line.errors[:-1], rest]):
        largest = max(largest, one.size())
        found.append(one.times(largest / one.size()) if one.size() > 0.0 else rest.times(largest / rest.size() if rest.size() > 0.0 else 0.0))
    return found[::-1], False


def is_clean(orders, wanted):
    """Whether the last orders agree; where Richardson's extrapolation is asked for, one is enough."""
    last = orders[-2:] if wanted == "auto" else orders[-1:]
    if len(last) < (2 if wanted == "auto" else 1) or not np.isfinite(last).all():
        return False
    return max(last) - min(last) <= SAME_ORDER * max(last)


@dataclasses.dataclass
class Budget:
    """Differences of a quantity's base. parts: [(number of the setting, difference from its reference)]; sum: of the same from the
    finest values; refined: base less the run with everything refined, None without it; total: base less the total reference."""
    parts: list
    sum: Value
    refined: Value
    total: Value

    def closure(self):
        """The sum over the difference of the refined run, of curves where that is largest; nan without it or where it is 0."""
        if self.refined is None or not self.refined.size() > 0.0:
            return float("nan")
        mine, others = self.refined.common(self.sum)
        if not len(mine):
            return float("nan")
        largest = int(np.argmax(np.abs(self.refined.values[mine])))
        return float(self.sum.values[others][largest] / self.refined.values[mine][largest])


def budget(lines, base, refined, reference):
    """The Budget of {number of the setting: Line}; `refined`: value of the run with everything refined, or None."""
    zero = base.minus(base)
    parts, total = [], zero
    for number, one in lines.items():
        parts.append((number, one.base_error))
        total = total.plus(one.base_error.minus(one.errors[-1]))
    return Budget(parts, total, None if refined is None else base.minus(refined), base.minus(reference))


def total_reference(exact, lines, base, refined):
    """What all variants are compared with: the exact value; else the refined run less what is left of each setting; else the base
    less the errors of all settings."""
    if exact is not None:
        return exact
    found = base if refined is None else refined
    for one in lines.values():
        found = found.minus(one.base_error if refined is None else one.errors[-1])
    return found


def pareto(seconds, errors):
    """Indices of what nothing else beats in both, by rising seconds; an error counts as smaller from BETTER on."""
    best, found = float("inf"), []
    for k in sorted(range(len(seconds)), key=lambda k: (seconds[k], errors[k])):
        if np.isfinite(seconds[k]) and np.isfinite(errors[k]) and errors[k] < BETTER * best:
            best = errors[k]
            found.append(k)
    return found
