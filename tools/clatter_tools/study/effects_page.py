# SPDX-License-Identifier: GPL-3.0-or-later
"""effects.html: what each effect changes and costs, as one page in the style of study.html."""
from . import effects as effects_of
from . import results
from .page import page_of, rows_of, section, words


def write(effects):
    """Writes effects.html into the study's folder; returns its path."""
    body = [section("What each effect changes and costs", f'<div class="card">{words(effects_of.report(effects))}</div>')]
    if effects.switches:
        body.append(section("By effect", f'<div class="card">{rows_of(effects_of.rows(effects))}</div>'))
    base = [["quantity", "value of the scene"], *([own.name, f"{value.text(6)} {own.unit}".rstrip() if value.is_number else f"{len(value.values)} values"]
                                                  for own, value in zip(effects.plan.quantities, effects.base))]
    body.append(section("Without a change", f'<div class="card">{rows_of(base)}</div>'))
    text = page_of(f"Effects of {effects.plan.pipeline.resolve().name.replace('_', ' ')}", body)
    return results.whole(effects.plan.output / "effects.html", lambda part: part.write_text(text, encoding="utf-8"))
