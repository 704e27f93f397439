#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of docs/accuracy.md that `clatter study` makes: budgets, effects and proved proposals of the samples, and a deck of
calculix-ccx-test under a moving force.

Takes what `make study` has made, and makes what is missing. A study's tables go between <!-- study NAME --> and the next <!-- end --> of
docs/accuracy.md, those of its effects between <!-- effects NAME -->, proposals of all studies between <!-- study proofs -->.
"""
import argparse
import os
import shutil
import sys
import tempfile
from pathlib import Path

from page import markdown as rows_as_markdown
from page import write

ROOT = Path(__file__).resolve().parent.parent
for folder in ("tools", "tests/validate"):
    sys.path.insert(0, str(ROOT / folder))
import deck_study  # noqa: E402
from clatter_tools.study import effects, effects_page, findings, markdown, page, proof, run  # noqa: E402

STUDIES = {"slap": "truck_diesel/study.toml", "mesh": "truck_diesel/study_mesh.toml", "drive": "timing_drive/study.toml", "beam": "beam/study.toml"}
WITH_EFFECTS = ("slap", "drive")
CHOICES = [*STUDIES, "deck", "proofs"]
PICTURE = ("sound-power.png", ROOT / "docs/study.png")


def budget(name, path, jobs, put):
    found = run.make(path, jobs)
    page.write(found)
    put(f"study {name}", [*markdown.study(found), "", *(f"- {one}." for one in findings.sentences(found) if not one.endswith("no value changes it"))])


def effects_of(name, jobs, put):
    found = effects.make(study_of(name), jobs)
    effects.write(found)
    effects_page.write(found)
    put(f"effects {name}", markdown.effects(found))


def study_of(name):
    return ROOT / "samples" / STUDIES[name]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", choices=CHOICES, default=CHOICES)
    parser.add_argument("-j", "--jobs", type=int, default=2)
    parser.add_argument("--write", action="store_true", help="put the tables into docs/accuracy.md, and the picture into docs")
    options = parser.parse_args()
    os.environ.setdefault("CLATTER_BIN", str(ROOT / "build/release/bin"))

    def put(mark, lines):
        print("\n".join([f"{mark}:", *lines, ""]), flush=True)
        if options.write:
            write(mark, lines)

    for name in STUDIES:
        if name in options.only:
            budget(name, study_of(name), options.jobs, put)
        if name in options.only and name in WITH_EFFECTS:
            effects_of(name, options.jobs, put)
    if "slap" in options.only and options.write:
        shutil.copyfile(study_of("slap").parent / "study" / PICTURE[0], PICTURE[1])
    if "deck" in options.only:
        with tempfile.TemporaryDirectory(prefix="clatter-deck-") as scratch:
            budget("deck", deck_study.write(scratch), options.jobs, put)
    if "proofs" in options.only:
        rows = [[name, *row] for name in STUDIES for row in proof.read_proofs(run.plan.read(study_of(name)))[1:]]
        put("study proofs", rows_as_markdown(["study", *proof.PROOFS], rows))


if __name__ == "__main__":
    main()
