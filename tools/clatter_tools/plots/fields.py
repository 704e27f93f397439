"""What a field file holds at its sensors and over its skin."""
import numpy as np

from ..artefact import BadArtefact, dataset, text
from .histories import centred, last_cycle

DIRECTIONS = "xyz"


def sensors(field):
    """Names of the sensors in a field file."""
    return sorted(field["sensors"]) if "sensors" in field else []


def acceleration(field, sensor, direction="y"):
    """(angle, a) [deg about firing TDC, m/s2] of one sensor over the last cycle, in one global direction."""
    angle = dataset(field, "crank_angle_deg")
    values = dataset(field, f"sensors/{sensor}/acceleration")[:, DIRECTIONS.index(direction)]
    window = last_cycle(angle)
    degrees, order = centred(angle[window])
    return degrees, values[window][order]


def third_octaves(field, sensor, direction="y"):
    """(mid frequencies [Hz], levels [dB re 1e-6 m/s2, RMS]) of a sensor's acceleration."""
    group = f"sensors/{sensor}/third_octaves"
    return dataset(field, f"{group}/frequency"), dataset(field, f"{group}/level_db")[:, DIRECTIONS.index(direction)]


def pick_sensor(field, wanted):
    """The sensor whose name contains `wanted`; BadArtefact lists the names present."""
    matches = [name for name in sensors(field) if wanted in name]
    if not matches:
        raise BadArtefact(f"{field.filename}: sensors: no name contains '{wanted}'; present: {', '.join(sensors(field))}")
    return matches[0]
