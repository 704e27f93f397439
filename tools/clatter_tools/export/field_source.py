# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface and its motion from a field file (clatter/field/1): the entire skin, by line or by frame."""
import pathlib

import numpy as np

from clatter.artefact import BadArtefact, dataset, text
from .surface import QUANTITIES, Motion, Origin, Surface


def checked(file, name, shape):
    """A dataset's values; BadArtefact when the shape is another one or a value is not finite."""
    values = dataset(file, name)
    if values.shape != shape:
        raise BadArtefact(f"{file.filename}: {name}: found shape {values.shape}, expected {shape}")
    if not np.isfinite(values).all():
        raise BadArtefact(f"{file.filename}: {name}: found values that are not finite")
    return values


def triangle_rows(file, n_nodes):
    """skin/triangles as f x 6 or f x 3 rows of the nodes."""
    rows = dataset(file, "skin/triangles")
    if rows.ndim != 2 or rows.shape[1] not in (3, 6) or len(rows) == 0:
        raise BadArtefact(f"{file.filename}: skin/triangles: found shape {rows.shape}, expected faces x 6")
    if rows.min() < 0 or rows.max() >= n_nodes:
        raise BadArtefact(f"{file.filename}: skin/triangles: found node {rows.min() if rows.min() < 0 else rows.max()}, "
                          f"expected 0 to {n_nodes - 1}")
    return rows


def panel_rows(file, n_faces):
    """{name: rows of the triangles} of the file's panels."""
    panels = {name: dataset(file, f"panels/{name}/faces") for name in file.get("panels", ())}
    for name, rows in panels.items():
        if len(rows) and (rows.min() < 0 or rows.max() >= n_faces):
            raise BadArtefact(f"{file.filename}: panels/{name}/faces: found faces outside of 0 to {n_faces - 1}")
    return panels


def read_surface(file):
    """The skin of an open field file."""
    if "skin" not in file:
        raise BadArtefact(f"{file.filename}: skin: missing, expected nodes and triangles")
    nodes = dataset(file, "skin/nodes")
    nodes = checked(file, "skin/nodes", (len(nodes), 3))
    triangles = triangle_rows(file, len(nodes))
    f = len(triangles)
    return Surface(nodes, triangles, checked(file, "skin/face_area", (f,)), checked(file, "skin/face_normal", (f, 3)),
                   checked(file, "skin/face_centre", (f, 3)), panel_rows(file, f))


def read_origin(file):
    missing = [name for name in ("body", "phase", "air_density_kg_m3", "air_sound_speed_m_s") if name not in file.attrs]
    if missing:
        raise BadArtefact(f"{file.filename}: attribute {missing[0]}: missing")
    return Origin(text(file.attrs["body"]), pathlib.Path(file.filename).name, text(file.attrs["phase"]),
                  float(file.attrs["air_density_kg_m3"]), float(file.attrs["air_sound_speed_m_s"]))


def kinds(file):
    """Which of lines and frames the file has."""
    axes = {"lines": "lines/frequency_hz", "frames": "frames/time"}
    return [kind for kind, axis in axes.items() if axis in file and len(file[axis])]


def read_motion(file, kind, surface):
    """Lines or frames of an open field file; nothing but the axis is read before it is needed."""
    if kind not in kinds(file):
        raise BadArtefact(f"{file.filename}: {kind}: found none, expected {kind}; set them in the field.toml of clatter-recover")
    at = dataset(file, "lines/frequency_hz" if kind == "lines" else "frames/time")
    shapes = {name: (len(surface.nodes), 3) if quantity.at_nodes else (len(surface.triangles),)
              for name, quantity in QUANTITIES.items()}

    def read(quantity, step):
        names = [f"{kind}/{quantity}{part}/{step:05d}" for part in (("_re", "_im") if kind == "lines" else ("",))]
        values = [checked(file, name, shapes[quantity]) for name in names]
        return values[0] + 1j * values[1] if kind == "lines" else values[0]

    stored = [name for name in QUANTITIES if f"{kind}/{name}{'_re' if kind == 'lines' else ''}" in file]
    return Motion(kind, checked(file, "lines/frequency_hz" if kind == "lines" else "frames/time", at.shape), tuple(stored), read,
                  read_origin(file))
