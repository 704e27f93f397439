# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra of a field file's sensors: universal file (nodes 2411, functions 58) or CSV."""
import dataclasses

import numpy as np

from ..artefact import BadArtefact, dataset, text
from ..fields import piece, pieces, sensor_names
from .columns import formatted, line, two_lines
from .field_source import checked, read_origin
from .surface import QUANTITIES, Origin, interleaved
from .table import unit_name
from .unv import RESULT_TYPE, write_nodes, write_units

SPECTRUM, COMPLEX_DOUBLE, EVEN, FREQUENCY = 12, 6, 1, 18


@dataclasses.dataclass(frozen=True)
class Spectra:
    """Complex peak spectra of one quantity of all channels, over an even frequency axis.

    labels of the channels c; position c x 3 [m]; direction c x 3; is_rotation c; frequency l [Hz]; values l x c.
    """
    quantity: str
    labels: list
    position: np.ndarray
    direction: np.ndarray
    is_rotation: np.ndarray
    frequency: np.ndarray
    values: np.ndarray
    origin: Origin

    def unit(self, channel):
        unit = QUANTITIES[self.quantity].unit
        return unit.replace("m", "rad") if self.is_rotation[channel] else unit

    def convention(self):
        return f"peak amplitudes, {self.origin.phase}"


def read_spectra(file, quantity):
    """Spectra of all sensors of the cycle, or of the window where the file has no cycle."""
    at = piece(file, "cycle", *pieces(file))
    names = sensor_names(file, at)
    if not names:
        raise BadArtefact(f"{file.filename}: {at}/sensors: found none, expected sensors; the part's fe.toml names them")
    frequency = dataset(file, f"{at}/frequency_hz")
    if len(frequency) < 2 or np.ptp(np.diff(frequency)) > 1e-6 * frequency[-1]:
        raise BadArtefact(f"{file.filename}: {at}/frequency_hz: found uneven or less than two frequencies, expected even ones")
    found = {key: [] for key in ("labels", "position", "direction", "is_rotation", "values")}
    for name in names:
        sensor = f"{at}/sensors/{name}"
        labels = [text(label) for label in dataset(file, f"{sensor}/labels")]
        shape = (len(frequency), len(labels))
        found["labels"] += labels
        found["position"].append(checked(file, f"{sensor}/position", (len(labels), 3)))
        found["direction"].append(checked(file, f"{sensor}/direction", (len(labels), 3)))
        found["is_rotation"].append(checked(file, f"{sensor}/is_rotation", (len(labels),)))
        found["values"].append(checked(file, f"{sensor}/spectrum/{quantity}_re", shape) +
                               1j * checked(file, f"{sensor}/spectrum/{quantity}_im", shape))
    return Spectra(quantity, found["labels"], np.concatenate(found["position"]), np.concatenate(found["direction"]),
                   np.concatenate(found["is_rotation"]), frequency, np.concatenate(found["values"], axis=1), read_origin(file))


def direction_code(direction, is_rotation):
    """1 2 3 along x y z, negative against it, 4 5 6 for rotations; 0: another direction."""
    axis = int(np.argmax(np.abs(direction)))
    if abs(direction[axis]) < 1 - 1e-9:
        return 0
    return int(np.sign(direction[axis])) * (axis + 1 + (3 if is_rotation else 0))


def head_58(spectra, channel, node):
    """Records 1 to 11 of a dataset 58."""
    direction, unit = spectra.direction[channel], spectra.unit(channel)
    step = (spectra.frequency[-1] - spectra.frequency[0]) / (len(spectra.frequency) - 1)
    ids = (f"clatter {spectra.labels[channel]} {spectra.quantity} of {spectra.origin.file}", *two_lines(spectra.convention()),
           f"SI: {unit}, Hz", "direction " + " ".join(f"{c:.9g}" for c in direction))
    code = direction_code(direction, spectra.is_rotation[channel])
    return ("".join(line(text) + "\n" for text in ids) +
            f"{SPECTRUM:>5d}{channel + 1:>10d}{0:>5d}{0:>10d} {'NONE':<10}{node:>10d}{code:>4d} {'NONE':<10}{0:>10d}{0:>4d}\n"
            f"{COMPLEX_DOUBLE:>10d}{len(spectra.frequency):>10d}{EVEN:>10d}{spectra.frequency[0]:13.5E}{step:13.5E}{0:13.5E}\n" +
            "".join(f"{kind:>10d}{0:>5d}{0:>5d}{0:>5d} {name:<20} {own:<20}\n" for kind, name, own in (
                (FREQUENCY, "frequency", "Hz"), (RESULT_TYPE[spectra.quantity], spectra.quantity, unit),
                (0, "NONE", "NONE"), (0, "NONE", "NONE"))))


def write_unv(files, path, spectra):
    places, nodes = np.unique(spectra.position, axis=0, return_inverse=True)
    with files.text(path) as stream:
        write_units(stream)
        write_nodes(stream, np.arange(1, len(places) + 1), places)
        for channel in range(len(spectra.labels)):
            stream.write(f"    -1\n{58:>6}\n" + head_58(spectra, channel, nodes[channel] + 1))
            values = interleaved(spectra.values[:, channel]).ravel()
            even = len(values) // 4 * 4
            stream.writelines(formatted("%20.12E" * 4 + "\n", values[:even].reshape(-1, 4)))
            stream.write("%20.12E%20.12E\n" % tuple(values[even:]) if even < len(values) else "")
            stream.write("    -1\n")


def write_table(files, path, spectra):
    names = [f"{label} {spectra.quantity}{part}_{unit_name(spectra.unit(c))}".replace(",", " ").replace('"', "'")
             for c, label in enumerate(spectra.labels) for part in ("_re", "_im")]
    with files.text(path) as stream:
        stream.write(f"# {line(spectra.origin.body + ' of ' + spectra.origin.file, 200)}\n# {line(spectra.convention(), 200)}\n")
        stream.write(",".join(["frequency_hz", *names]) + "\n")
        stream.writelines(formatted("%.12g" + ",%.12g" * len(names) + "\n", spectra.frequency, interleaved(spectra.values)))
