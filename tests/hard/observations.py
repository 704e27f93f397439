# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of a hard case print about it: `[ observed ] largest residual: 2e-13 (at most 1e-09)`."""
import dataclasses
import math
import re
import tempfile

LINE = re.compile(r"\[ observed \] (.*)")
SCRATCH = re.compile(rf"{re.escape(tempfile.gettempdir())}/(?:[^\s:'\"]*/)?")
NUMBER = r"[-+]?(?:\d+\.?\d*(?:e[-+]?\d+)?|inf|nan)"
FIGURE = re.compile(rf"(.*): ({NUMBER}) \((at most|at least) ({NUMBER})\)")


@dataclasses.dataclass(frozen=True)
class Observation:
    """A line of a test; without limit it is only text. `margin`: how many times the value fits its limit, infinite
    where a value of 0 is far from any limit, None where that means nothing (no limit, or one of 0 or less)."""
    text: str
    margin: float | None = None


def observations(output):
    """What the lines of an output say, each text once; files in scratch folders without the folder."""
    found = {}
    for line in LINE.findall(output):
        text = SCRATCH.sub("", line.strip())
        found.setdefault(text, Observation(text, margin(text)))
    return list(found.values())


def margin(text):
    """Limit over value of `at most`, value over limit of `at least`."""
    figure = FIGURE.fullmatch(text)
    if not figure:
        return None
    value, limit = float(figure[2]), float(figure[4])
    if not limit > 0.0 or math.isnan(value):
        return None
    if figure[3] == "at least":
        return value / limit
    return limit / value if value > 0.0 else math.inf


def tightest(seen):
    """The observation with the smallest margin; else the first of those without figures; None of none."""
    figures = [one for one in seen if one.margin is not None]
    return min(figures, key=lambda one: one.margin) if figures else next(iter(seen), None)


def margin_text(value):
    """`1.3`, `47`, `2e+05`; empty for None."""
    if value is None:
        return ""
    return "no limit near" if math.isinf(value) else f"{value:.2g}" if value < 10 else f"{value:.0f}" if value < 1e4 else f"{value:.0e}"
