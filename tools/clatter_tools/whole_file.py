# SPDX-License-Identifier: GPL-3.0-or-later
"""A file that is complete or absent: written under a temporary name, synced, then renamed."""
import contextlib
import os
import pathlib

from clatter.artefact import CannotWrite


def sync(path):
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


@contextlib.contextmanager
def whole_file(path):
    """The temporary path to write: after the block it gets the name `path`, after an error it is removed. CannotWrite."""
    path = pathlib.Path(path)
    part = path.with_name(path.name + ".part")
    try:
        yield part
        sync(part)
        os.replace(part, path)
    except OSError as error:
        raise CannotWrite(f"{path}: cannot be written: {error.strerror or error}") from error
    finally:
        with contextlib.suppress(OSError):
            part.unlink(missing_ok=True)
