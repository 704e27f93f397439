# SPDX-License-Identifier: GPL-3.0-or-later
"""The pressure table of a motored engine, as CSV for [gas] of a scene."""
import dataclasses
import math

from clatter.artefact import BadArtefact
from .whole_file import whole_file

DEGREE = math.pi / 180.0


@dataclasses.dataclass
class MotoredCycle:
    """Polytropic between intake valve closing and exhaust valve opening with the same exponent both ways, constant
    outside: with closing and opening at equal volumes the loop encloses no work. Defaults: the sample's truck diesel."""
    bore: float = 0.107         # [m]
    stroke: float = 0.130       # [m]
    rod: float = 0.210          # [m]
    pin_offset: float = 0.0     # [m]
    compression_ratio: float = 17.0
    exponent: float = 1.34      # n
    intake: float = 1e5         # absolute pressure at valve closing [Pa]
    closed: float = math.pi     # valves closed for |theta| below this [rad]

    def pin_height(self, theta):
        """Height of the piston pin above the crank axis [m]."""
        radius = 0.5 * self.stroke
        tilt = math.asin((-radius * math.sin(theta) - self.pin_offset) / self.rod)
        return radius * math.cos(theta) + self.rod * math.cos(tilt)

    def volume(self, theta):
        """Volume above the piston [m3]; at its dead centres rod and crank are collinear."""
        area = 0.25 * math.pi * self.bore * self.bore
        longest, shortest = self.rod + 0.5 * self.stroke, self.rod - 0.5 * self.stroke
        top = math.sqrt(longest * longest - self.pin_offset * self.pin_offset)
        bottom = math.sqrt(shortest * shortest - self.pin_offset * self.pin_offset)
        swept = area * (top - bottom)
        return swept / (self.compression_ratio - 1.0) + area * (top - self.pin_height(theta))

    def pressure(self, theta):
        """p = p_IVC (V_IVC / V)^n at crank angle theta [rad], 0 = firing TDC; absolute [Pa]."""
        cycles = theta / (4.0 * math.pi)
        wrapped = theta - 4.0 * math.pi * math.copysign(math.floor(abs(cycles) + 0.5), cycles)
        if abs(wrapped) >= self.closed:
            return self.intake
        return self.intake * (self.volume(self.closed) / self.volume(wrapped)) ** self.exponent


def heading(cycle, kind):
    """The first line of a table: what the cylinder is."""
    return (f"# {kind} cycle: bore {cycle.bore * 1e3:.6g} mm, stroke {cycle.stroke * 1e3:.6g} mm, rod {cycle.rod * 1e3:.6g} mm, "
            f"pin offset {cycle.pin_offset * 1e3:.6g} mm, ratio {cycle.compression_ratio:.6g}, n = {cycle.exponent:.6g}, "
            f"intake {cycle.intake * 1e-5:.6g} bar")


def table(cycle, step):
    """"crank_angle [deg], pressure [bar]" over -360 to 360 deg every `step` [rad], with a heading."""
    lines = [heading(cycle, "motored"),
             f"# p = p_IVC (V_IVC / V)^n, valves closed from {-cycle.closed / DEGREE:.6g} to {cycle.closed / DEGREE:.6g} deg; "
             "0 deg = firing TDC; absolute pressure"]
    return with_rows(lines, cycle.pressure, step)


def with_rows(lines, pressure, step):
    """The text of a table: heading, column names, pressure(theta) [Pa] over -360 to 360 deg every `step` [rad]."""
    lines = [*lines, "crank_angle [deg], pressure [bar]"]
    rows = math.floor(4.0 * math.pi / step + 0.5)
    for i in range(rows + 1):
        theta = -2.0 * math.pi + 4.0 * math.pi * i / rows
        lines.append(f"{theta / DEGREE:.10g}, {pressure(theta) * 1e-5:.12g}")
    return "\n".join(lines) + "\n"


# Option, default, smallest and largest value, help. The limits are those of a scene (docs/keys/run.md).
OPTIONS = (("bore-mm", 107.0, 0.1, 1e4, "bore [mm]"),
           ("stroke-mm", 130.0, 0.1, 1e4, "stroke [mm]"),
           ("rod-mm", 210.0, 1.0, 1e5, "rod length [mm]"),
           ("pin-offset-mm", 0.0, -1e4, 1e4, "pin offset [mm]"),
           ("compression-ratio", 17.0, 1.01, 100.0, "compression ratio"),
           ("exponent", 1.34, 1.0, 5.0 / 3.0, "polytropic exponent, from isothermal to adiabatic with one atom"),
           ("intake-bar", 1.0, 0.001, 1000.0, "absolute pressure at valve closing [bar]"),
           ("closed-deg", 180.0, 1.0, 360.0, "valves closed within +- this of firing TDC [deg]"),
           ("step-deg", 1.0, 0.001, 180.0, "rows every so many degrees of crank angle"))


def add_arguments(command, wanted=OPTIONS):
    """Declares the options of `clatter motored-cycle`."""
    command.add_argument("output", metavar="out.csv")
    for name, default, _, _, text in wanted:
        shown = text if default is None else f"{text}; default {default:g}"
        command.add_argument(f"--{name}", type=float, default=default, metavar="X", help=shown)


def check(options, wanted=OPTIONS):
    """BadArtefact for an option outside its limits (also nan) and for a rod that is too short."""
    for name, default, low, high, _ in wanted:
        value = getattr(options, name.replace("-", "_"))
        if value is None and default is None:
            continue
        if not low <= value <= high:
            raise BadArtefact(f"--{name}: found {value:g}, expected at least {low:.4g} and at most {high:.4g}")
    radius, offset = 0.5 * options.stroke_mm, abs(options.pin_offset_mm)
    if not options.rod_mm > radius + offset:
        raise BadArtefact(f"--rod-mm: found {options.rod_mm:g}, expected more than {radius + offset:g}: "
                          f"rod > radius + offset, {radius:g} + {offset:g} mm")


def cycle_of(options):
    """The MotoredCycle of the options."""
    return MotoredCycle(1e-3 * options.bore_mm, 1e-3 * options.stroke_mm, 1e-3 * options.rod_mm, 1e-3 * options.pin_offset_mm,
                        options.compression_ratio, options.exponent, 1e5 * options.intake_bar, DEGREE * options.closed_deg)


def write_text(path, text):
    """Writes a table complete or not at all; CannotWrite."""
    with whole_file(path) as part:
        part.write_text(text, encoding="ascii")


def write_motored_cycle(options):
    """Writes the table that the options describe; prints the peak pressure."""
    check(options)
    cycle = cycle_of(options)
    write_text(options.output, table(cycle, DEGREE * options.step_deg))
    print(f"{options.output}: peak {1e-5 * cycle.pressure(0.0):.2f} bar")
