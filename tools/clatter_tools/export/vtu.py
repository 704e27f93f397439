# SPDX-License-Identifier: GPL-3.0-or-later
"""ParaView and other readers of VTK XML: a .pvd, and beside it one binary .vtu per step, appended raw data."""
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from .columns import line
from .surface import QUANTITIES

TYPES = {"float64": "Float64", "float32": "Float32", "int64": "Int64", "uint8": "UInt8"}
TRIANGLE, QUADRATIC_TRIANGLE = 5, 22


class RawArrays:
    """Arrays of one file: their XML elements, and their bytes, each after its length."""

    def __init__(self):
        self.blocks, self.offset = [], 0

    def element(self, name, values):
        values = np.ascontiguousarray(values)
        size = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
        text = (f'<DataArray type="{TYPES[values.dtype.name]}" Name={quoteattr(name)}{size} NumberOfTuples="{len(values)}" '
                f'format="appended" offset="{self.offset}"/>\n')
        self.blocks += [np.uint64(values.nbytes).tobytes(), values.tobytes()]
        self.offset += 8 + values.nbytes
        return text


def grid(surface, raw):
    """Points and cells."""
    corners = surface.triangles.shape[1]
    count = len(surface.triangles)
    return ("<Points>\n" + raw.element("Points", surface.nodes) + "</Points>\n<Cells>\n" +
            raw.element("connectivity", surface.triangles.astype(np.int64).ravel()) +
            raw.element("offsets", np.arange(1, count + 1, dtype=np.int64) * corners) +
            raw.element("types", np.full(count, QUADRATIC_TRIANGLE if surface.is_quadratic else TRIANGLE, np.uint8)) + "</Cells>\n")


def panel_flags(surface, raw):
    text = ""
    for name, rows in surface.panels.items():
        flags = np.zeros(len(surface.triangles), np.uint8)
        flags[rows] = 1
        text += raw.element(f"panel {name}", flags)
    return text


def data(motion, quantities, step, at_nodes, raw):
    """Elements of the quantities at nodes, or of those on faces."""
    text = ""
    for quantity in (name for name in quantities if QUANTITIES[name].at_nodes == at_nodes):
        values = motion.read(quantity, step)
        text += "".join(raw.element(name, part(values)) for name, part in motion.parts(quantity).items())
    return text


def write_grid(path, surface, motion, quantities, step):
    """One .vtu."""
    raw, (axis, unit) = RawArrays(), motion.axis
    units = ", ".join(f"{name} {QUANTITIES[name].unit}" for name in quantities)
    comment = line(f"{motion.origin.body} of {motion.origin.file}; {units}, points m; {motion.convention()}", 400).replace("--", "- -")
    xml = (f'<?xml version="1.0"?>\n<!-- {escape(comment)} -->\n'
           '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
           "<UnstructuredGrid>\n<FieldData>\n" + raw.element(f"{axis}_{unit.lower()}", motion.at[step:step + 1].astype(float)) +
           f'</FieldData>\n<Piece NumberOfPoints="{len(surface.nodes)}" NumberOfCells="{len(surface.triangles)}">\n' +
           grid(surface, raw) + "<PointData>\n" + data(motion, quantities, step, True, raw) + "</PointData>\n<CellData>\n" +
           panel_flags(surface, raw) + data(motion, quantities, step, False, raw) +
           '</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding="raw">\n_')
    with open(path, "wb") as stream:
        stream.write(xml.encode("ascii"))
        stream.writelines(raw.blocks)
        stream.write(b"\n</AppendedData>\n</VTKFile>\n")


def write(files, path, surface, motion, options, progress):
    digits, entries = len(str(len(motion.at))), []
    for step in progress(len(motion.at)):
        one = path.with_name(f"{path.stem}_{step + 1:0{digits}d}.vtu")
        write_grid(files.part(one), surface, motion, options.quantities, step)
        entries.append(f'<DataSet timestep="{motion.at[step]:.12g}" file={quoteattr(one.name)}/>\n')
    with files.text(path) as stream:
        stream.write(f'<?xml version="1.0"?>\n<!-- timestep: {" in ".join(motion.axis)} -->\n<VTKFile type="Collection" version="0.1">\n'
                     "<Collection>\n" + "".join(entries) + "</Collection>\n</VTKFile>\n")
