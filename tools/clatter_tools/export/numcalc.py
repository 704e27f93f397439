# SPDX-License-Identifier: GPL-3.0-or-later
"""Folder for NumCalc, the boundary element code of Mesh2HRTF: Nodes.txt, Elements.txt, and a folder with NC.inp per line.

NumCalc's phase is e^{-i w t}: the normal velocities are conjugated. Its elements have three nodes; normals point outward.
"""
import numpy as np

from .columns import formatted, line
from .whole_files import MARK

INPUT = """##
## Written by clatter export from {source}
## normal velocity [m/s] of each element, outward, peak amplitudes
## phase of this file: x(t) = Re( X exp(-i 2 pi f t) ), conjugate of the source
##
Mesh2HRTF 1.0.0
##
{title}
##
## Controlparameter I
0 0 0 0 7 0
##
## Controlparameter II
1 1 0.000001 0.00e+00 1 0 0
##
## Load Frequency Curve
0 2
0.000000 0.000000e+00 0.0
0.000001 {frequency:.12e} 0.0
##
## 1. Main Parameters I
1 {elements} {nodes} 0 0 2 1 4 0
##
## 2. Main Parameters II
0 0 0 0.0000e+00 0 0 0
##
## 3. Main Parameters III
0 0 0 0
##
## 4. Main Parameters IV
{sound_speed:.10g} {density:.10g} 1.0 0.0e+00 0.0e+00 0.0e+00 0.0e+00
##
NODES
../Nodes.txt
##
ELEMENTS
../Elements.txt
##
BOUNDARY
"""
END = """RETU
##
POST PROCESS
##
END
"""
README = """Input of NumCalc (Mesh2HRTF), written by clatter export from {source}.
Run NumCalc in each of the folders line_*. To add evaluation points, append their files below NODES and
ELEMENTS of NC.inp, count them in "1. Main Parameters I" and make its first number 2.
Lengths in m, normal velocities in m/s, outward, peak amplitudes.
Phase: x(t) = Re( X exp(-i 2 pi f t) ), the conjugate of the source: {phase}
"""


def write_mesh(folder, surface):
    with open(folder / "Nodes.txt", "w", encoding="ascii") as stream:
        stream.write(f"{len(surface.nodes)}\n")
        stream.writelines(formatted("%d %.12e %.12e %.12e\n", np.arange(len(surface.nodes)), surface.nodes))
    with open(folder / "Elements.txt", "w", encoding="ascii") as stream:
        stream.write(f"{len(surface.triangles)}\n")
        stream.writelines(formatted("%d %d %d %d 0 0 0\n", np.arange(len(surface.triangles)), surface.triangles))


def write_line(folder, surface, motion, step):
    velocity = np.conj(motion.read("normal_velocity", step))
    origin, elements = motion.origin, np.arange(len(velocity))
    own = folder / f"line_{step + 1:04d}"
    own.mkdir()
    with open(own / "NC.inp", "w", encoding="ascii") as stream:
        stream.write(INPUT.format(source=line(origin.file), title=line(f"{origin.body} {motion.step_name(step)}"),
                                  frequency=motion.at[step], elements=len(elements), nodes=len(surface.nodes),
                                  sound_speed=origin.air_sound_speed, density=origin.air_density))
        stream.writelines(formatted("ELEM %d TO %d VELO %.9e -1 %.9e -1\n", elements, elements, velocity.real, velocity.imag))
        stream.write(END)


def write(files, path, surface, motion, _, progress):
    folder = files.folder(path)
    with open(folder / MARK, "w", encoding="ascii") as stream:
        stream.write(README.format(source=line(motion.origin.file), phase=line(motion.origin.phase, 200)))
    write_mesh(folder, surface)
    for step in progress(len(motion.at)):
        write_line(folder, surface, motion, step)
