# SPDX-License-Identifier: GPL-3.0-or-later
"""What accuracy costs: the studies (`clatter study`) and their effects in folders of the folder."""
import base64
import csv

from clatter import artefact
from ..parameters import slug


def collect(folder):
    """One entry for each folder with study.h5, effects.csv or proofs.csv; None without one."""
    places = sorted({path.parent for name in ("study.h5", "effects.csv") for path in folder.path.glob(f"*/{name}")})
    return [{"name": one.name, **study(one / "study.h5"), "effects": rows(one / "effects.csv"), "proofs": rows(one / "proofs.csv")} for one in places] or None


def study(path):
    """{"quantities": [{name, sentences, picture: PNG as base64, None without it}]} of study.h5."""
    found = []
    if not path.exists():
        return {"quantities": found}
    with artefact.open_artefact(path, "study") as file:
        texts = ([artefact.text(one) for one in file[f"said/{key}"][()]] for key in ("quantity", "headline", "verdict", "sentences"))
        for name, headline, verdict, said in zip(*texts):
            picture = path.parent / f"{slug(name)}.png"
            found.append({"name": name, "sentences": [headline, verdict, *said.split("\n")],
                          "picture": base64.b64encode(picture.read_bytes()).decode() if picture.exists() else None})
    return {"quantities": found}


def rows(path):
    """Rows of a CSV file, the first is the head; None without it."""
    if not path.exists():
        return None
    with open(path, newline="", encoding="utf-8") as stream:
        return list(csv.reader(stream))
