# SPDX-License-Identifier: GPL-3.0-or-later
"""study.html: sentences, diagrams and tables of a study as one page in the style of `clatter report --html`, without scripts; the diagrams
as pictures besides."""
import html
import io
import re

from ..parameters import slug
from ..plots import study_curves, style
from ..report_page import PAGE
from . import findings, results
from .run import BASE

FRAME = """<!DOCTYPE html>
<!-- SPDX-License-Identifier: GPL-3.0-or-later -->
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>{title}</title>
<style>
{style}
figure svg {{ max-width: 100%; height: auto; background: #ffffff; }}
td {{ white-space: normal; }}
.card {{ overflow-x: auto; }}
</style>
</head>
<body>
<header><div class="row"><h1>{title}</h1></div></header>
<main>
{body}
</main>
</body>
</html>
"""


def write(study):
    """Writes study.html and a picture of each quantity into the study's folder; returns the path of the page."""
    style.apply()
    body = [section("What accuracy costs", summary(study))]
    for quantity, own in enumerate(study.plan.quantities):
        sentences = words([findings.sentence(study, quantity, number) for number in range(len(study.plan.settings))])
        body.append(section(own.name, f'<figure>{diagram(study, quantity)}</figure><div class="card">{sentences}</div><div class="grid">'
                            f'<div class="card">{rows_of(findings.budget_rows(study, quantity))}</div>'
                            f'<div class="card">{rows_of(findings.variant_rows(study, quantity))}</div></div>'))
    body.append(section("Cost of the stages of the base", f'<div class="card">{rows_of(stage_cells(study))}</div>'))
    text = page_of(f"Study of {study.plan.pipeline.resolve().name.replace('_', ' ')}", body)
    return results.whole(study.plan.output / "study.html", lambda part: part.write_text(text, encoding="utf-8"))


def page_of(title, body):
    """The text of a page of sections."""
    return FRAME.format(title=html.escape(title), style=(PAGE / "page.css").read_text(encoding="utf-8"), body="\n".join(body))


def section(title, body):
    return f"<section><h2>{html.escape(title)}</h2>{body}</section>"


def summary(study):
    return f'<div class="card">{words(findings.headlines(study))}</div><div class="card">{words(findings.verdicts(study))}</div>'


def words(sentences):
    return f"<ul>{''.join(f'<li>{html.escape(one)}.</li>' for one in sentences)}</ul>"


def diagram(study, quantity):
    """The picture of a quantity as SVG for the page; names of its parts are made its own."""
    stream = io.StringIO()
    figure = study_curves.picture(study, quantity)
    figure.savefig(stream, format="svg", metadata={"Date": None})
    style.save(figure, study.plan.output / f"{slug(study.plan.quantities[quantity].name)}.png")
    text = stream.getvalue()
    text = text[text.index("<svg"):]
    return re.sub(r'(\bid="|href="#|url\(#)', rf"\g<1>q{quantity}-", text)


def rows_of(rows):
    """A table: the first row is its head."""
    head = "".join(f"<th>{html.escape(cell)}</th>" for cell in rows[0])
    body = "".join(f"<tr>{''.join(f'<td>{html.escape(cell)}</td>' for cell in row)}</tr>" for row in rows[1:])
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def stage_cells(study):
    rows = [["artefact", "seconds", "processor seconds", "peak GiB"]]
    return rows + [[one.name, f"{one.seconds:.2f}", f"{one.processor:.2f}", f"{one.peak_gib:.2f}"] for one in study.stages[BASE]]
