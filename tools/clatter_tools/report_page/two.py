# SPDX-License-Identifier: GPL-3.0-or-later
"""Two folders side by side: the page of each in a frame, and above them the levels of runs that both have."""
from xml.sax.saxutils import escape, quoteattr

from .. import findings


def page(folders, texts, template):
    """The page of two folders, of which `texts` are the pages."""
    names = titles(folders)
    frames = "".join(f"<iframe title={quoteattr(name)} srcdoc={quoteattr(text)}></iframe>" for name, text in zip(names, texts))
    parts = {"TITLE": escape(" beside ".join(names)), "LEVELS": levels_table(names, levels(folders)), "FRAMES": frames}
    for name, value in parts.items():
        template = template.replace(f"<!--{name}-->", value, 2 if name == "TITLE" else 1)
    return template


def titles(folders):
    """Names of both folders, with those of the folders around them where they are the same."""
    first, second = (one.path.resolve() for one in folders)
    if first.name == second.name:
        return [f"{one.parent.name}/{one.name}" for one in (first, second)]
    return [one.title for one in folders]


def levels(folders):
    """(run, level of the first folder, of the second) [dB(A) re 1 pW] of runs that both have a field of, by their file's name."""
    first, second = ({one.stem: findings.loudness(one.label, one.field)[0] for one in folder.with_field()} for folder in folders)
    return [(name, first[name], second[name]) for name in first if name in second]


def levels_table(names, rows):
    if not rows:
        return "no run of the same name has a field in both"
    head = "".join(f"<th scope=\"col\">{escape(cell)}</th>" for cell in ("dB(A) re 1 pW", *names, "change"))
    body = "".join(f"<tr><td>{escape(name)}</td><td>{one:.1f}</td><td>{other:.1f}</td><td>{other - one:+.1f}</td></tr>" for name, one, other in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
