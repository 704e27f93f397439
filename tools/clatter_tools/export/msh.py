# SPDX-License-Identifier: GPL-3.0-or-later
"""Gmsh MSH 2.2 text with data: views velocity_re, velocity_im, ... with one step per line or frame; their time is Hz or s."""
import numpy as np

from .columns import formatted, line
from .surface import QUANTITIES

TRIANGLE, QUADRATIC_TRIANGLE = 2, 9


def write_mesh(stream, surface, body):
    kind = QUADRATIC_TRIANGLE if surface.is_quadratic else TRIANGLE
    name = line(body, 60).replace('"', "'")
    stream.write(f'$PhysicalNames\n1\n2 1 "{name}"\n$EndPhysicalNames\n$Nodes\n{len(surface.nodes)}\n')
    stream.writelines(formatted("%d %.16e %.16e %.16e\n", np.arange(1, len(surface.nodes) + 1), surface.nodes))
    stream.write(f"$EndNodes\n$Elements\n{len(surface.triangles)}\n")
    stream.writelines(formatted(f"%d {kind} 2 1 1{' %d' * surface.triangles.shape[1]}\n",
                                np.arange(1, len(surface.triangles) + 1), surface.triangles + 1))
    stream.write("$EndElements\n")


def write_view(stream, name, motion, step, values):
    """One step of a view; values n x 3 at nodes, or f on faces."""
    section = "NodeData" if values.ndim == 2 else "ElementData"
    components = 3 if values.ndim == 2 else 1
    stream.write(f'${section}\n1\n"{name}"\n1\n{motion.at[step]:.12g}\n3\n{step}\n{components}\n{len(values)}\n')
    stream.writelines(formatted("%d" + " %.9e" * components + "\n", np.arange(1, len(values) + 1), values))
    stream.write(f"$End{section}\n")


def write(files, path, surface, motion, options, progress):
    units = ", ".join(f"{name} {QUANTITIES[name].unit}" for name in options.quantities)
    with files.text(path) as stream:
        stream.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\n" +
                     line(f"{motion.origin.body} of {motion.origin.file}; {units}, nodes m; time of the views: {' in '.join(motion.axis)}; "
                          f"{motion.convention()}; normals out of the solid", 400) + "\n$EndComments\n")
        write_mesh(stream, surface, motion.origin.body)
        for step in progress(len(motion.at)):
            for quantity in options.quantities:
                values = motion.read(quantity, step)
                for name, part in motion.parts(quantity).items():
                    write_view(stream, name, motion, step, part(values))
