# SPDX-License-Identifier: GPL-3.0-or-later
"""Bores, planes and named faces of a CAD file, as `clatter-mesh faces --json` lists them."""
import dataclasses
import json
import re

import numpy as np

BORES, PLANES, NAMES = 6, 3, 12   # at most, the largest first: of more the file would tell less
WHOLE = 0.7              # part of a full cylinder's area: a bore with ports and slots has more, a fillet a quarter
SAME = 1e-4              # of the part's size: axes and radii that differ by less are one


@dataclasses.dataclass
class Surface:
    name: str
    toml: str       # its filters in mesh.toml
    comment: str


def size_of(faces):
    """Diagonal of the box around all faces."""
    boxes = np.array([face["box"] for face in faces])
    return float(np.linalg.norm(boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)))


def vector(values):
    return "[" + ", ".join(f"{value:.9g}" for value in np.asarray(values) + 0.0) + "]"


def same_cylinder(one, other, near):
    """Whether two faces lie on one cylinder and, along its axis, side by side, as the halves of a bore do."""
    axis = np.array(one["direction"])
    apart = np.array(other["place"]) - one["place"]
    along = np.abs(axis).argmax()
    (low, high), (other_low, other_high) = (np.array(face["box"])[:, along] for face in (one, other))
    return (abs(one["radius"] - other["radius"]) < near and np.linalg.norm(np.cross(axis, other["direction"])) < SAME
            and np.linalg.norm(np.cross(axis, apart)) < near and low < other_high and other_low < high)


def length(box, axis, radius):
    """Length of a full cylinder that has this box."""
    along = np.abs(axis).argmax()
    return (box[1][along] - box[0][along] - 2 * radius * np.sqrt(max(0.0, 1 - axis[along]**2))) / abs(axis[along])


def bores(faces):
    """The holes: concave cylinders that go around, the largest first; of halves one."""
    near, groups = SAME * size_of(faces), []
    for face in faces:
        if face["kind"] != "cylinder" or not face["concave"]:
            continue
        group = next((group for group in groups if same_cylinder(group[0], face, near)), None)
        groups.append([face]) if group is None else group.append(face)
    found = []
    for group in groups:
        first = group[0]
        box = np.array([np.min([face["box"][0] for face in group], axis=0), np.max([face["box"][1] for face in group], axis=0)])
        axis, radius, area = np.array(first["direction"]), first["radius"], sum(face["area"] for face in group)
        long = length(box, axis, radius)
        if area > WHOLE * 2 * np.pi * radius * long > 0.0:
            found.append((area, first, box, long))
    return sorted(found, key=lambda one: -one[0])


def of_names(faces, unit):
    """A surface for each name that faces have in the CAD file, the largest first."""
    areas, counts = {}, {}
    for face in faces:
        if face.get("named"):
            areas[face["named"]] = areas.get(face["named"], 0.0) + face["area"]
            counts[face["named"]] = counts.get(face["named"], 0) + 1
    surfaces = {}
    for name in sorted(areas, key=lambda one: -areas[one])[:NAMES]:
        own = re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_") or "face"
        if own == "skin" or own in surfaces or re.fullmatch(r"(bore|plane)_\d+", own):
            own = f"{own}_of_cad_{len(surfaces) + 1}"
        faces_of = f"{counts[name]} faces" if counts[name] > 1 else "a face"
        surfaces[own] = Surface(own, f"named = {json.dumps(name, ensure_ascii=False)}", f"{faces_of} of this name in the file, "
                                f"{areas[name]:.4g} {unit}2")
    return list(surfaces.values())


def named(faces, unit):
    """(the surfaces to name, how many bores there are in all)."""
    pad = SAME * size_of(faces)
    holes = bores(faces)
    surfaces = [Surface(f"bore_{k}", f"cylinder = {{ radius = {face['radius']:.9g}, point = {vector(face['place'])}, "
                                     f"axis = {vector(face['direction'])} }}\n"
                                     f"box = {{ min = {vector(box[0] - pad)}, max = {vector(box[1] + pad)} }}",
                        f"radius {face['radius']:g} {unit}, length {long:.4g} {unit}")
                for k, (_, face, box, long) in enumerate(holes[:BORES], 1)]
    planes = sorted((face for face in faces if face["kind"] == "plane" and not face.get("named")), key=lambda face: -face["area"])[:PLANES]
    surfaces += [Surface(f"plane_{k}", face["toml"], f"face {face['number']}, {face['area']:.4g} {unit}2, "
                                                     f"normal {vector(np.round(face['direction'], 4))}")
                 for k, face in enumerate(planes, 1)]
    return surfaces + of_names(faces, unit), len(holes)
