# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the files of clatter's programs, and runs the programs: see docs/python.md. Files are opened for reading only; an array is
read when it is needed. All numbers are in SI units, which the documentation of each name gives."""
import importlib

from . import pipeline
from .errors import BadArtefact, CannotWrite, Failed, Refused

# Where a name is: numpy and h5py are loaded with the first of them.
_HOME = {"Artefact": "artefact", "Field": "field", "Model": "model", "Modes": "modes", "Rom": "rom", "Run": "run", "Sound": "sound",
         "open": "opening"}
__all__ = ["BadArtefact", "CannotWrite", "Failed", "Refused", "pipeline", *_HOME]


def __getattr__(name):
    if name not in _HOME:
        raise AttributeError(f"module {__name__} has no {name}")
    return getattr(importlib.import_module(f".{_HOME[name]}", __name__), name)


def __dir__():
    return __all__
