# SPDX-License-Identifier: GPL-3.0-or-later
"""The 3-D view: parts with their operating shapes at lines and instants, mode shapes, panels."""
import pathlib

import numpy as np

from clatter.artefact import dataset, open_artefact, stem, text
from clatter.rom import Rom
from . import shapes, skin
from .folder import made_with
from .summary import loudest_line

MODES = 40           # elastic ones of a part, at most
INSTANT_DEG = 1.0    # between instants of a cycle
ELASTIC_HZ = 1.0     # modes below are rigid ones of a free body


def collect(folder, pack):
    """Parts: of each reduced model with a skin, and of field files whose model is not in the folder."""
    parts, shown = [], set()
    for path in folder.models():
        with open_artefact(path, "rom") as rom:
            if "skin/T" not in rom:
                continue
            runs = [one for one in folder.with_field() if path.resolve() in map(pathlib.Path.resolve, made_with(one.field))
                    and len(one.field["skin/nodes"]) == len(rom["skin/nodes"]) and motion(one) is not None]
            parts.append(reduced_part(pack, stem(path), rom, runs))
            shown.update(one.number for one in runs)
    parts += [field_part(pack, one) for one in folder.with_field() if one.number not in shown and "skin" in one.field]
    parts.sort(key=lambda part: not part["runs"])
    return {"parts": parts} if parts else None


def motion(one):
    """Velocity of the field's body in reduced coordinates over its cycle (samples x r), or None without the run and for a cycle
    whose values lie between the samples of the run."""
    body = text(one.field.attrs.get("body", ""))
    if one.run is None or f"bodies/{body}/v" not in one.run or "analysis/cycle" not in one.field:
        return None
    if text(one.field["analysis/cycle"].attrs.get("domain", "time")) == "angle":
        return None
    count = int(one.field["analysis/cycle"].attrs["samples"])
    first = int(one.field["analysis/cycle"].attrs["first_sample"])
    values = one.run[f"bodies/{body}/v"]
    return values[first:first + count] if first + count <= len(values) else None


def reduced_part(pack, name, rom, runs):
    block = f"skin_{name}"
    nodes, triangles = dataset(rom, "skin/nodes"), dataset(rom, "skin/triangles")
    found, corners = skin.geometry(pack, block, nodes, triangles, skin.smooth_normals(nodes, triangles))
    expansion = dataset(rom, "skin/T").reshape(len(nodes), 3, -1)[corners].reshape(3 * len(corners), -1)
    hz, vectors = modes(rom)
    found.update(name=name, runs=[], modes={"hz": hz, "shapes": shapes.packed(pack, f"{block}_modes", (expansion @ vectors).T)}
                 if len(hz) else None)
    if runs:
        velocity = [motion(one) for one in runs]
        lines = [spectrum(values, one.field) for values, one in zip(velocity, runs)]
        basis = shapes.Basis(nodes[corners], expansion, lines)
        found["shapes"] = shapes.packed(pack, f"{block}_shapes", basis.shapes)
        found["panels"] = skin.panels(pack, block, runs[0].field)
        for one, values, spectral in zip(runs, velocity, lines):
            found["runs"].append(shown_run(pack, block, one, basis, values, spectral))
            if len(hz):
                found["runs"][-1]["mac"] = mac(basis, vectors, spectral, one.field)
    return found


def spectrum(values, field):
    """Complex amplitudes (peak) of the lines of a cycle, by the convention of field files: t = 0 at firing TDC."""
    count = len(dataset(field, "analysis/cycle/frequency_hz"))
    begin = dataset(field, "analysis/cycle/time")[0]
    lines = np.fft.rfft(values, axis=0)[:count] * (2.0 / len(values))
    lines[0] *= 0.5
    turn = np.exp(-2j * np.pi * dataset(field, "analysis/cycle/frequency_hz") * begin)
    return lines * turn[:, None]


def shown_run(pack, block, one, basis, values, spectral):
    """Amounts of the shapes at each line (complex, peak) and at instants of the cycle, with their relative errors."""
    angle = dataset(one.field, "analysis/cycle/crank_angle_deg")
    step = max(1, int(INSTANT_DEG / max(1e-9, float(angle[1] - angle[0]))))
    at_lines, line_error = basis.amounts(spectral)
    at_instants, instant_error = basis.amounts(values[::step])
    return {"run": one.number, "line_error": pack.add(block, line_error), "instant_error": float(instant_error.max()),
            "frequency": pack.add(block, dataset(one.field, "analysis/cycle/frequency_hz")),
            "lines": [shapes.packed(pack, block, at_lines.real), shapes.packed(pack, block, at_lines.imag)],
            "rpm": one.field["analysis/cycle"].attrs.get("speed_rpm"),
            "angle": pack.add(block, angle[::step]), "time": pack.add(block, dataset(one.field, "analysis/cycle/time")[::step]),
            "instants": shapes.packed(pack, block, at_instants), "loudest": loudest_line(one.field),
            "strongest": list(dataset(one.field, "lines/frequency_hz")) if "lines" in one.field else []}


def modes(rom):
    """(frequencies [Hz], vectors r x m) of the free reduced part, rigid modes left out."""
    hz, vector = Rom(rom).modes()
    limit = rom["certificate"].attrs.get("accurate_to_hz", np.inf) if "certificate" in rom else np.inf
    kept = np.flatnonzero((hz > ELASTIC_HZ) & (hz <= limit))[:MODES]
    return hz[kept], vector[:, kept]


def mac(basis, vectors, spectral, field):
    """Modal assurance criterion of the elastic part of the lines that a field file has in full, against the modes (Allemang and
    Brown 1982)."""
    wanted = dataset(field, "lines/frequency_hz") if "lines" in field else []
    frequency = dataset(field, "analysis/cycle/frequency_hz")
    rows = [int(np.argmin(np.abs(frequency - hz))) for hz in wanted]
    if not rows:
        return None
    lines, own = spectral[rows] @ basis.size, vectors.T @ basis.size
    product = np.abs(lines.conj() @ own.T) ** 2
    return {"hz": frequency[rows], "values": product / np.outer((np.abs(lines) ** 2).sum(1), (own**2).sum(1))}


def field_part(pack, one):
    """A field without its reduced model: the instants and lines that the file has in full."""
    field, block = one.field, f"skin_{one.stem}"
    nodes, triangles = dataset(field, "skin/nodes"), dataset(field, "skin/triangles")
    found, corners = skin.geometry(pack, block, nodes, triangles, dataset(field, "skin/node_normal"))
    read = lambda group: [field[f"{group}/{name}"][()][corners].ravel() for name in sorted(field.get(group, {}))]  # noqa: E731
    instants = np.array(read("frames/velocity"), float)
    lines = np.array(read("lines/velocity_re"), float) + 1j * np.array(read("lines/velocity_im"), float)
    kept = [rows for rows in (instants, lines) if len(rows)]
    found.update(name=f"{text(field.attrs.get('body', 'body'))}, {one.stem}", modes=None, runs=[], panels=skin.panels(pack, block, field))
    if not kept:
        return found
    # The velocities themselves are the coordinates: their expansion is the matrix of all of them.
    stacked = np.vstack([instants] * bool(len(instants)) + [lines.real, lines.imag] * bool(len(lines))).T
    own = np.eye(stacked.shape[1])
    at_instants, at_lines = own[:len(instants)], own[len(instants):len(instants) + len(lines)] + 1j * own[len(instants) + len(lines):]
    basis = shapes.Basis(nodes[corners], stacked, [rows.astype(complex) for rows in (at_instants, at_lines) if len(rows)])
    found["shapes"] = shapes.packed(pack, f"{block}_shapes", basis.shapes)
    run = {"run": one.number, "loudest": loudest_line(field), "strongest": [], "rpm": None}
    if len(lines):
        amount, error = basis.amounts(at_lines)
        run.update(lines=[shapes.packed(pack, block, amount.real), shapes.packed(pack, block, amount.imag)], line_error=pack.add(block, error),
                   frequency=pack.add(block, dataset(field, "lines/frequency_hz")))
    if len(instants):
        amount, error = basis.amounts(at_instants)
        run.update(instants=shapes.packed(pack, block, amount), instant_error=float(error.max()), time=pack.add(block, dataset(field, "frames/time")))
        if "frames/crank_angle_deg" in field:
            run["angle"] = pack.add(block, dataset(field, "frames/crank_angle_deg"))
    found["runs"].append(run)
    return found
