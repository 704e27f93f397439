# SPDX-License-Identifier: GPL-3.0-or-later
"""Kinds of TOML files, and their tables of keys from the programs that read them."""
import json
import subprocess

from clatter.errors import BadArtefact
from clatter.pipeline import program
from . import study_keys

# kind: the program that reads it; none for the tools' own.
KINDS = {"mesh": "clatter-mesh", "fe": "clatter-assembly", "modes": "clatter-modal", "rom": "clatter-condense", "run": "clatter-dynamics",
         "field": "clatter-recover", "sound": "clatter-recover", "study": None, "parameters": None}
OWN = {"study": study_keys.STUDY, "parameters": study_keys.PARAMETERS}


def tables_of(name):
    """{kind: table} of a program; empty where it is not there, or has no command `keys`."""
    try:
        path = program(name)
    except BadArtefact:
        return {}
    done = subprocess.run([path, "keys", "--json"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return {}
    return {one["name"].removesuffix(".toml"): one for one in json.loads(done.stdout.splitlines()[-1])["files"]}


def read(kinds=KINDS):
    """({kind: table}, kinds that their programs cannot describe)."""
    found = {}
    for name in dict.fromkeys(KINDS[kind] for kind in kinds):
        found.update(OWN if name is None else tables_of(name))
    return {kind: found[kind] for kind in kinds if kind in found}, [kind for kind in kinds if kind not in found]


def walk(table, path=""):
    """(path, key) of all keys of a table and the tables below: ("window.taper", {...})."""
    for key in table["keys"]:
        yield path + key["name"], key
        if "table" in key:
            yield from walk(key["table"], f"{path}{key['name']}.")
