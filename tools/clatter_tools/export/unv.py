# SPDX-License-Identifier: GPL-3.0-or-later
"""I-DEAS universal file: 164 (SI), 2411 (nodes), 2412 (thin shells 91, 92), 2467 (panels as groups), and results as
datasets 2414 (at nodes, on elements) or 55 (at nodes). As clatter-mesh writes meshes; six digits of a result (6E13.5)."""
import numpy as np

from clatter.artefact import BadArtefact
from .columns import formatted, line, two_lines
from .surface import QUANTITIES, interleaved

RING = [0, 3, 1, 4, 2, 5]  # universal files alternate corners and mid-side nodes
RESULT_TYPE = {"displacement": 8, "velocity": 11, "acceleration": 12, "normal_velocity": 11}
ELEMENT, SHELL, PARABOLIC_SHELL = 8, 91, 92  # entity of groups, descriptors of elements
TRANSIENT, FREQUENCY_RESPONSE = 4, 5
SINGLE, COMPLEX = 2, 5
LONGEST_NAME = 40


def fortran(texts):
    """Exponents with D instead of E."""
    for text in texts:
        yield text.replace("E", "D")


def integers(*values):
    return "".join(f"{value:>10d}" for value in values) + "\n"


def reals(values, width):
    """Values in the format 6E13.5, `width` of them, the rest 0."""
    padded = [*values, *([0.0] * (width - len(values)))]
    return "".join(f"{value:13.5E}" + ("\n" if i % 6 == 5 or i + 1 == width else "") for i, value in enumerate(padded))


def write_units(stream):
    stream.write(f"    -1\n{164:>6}\n{1:>10}{'SI: Meter (newton)':<20}{2:>10}\n")
    stream.writelines(fortran([f"{1:25.16E}{1:25.16E}{1:25.16E}\n{273.15:25.16E}\n"]))
    stream.write("    -1\n")


def write_nodes(stream, numbers, positions):
    """Dataset 2411; numbers n, positions n x 3 [m]."""
    stream.write(f"    -1\n{2411:>6}\n")
    stream.writelines(fortran(formatted("%10d         1         1        11\n%25.16E%25.16E%25.16E\n", numbers, positions)))
    stream.write("    -1\n")


def write_elements(stream, surface):
    kind, order = (PARABOLIC_SHELL, RING) if surface.is_quadratic else (SHELL, [0, 1, 2])
    head = "".join(f"{value:>10d}" for value in (kind, 1, 1, 7, len(order)))
    stream.write(f"    -1\n{2412:>6}\n")
    stream.writelines(formatted(f"%10d{head}\n{'%10d' * len(order)}\n", np.arange(1, len(surface.triangles) + 1),
                                surface.triangles[:, order] + 1))
    stream.write("    -1\n")


def write_groups(stream, panels):
    if not panels:
        return
    stream.write(f"    -1\n{2467:>6}\n")
    for number, (name, rows) in enumerate(panels.items(), 1):
        if len(name) > LONGEST_NAME:
            raise BadArtefact(f"panel {name}: found a name of {len(name)} characters, expected at most {LONGEST_NAME} for a universal file")
        stream.write(integers(number, 0, 0, 0, 0, 0, 0, len(rows)) + line(name, LONGEST_NAME) + "\n")
        members = [f"{ELEMENT:>10d}{row + 1:>10d}{0:>10d}{0:>10d}" for row in rows]
        stream.writelines("".join(members[k:k + 2]) + "\n" for k in range(0, len(members), 2))
    stream.write("    -1\n")


def id_lines(motion, quantity, step):
    """The five ID lines of a result."""
    return "".join(line(text) + "\n" for text in (
        f"clatter {motion.origin.body} {quantity} of {motion.origin.file}", *two_lines(motion.convention()),
        f"SI: {quantity} in {QUANTITIES[quantity].unit}, nodes in m; normals out of the solid", motion.step_name(step)))


def head_2414(motion, quantity, step, label):
    """Records 1 to 13 of a dataset 2414."""
    at_nodes = QUANTITIES[quantity].at_nodes
    analysis, data = (FREQUENCY_RESPONSE, COMPLEX) if motion.is_complex else (TRANSIENT, SINGLE)
    components = 3 if at_nodes else 1
    numbers = [0] * 6 + ([0, step + 1] if motion.is_complex else [step + 1, 0])
    values = [0.0, motion.at[step]] if motion.is_complex else [motion.at[step]]
    return (integers(label) + quantity + "\n" + integers(1 if at_nodes else 2) + id_lines(motion, quantity, step) +
            integers(1, analysis, 2 if at_nodes else 1, RESULT_TYPE[quantity], data, components) + integers(*numbers) +
            integers(0, 0) + reals(values, 6) + reals([], 6))


def head_55(motion, quantity, step, _):
    """Records 1 to 8 of a dataset 55."""
    analysis, data = (FREQUENCY_RESPONSE, COMPLEX) if motion.is_complex else (TRANSIENT, SINGLE)
    return (id_lines(motion, quantity, step) + integers(1, analysis, 2, RESULT_TYPE[quantity], data, 3) +
            integers(2, 1, 1, step + 1) + reals([motion.at[step]], 1))


def write_result(stream, dataset, motion, quantity, step, label):
    values = interleaved(motion.read(quantity, step))
    head = head_55 if dataset == 55 else head_2414
    stream.write(f"    -1\n{dataset:>6}\n" + head(motion, quantity, step, label))
    number = "%10d\n" if QUANTITIES[quantity].at_nodes else f"%10d{1:>10d}\n"
    stream.writelines(formatted(number + "%13.5E" * values.shape[1] + "\n", np.arange(1, len(values) + 1), values))
    stream.write("    -1\n")


def write(files, path, surface, motion, options, progress):
    if options.dataset == 55 and not all(QUANTITIES[name].at_nodes for name in options.quantities):
        raise BadArtefact("--dataset 55: found normal_velocity, expected quantities at nodes; 2414 has both")
    with files.text(path) as stream:
        write_units(stream)
        write_nodes(stream, np.arange(1, len(surface.nodes) + 1), surface.nodes)
        write_elements(stream, surface)
        write_groups(stream, surface.panels)
        label = 0
        for step in progress(len(motion.at)):
            for quantity in options.quantities:
                label += 1
                write_result(stream, options.dataset, motion, quantity, step, label)
