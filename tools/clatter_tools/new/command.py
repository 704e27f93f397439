# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter new`: writes a folder that `clatter run` brings to results."""
import contextlib
import os
import pathlib
import re
import shutil
import tempfile

from clatter.errors import BadArtefact, CannotWrite
from . import part, templates
from ..keys.schema_line import PACKAGE, schema_line

# The sample of each kind, and which of its files a user reads and edits.
SAMPLES = {"part": ("beam", ("*.toml", "Makefile", "compare")),
           "slap": ("truck_diesel", ("slap.run.toml", "slap_dry.run.toml", "block.[!m]*.toml", "block.mesh.toml", "block_warm.fe.toml",
                                     "head.*.toml", "engine_bolts.fe.toml", "piston.[!m]*.toml", "piston.mesh.toml",
                                     "piston_warm.fe.toml", "field.toml", "motored.csv")),
           "drive": ("timing_drive", ("*.toml", "Makefile"))}
START = {"part": "start with step.run.toml, the scene, and beam.*.toml, its part",
         "slap": "start with slap.run.toml, the scene, and block.*.toml and piston.*.toml, its parts; slap_dry.run.toml changes a few keys of it",
         "drive": "start with drive.run.toml, the scene, and block.*.toml, its part; valves.run.toml changes a few tables of it"}
INCLUDE = re.compile(r"^include .*clatter rules.*$", re.M)


def add_arguments(one):
    one.add_argument("folder", metavar="NAME", help="the folder to write, which does not exist yet")
    one.add_argument("--kind", choices=SAMPLES, default="part",
                     help="part: a part to its certified reduced model and a hit; slap: piston slap; drive: a timing drive; default part")
    one.add_argument("--part", metavar="FILE", help="of kind part: CAD (.step, .brep, .iges), or a deck or mesh (.bdf, .inp, .msh, ...); "
                                                    "without it a beam")
    one.add_argument("--units", metavar="NAME", help="of a deck, which does not say its own: mm-t-s, m-kg-s, ...")


def write_new(options):
    """`clatter new`: the folder is complete or absent. BadArtefact where it exists, or for what cannot be combined."""
    folder = pathlib.Path(options.folder)
    if folder.exists() or folder.is_symlink():
        raise BadArtefact(f"{folder}: exists; give a name that does not")
    if not folder.parent.is_dir():
        raise BadArtefact(f"{folder.parent}: no such folder")
    if options.part and options.kind != "part":
        raise BadArtefact(f"--part needs --kind part: a {options.kind} names faces and sets of several parts; start from its sample and "
                          "change its block.mesh.toml and block.fe.toml")
    if options.units and not options.part:
        raise BadArtefact("--units needs --part: it is the unit of a deck")
    with whole_folder(folder) as scratch:
        if options.part:
            lines = part.write_part(scratch, pathlib.Path(options.part), options.units)
        else:
            lines = [*copy_sample(scratch, *SAMPLES[options.kind]), START[options.kind]]
        names = sorted(path.name for path in scratch.iterdir())
    print(f"{folder}: {len(names)} files: {', '.join(names)}")
    for line in lines:
        print(line)
    print(f"next: clatter run {folder}")


@contextlib.contextmanager
def whole_folder(path):
    """A scratch folder beside `path`, which gets its name after the block; after an error it is removed. CannotWrite."""
    scratch = None
    try:
        scratch = pathlib.Path(tempfile.mkdtemp(prefix=f".{path.name}.", suffix=".part", dir=path.parent))
        scratch.chmod(0o777 & ~umask())
        yield scratch
        os.rename(scratch, path)
    except OSError as error:
        raise CannotWrite(f"{path}: cannot be written: {error.strerror or error}") from error
    finally:
        if scratch:
            shutil.rmtree(scratch, ignore_errors=True)


def umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def samples_folder():
    """Of an installation, or of the source tree."""
    for folder in (PACKAGE.parent / "samples", PACKAGE.parents[1] / "samples"):
        if folder.is_dir():
            return folder
    raise BadArtefact("the samples were not found beside clatter's tools; reinstall clatter")


def copy_sample(folder, name, patterns):
    """Copies these files of a sample, with the rules and schemas of this installation; returns lines for the user."""
    source = samples_folder() / name
    for path in (path for pattern in patterns for path in source.glob(pattern)):
        text = INCLUDE.sub("include $(shell clatter rules)", path.read_text(encoding="utf-8"))
        text = re.sub(r"^#:schema \S*?(\w+)\.schema\.json\n", lambda found: schema_line(f"{found[1]}.toml"), text, flags=re.M)
        (folder / path.name).write_text(text, encoding="utf-8")
        shutil.copymode(path, folder / path.name)
    if not (folder / "Makefile").exists():
        (folder / "Makefile").write_text(templates.SLAP_MAKEFILE, encoding="utf-8")
        return [f"from samples/{name}, which has more scenes: the comments say what each number is"]
    return [f"a copy of samples/{name}: its comments say what each number is"]
