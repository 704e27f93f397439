# SPDX-License-Identifier: GPL-3.0-or-later
"""The artefacts of a folder, opened once for all sections of a page."""
import dataclasses
import pathlib
import re

from clatter import artefact
from clatter.artefact import stem
from ..plots import style
from ..report import artefacts_of

MANY = 7  # runs, of which each has a colour of its own; of more only some are shown in full


@dataclasses.dataclass
class Run:
    """A run and the field recovered from it; either may be absent (None)."""
    number: int
    stem: str
    label: str
    run: object
    field: object


class Folder:
    """Paths by stage, and runs in the order of their names."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.files = artefacts_of(path)
        self.runs = [self.read(number, name) for number, name in
                     enumerate(sorted({stem(one) for stage in ("run", "field") for one in self.files[stage]}, key=natural))]

    def read(self, number, name):
        found = {kind: artefact.open_artefact(path, kind) for kind in ("run", "field")
                 for path in self.files[kind] if stem(path) == name}
        run, field = found.get("run"), found.get("field")
        return Run(number, name, style.label(field or run), run, field)

    @property
    def many(self):
        """Whether the runs are too many to show each in full."""
        return len(self.runs) > MANY

    def models(self):
        """Paths of the reduced models of the folder, and of those elsewhere that its fields were made with."""
        found = {path.resolve(): path for path in self.files["rom"]}
        for one in self.with_field():
            for path in made_with(one.field):
                found.setdefault(path.resolve(), path)
        return list(found.values())

    @property
    def title(self):
        """The folder's name as words."""
        return self.path.resolve().name.replace("_", " ")

    def with_run(self):
        return [one for one in self.runs if one.run is not None]

    def with_field(self):
        return [one for one in self.runs if one.field is not None]


def natural(name):
    """A key that sorts numbers in names by their values."""
    return [(0, int(part), "") if part.isdigit() else (1, 0, part) for part in re.split(r"(\d+)", name) if part]


def made_with(field):
    """Paths of the reduced models that a field was made with, where they are found unchanged."""
    own = pathlib.Path(field.filename).resolve().parent
    found = []
    for name, digest in zip(*(field[f"inputs/{key}"][()] if "inputs" in field else () for key in ("path", "sha256"))):
        name = pathlib.Path(artefact.text(name))
        places = [path for path in (own / name.name, own / name, own.parent / name.name, name)
                  if name.name.endswith(".rom.h5") and path.exists()]
        found += [path for path in places[:1] if artefact.sha256(path) == artefact.text(digest)]
    return found
