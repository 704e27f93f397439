# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder of one part, from CAD, a deck or a mesh: reduced model with a certificate, a hit, its surface velocity."""
import json
import os
import pathlib
import re
import subprocess
import tomllib

import h5py
import numpy as np

from clatter import pipeline
from clatter.errors import BadArtefact, CannotWrite, Failed
from . import cad_faces, templates
from ..keys.schema_line import schema_line

CAD = (".step", ".stp", ".brep", ".iges", ".igs")
SETS = 12          # of a deck's couplings, at most, are retained
BAR_M_S = 5000.0   # speed of sound along a bar of steel or aluminium


def write_part(folder, path, units):
    """Writes the files of the part at `path` into `folder`; returns lines for the user."""
    if not path.is_file():
        raise BadArtefact(f"{path}: no such file")
    stem = re.sub(r"\W+", "_", path.stem)
    source = literal(os.path.relpath(path.resolve(), folder.resolve()))
    if path.suffix.lower() in CAD:
        if units:
            raise BadArtefact(f"--units: {path} is CAD, which names its unit; --units is for decks and meshes")
        return write_cad(folder, path, stem, source)
    if not units:
        raise BadArtefact(f"{path}: give --units: a deck does not say its own (mm-t-s, m-kg-s, mm-kg-ms, ...)")
    return write_deck(folder, path, stem, source, units)


def literal(text):
    return json.dumps(text, ensure_ascii=False)  # which TOML reads as well


def mesh_program(*arguments):
    """Runs clatter-mesh; returns (standard output, standard error). Its error is ours, of the same kind."""
    done = subprocess.run([pipeline.program("clatter-mesh"), *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode:
        lines = done.stderr.strip().splitlines() or [f"clatter-mesh ended with {done.returncode}"]
        kind = {2: BadArtefact, 4: CannotWrite}.get(done.returncode, Failed)
        raise kind(lines[-1].partition("error: ")[2] or lines[-1])
    return done.stdout, done.stderr


def write(folder, name, text):
    (folder / name).write_text(schema_line(name) + text, encoding="utf-8")


def write_cad(folder, path, stem, source):
    drawn = folder / "faces.h5"
    output, said = mesh_program("faces", path, "--json", "-o", drawn)
    found = json.loads(output.splitlines()[-1])
    unit, faces, element = found["unit"], found["faces"], float(found["element_size_mm"])
    with h5py.File(drawn) as file:
        nodes = file["nodes"][()]
    drawn.unlink()
    surfaces, holes = cad_faces.named(faces, unit)
    written = re.search(r"written in \w+|gives no unit", said)
    size = " x ".join(f"{value:.4g}" for value in np.ptp(np.array([face["box"] for face in faces]).reshape(-1, 3), axis=0))
    bores = [surface for surface in surfaces if surface.name.startswith("bore")]
    scale = {"mm": 1e3, "m": 1.0, "cm": 1e2, "in": 1 / 0.0254}[unit]
    write(folder, f"{stem}.mesh.toml", templates.CAD_MESH.format(
        stem=stem, source=source, unit=unit, size=size, written=f"the file {written[0]}" if written else "the file is CAD",
        element=element,
        surfaces="".join(f"\n[surface.{one.name}]   # {one.comment}\n{one.toml}\n" for one in surfaces)))
    couplings = "".join(f'\n[[coupling]]\nname = "{bore.name}"\nkind = "bearing"\nsurface = "{bore.name}"   # {bore.comment}\n'
                        for bore in bores)
    write(folder, f"{stem}.fe.toml", templates.CAD_FE.format(unit=unit if unit in ("m", "mm") else "m", couplings=couplings)
          + sensors(nodes, scale if unit in ("m", "mm") else 1.0))
    write_rest(folder, stem, nodes, [bore.name for bore in bores], ["[[setting]]", 'name = "element size"', 'unit = "mm"',
               f'key = "{stem}.mesh.toml:mesh.element_size_mm"', f"values = {sizes(element)}", "", ""])
    return [f"{path}: {written[0] if written else 'CAD'}, {size} {unit}; {len(faces)} faces",
            *(f"  {one.name:<8} {one.comment}" for one in surfaces),
            *([f"  {holes - len(bores)} smaller bores have no name: clatter-mesh faces {path} lists them"] if holes > len(bores) else []),
            "material: steel is assumed; the part is free: see the comments of the .fe.toml"]


def sizes(fine):
    return [round(fine * factor, 3) for factor in (2.0, 1.5, 1.0)]


def write_deck(folder, path, stem, source, units):
    write(folder, f"{stem}.mesh.toml", templates.DECK_MESH.format(stem=stem, source=source, units=units))
    mesh, recipe = folder / "part.mesh.h5", folder / f"{stem}.fe.toml"
    mesh_program(path, "--units", units, "-o", mesh, "--recipe", recipe)
    text = recipe.read_text(encoding="utf-8")
    table = tomllib.loads(text)
    with h5py.File(mesh) as file:
        if "surfaces/skin" not in file:
            raise BadArtefact(f"{path}: has no solid cells, whose skin is what radiates; "
                              f"clatter-mesh {path} --units {units} --check lists what it holds")
        nodes = file["nodes"][()][free_nodes(file, table)]
    mesh.unlink()
    damping = "" if "damping" in table else templates.DAMPING
    recipe.write_text(text + damping + sensors(nodes, {"m": 1.0, "mm": 1e3}[table.get("length_unit", "m")]), encoding="utf-8")
    names = retained(table)
    write_rest(folder, stem, nodes, names[:SETS], [])
    held = f"{len(table['support'])} supports" if "support" in table else "no supports: the part is free"
    return [f"{path}: {', '.join(table.get('material', {})) or 'no material'}; {held}",
            f"retained are {', '.join(names[:SETS]) or 'three sensors'}"
            + (f", not {len(names) - SETS} further couplings" if len(names) > SETS else "")]


def retained(table):
    """Couplings that a support does not hold."""
    held = {one.get("point") for one in table.get("support", [])}
    names = [one.get("name", one.get("point")) for one in table.get("coupling", [])]
    return [name for name in dict.fromkeys(names) if isinstance(name, str) and name not in held]


def free_nodes(file, table):
    """Nodes of the skin that nothing else holds or couples: where sensors can be."""
    skin = np.unique(np.concatenate([faces[()].ravel() for faces in file["surfaces/skin"].values()]))
    taken = [member for kind in ("support", "coupling", "equation", "tie", "straight_edges") for member in members(table.get(kind, []))]
    held = [nodes_of(file[path]) for path in taken if path in file]
    free = np.setdiff1d(skin, np.concatenate(held)) if held else skin
    return free if len(free) >= 3 else skin


def nodes_of(item):
    return item[()].ravel() if isinstance(item, h5py.Dataset) else np.concatenate([faces[()].ravel() for faces in item.values()])


def members(value):
    """Paths in the mesh file of all node sets and surfaces that a table names."""
    if isinstance(value, list):
        return [path for one in value for path in members(one)]
    if not isinstance(value, dict):
        return []
    folders = {"node_set": "node_sets", "surface": "surfaces", "slave": "surfaces"}
    own = [f"{folders[key]}/{name}" for key, name in value.items() if key in folders and isinstance(name, str)]
    return own + [path for one in value.values() for path in members(one)]


def corners(nodes):
    """Three of the positions that are far from each other and not in line: they hold all rigid motions."""
    first = nodes[np.linalg.norm(nodes - nodes.mean(axis=0), axis=1).argmax()]
    second = nodes[np.linalg.norm(nodes - first, axis=1).argmax()]
    third = nodes[np.linalg.norm(np.cross(nodes - first, second - first), axis=1).argmax()]
    return np.array([first, second, third])


def sensors(nodes, scale):
    return templates.SENSORS + "".join(
        f'\n[[sensor]]\nname = "sensor_{k}"\nsurface = "skin"\nnear = {cad_faces.vector(np.round(scale * place, 9))}\n'
        for k, place in enumerate(corners(nodes), 1))


def write_rest(folder, stem, nodes, names, mesh_setting):
    """Reduction, hit, field, study, Makefile; frequencies follow the part's length."""
    longest = np.ptp(nodes, axis=0).max()
    fmax = float(f"{BAR_M_S / (2 * longest):.2g}")
    apart = corners(nodes)[0] - nodes.mean(axis=0)
    facts = {"stem": stem, "names": ", ".join(literal(name) for name in [*names, "sensor_1", "sensor_2", "sensor_3"]),
             "fmax": f"{fmax:g}", "used": f"{fmax / 2:g}", "longest": f"{1e3 * longest:.4g}", "at": f"{fmax / 4:g}",
             "component": "xyz"[np.abs(apart).argmax()], "end": f"{800 / fmax:.6g}", "step": f"{1e6 / (4 * fmax):.6g}",
             "frames_end": f"{40 / fmax:.6g}", "frames_step": f"{1 / (4 * fmax):.6g}", "mesh_setting": "\n".join(mesh_setting),
             "modes": ", ".join(f"{fmax * factor:g}" for factor in (0.25, 0.5, 1.0)),
             "steps": ", ".join(f"{1e6 * factor / (4 * fmax):.6g}" for factor in (4, 2, 1))}
    for name, text in templates.REST.items():
        write(folder, name.format(stem=stem), text.format(**facts))
    time = np.linspace(0.0, 3.0 / fmax, 41)
    rows = [f"{t:.9g}, {1000.0 * np.sin(np.pi * t * fmax / 3.0):.6g}" for t in time[:-1]] + [f"{time[-1]:.9g}, 0", f"{800 / fmax:.9g}, 0"]
    (folder / "hit.csv").write_text(f"# half a sine of {3e3 / fmax:.3g} ms and 1000 N: excites up to about {fmax / 2:g} Hz\n"
                                    "time [s], force [N]\n" + "\n".join(rows) + "\n", encoding="utf-8")
