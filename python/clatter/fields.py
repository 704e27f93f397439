# SPDX-License-Identifier: GPL-3.0-or-later
"""Contents of a field file: pieces of a run (a cycle, windows), sensors, panels, radiated power, the skin."""
import typing

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
    raise BadArtefact(f"{field.filename}: analysis: found {', '.join(present)}, expected {' or '.join(wanted)}"
                      + (" (of a run with cycles, and cycle = true in its field.toml)" if wanted == ("cycle",) else ""))


def mean_of_cycles(field):
    """(name of the window that is the mean over most cycles, how many), or (None, 1) where no window is one."""
    cycles = {name: int(one.attrs.get("averages", 1)) for name, one in field.get("analysis", {}).items() if text(one.attrs.get("periodic", "no")) == "yes"}
    most = max(cycles.values(), default=1)
    return next((name for name, count in cycles.items() if count == most), None) if most > 1 else None, most


def level_piece(field):
    """Path of the piece whose levels a run is known by: the mean over its cycles where the file has one, else its cycle, else its first piece."""
    return piece(field, *(name for name in (mean_of_cycles(field)[0], "cycle", *pieces(field)) if name))


def sensor_names(field, at):
    return sorted(field[f"{at}/sensors"]) if f"{at}/sensors" in field else []


def labelled(field, at, label):
    """(path of the sensor, index of its channel) by the channel's label; BadArtefact with the labels that the piece has."""
    known = {text(name): (f"{at}/sensors/{sensor}", k) for sensor in sensor_names(field, at)
             for k, name in enumerate(dataset(field, f"{at}/sensors/{sensor}/labels"))}
    if label not in known:
        raise BadArtefact(f"{field.filename}: {at}/sensors: found {', '.join(sorted(known)) or 'none'}, expected {label}")
    return known[label]


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
    return f"{levels.attrs['reference']:g} {text(levels.attrs['reference_unit'])}".replace("m/s2", "m/s²").replace("e-0", "e-")


def panel(field, at, *wanted):
    """Path of the first of the wanted panels in the file."""
    for name in wanted:
        if f"{at}/panels/{name}" in field:
            return f"{at}/panels/{name}"
    raise BadArtefact(f"{field.filename}: {at}/panels: none of {', '.join(wanted)}")


class Radiated(typing.NamedTuple):
    """A radiated power of a piece: paths of datasets and its total."""

    name: str     # "sound power", "ERP of panel “exposed”"
    power: str    # per line [W]
    bands: str    # per third octave [dB(A) re 1 pW]
    dba: float    # total [dB(A) re 1 pW]
    error: float  # standard error of the total [dB]; nan of one segment

    def level(self):
        """"92.7", or of a mean "92.7 ± 0.26"."""
        return f"{self.dba:.1f}{error_text(self.error)}"


def error_text(error):
    """" ± 0.26"; empty where there is none."""
    return "" if np.isnan(error) else f" ± {error:.2f}"


def standard_error(group, level, unit="dba"):
    """Of a level of a panel or of the sound, which is "erp" or "power" [dB]; nan of one segment."""
    return float(group.attrs.get(f"{level}_standard_error_{unit}", np.nan))


def sound_power(field, at):
    """The sound power of a piece, or None where the field file has none."""
    if f"{at}/sound" not in field:
        return None
    return Radiated("sound power", f"{at}/sound/power", f"{at}/sound/third_octave/power_dba", float(field[f"{at}/sound"].attrs["power_dba"]),
                    standard_error(field[f"{at}/sound"], "power"))


def radiated_estimate(field, at):
    """The ERP of a piece, of the exposed faces where the file has them."""
    where = panel(field, at, "exposed", "skin")
    return Radiated(f"ERP of panel “{where.rpartition('/')[2]}”", f"{where}/erp", f"{where}/third_octave/erp_dba",
                    float(field[where].attrs["erp_dba"]), standard_error(field[where], "erp"))


def radiated(field, at):
    """The sound power of a piece, or else its ERP."""
    return sound_power(field, at) or radiated_estimate(field, at)


def sound_limit(field, at):
    """The frequency up to which the sound power is of boundary elements, above it of the ERP [Hz]; 0 without sound."""
    return float(field[f"{at}/sound"].attrs["boundary_elements_to_hz"]) if f"{at}/sound" in field else 0.0


def basis_limit(field):
    """The frequency up to which the reduced model is proved [Hz]; 0 where it is not stated."""
    return float(field.attrs.get("basis_valid_to_hz", 0.0))


def orders_per_hz(field, at):
    """Engine orders per Hz of a piece at constant speed, else None."""
    if f"{at}/order" not in field or f"{at}/crank_angle_deg" not in field:
        return None
    angle, time = dataset(field, f"{at}/crank_angle_deg"), dataset(field, f"{at}/time")
    even = np.interp(time, time[[0, -1]], angle[[0, -1]])
    if np.abs(angle - even).max() > 0.01 * abs(angle[-1] - angle[0]):
        return None
    return dataset(field, f"{at}/order")[-1] / dataset(field, f"{at}/frequency_hz")[-1]
