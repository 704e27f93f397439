# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run of make has made: stage, file, seconds, memory, and the figure by which the file is judged."""
from clatter import artefact, fields
from clatter.errors import BadArtefact
from .. import findings
from ..report import print_table

STAGES = {"mesh": "mesh", "fe": "assembly", "modes": "modal", "static": "modal", "shape": "modal", "rom": "condense", "run": "dynamics",
          "field": "recover", "sound": "recover"}
# Kind of file: (number of its certificate, words).
JUDGED = {"mesh": ("min_dihedral_deg", "smallest dihedral angle {:.3g} deg"),
          "fe": ("rigid_force_residue", "forces of rigid motions {:.1e}"),
          "modes": ("residual_max", "largest residual {:.1e}"),
          "rom": ("frequency_error_estimate", "frequencies within {:.1e}"),
          "run": ("energy_residue", "energy residue {:.1e}")}


def print_made(folder, began):
    """A row for each artefact that is newer than `began` [s since 1970]; nothing where there is none."""
    made = sorted((path for path in folder.rglob("*.h5") if path.stat().st_mtime >= began - 0.01), key=lambda path: path.stat().st_mtime)
    rows = [row(folder, path) for path in made if kind_of(path) in STAGES]
    print_table("made", ["file", "stage", "seconds", "peak GiB", "judged by"], rows)


def kind_of(path):
    return path.name.split(".")[-2] if path.name.count(".") > 1 else ""


def row(folder, path):
    kind = kind_of(path)
    try:
        with artefact.open_artefact(path, kind) as file:
            seconds, peak = artefact.totals(file)
            return [str(path.relative_to(folder)), STAGES[kind], f"{seconds:.1f}", f"{peak:.2f}", judged(kind, file)]
    except BadArtefact:  # of another version or program: make's exit code says what that means
        return [str(path.relative_to(folder)), STAGES[kind], *[findings.NOTHING] * 3]


def judged(kind, file):
    if kind == "field":
        return f"{fields.radiated(file, fields.level_piece(file)).level()} dB(A)"
    name, words = JUDGED.get(kind, ("", ""))
    numbers = artefact.certificate(file)
    if name not in numbers:
        return findings.NOTHING
    proved = "" if numbers.get("certified", 1) else ", not certified"
    limit = f" up to {numbers['accurate_to_hz']:.0f} Hz" if kind == "rom" and "accurate_to_hz" in numbers else ""
    return words.format(numbers[name]) + limit + proved
