# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter report`: results of the runs of a folder, cost of each stage, paths of pictures."""
import pathlib
import sys

from clatter import artefact, chains
from clatter.artefact import stem
from . import drive_findings, findings, slap

STAGES = ["mesh", "fe", "modes", "rom", "sound", "run", "field"]


def artefacts_of(folder):
    """The paths of a folder's artefacts by stage; one that cannot be read is left out with a warning."""
    folder = pathlib.Path(folder)
    files = {stage: [] for stage in STAGES}
    damaged = []
    for stage in STAGES:
        for path in sorted(folder.glob(f"*.{stage}.h5")):
            try:
                artefact.open_artefact(path, stage).close()
                files[stage].append(path)
            except artefact.BadArtefact as error:
                damaged.append(error)
    if not any(files.values()):
        raise damaged[0] if damaged else artefact.BadArtefact(f"{folder}: no artefacts; `clatter run {folder}` makes them")
    for error in damaged:
        print(f"clatter: warning: {error}: left out", file=sys.stderr)
    return files


def print_report(folder):
    """Prints findings per run, seconds and memory per stage, and the files to view."""
    folder = pathlib.Path(folder)
    files = artefacts_of(folder)
    print_models(files["fe"], files["rom"])
    print_quality(files["mesh"])
    print_comparisons(folder)
    print_runs(files["run"])
    print_drives(files["run"])
    print_fields(files["field"])
    print_cost([path for stage in STAGES for path in files[stage]])
    print_paths(folder)


def print_table(title, head, rows):
    """A table with aligned columns; the first column is text, the others are numbers as text."""
    if not rows:
        return
    widths = [max(len(str(row[i])) for row in [head, *rows]) for i in range(len(head))]
    print(f"\n{title}")
    for row in [head, *rows]:
        print("  " + "  ".join(str(cell).ljust(w) if i == 0 else str(cell).rjust(w)
                               for i, (cell, w) in enumerate(zip(row, widths))))


def print_models(fe_files, rom_files):
    rows = []
    for path in fe_files:
        with artefact.open_artefact(path, "fe") as file:
            rows.append([stem(path), findings.fe_size(file), findings.reduced_size(path), *findings.mass(file)])
    print_table("parts", ["part", "FE DoF", "reduced DoF", "mass [kg]"], rows)


def print_quality(paths):
    """The worst cell of each mesh by its angle and by its scaled Jacobian."""
    rows = []
    for path in paths:
        with artefact.open_artefact(path, "mesh") as file:
            rows += [[stem(path), *row] for row in findings.mesh_quality(file)]
    print_table("worst cells of the meshes", ["part", "measure", "worst", "cell", "at [mm]"], rows)


def print_comparisons(folder):
    """The last line of clatter-modal's comparison of each reduced model."""
    tables = sorted(folder.glob("*.compare.txt"))
    if tables:
        print("\nreduced against full model (each mode: *.compare.txt)")
    for path in tables:
        print(f"  {stem(path)}: {path.read_text().strip().splitlines()[-1]}")


def print_runs(paths):
    rows = []
    for path in paths:
        with artefact.open_artefact(path, "run") as file:
            rows += [[f"{stem(path)} {cylinder}".rstrip(), *cells] for cylinder, cells in findings.run_rows(file)]
    print_table("runs (last cycle)", ["run", *findings.RUN_HEAD], rows)


def print_drives(paths):
    """Chain drives, run by run, then what runs at several speeds show together."""
    runs = [(path, file) for path in paths for file in [artefact.open_artefact(path, "run")] if chains.names(file)]
    for path, file in runs:
        print(f"\nchain drive of {stem(path)}, {chains.mean_rpm(file):.0f} rpm")
        for sentence in drive_findings.sentences(file):
            print(f"  {sentence}")
    names = sorted({name for _, file in runs for name in chains.names(file)})
    for name in names:
        same = [(file, name) for _, file in runs if name in chains.names(file)]
        found = drive_findings.critical_speed(same) if len(same) > 1 else []
        if found:
            print(f"\n{name} at several speeds")
        for sentence in found:
            print(f"  {sentence}")


def print_fields(paths):
    rows, panels, loud = [], [], []
    for path in paths:
        with artefact.open_artefact(path, "field") as file:
            panels += [[f"{stem(path)}, {panel}", *cells] for panel, *cells in findings.panel_rows(file)]
            rows.append([stem(path), *findings.field_row(file)])
            loud.append(findings.loudness(stem(path), file))
    print_table(f"sensors above {slap.FROM_HZ:g} Hz around firing TDC, and power over the cycle", ["run", *findings.FIELD_HEAD], rows)
    print_table(findings.PANELS[0].lower() + findings.PANELS[1:], [f"run, {findings.PANEL_HEAD[0]}", *findings.PANEL_HEAD[1:]], panels)
    print_loudness(loud)


def print_loudness(loud):
    """What each field radiates, the loudest first."""
    if loud:
        print("\nradiated, A-weighted")
    for _, sentence in sorted(loud, key=lambda one: -one[0]):
        print(f"  {sentence}")


def print_cost(paths):
    rows, total = [], 0.0
    for path in paths:
        with artefact.open_artefact(path) as file:
            seconds, peak = artefact.totals(file)
            size = path.stat().st_size / 1e6
        total += seconds
        rows.append([path.name, f"{seconds:.1f}", f"{peak:.2f}", f"{size:.1f}"])
    rows.append(["total", f"{total:.1f}", "", ""])
    print_table("cost of each stage", ["artefact", "seconds", "peak GiB", "file MB"], rows)


def print_paths(folder):
    pictures = sorted(path for kind in ("png", "svg", "html") for path in folder.rglob(f"*.{kind}"))
    series = sorted(folder.glob("*.xdmf"))
    print()
    if pictures:
        print("pictures:  " + "\n           ".join(map(str, pictures)))
    if series:
        print("ParaView:  " + "\n           ".join(map(str, series)))
