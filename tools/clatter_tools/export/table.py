# SPDX-License-Identifier: GPL-3.0-or-later
"""CSV: one row per node or face and step, after comment lines with # and one line of names."""
import numpy as np

from clatter.artefact import BadArtefact
from .columns import formatted, line
from .surface import QUANTITIES, interleaved


def unit_name(unit):
    """Of a column: m/s2 as m_s2."""
    return unit.replace("/", "_")


def value_names(motion, quantity):
    """Names of the value columns: velocity_x_re_m_s, velocity_x_im_m_s, ..."""
    axes = [f"{quantity}_{axis}" for axis in "xyz"] if QUANTITIES[quantity].at_nodes else [quantity]
    parts = ("_re", "_im") if motion.is_complex else ("",)
    return [f"{name}{part}_{unit_name(QUANTITIES[quantity].unit)}" for name in axes for part in parts]


def places(surface, quantity):
    """(names, values) of the columns that say where: node and position, or face, centre, normal and area."""
    if QUANTITIES[quantity].at_nodes:
        return ["node", "x_m", "y_m", "z_m"], [np.arange(1, len(surface.nodes) + 1), surface.nodes]
    return (["face", "x_m", "y_m", "z_m", "normal_x", "normal_y", "normal_z", "area_m2"],
            [np.arange(1, len(surface.triangles) + 1), surface.centre, surface.normal, surface.area])


def write(files, path, surface, motion, options, progress):
    if len(options.quantities) != 1:
        raise BadArtefact(f"{path}: found the quantities {', '.join(options.quantities)}, expected one in a CSV file")
    quantity = options.quantities[0]
    names, columns = places(surface, quantity)
    with files.text(path) as stream:
        stream.write(f"# {line(motion.origin.body + ' of ' + motion.origin.file, 200)}\n# {line(motion.convention(), 200)}; "
                     "normals out of the solid\n" +
                     ",".join([f"{motion.axis[0]}_{motion.axis[1].lower()}", *names, *value_names(motion, quantity)]) + "\n")
        for step in progress(len(motion.at)):
            values = interleaved(motion.read(quantity, step))
            row = f"{motion.at[step]:.12g},%d" + ",%.9g" * (len(names) - 1 + values.shape[1]) + "\n"
            stream.writelines(formatted(row, *columns, values))
