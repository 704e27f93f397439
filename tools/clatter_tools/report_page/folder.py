# SPDX-License-Identifier: GPL-3.0-or-later
"""The artefacts of a folder, opened once for all sections of a page."""
import dataclasses
import pathlib

from .. import artefact
from ..plots import style
from ..report import STAGES, stem


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
        self.files = {stage: sorted(self.path.glob(f"*.{stage}.h5")) for stage in STAGES}
        if not any(self.files.values()):
            raise artefact.BadArtefact(f"{path}: no artefacts; `clatter run {path}` makes them")
        self.runs = [self.read(number, name) for number, name in
                     enumerate(sorted({stem(one) for stage in ("run", "field") for one in self.files[stage]}))]

    def read(self, number, name):
        found = {kind: artefact.open_artefact(path, kind) for kind in ("run", "field")
                 for path in self.files[kind] if stem(path) == name}
        run, field = found.get("run"), found.get("field")
        return Run(number, name, style.label(field or run), run, field)

    @property
    def title(self):
        """The folder's name as words."""
        return self.path.resolve().name.replace("_", " ")

    def with_run(self):
        return [one for one in self.runs if one.run is not None]

    def with_field(self):
        return [one for one in self.runs if one.field is not None]
