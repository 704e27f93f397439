# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a field file and its XDMF as another program would: resolves every reference, compares every
shape, and computes the total power again from the complex lines. Exit code 0 when all are consistent."""
import os
import sys
import xml.etree.ElementTree as xml

import h5py
import numpy as np


def check_series(path, n_nodes, n_faces):
    root = xml.parse(path).getroot()
    assert root.tag == "Xdmf" and root.get("Version").startswith("3"), "not XDMF 3"
    collection = root.find("Domain/Grid")
    assert collection.get("CollectionType") == "Temporal"
    grids = collection.findall("Grid")
    times = [float(grid.find("Time").get("Value")) for grid in grids]
    assert times == sorted(times) and len(set(times)) == len(times), "slider values do not rise"
    for grid in grids:
        assert grid.find("Topology").get("TopologyType") == "Triangle_6"
        assert int(grid.find("Topology").get("NumberOfElements")) == n_faces
        for item in grid.iter("DataItem"):
            name, dataset = item.text.strip().split(":")
            with h5py.File(os.path.join(os.path.dirname(path), name)) as file:
                data = file[dataset]
                assert data.shape == tuple(map(int, item.get("Dimensions").split())), dataset
                assert data.dtype.itemsize == int(item.get("Precision")), dataset
                assert data.dtype.kind == {"Float": "f", "Int": "i"}[item.get("NumberType")], dataset
        for attribute in grid.findall("Attribute"):
            dimensions = attribute.find("DataItem").get("Dimensions")
            expected = f"{n_nodes} 3" if attribute.get("Center") == "Node" else f"{n_faces}"
            assert dimensions == expected, attribute.get("Name")
    return times


def check_units(file):
    def visit(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and name.count("/") > 1:
            owner = item if "unit" in item.attrs else item.parent
            if not name.startswith(("inputs", "timing")):
                assert "unit" in owner.attrs, f"{name}: no unit"
    file.visititems(visit)


def check_power(file):
    """ERP of the skin at each written line from the faces' mean normal velocities: never more than
    that of the quadratic form (the mean over a face excludes variations inside it)."""
    area = file["skin/face_area"][()]
    rho_c = file.attrs["air_density_kg_m3"] * file.attrs["air_sound_speed_m_s"]
    cycle = file["analysis"][file["lines"].attrs["analysis"].decode()]
    for k, hz in enumerate(file["lines/frequency_hz"]):
        line = int(np.argmin(abs(cycle["frequency_hz"][()] - hz)))
        v2 = (file[f"lines/normal_velocity_re/{k:05d}"][()] ** 2
              + file[f"lines/normal_velocity_im/{k:05d}"][()] ** 2)
        power = 0.5 * rho_c * np.dot(area, v2) * file.attrs["radiation_loss_factor"]
        erp = cycle["panels/skin/erp"][line]
        assert power <= erp * (1 + (1e-9 if erp.dtype == np.float64 else 1e-5)), f"line {hz} Hz"
        assert power >= 0.0


path = sys.argv[1]
with h5py.File(path) as file:
    assert file.attrs["schema"] == b"clatter/field/1"
    n_nodes, n_faces = len(file["skin/nodes"]), len(file["skin/triangles"])
    check_units(file)
    check_power(file)
    frame_times, line_hz = file["frames/time"][()], file["lines/frequency_hz"][()]
stem = os.path.splitext(path)[0]
assert np.allclose(check_series(stem + ".xdmf", n_nodes, n_faces), frame_times, rtol=1e-11, atol=1e-15)
assert np.allclose(check_series(stem + ".lines.xdmf", n_nodes, n_faces), line_hz, rtol=1e-11)
print("field file and XDMF fit")
