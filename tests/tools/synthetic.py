# SPDX-License-Identifier: GPL-3.0-or-later
"""Small artefacts with the layout of docs/formats.md and plausible values, for tests of the tools that read them."""
import pathlib

import h5py
import numpy as np
from clatter.artefact import schema_of


def new_file(path, kind):
    file = h5py.File(path, "w")
    file.attrs["schema"] = schema_of(kind)
    file.attrs["version"] = "0.1.0"
    file.attrs["config"] = "speed_rpm = 2000\n"
    text = h5py.string_dtype()
    file.create_dataset("timing/step", data=["read", "solve"], dtype=text)
    file["timing/seconds"] = [0.25, 1.5]
    file["timing/peak_gib"] = [0.05, 0.2]
    file["timing"].attrs["total_seconds"] = 1.75
    file["timing"].attrs["peak_gib"] = 0.2
    file.require_group("certificate").attrs["energy_residue"] = 0.002
    return file


def box_skin(lengths=(0.4, 0.2, 0.25), counts=(8, 4, 5)):
    """Nodes (n, 3) and tri6 (f, 6) of a box's surface, normals outward."""
    nodes, index, faces = [], {}, []

    def node(point):
        key = tuple(np.round(point, 9))
        if key not in index:
            index[key] = len(nodes)
            nodes.append(key)
        return index[key]

    def triangle(a, b, c):
        faces.append([node(p) for p in (a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2)])

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, 1):
            for i in range(counts[u]):
                for j in range(counts[v]):
                    corner = np.zeros((4, 3))
                    for k, (di, dj) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1))):
                        corner[k, axis] = side * lengths[axis]
                        corner[k, u] = (i + di) * lengths[u] / counts[u]
                        corner[k, v] = (j + dj) * lengths[v] / counts[v]
                    order = (0, 1, 2, 3) if side else (0, 3, 2, 1)
                    a, b, c, d = corner[list(order)]
                    triangle(a, b, c)
                    triangle(a, c, d)
    return np.array(nodes) - [lengths[0] / 2, lengths[1] / 2, 0], np.array(faces, np.int32)


def write_mesh(path):
    nodes, faces = box_skin()
    with new_file(path, "mesh") as file:
        file.attrs["name"] = pathlib.Path(path).name.split(".")[0]
        file["nodes"] = nodes
        file["surfaces/skin/tri6"] = faces
        file["surfaces/deck/tri6"] = faces[(nodes[faces[:, :3]][:, :, 2] > 0.2499).all(axis=1)]
        file["surfaces/mount_1/tri6"] = faces[(nodes[faces[:, :3]][:, :, 1] > 0.0999).all(axis=1)]
        file["cells/0/nodes"] = np.zeros((1, 10), np.int32)
        for name, low, high, worst in (("min_dihedral_deg", 0.0, 80.0, 12.5), ("scaled_jacobian", 0.0, 1.0, 0.31)):
            write_measure(file, f"quality/{name}", low, high, worst)


def write_measure(file, group, low, high, worst):
    """Two cell types with the same counts; cell 417 is the worst."""
    counts = np.minimum(np.arange(20), 8) * 2
    file[f"{group}/histogram"] = counts * 2
    file[f"{group}/by_type/hex8"] = file[f"{group}/by_type/wedge6"] = counts
    file[group].attrs.update({"low": low, "high": high, "worst": worst, "worst_label": 417})
    file[f"{group}/worst_place"] = [0.1, 0.2, 0.3]
    file[f"{group}/worst_cells"] = np.array([417, 12], np.int32)
    file[f"{group}/worst_values"] = [worst, 1.1 * worst]
    file[f"{group}/worst_places"] = np.full((2, 3), 0.1)


def write_shape(path, cases=("thermal", "gas"), covered=True):
    """A bore of 100 mm, conical and oval; half of its points lie on faces where it is not `covered`."""
    with new_file(path, "shape") as file:
        height, angle = np.linspace(0.1, 0.3, 9), np.arange(24) * np.pi / 12
        file.attrs["name"], file.attrs["surface"], file.attrs["radius"] = "block", "liner_1_bore", 0.05
        file["height"], file["angle"] = height, angle
        file["covered"] = np.tile(np.ones(24) if covered else np.abs(np.cos(angle)) > 0.7, (9, 1)).astype(np.int32)
        for k, case in enumerate(cases):
            file[f"cases/{case}/deviation"] = 1e-6 * (50.0 * (height[:, None] - 0.1) + (20.0 + k) * np.cos(2 * angle))


def slap_signal(time, amplitude, ring_hz=1800.0):
    """An impact 0.3 ms after time zero that rings for about 2.5 ms."""
    after = np.maximum(time - 0.3e-3, 0.0)
    return amplitude * np.sin(2 * np.pi * ring_hz * after) * np.exp(-after / 0.9e-3) * (after > 0)


def write_run(path, clearance=20e-6, film=True, cylinder=""):
    prefix = f"{cylinder}_" if cylinder else ""
    angle = np.arange(0, 1440.5, 0.5)
    wrapped = np.radians((angle + 360) % 720 - 360)
    with new_file(path, "run") as file:
        put = lambda name, values, unit: history(file, prefix + name, values, unit)  # noqa: E731
        history(file, "crank_angle_deg", angle, "deg")
        put("piston_lateral", clearance * np.tanh(3 * np.sin(wrapped)), "m")
        put("piston_tilt", 4e-4 * np.cos(wrapped / 2) * np.sin(2 * wrapped), "rad")
        put("side_force", 3000 * np.exp(-(wrapped / 0.8) ** 2) * np.sin(wrapped), "N")
        if film:
            put("film_min", 2e-6 + clearance / 4 * np.cos(wrapped) ** 2, "m")


def history(file, name, values, unit):
    file[f"history/{name}"] = values
    file[f"history/{name}"].attrs["unit"] = unit


def put(file, name, values, **attributes):
    file[name] = values
    for key, value in attributes.items():
        file[name].attrs[key] = value


def write_field(path, amplitude=40.0, ring_hz=1800.0):
    """A field file: two sensors that ring after a slap, an ERP, a skin that expands and contracts."""
    time = np.arange(-0.83e-3, 5e-3, 2e-5)
    nodes, faces = box_skin()
    with new_file(path, "field") as file:
        for piece, times in (("ftdc", time), ("cycle", np.arange(0, 0.06, 2e-5))):
            write_piece(file, f"analysis/{piece}", times, amplitude, ring_hz)
        write_skin(file, nodes, faces)


def write_piece(file, at, time, amplitude, ring_hz):
    put(file, f"{at}/time", time, unit="s")
    frequency = np.arange(1, 300) * 1000 / 60
    file[f"{at}/frequency_hz"] = frequency
    file[at].attrs["line_spacing_hz"] = frequency[0]
    mid = 1000 * 10 ** (np.arange(-12, 7) / 10)
    names = "63 80 100 125 160 200 250 315 400 500 630 800 1000 1250 1600 2000 2500 3150 4000".split()
    for key, values in (("mid", mid), ("lower", mid * 10**-0.05), ("upper", mid * 10**0.05)):
        file[f"{at}/third_octave/{key}_hz"] = values
    file.create_dataset(f"{at}/third_octave/nominal", data=names, dtype=h5py.string_dtype())
    levels = 20 * np.log10(amplitude / 1e-6) - 30 * np.abs(np.log10(mid / ring_hz))
    for name, factor in (("sensor_liner", 1.0), ("sensor_block", 0.3)):
        sensor = f"{at}/sensors/{name}"
        file.create_dataset(f"{sensor}/labels", data=[f"{name}.{d}" for d in "xyz"], dtype=h5py.string_dtype())
        file[f"{sensor}/direction"] = np.eye(3)
        file[f"{sensor}/is_rotation"] = np.zeros(3, np.int32)
        signal = slap_signal(time, factor * amplitude, ring_hz)
        put(file, f"{sensor}/acceleration", signal[:, None] * [0.1, 1, 0.2], unit="m/s2")
        put(file, f"{sensor}/third_octave/acceleration_db", (levels + 20 * np.log10(factor))[:, None] * np.ones(3),
            reference=1e-6, reference_unit="m/s2")
    for panel in ("skin", "exposed"):
        where = f"{at}/panels/{panel}"
        put(file, f"{where}/erp", 1e-9 / (1 + ((frequency - ring_hz) / 200) ** 2), unit="W")
        put(file, f"{where}/third_octave/erp_db", levels - 80, reference=1e-12, reference_unit="W")
        put(file, f"{where}/third_octave/erp_dba", levels - 83, reference=1e-12, reference_unit="W")
        file[where].attrs["erp_dba"] = levels.max() - 78
        file[where].attrs["erp_db"] = levels.max() - 76


def add_mean(file, cycles=8, error=0.27, more_db=1.0):
    """A window "mean" over cycles, of which the cycle in the file is one: no phases, levels that are `more_db` higher, and their standard error."""
    file.copy("analysis/cycle", "analysis/mean")
    mean = file["analysis/mean"]
    mean.attrs.update({"periodic": "yes", "averages": cycles})
    for sensor in mean["sensors"].values():
        if "spectrum" in sensor:
            lines = sensor["spectrum"]
            lines["acceleration_power"] = (lines["acceleration_re"][()] ** 2 + lines["acceleration_im"][()] ** 2) / 2.0
            del lines["acceleration_re"], lines["acceleration_im"]
    for level, group in [("erp", panel) for panel in mean["panels"].values()] + ([("power", mean["sound"])] if "sound" in mean else []):
        for unit in ("db", "dba"):
            group.attrs.update({f"{level}_{unit}": group.attrs[f"{level}_{unit}"] + more_db, f"{level}_standard_error_{unit}": error})


def write_skin(file, nodes, faces):
    centre = nodes[faces[:, :3]].mean(axis=1)
    outward = (nodes - nodes.mean(axis=0)) / np.linalg.norm(nodes - nodes.mean(axis=0), axis=1)[:, None]
    file["skin/nodes"], file["skin/triangles"] = nodes, faces
    file["skin/node_normal"], file["skin/face_area"] = outward, np.full(len(faces), 1e-4)
    shape = np.sin(8 * nodes[:, :1]) * np.cos(6 * nodes[:, 2:]) * outward
    file["frames/time"] = [0.0, 0.4e-3, 0.8e-3]
    file["lines/frequency_hz"] = [600.0, 1800.0]
    for k, factor in enumerate((0.1, 1.0, 0.5)):
        file[f"frames/velocity/{k:05d}"] = (factor * 2e-3 * shape).astype(np.float32)
        file[f"frames/normal_velocity/{k:05d}"] = (factor * np.sin(8 * centre[:, 0])).astype(np.float32)
    for k in range(2):
        for part, value in (("re", 1e-3), ("im", 5e-4)):
            file[f"lines/velocity_{part}/{k:05d}"] = value * (1 + k) * shape
            file[f"lines/normal_velocity_{part}/{k:05d}"] = value * (1 + k) * np.sin(8 * centre[:, 0])
