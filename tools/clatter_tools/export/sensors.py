# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra or time histories of a field file's sensors: universal file (nodes 2411, functions 58) or CSV."""
import dataclasses

import numpy as np

from clatter.artefact import BadArtefact, dataset, text
from clatter.fields import piece, pieces, sensor_names
from .columns import formatted, line, two_lines
from .field_source import checked, read_origin
from .surface import QUANTITIES, Origin, interleaved
from .table import unit_name
from .unv import RESULT_TYPE, write_nodes, write_units

HISTORY, SPECTRUM = 1, 12         # types of functions
REAL_DOUBLE, COMPLEX_DOUBLE = 4, 6
EVEN, TIME, FREQUENCY = 1, 17, 18
SPACING = 1e-6                    # of the axis, by which steps may differ, over the last value


@dataclasses.dataclass(frozen=True)
class Channels:
    """One quantity of all channels over an even axis: complex peak spectra, or real histories.

    labels of the channels c; position c x 3 [m]; direction c x 3; is_rotation c; at n: frequency [Hz] or time [s]; values n x c.
    """
    quantity: str
    labels: list
    position: np.ndarray
    direction: np.ndarray
    is_rotation: np.ndarray
    at: np.ndarray
    values: np.ndarray
    origin: Origin

    @property
    def is_spectrum(self):
        return np.iscomplexobj(self.values)

    @property
    def axis(self):
        """(name, unit) of `at`."""
        return ("frequency", "Hz") if self.is_spectrum else ("time", "s")

    def unit(self, channel):
        unit = QUANTITIES[self.quantity].unit
        return unit.replace("m", "rad") if self.is_rotation[channel] else unit

    def convention(self):
        return f"peak amplitudes, {self.origin.phase}" if self.is_spectrum else \
            "real values, time from crank angle 0 (from the first sample when nothing turns)"


def read_channels(file, quantity, histories):
    """Spectra or histories of all sensors over the cycle, or the window where the file has no cycle."""
    at = piece(file, "cycle", *pieces(file))
    names = sensor_names(file, at)
    if not names:
        raise BadArtefact(f"{file.filename}: {at}/sensors: found none, expected sensors; the part's fe.toml names them")
    axis_name = f"{at}/time" if histories else f"{at}/frequency_hz"
    axis = dataset(file, axis_name)
    if len(axis) < 2 or np.ptp(np.diff(axis)) > SPACING * np.abs(axis).max():
        raise BadArtefact(f"{file.filename}: {axis_name}: found uneven or less than two values, expected even ones")
    found = {key: [] for key in ("labels", "position", "direction", "is_rotation", "values")}
    for name in names:
        sensor = f"{at}/sensors/{name}"
        labels = [text(label) for label in dataset(file, f"{sensor}/labels")]
        shape = (len(axis), len(labels))
        found["labels"] += labels
        found["position"].append(checked(file, f"{sensor}/position", (len(labels), 3)))
        found["direction"].append(checked(file, f"{sensor}/direction", (len(labels), 3)))
        found["is_rotation"].append(checked(file, f"{sensor}/is_rotation", (len(labels),)))
        found["values"].append(checked(file, f"{sensor}/{quantity}", shape) if histories else
                               checked(file, f"{sensor}/spectrum/{quantity}_re", shape) +
                               1j * checked(file, f"{sensor}/spectrum/{quantity}_im", shape))
    return Channels(quantity, found["labels"], np.concatenate(found["position"]), np.concatenate(found["direction"]),
                    np.concatenate(found["is_rotation"]), axis, np.concatenate(found["values"], axis=1), read_origin(file))


def direction_code(direction, is_rotation):
    """1 2 3 along x y z, negative against it, 4 5 6 for rotations; 0: another direction."""
    axis = int(np.argmax(np.abs(direction)))
    if abs(direction[axis]) < 1 - 1e-9:
        return 0
    return int(np.sign(direction[axis])) * (axis + 1 + (3 if is_rotation else 0))


def head_58(channels, channel, node):
    """Records 1 to 11 of a dataset 58."""
    direction, unit, (axis, axis_unit) = channels.direction[channel], channels.unit(channel), channels.axis
    function, data, axis_type = (SPECTRUM, COMPLEX_DOUBLE, FREQUENCY) if channels.is_spectrum else (HISTORY, REAL_DOUBLE, TIME)
    step = (channels.at[-1] - channels.at[0]) / (len(channels.at) - 1)
    ids = (f"clatter {channels.labels[channel]} {channels.quantity} of {channels.origin.file}", *two_lines(channels.convention()),
           f"SI: {unit}, {axis_unit}", "direction " + " ".join(f"{c:.9g}" for c in direction))
    code = direction_code(direction, channels.is_rotation[channel])
    return ("".join(line(text) + "\n" for text in ids) +
            f"{function:>5d}{channel + 1:>10d}{0:>5d}{0:>10d} {'NONE':<10}{node:>10d}{code:>4d} {'NONE':<10}{0:>10d}{0:>4d}\n"
            f"{data:>10d}{len(channels.at):>10d}{EVEN:>10d}{channels.at[0]:13.5E}{step:13.5E}{0:13.5E}\n" +
            "".join(f"{kind:>10d}{0:>5d}{0:>5d}{0:>5d} {name:<20} {own:<20}\n" for kind, name, own in (
                (axis_type, axis, axis_unit), (RESULT_TYPE[channels.quantity], channels.quantity, unit),
                (0, "NONE", "NONE"), (0, "NONE", "NONE"))))


def write_unv(files, path, channels):
    places, nodes = np.unique(channels.position, axis=0, return_inverse=True)
    with files.text(path) as stream:
        write_units(stream)
        write_nodes(stream, np.arange(1, len(places) + 1), places)
        for channel in range(len(channels.labels)):
            stream.write(f"    -1\n{58:>6}\n" + head_58(channels, channel, nodes[channel] + 1))
            values = interleaved(channels.values[:, channel]).ravel()
            even = len(values) // 4 * 4
            stream.writelines(formatted("%20.12E" * 4 + "\n", values[:even].reshape(-1, 4)))
            rest = values[even:]
            stream.write("%20.12E" * len(rest) % tuple(rest) + "\n" if len(rest) else "")
            stream.write("    -1\n")


def write_table(files, path, channels):
    names = [f"{label} {channels.quantity}{part}_{unit_name(channels.unit(c))}".replace(",", " ").replace('"', "'")
             for c, label in enumerate(channels.labels) for part in (("_re", "_im") if channels.is_spectrum else ("",))]
    with files.text(path) as stream:
        stream.write(f"# {line(channels.origin.body + ' of ' + channels.origin.file, 200)}\n# {line(channels.convention(), 200)}\n")
        stream.write(",".join(["_".join(channels.axis).lower(), *names]) + "\n")
        stream.writelines(formatted("%.12g" + ",%.12g" * len(names) + "\n", channels.at, interleaved(channels.values)))
