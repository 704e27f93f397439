# SPDX-License-Identifier: GPL-3.0-or-later
"""openCFS HDF5: mesh with one surface region, panels as groups, one harmonic or transient sequence step."""
import h5py
import numpy as np

from .patient_file import PatientFile
from .surface import QUANTITIES

TYPE_CODE = {3: 4, 6: 5}        # nodes of a triangle: openCFS's TRIA3, TRIA6
NODE, SURFACE_ELEMENT = 1, 4    # DefinedOn
SCALAR, VECTOR = 1, 3           # EntryType
MESH, MESH_RESULTS = 1, 2       # FileInfo/Content
REGION = "skin"
NAMES = {"displacement": "mechDisplacement", "velocity": "mechVelocity", "acceleration": "mechAcceleration",
         "normal_velocity": "acouNormalVelocity"}


def write_file_info(file, motion):
    info = file.create_group("FileInfo")
    info["Version"], info["Creator"] = ["0.9"], [f"clatter export of {motion.origin.body} from {motion.origin.file}"]
    info["Content"] = np.array([MESH, MESH_RESULTS], np.int32)
    info["Date"] = ["none"]  # the same input gives the same file
    data = file.create_group("UserData")
    data["Conventions"] = [f"{motion.convention()}; SI; normals out of the solid"]


def write_entities(group, surface, rows):
    """Elements, their nodes and the dimension of a region or group; numbers from 1."""
    group.attrs["Dimension"] = np.uint32(2)
    group["Elements"] = (np.asarray(rows) + 1).astype(np.uint32)
    group["Nodes"] = (np.unique(surface.triangles[rows]) + 1).astype(np.uint32)


def write_mesh(file, surface):
    mesh, f = file.create_group("Mesh"), len(surface.triangles)
    mesh.attrs["Dimension"] = np.uint32(3)
    mesh["Nodes/Coordinates"] = surface.nodes
    mesh["Nodes"].attrs["NumNodes"] = np.uint32(len(surface.nodes))
    elements = mesh.create_group("Elements")
    elements["Connectivity"] = (surface.triangles + 1).astype(np.uint32)
    elements["Types"] = np.full(f, TYPE_CODE[surface.triangles.shape[1]], np.int32)
    counts = {"NumElems": f, "QuadraticElems": int(surface.is_quadratic), "Num1DElems": 0, "Num2DElems": f, "Num3DElems": 0,
              "Num_TRIA3": 0 if surface.is_quadratic else f, "Num_TRIA6": f if surface.is_quadratic else 0}
    elements.attrs.update({name: np.uint32(count) for name, count in counts.items()})
    write_entities(mesh.create_group(f"Regions/{REGION}"), surface, np.arange(f))
    groups = mesh.create_group("Groups")
    for name, rows in surface.panels.items():
        if name != REGION and len(rows):
            write_entities(groups.create_group(name), surface, rows)


def describe(results, motion, quantities):
    """ResultDescription of each quantity."""
    for quantity in quantities:
        at_nodes = QUANTITIES[quantity].at_nodes
        group = results.create_group(f"ResultDescription/{NAMES[quantity]}")
        group["DefinedOn"] = np.array([NODE if at_nodes else SURFACE_ELEMENT], np.uint32)
        group["EntityNames"], group["Unit"] = [REGION], [QUANTITIES[quantity].unit.replace("s2", "s^2")]
        group["DOFNames"], group["NumDOFs"] = (list("xyz") if at_nodes else ["-"]), np.array([3 if at_nodes else 1], np.uint32)
        group["EntryType"] = np.array([VECTOR if at_nodes else SCALAR], np.uint32)
        group["StepNumbers"] = np.arange(1, len(motion.at) + 1, dtype=np.uint32)
        group["StepValues"] = motion.at.astype(float)


def write_step(results, motion, quantities, step):
    group = results.create_group(f"Step_{step + 1}")
    group.attrs["StepValue"] = float(motion.at[step])
    for quantity in quantities:
        where = f"{NAMES[quantity]}/{REGION}/{'Nodes' if QUANTITIES[quantity].at_nodes else 'Elements'}"
        values = motion.read(quantity, step).reshape(-1, 3 if QUANTITIES[quantity].at_nodes else 1)
        group[f"{where}/Real"] = values.real.astype(float)
        if motion.is_complex:
            group[f"{where}/Imag"] = values.imag


def write_results(file, motion, quantities, progress, check):
    """All steps; `check` raises the error of a full disk."""
    results = file.create_group("Results/Mesh/MultiStep_1")
    file["Results/Mesh"].attrs["ExternalFiles"] = np.uint32(0)
    results.attrs["AnalysisType"] = "harmonic" if motion.is_complex else "transient"
    results.attrs["LastStepNum"], results.attrs["LastStepValue"] = np.uint32(len(motion.at)), float(motion.at[-1])
    describe(results, motion, quantities)
    for step in progress(len(motion.at)):
        write_step(results, motion, quantities, step)
        check()


def write(files, path, surface, motion, options, progress):
    with PatientFile(files.part(path)) as stream:
        try:
            with h5py.File(stream, "w") as file:
                write_file_info(file, motion)
                write_mesh(file, surface)
                write_results(file, motion, options.quantities, progress, stream.check)
        finally:
            stream.check()
