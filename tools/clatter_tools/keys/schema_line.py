# SPDX-License-Identifier: GPL-3.0-or-later
"""The first line of a TOML file that the tools write: editors then complete and explain its keys."""
import os
import pathlib

from .files import KINDS

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
# Beside the programs that are used, installed beside the tools, or in the build of the source tree.
FOLDERS = (pathlib.Path(os.environ.get("CLATTER_BIN", PACKAGE)).parent / "share/clatter/schemas", PACKAGE.parent / "schemas",
           PACKAGE.parents[1] / "build/release/share/clatter/schemas")


def kind_of(name):
    """The kind of file that a name is of, "run" for slap.run.toml; empty for others."""
    kind = pathlib.PurePath(name).name.removesuffix(".toml").split(".")[-1]
    return kind if kind in KINDS else ""


def schema_line(name):
    """The line for a file of that name; empty where there are no schemas."""
    kind = kind_of(name)
    found = [path for folder in FOLDERS if kind and (path := folder / f"{kind}.schema.json").is_file()]
    return f"#:schema {found[0].as_uri()}\n" if found else ""
