# SPDX-License-Identifier: GPL-3.0-or-later
"""Nastran: name.pch, punched output in SORT1 (real and imaginary), and name.bdf, its grid points and CTRIA6 or CTRIA3.

Columns of the punch are those of Nastran's own: I10, G, 3 E18.6 and a sequence number; -CONT- for rotations (zero) and
imaginary parts.
"""
import numpy as np

from .columns import formatted, line
from .surface import QUANTITIES

REQUEST = {"displacement": "$DISPLACEMENTS", "velocity": "$VELOCITY", "acceleration": "$ACCELERATION"}
POINT = "%10d       G%18.6E%18.6E%18.6E%8d\n"
MORE = "-CONT-            %18.6E%18.6E%18.6E%8d\n"
NO_ROTATION = f"-CONT-            {'%18.6E' % 0 * 3}%8d\n"
LAST = 10 ** 8  # sequence numbers have eight columns


def write_bulk(stream, surface, motion):
    stream.write(f"$ {line(motion.origin.body + ' of ' + motion.origin.file, 70)}\n$ m; results: the .pch file of the same name; "
                 "property 1 is not defined here\nBEGIN BULK\n")
    nodes = np.where(np.abs(surface.nodes) < 1e-90, 0.0, surface.nodes)  # an exponent of three digits has no column
    stream.writelines(formatted("GRID*   %16d                %16.9E%16.9E\n*       %16.9E\n", np.arange(1, len(nodes) + 1), nodes))
    card = "CTRIA6  " if surface.is_quadratic else "CTRIA3  "
    stream.writelines(formatted(f"{card}%8d{1:>8d}{'%8d' * surface.triangles.shape[1]}\n",
                                np.arange(1, len(surface.triangles) + 1), surface.triangles + 1))
    stream.write("ENDDATA\n")


def head(motion, quantity, step):
    """Lines of the head of one step, without their sequence numbers."""
    format_ = "$REAL-IMAGINARY OUTPUT" if motion.is_complex else "$REAL OUTPUT"
    axis = "$FREQUENCY =" if motion.is_complex else "$TIME ="
    phase = "PEAK, EXP(+I 2 PI F T), SI" if motion.is_complex else "REAL VALUES, SI"
    return [f"$TITLE   ={line(motion.origin.body, 60)}", f"$SUBTITLE={line(motion.origin.file, 60)}",
            f"$LABEL   ={phase}, {QUANTITIES[quantity].unit}", REQUEST[quantity], format_,
            f"$SUBCASE ID ={1:>12d}", f"{axis}{motion.at[step]:16.7E}"]


def write_step(stream, motion, quantity, step, sequence):
    """One step; returns the next sequence number."""
    lines = head(motion, quantity, step)
    stream.writelines(f"{text:<72}{(sequence + i) % LAST:>8d}\n" for i, text in enumerate(lines))
    values = motion.read(quantity, step)
    count = 4 if motion.is_complex else 2
    numbers = (sequence + len(lines) + np.arange(count * len(values)).reshape(-1, count)) % LAST
    columns = [np.arange(1, len(values) + 1), values.real, numbers[:, :2]]
    if motion.is_complex:
        columns += [values.imag, numbers[:, 2:]]
    stream.writelines(formatted(POINT + NO_ROTATION + (MORE + NO_ROTATION if motion.is_complex else ""), *columns))
    return sequence + len(lines) + numbers.size


def write(files, path, surface, motion, options, progress):
    with files.text(path.with_suffix(".bdf")) as stream:
        write_bulk(stream, surface, motion)
    with files.text(path) as stream:
        sequence = 1
        for step in progress(len(motion.at)):
            for quantity in options.quantities:
                sequence = write_step(stream, motion, quantity, step, sequence)
