# SPDX-License-Identifier: GPL-3.0-or-later
"""The pressure table of a fired engine, as CSV for [gas] of a scene.

One zone with a constant exponent n (Heywood 1988, section 9.2.2): dp = (-n p dV + (n - 1) dQ) / V while the valves are
closed, so that p V^n = (p V^n at closing) + (n - 1) integral of V^(n - 1) dQ: exact but for the integral. The heat is
released in two parts by the function of Wiebe (1970), premixed and by diffusion (Miyamoto et al. 1985): the premixed part decides how
loud a diesel burns.
"""
import bisect
import dataclasses
import math

import numpy as np

from clatter.artefact import BadArtefact
from . import motored_cycle
from .motored_cycle import DEGREE

COMPLETE = 6.908  # a of Wiebe's function: 99.9 % are burnt at the end of the duration
PANELS = 64       # of the quadrature over the shortest duration, with two Gauss points each


@dataclasses.dataclass
class Burn:
    """Heat released from `start` over `duration`: x = 1 - exp(-a ((theta - start) / duration)^(form + 1))."""
    start: float     # [rad]
    duration: float  # [rad]
    form: float

    def rate(self, theta):
        """dx/dtheta [1/rad] at an array of angles."""
        x = np.maximum((theta - self.start) / self.duration, 0.0)
        power = x ** (self.form + 1.0)
        return COMPLETE * (self.form + 1.0) * np.where(x > 0.0, power / np.where(x > 0.0, x, 1.0), 0.0) * np.exp(-COMPLETE * power) / self.duration


class FiredCycle:
    """Pressure of one cylinder, `heat` [J] released by `burns`, a list of (share, Burn); from `opened` [rad] on the pressure
    falls to that of the intake over `blowdown` [rad]."""

    def __init__(self, motored, burns, heat, opened, blowdown):
        self.motored, self.heat, self.opened, self.blowdown = motored, heat, opened, blowdown
        first = min(burn.start for _, burn in burns)
        panels = math.ceil(PANELS * (opened - first) / min(burn.duration for _, burn in burns))
        self.edges = np.linspace(first, opened, panels + 1)
        half = 0.5 * (self.edges[1] - self.edges[0])
        points = (self.edges[:-1] + half)[:, None] + half / math.sqrt(3.0) * np.array([-1.0, 1.0])
        rate = sum(share * burn.rate(points) for share, burn in burns)
        volume = np.vectorize(motored.volume)(points)
        self.released = np.concatenate(([0.0], np.cumsum(half * (rate * volume ** (motored.exponent - 1.0)).sum(axis=1))))
        self.burns = burns

    def raised(self, theta):
        """Integral of V^(n - 1) dx from the start of combustion to theta, before the exhaust valve opens."""
        if theta <= self.edges[0]:
            return 0.0
        i = min(bisect.bisect_right(self.edges, theta) - 1, len(self.edges) - 2)
        middle, half = 0.5 * (self.edges[i] + theta), 0.5 * (theta - self.edges[i])
        points = middle + half / math.sqrt(3.0) * np.array([-1.0, 1.0])
        rate = sum(share * burn.rate(points) for share, burn in self.burns)
        volume = np.array([self.motored.volume(point) for point in points])
        return self.released[i] + half * float((rate * volume ** (self.motored.exponent - 1.0)).sum())

    def pressure(self, theta):
        """Absolute pressure [Pa] at crank angle theta [rad], 0 = firing TDC."""
        wrapped = (theta + 2.0 * math.pi) % (4.0 * math.pi) - 2.0 * math.pi
        m = self.motored
        if wrapped < -m.closed or wrapped >= self.opened + self.blowdown:
            return m.intake
        shut = min(wrapped, self.opened)
        n = m.exponent
        p = (m.intake * m.volume(m.closed) ** n + (n - 1.0) * self.heat * self.raised(shut)) / m.volume(shut) ** n
        if wrapped <= self.opened:
            return p
        x = (wrapped - self.opened) / self.blowdown
        return m.intake + (p - m.intake) * (1.0 - x) ** 2 * (1.0 + 2.0 * x)

    def mean_effective_pressure(self, step=0.25 * DEGREE):
        """Indicated work of all four strokes over the swept volume [Pa], by Simpson's rule."""
        m = self.motored
        rows = 2 * round(2.0 * math.pi / step)
        angles = np.linspace(-2.0 * math.pi, 2.0 * math.pi, rows + 1)
        p = np.array([self.pressure(angle) for angle in angles])
        v = np.array([m.volume(angle) for angle in angles])
        work = (p[:-1] + p[1:]) / 2 @ np.diff(v)
        return work / (v.max() - v.min())


# Option, default (None: not given), smallest and largest value, help.
OPTIONS = (*(one for one in motored_cycle.OPTIONS if one[0] != "closed-deg"),
           ("closed-deg", 180.0, 1.0, 360.0, "valves closed from this before firing TDC [deg]"),
           ("imep-bar", None, 0.0, 100.0, "indicated mean effective pressure [bar]; or"),
           ("heat-j", None, 0.0, 1e7, "heat released in a cycle, less that to the walls [J]"),
           ("start-deg", -4.0, -90.0, 90.0, "start of combustion after firing TDC [deg]"),
           ("duration-deg", 60.0, 1.0, 170.0, "duration of the diffusion burn [deg]"),
           ("form", 0.8, 0.0, 10.0, "exponent m of its Wiebe function"),
           ("premixed", 0.1, 0.0, 1.0, "share of the heat that burns premixed"),
           ("premixed-deg", 8.0, 1.0, 170.0, "its duration [deg]"),
           ("premixed-form", 2.0, 0.0, 10.0, "its exponent m"),
           ("open-deg", 130.0, 1.0, 359.0, "exhaust valve opens after firing TDC [deg]"),
           ("blowdown-deg", 50.0, 1.0, 359.0, "then the pressure falls to that of the intake over this [deg]"))


def add_arguments(command):
    """Declares the options of `clatter fired-cycle`."""
    motored_cycle.add_arguments(command, OPTIONS)


def cycle_of(options):
    """The FiredCycle of the options; BadArtefact where they contradict each other."""
    motored_cycle.check(options, OPTIONS)
    if options.imep_bar is None and options.heat_j is None:
        raise BadArtefact("give --imep-bar or --heat-j")
    if options.imep_bar is not None and options.heat_j is not None:
        raise BadArtefact("--imep-bar and --heat-j exclude each other: each gives the heat")
    if options.open_deg + options.blowdown_deg > 360.0:
        raise BadArtefact(f"--blowdown-deg: found {options.blowdown_deg:g} after {options.open_deg:g}, expected an end at 360 deg at most")
    if options.start_deg >= options.open_deg or options.start_deg <= -options.closed_deg:
        raise BadArtefact(f"--start-deg: found {options.start_deg:g}, expected it between {-options.closed_deg:g}, where the valves close, "
                          f"and {options.open_deg:g}, where they open")
    start = DEGREE * options.start_deg
    burns = [(options.premixed, Burn(start, DEGREE * options.premixed_deg, options.premixed_form)),
             (1.0 - options.premixed, Burn(start, DEGREE * options.duration_deg, options.form))]
    motored = motored_cycle.cycle_of(options)

    def cycle(heat):
        return FiredCycle(motored, burns, heat, DEGREE * options.open_deg, DEGREE * options.blowdown_deg)

    if options.heat_j is not None:
        return cycle(options.heat_j)
    without, slope = cycle(0.0).mean_effective_pressure(), 1e3  # the pressure is linear in the heat
    per_joule = (cycle(slope).mean_effective_pressure() - without) / slope
    heat = (1e5 * options.imep_bar - without) / per_joule
    if heat < 0.0:
        raise BadArtefact(f"--imep-bar: found {options.imep_bar:g}, expected at least {without * 1e-5:.4g}, that without combustion")
    return cycle(heat)


def table(cycle, options):
    """The text of the CSV file."""
    lines = [motored_cycle.heading(cycle.motored, "fired"),
             f"# {cycle.heat:.6g} J by Wiebe's function from {options.start_deg:g} deg: {100 * options.premixed:g} % over {options.premixed_deg:g} deg "
             f"(m = {options.premixed_form:g}), the rest over {options.duration_deg:g} deg (m = {options.form:g})",
             f"# valves closed from {-options.closed_deg:g} to {options.open_deg:g} deg; 0 deg = firing TDC; absolute pressure"]
    return motored_cycle.with_rows(lines, cycle.pressure, DEGREE * options.step_deg)


def write_fired_cycle(options):
    """Writes the table that the options describe; prints peak, mean effective pressure and heat."""
    cycle = cycle_of(options)
    motored_cycle.write_text(options.output, table(cycle, options))
    angles = np.linspace(-math.pi, math.pi, 3601)
    p = np.array([cycle.pressure(angle) for angle in angles])
    print(f"{options.output}: peak {1e-5 * p.max():.2f} bar at {angles[p.argmax()] / DEGREE:.1f} deg, "
          f"steepest rise {1e-5 * (np.diff(p).max() / (angles[1] - angles[0])) * DEGREE:.2f} bar/deg, "
          f"mean effective pressure {1e-5 * cycle.mean_effective_pressure():.2f} bar, heat {cycle.heat:.0f} J")
