# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter report --html`: the results of a folder as one page of HTML that needs no other file and no network.

Each module collects the data of one section; the folder `page` beside this one has the page itself: template, style, scripts.
"""
import pathlib
from xml.sax.saxutils import escape

import numpy as np

from clatter import artefact
from clatter.histories import angle_zero
from . import (accuracy, certificates, cost, drive, film_maps, mechanism, models, radiation, sensors, sound, speeds, summary, surface, two)
from ..plots import style
from ..whole_file import whole_file
from .folder import Folder
from .pack import Pack, json_text

PAGE = pathlib.Path(__file__).resolve().parent.parent / "page"
# In this order: each uses only what is before it.
SCRIPTS = ("element", "data", "theme", "runs", "save", "scale", "lines", "picture", "plot", "heat", "matrix", "renderer", "motion", "view", "sound",
           "loudness", "summary", "beside", "controls", "surface_save", "surface", "radiation", "listening", "sensors", "mechanism", "film", "drive", "speeds", "models", "accuracy", "cost", "main")
COLOURS = {"viridis": "viridis", "cividis": "cividis", "diverging": "RdBu_r"}  # safe for colour-blind eyes
STEPS = 64


def write_page(folder, output=None, beside=None):
    """Writes the page, by default report.html in the folder, complete or not at all; returns its path. Of two folders, the second of which
    is `beside`, it has the pages of both."""
    found = [Folder(one) for one in (folder, beside) if one is not None]
    output = pathlib.Path(output) if output else found[0].path / "report.html"
    texts = [page(one) for one in found]
    text = two.page(found, texts, (PAGE / "two.html").read_text(encoding="utf-8")) if beside is not None else texts[0]
    with whole_file(output) as part:
        part.parent.mkdir(parents=True, exist_ok=True)
        part.write_text(text, encoding="utf-8")
    return output


def page(folder):
    """The page as text."""
    pack = Pack()
    data = collect(folder, pack)
    blocks = "\n".join(f'<script type="text/plain" id="block-{name}">{text}</script>' for name, text in pack.texts().items())
    read = lambda name: (PAGE / name).read_text(encoding="utf-8")  # noqa: E731
    script = "\n".join(read(f"{name}.js") for name in SCRIPTS)
    parts = {"TITLE": escape(folder.title), "STYLE": read("page.css"), "DATA": json_text(data), "BLOCKS": blocks, "SCRIPT": script}
    text = read("page.html")
    for name, value in parts.items():
        text = text.replace(f"<!--{name}-->", value, 1)
    return text


def collect(folder, pack):
    """Everything that the page shows, section by section; None: the folder has nothing for a section."""
    cards = certificates.collect(folder)
    return {
        "title": folder.title,
        "version": version(folder),
        "runs": [{"label": one.label, "stem": one.stem} for one in folder.runs],
        "many": folder.many,
        "zero": zero_of(folder),
        "run_colours": style.COLOURS,
        "colours": {name: colour_table(own) for name, own in COLOURS.items()},
        "summary": summary.collect(folder, cards),
        "certificates": cards,
        "surface": surface.collect(folder, pack),
        "radiation": radiation.collect(folder, pack),
        "sound": sound.collect(folder, pack),
        "sensors": sensors.collect(folder, pack),
        "mechanism": mechanism.collect(folder, pack),
        "film": film_maps.collect(folder, pack),
        "drive": drive.collect(folder, pack),
        "speeds": speeds.collect(folder, pack),
        "models": models.collect(folder, pack),
        "accuracy": accuracy.collect(folder),
        "cost": cost.collect(folder),
    }


def zero_of(folder):
    """What crank angle 0 is; words that hold for all runs where they differ."""
    found = {angle_zero(file) for one in folder.runs for file in (one.run, one.field) if file is not None}
    return found.pop() if len(found) == 1 else "the cycle's start"


def version(folder):
    """Of the programs that wrote the folder's newest artefact."""
    newest = max((path for paths in folder.files.values() for path in paths), key=lambda path: path.stat().st_mtime)
    with artefact.open_artefact(newest) as file:
        return artefact.text(file.attrs.get("version", ""))


def colour_table(name):
    """A colour map as STEPS rows of red, green, blue from 0 to 255."""
    return np.rint(255.0 * style.matplotlib.colormaps[name](np.linspace(0.0, 1.0, STEPS))[:, :3]).astype(int)
