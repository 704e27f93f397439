# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the entries did: one line, JSON, a table in Markdown and a page."""
import dataclasses
import html
import math
import re

import observations

FRAME = """<!DOCTYPE html>
<!-- SPDX-License-Identifier: GPL-3.0-or-later -->
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>Hard cases</title>
<style>
{style}
td {{ white-space: normal; vertical-align: top; text-align: left; }}
.card {{ overflow-x: auto; }}
</style>
</head>
<body>
<header><div class="row"><h1>Hard cases</h1></div></header>
<main>
<section><h2>{summary}</h2><div class="card"><table>
<thead><tr>{head}</tr></thead>
<tbody>
{rows}
</tbody></table></div></section>
</main>
</body>
</html>
"""
HEADINGS = ("case", "what could go wrong", "what must happen", "what happened", "margin", "seconds", "")


@dataclasses.dataclass(frozen=True)
class Result:
    """An entry of the list with what its tests did. `trouble`: why it failed, empty if it did not."""
    entry: object
    seen: tuple
    ran: int
    skipped: int
    trouble: str
    seconds: float


def result(entry, outcomes, missing, seconds):
    """The result of an entry from those of its processes; `missing`: names for which no test is registered."""
    seen = observations.observations("\n".join(one.output for one in outcomes))
    ran, skipped = sum(one.ran for one in outcomes), sum(one.skipped for one in outcomes)
    if any(one.failed for one in outcomes):
        trouble = "a test failed"
    elif missing:
        trouble = f"no test is registered for {', '.join(missing)}"
    elif ran == 0:
        trouble = f"no test ran, {skipped} skipped" if skipped else "no test ran"
    else:
        trouble = ""
    return Result(entry, tuple(seen), ran, skipped, trouble, seconds)


def happened(one):
    """What happened, in a few words: the figure nearest to its limit, a message, or how many tests passed."""
    if one.trouble:
        return one.trouble
    nearest = observations.tightest(one.seen)
    return nearest.text if nearest else f"held, {tests_text(one.ran)}"


def margin_of(one):
    nearest = observations.tightest(one.seen)
    return nearest.margin if nearest else None


def line(one, width=100):
    """`B3   Dependent basis vectors  |  largest residual: 2e-13 (at most 1e-09)  |  margin 5e+03  |  ok  0.3 s`."""
    margin = observations.margin_text(margin_of(one))
    text = happened(one)
    text = text if len(text) <= width else text[:width - 3] + "..."
    return "  |  ".join([f"{one.entry.case:5s}{one.entry.title}", text, *([f"margin {margin}"] if margin else []),
                         f"{'FAILED' if one.trouble else 'ok'}  {one.seconds:.1f} s"])


def tests_text(count):
    return f"{count} test{'' if count == 1 else 's'}"


def summary(results):
    """`99 cases, 99 held, 352 tests`."""
    held = sum(not one.trouble for one in results)
    failed = [one.entry.case for one in results if one.trouble]
    return (f"{len(results)} cases, {held} held, {tests_text(sum(one.ran for one in results))}"
            + (f", {sum(one.skipped for one in results)} skipped" if any(one.skipped for one in results) else "")
            + (f"; failed: {', '.join(failed)}" if failed else ""))


def as_json(results):
    """For hard.json; a margin that is infinite becomes the text `inf`, which JSON has no number for."""
    def number(value):
        return "inf" if value is not None and math.isinf(value) else value
    return [{"case": one.entry.case, "title": one.entry.title, "wrong": one.entry.wrong, "must": one.entry.must,
             "tests": list(one.entry.tests), "ran": one.ran, "skipped": one.skipped, "failed": one.trouble,
             "margin": number(margin_of(one)), "seconds": round(one.seconds, 2),
             "observed": [{"text": seen.text, "margin": number(seen.margin)} for seen in one.seen]} for one in results]


def plain(markdown):
    """Text without links and code marks."""
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", markdown).replace("`", "")


def page(results, style):
    """The page with all figures."""
    rows = []
    for one in results:
        figures = "".join(f"<li>{html.escape(seen.text)}{margin_note(seen)}</li>" for seen in one.seen)
        cells = [html.escape(one.entry.case), f"<b>{html.escape(one.entry.title)}</b><br>{html.escape(plain(one.entry.wrong))}",
                 html.escape(plain(one.entry.must)),
                 (f"<b>{html.escape(one.trouble)}</b>" if one.trouble else tests_text(one.ran)) + (f"<ul>{figures}</ul>" if figures else ""),
                 observations.margin_text(margin_of(one)), f"{one.seconds:.1f}", "FAILED" if one.trouble else "ok"]
        rows.append(f'<tr id="{html.escape(one.entry.case)}">{"".join(f"<td>{cell}</td>" for cell in cells)}</tr>')
    head = "".join(f"<th>{cell}</th>" for cell in HEADINGS)
    return FRAME.format(style=style, summary=html.escape(summary(results)), head=head, rows="\n".join(rows))


def margin_note(seen):
    return "" if seen.margin is None else f", margin {observations.margin_text(seen.margin)}"
