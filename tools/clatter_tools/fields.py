# SPDX-License-Identifier: GPL-3.0-or-later
"""Contents of a field file: pieces of a run (a cycle, windows), sensors, panels, the skin."""
import numpy as np

from .artefact import BadArtefact, dataset, text

THRUST = np.array([0.0, 1.0, 0.0])


def pieces(field):
    """Names of the pieces in the file; at least one."""
    present = sorted(field["analysis"]) if "analysis" in field else []
    if not present:
        raise BadArtefact(f"{field.filename}: analysis: found nothing, expected a cycle or a window")
    return present


def piece(field, *wanted):
    """Path of the first of the wanted pieces in the file: "analysis/ftdc"."""
    present = pieces(field)
    for name in wanted:
        if name in present:
            return f"analysis/{name}"
    raise BadArtefact(f"{field.filename}: analysis: found {', '.join(present)}, "
                      f"expected {' or '.join(wanted)}")


def sensor_names(field, at):
    return sorted(field[f"{at}/sensors"]) if f"{at}/sensors" in field else []


def pick_sensor(field, at, part):
    """Path of the sensor whose name contains `part`, or None."""
    return next((f"{at}/sensors/{name}" for name in sensor_names(field, at) if part in name), None)


def channel(field, sensor, direction=THRUST):
    """Index of the displacement channel that is most parallel to `direction`."""
    along = np.abs(dataset(field, f"{sensor}/direction") @ direction)
    along[dataset(field, f"{sensor}/is_rotation") != 0] = -1
    return int(np.argmax(along))


def channel_name(field, sensor, index):
    return text(dataset(field, f"{sensor}/labels")[index])


def acceleration(field, sensor, at):
    """(time from firing TDC [s], acceleration [m/s2]) of a sensor's thrust-side channel."""
    return (dataset(field, f"{at}/time"),
            dataset(field, f"{sensor}/acceleration")[:, channel(field, sensor)])


def acceleration_bands(field, sensor):
    """Third-octave levels of the same channel [dB], and their reference as text."""
    levels = field[f"{sensor}/third_octave/acceleration_db"]
    return levels[:, channel(field, sensor)], reference(levels)


def reference(levels):
    return f"{levels.attrs['reference']:g} {text(levels.attrs['reference_unit'])}".replace("m/s2", "m/s²")


def panel(field, at, *wanted):
    """Path of the first of the wanted panels in the file."""
    for name in wanted:
        if f"{at}/panels/{name}" in field:
            return f"{at}/panels/{name}"
    raise BadArtefact(f"{field.filename}: {at}/panels: none of {', '.join(wanted)}")
