# SPDX-License-Identifier: GPL-3.0-or-later
"""The surfaces of skirt and liner of a run as [contact] of its scene gives them: machined, and what each shape adds.

Angles count from the thrust side right-handed about z [rad], heights are engine z, those of the skirt from the pin [m]; deviations
are positive away from the axis [m].
"""
import math
import pathlib
import re
import tomllib

import numpy as np

from clatter.artefact import BadArtefact, configuration, dataset, open_artefact, text


def contact_of(run):
    """{"contact": .., "engine": .., "rod": ..} of a run's resolved configuration, lists of tables as lists."""
    found = {"engine": {}, "rod": {}, "contact": {}}
    for line in configuration(run).splitlines():
        match = re.match(r"(engine|rod|contact)\.(?:(bore_shape|skirt_shape)\[(\d+)\]\.)?(\w+) = (.*)", line)
        if not match:
            continue
        table, kind, number, key, value = match.groups()
        place = found[table]
        if kind:
            entries = place.setdefault(kind, [])
            while len(entries) <= int(number):
                entries.append({})
            place = entries[int(number)]
        place[key] = tomllib.loads(f"v = {value}")["v"]
    if "bore_mm" not in found["contact"]:
        raise BadArtefact(f"{run.filename}: config: found no [contact], expected a run of one cylinder with it")
    return found


class Shape:
    """Deviations on angles x heights, bilinear, constant beyond the ends."""

    def __init__(self, name, angle, height, deviation):
        self.name = name
        order = np.argsort(np.mod(angle, 2 * np.pi))
        angle, deviation = np.mod(angle, 2 * np.pi)[order], deviation[order]
        self.angle = np.concatenate([[angle[-1] - 2 * np.pi], angle, [angle[0] + 2 * np.pi]])
        self.height, self.deviation = height, np.concatenate([deviation[-1:], deviation, deviation[:1]])

    def at(self, angle, height):
        """angles x heights."""
        along = np.array([np.interp(height, self.height, row) for row in self.deviation])
        return np.array([np.interp(np.mod(angle, 2 * np.pi), self.angle, column) for column in along.T]).T


def of_entry(run, entry):
    """The Shape of a [[contact.bore_shape]] or skirt_shape."""
    if "file" in entry:
        return entry.get("factor", 1.0), of_file(shape_path(run, entry["file"]), entry["case"])
    if "order" in entry:
        angle, order = np.radians(np.arange(0.0, 360.0, 2.0)), entry["order"]
        around = np.cos(order * (angle - math.radians(entry.get("phase_deg", 0.0))))
        return entry.get("factor", 1.0), Shape(f"order {order:g}", angle, 1e-3 * np.array(entry["height_mm"]),
                                               1e-6 * around[:, None] * np.array(entry["amplitude_um"]))
    raise BadArtefact(f"{run.filename}: config: found a shape of {entry.get('table', 'nothing')}, expected shapes of files or orders")


def shape_path(run, name):
    """Where a shape file is: as the scene names it, beside the run or above a sweep's folder."""
    folder = pathlib.Path(run.filename).parent
    for path in (folder / name, folder.parent / name):
        if path.exists():
            return path
    raise BadArtefact(f"{folder / name}: no such file, expected the shape that {run.filename} has used")


def of_file(path, case):
    with open_artefact(path, "shape") as file:
        if f"cases/{case}" not in file:
            raise BadArtefact(f"{path}: cases: found {', '.join(file['cases'])}, expected {case}")
        point, axis, zero = (dataset(file, name) for name in ("axis_point", "axis", "zero_angle"))
        up = 1.0 if axis[2] > 0.0 else -1.0
        height = up * dataset(file, "height") + point[2]
        angle = math.atan2(-zero[0], zero[1]) + up * dataset(file, "angle")
        deviation = dataset(file, f"cases/{case}/deviation").T
    order = np.argsort(height)
    return Shape(case, angle, height[order], deviation[:, order])


class Surfaces:
    """Skirt and liner of a run."""

    def __init__(self, run):
        tables = contact_of(run)
        self.contact = tables["contact"]
        self.bore = [of_entry(run, entry) for entry in self.contact.get("bore_shape", [])]
        self.skirt = [of_entry(run, entry) for entry in self.contact.get("skirt_shape", [])]
        if self.contact.get("bore_height_mm"):
            self.bore.append((1.0, Shape("widening", np.zeros(1), 1e-3 * np.array(self.contact["bore_height_mm"]),
                                         1e-6 * np.array([self.contact["bore_widening_um"]]))))
        self.z = 1e-3 * np.linspace(self.contact["skirt_bottom_mm"], self.contact["skirt_top_mm"], 165)
        half = math.radians(0.5 * self.contact["pad_span_deg"])
        self.angle = np.linspace(-half, half, 41)
        radius, rod, offset = (1e-3 * value for value in (0.5 * tables["engine"]["stroke_mm"], tables["rod"]["length_mm"],
                                                          tables["engine"].get("pin_offset_mm", 0.0)))
        self.dead_centres = tuple(math.sqrt((rod + sign * radius) ** 2 - offset**2) for sign in (-1, 1))

    def relief(self, angle):
        """The machined skirt's distance inside its largest radius, angles x self.z."""
        contact = self.contact
        if contact.get("profile_height_mm"):
            barrel = np.interp(1e3 * self.z, contact["profile_height_mm"], contact["profile_relief_um"])
        else:
            apex, low, top = (1e-3 * contact[key] for key in ("barrel_apex_mm", "skirt_bottom_mm", "skirt_top_mm"))
            above = np.clip((self.z - apex) / (top - apex) if top > apex else 0 * self.z, 0, None)
            below = np.clip((self.z - apex) / (low - apex) if low < apex else 0 * self.z, 0, None)
            barrel = contact["barrel_top_um"] * above**2 + contact["barrel_bottom_um"] * below**2
        return 1e-6 * (barrel + contact["ovality_um"] * np.sin(angle)[:, None] ** 2)

    def without_clearance(self, pin, angle):
        """Gap at a height of the pin but for the clearance, angles x self.z."""
        gap = self.relief(angle)
        for factor, shape in self.skirt:
            gap = gap - factor * shape.at(angle, self.z)
        for factor, shape in self.bore:
            gap = gap + factor * shape.at(angle, pin + self.z)
        return gap

    def inside(self, pin):
        """Which of self.z are between the ends of the liner that the scene gives."""
        low, high = (1e-3 * self.contact.get(key, end) for key, end in (("liner_bottom_mm", -math.inf), ("liner_top_mm", math.inf)))
        return (pin + self.z >= low) & (pin + self.z <= high)

    def clearance(self, run):
        """Between the cold surfaces [m]: of the scene, or what the run has found for a smallest warm gap."""
        if "clearance_um" in self.contact:
            return 1e-6 * self.contact["clearance_um"]
        effects = zip(dataset(run, "effects/name"), dataset(run, "effects/why"))
        why = next((text(why) for name, why in effects if text(name) == "minimum warm clearance"), "")
        found = re.search(r": (\S+) um of clearance between the cold surfaces", why)
        if not found:
            raise BadArtefact(f"{run.filename}: effects: found no minimum warm clearance, expected it as the scene has one")
        return 1e-6 * float(found[1])
