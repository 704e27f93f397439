# SPDX-License-Identifier: GPL-3.0-or-later
"""The documents of the site in reading order, and the frame of a page."""
import html
import pathlib
import posixpath

ROOT = pathlib.Path(__file__).resolve().parents[2]
KEYS = [(f"docs/keys/{name}.md", name) for name in ("mesh", "fe", "modes", "rom", "run", "field", "sound", "study")
        if (ROOT / f"docs/keys/{name}.md").exists()]

# Heading: [(document of the repository, or page of the C++ reference; its title)].
NAVIGATION = {
    "": [("README.md", "clatter")],
    "Tutorials": [("docs/tutorial/README.md", "Tutorials"), ("docs/tutorial/1-beam.md", "1. Beam"),
                  ("docs/tutorial/2-cad-part.md", "2. CAD part"), ("docs/tutorial/3-deck.md", "3. Deck"),
                  ("docs/tutorial/4-piston-slap.md", "4. Piston slap"),
                  ("docs/tutorial/5-timing-drive.md", "5. Timing drive"),
                  ("docs/tutorial/6-sound.md", "6. Sound and report"),
                  ("docs/tutorial/7-accuracy.md", "7. Accuracy"),
                  ("docs/tutorial/8-cluster.md", "8. On a cluster"),
                  ("docs/tutorial/9-whole-engine.md", "9. The whole engine")],
    "Programs": [("mesh/README.md", "mesh"), ("mesh/deck/README.md", "mesh/deck"), ("assembly/README.md", "assembly"),
                 ("modal/README.md", "modal"), ("condense/README.md", "condense"), ("dynamics/README.md", "dynamics"),
                 ("docs/dynamics/theory.md", "dynamics: theory"), ("docs/dynamics/methods.md", "dynamics: methods"),
                 ("docs/dynamics/scene.md", "dynamics: the scene"), ("docs/dynamics/results.md", "dynamics: results"),
                 ("dynamics/film/README.md", "dynamics/film"), ("dynamics/profile/README.md", "dynamics/profile"), ("dynamics/chain/README.md", "dynamics/chain"),
                 ("dynamics/hydraulic/README.md", "dynamics/hydraulic"), ("dynamics/ring/README.md", "dynamics/ring"),
                 ("dynamics/shaft/README.md", "dynamics/shaft"), ("dynamics/crank/README.md", "dynamics/crank"),
                 ("dynamics/valve/README.md", "dynamics/valve"), ("recover/README.md", "recover"),
                 ("tools/clatter_tools/report_page/README.md", "report")],
    "Samples": [("samples/beam/README.md", "beam"), ("samples/cpp/README.md", "cpp"),
                ("samples/timing_drive/README.md", "timing_drive"), ("samples/truck_diesel/README.md", "truck_diesel")],
    "Keys of TOML files": KEYS,
    "Documents": [("docs/concepts.md", "Concepts"), ("docs/faq.md", "Questions"), ("docs/gallery.md", "Gallery"),
                  ("docs/design.md", "Design"), ("docs/effects.md", "Effects"), ("docs/formats.md", "File formats"),
                  ("docs/python.md", "Python"), ("docs/matlab.md", "MATLAB"),
                  ("docs/cards.md", "Cards and keywords"),
                  ("docs/accuracy.md", "Accuracy"), ("docs/validation.md", "Validation"), ("docs/hard-cases.md", "Hard cases"),
                  ("docs/certificates.md", "Certificates"),
                  ("docs/cluster.md", "Batch systems")],
    "Development": [("CONTRIBUTING.md", "Contributing"), ("STYLE.md", "Style"), ("CHANGELOG.md", "Changelog"),
                    ("core/README.md", "core"), ("bench/README.md", "bench")],
    "C++ reference": [("api/namespaces.html", "Namespaces"), ("api/annotated.html", "Classes"),
                      ("api/namespacemembers_func.html", "Functions"), ("api/files.html", "Headers")],
}


def documents():
    return [path for entries in NAVIGATION.values() for path, _ in entries if path.endswith(".md")]


def page_of(path):
    """The page of a document: index.html for a README."""
    folder, name = posixpath.split(path)
    return posixpath.join(folder, "index.html" if name == "README.md" else name.replace(".md", ".html"))


def relative(page, target):
    """The href by which a page leads to a path of the site."""
    return posixpath.relpath(target, posixpath.dirname(page) or ".")


def navigation(page, sections=()):
    """The list of all pages; `sections`, [(anchor, title)], are those of `page` itself."""
    lines = ['<nav class="site">']
    for heading, entries in NAVIGATION.items():
        lines += [f"<h2>{heading}</h2>"] if heading else []
        lines.append("<ul>")
        for path, title in entries:
            target = page_of(path)
            here = ' class="here"' if target == page else ""
            inner = "".join(f'<li><a href="#{anchor}">{html.escape(text)}</a></li>' for anchor, text in sections)
            inner = f"<ul>{inner}</ul>" if here and inner else ""
            lines.append(f'<li><a{here} href="{relative(page, target)}">{title}</a>{inner}</li>')
        lines.append("</ul>")
    return "\n".join([*lines, "</nav>"])


def framed(page, title, body, sections=()):
    """A complete page of the site."""
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{html.escape(title)}</title>
<link rel="stylesheet" href="{relative(page, "site.css")}">
</head>
<body class="document">
{navigation(page, sections)}
<main>
{body}</main>
</body>
</html>
"""


def doxygen_header():
    """The same frame for Doxygen, which replaces the words with a dollar sign; it closes #top itself."""
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<link rel="stylesheet" href="$relpath^tabs.css">
<script src="$relpath^jquery.js"></script>
<script src="$relpath^dynsections.js"></script>
$search
<link rel="stylesheet" href="$relpath^$stylesheet">
<link rel="stylesheet" href="$relpath^../site.css">
</head>
<body class="reference">
{navigation("api/index.html")}
<div id="top">
<div id="search-of-reference">$searchbox</div>
"""


DOXYGEN_FOOTER = "</body>\n</html>\n"
