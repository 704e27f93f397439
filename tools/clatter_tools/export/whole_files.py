# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are complete or absent: written under temporary names, synced, then renamed."""
import contextlib
import os
import pathlib
import shutil

from clatter.artefact import BadArtefact, CannotWrite
from ..whole_file import sync

MARK = "clatter.txt"  # in a folder that a hand-off wrote, so that another hand-off may replace it


def remove(path):
    shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)


class WholeFiles:
    """Context of a hand-off: `part(path)` is the temporary path to write; all of them are renamed at the end, in the order in
    which they were requested, or removed after an error. The path of a folder is renamed as one."""

    def __init__(self):
        self.paths = []

    def part(self, path):
        path = pathlib.Path(path)
        self.paths.append(path)
        part = path.with_name(path.name + ".part")
        remove(part)
        return part

    @contextlib.contextmanager
    def text(self, path):
        """A text file to write, by its final path."""
        with open(self.part(path), "w", encoding="ascii", errors="replace", newline="\n") as stream:
            yield stream

    def folder(self, path):
        """An empty folder to write into, by its final path."""
        if path.exists() and not (path / MARK).is_file():
            raise BadArtefact(f"{path}: found a file or folder that clatter export did not write, expected a new name")
        part = self.part(path)
        part.mkdir()
        return part

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        parts = [path.with_name(path.name + ".part") for path in self.paths]
        try:
            if kind is None:
                for path, part in zip(self.paths, parts):
                    for file in part.rglob("*") if part.is_dir() else ():
                        sync(file)
                    sync(part)
                for path, part in zip(self.paths, parts):
                    if part.is_dir() and path.exists():
                        remove(path)
                    os.replace(part, path)
                    sync(path.parent)
        except OSError as problem:
            kind, error = OSError, problem
        if kind is not None:
            for part in parts:
                remove(part)
        if isinstance(error, OSError) and error.errno:  # without a number: HDF5 on data that it reads
            raise CannotWrite(f"{self.paths[-1]}: cannot be written: {os.strerror(error.errno)}") from error
