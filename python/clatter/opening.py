# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens a file by its own kind."""
from .artefact import Artefact, open_artefact, text
from .errors import BadArtefact
from .field import Field
from .model import Model
from .modes import Modes
from .rom import Rom
from .run import Run
from .sound import Sound

CLASSES = {one.kind: one for one in (Model, Modes, Rom, Run, Field, Sound)}


def open(path) -> Artefact:
    """The Model, Modes, Rom, Run, Field or Sound of a file, by the schema that it names. Refused for another kind of file."""
    with open_artefact(path) as file:
        schema = text(file.attrs.get("schema", "none"))
    kind = schema.split("/")[1] if schema.startswith("clatter/") else ""
    if kind not in CLASSES:
        raise BadArtefact(f"{path}: schema: found {schema}, expected that of {', '.join(CLASSES)}")
    return CLASSES[kind](path)
