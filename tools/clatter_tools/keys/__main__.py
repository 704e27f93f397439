# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes all schemas or all pages: python3 -m clatter_tools.keys schemas|pages FOLDER, with the programs of CLATTER_BIN."""
import sys

from clatter.errors import BadArtefact
from . import command, files, pages, schema

try:
    what, folder = sys.argv[1:]
    tables, missing = files.read()
    command.note_missing(missing)
    {"schemas": schema, "pages": pages}[what].write(tables, folder)
except BadArtefact as error:
    sys.exit(f"clatter: error: {error}")
