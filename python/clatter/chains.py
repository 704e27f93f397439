# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of a chain drive in a run file: links, tensions, sprockets and guides at instants; crank angle; place along the loop."""
import dataclasses

import numpy as np

from .artefact import BadArtefact, dataset, text
from .histories import has, history

CYCLE_DEG = 720.0
FIRST_STEP_DEG = 1.0  # a recorded cycle begins after the first step, which is not longer


@dataclasses.dataclass
class Over:
    """A sprocket (teeth > 0) or a guide."""
    name: str
    teeth: int
    turn: float          # 1: the chain keeps it on its left, -1: on its right
    outline: np.ndarray  # m x 2, in its own axes [m]
    place: np.ndarray    # instants x 3: x, y [m], angle [rad] of its axes

    def at(self, instant, points=None):
        """Its outline, or other points of it, at an instant [m]."""
        x, y, angle = self.place[instant]
        turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        return (self.outline if points is None else points) @ turn + [x, y]

    def band(self, thickness):
        """The outline of a guide as a solid: its profile and the line behind it, in its own axes [m]."""
        along = np.gradient(self.outline, axis=0)
        along /= np.linalg.norm(along, axis=1)[:, None]
        inside = self.turn * np.column_stack([-along[:, 1], along[:, 0]])
        ends = np.sin(np.linspace(0.0, np.pi, len(along))) ** 0.25  # rounded
        return np.vstack([self.outline, (self.outline + thickness * ends[:, None] * inside)[::-1]])


@dataclasses.dataclass
class Chain:
    """One chain at instants."""
    name: str
    time: np.ndarray     # [s]
    angle: np.ndarray    # of the crank [deg], rising; nan where the run has none
    links: np.ndarray    # instants x n x 3: x, y of the centre [m], angle [rad]
    tension: np.ndarray  # instants x n: joint j, front pin of link j [N]
    inner: np.ndarray    # n, bool
    pitch: np.ndarray    # n [m]
    bush_radius: float   # [m]
    half_height: float   # of the plates [m]
    over: list           # in running order

    def pins(self, instants=slice(None)):
        """Front pins of the links, joint by joint: instants x n x 2 [m]."""
        at = self.links[instants]
        return at[..., :2] + 0.5 * self.pitch[:, None] * np.stack([np.cos(at[..., 2]), np.sin(at[..., 2])], axis=-1)

    def last_cycle(self):
        """Indices of the instants of the last complete cycle; of all, where the run is shorter or has no crank."""
        if np.isnan(self.angle).any():
            return np.arange(len(self.time))
        return np.flatnonzero(self.angle > self.angle[-1] - CYCLE_DEG)

    def seen_from_behind(self):
        """The same with x reversed."""
        links = self.links * [-1.0, 1.0, -1.0] + [0.0, 0.0, np.pi]
        over = [dataclasses.replace(one, turn=-one.turn, outline=one.outline * [-1.0, 1.0], place=one.place * [-1.0, 1.0, -1.0])
                for one in self.over]
        return dataclasses.replace(self, links=links, over=over)


def names(run):
    """Chains of a run with shapes."""
    return sorted(name for name in run.get("chain", {}) if "tension" in run[f"chain/{name}"])


def read_chain(run, name=None):
    """A chain of the run, by default its only one or the first by name; seen from where its first sprocket turns clockwise,
    as front views of engines are drawn."""
    present = names(run)
    if not present:
        raise BadArtefact(f"{run.filename}: chain: found no shapes of a chain, expected a scene with [[chain]] whose "
                          "shape_every_us is not 0")
    if name is None:
        name = present[0]
    if name not in present:
        raise BadArtefact(f"{run.filename}: chain: found {', '.join(present)}, expected {name}")
    group = f"chain/{name}"
    time = dataset(run, f"{group}/time")
    over = [read_over(run, f"{group}/over/{one}", one)
            for one in sorted(run[f"{group}/over"], key=lambda one: run[f"{group}/over/{one}"].attrs["order"])]
    links = np.stack([dataset(run, f"{group}/{part}").astype(float) for part in ("x", "y", "angle")], axis=-1)
    chain = Chain(name, time, crank_at(run, time), links, dataset(run, f"{group}/tension").astype(float),
                 dataset(run, f"{group}/inner") != 0, dataset(run, f"{group}/pitch"),
                 float(run[group].attrs["bush_radius"]), float(run[group].attrs["plate_half_height"]), over)
    return chain.seen_from_behind() if over[0].turn > 0.0 else chain


def read_over(run, group, name):
    attributes = run[group].attrs
    return Over(name, int(attributes["teeth"]), 1.0 if text(attributes["turn"]) == "counter-clockwise" else -1.0,
                dataset(run, f"{group}/outline"), dataset(run, f"{group}/place").astype(float))


def crank_history(run):
    """The history that gives the crank's speed: of the first sprocket of the first chain; None without a chain."""
    for name in sorted(run.get("chain", {})):
        over = run[f"chain/{name}/over"]
        first = min(over, key=lambda one: over[one].attrs["order"])
        return f"{name}_{first}_speed"
    return None


def crank_angle(run):
    """Crank angle of the histories [deg], rising: that of an engine scene from firing TDC, else of the first sprocket from
    the start, by its speed."""
    if has(run, "crank_angle_deg"):
        return history(run, "crank_angle_deg", "deg")
    name = crank_history(run)
    if name is None or not has(run, name):
        raise BadArtefact(f"{run.filename}: history/crank_angle_deg: missing, and no chain whose first sprocket is the crank")
    time, speed = dataset(run, "history/time"), history(run, name, "rad/s")
    before = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time))])
    return np.degrees(before + speed[0] * (time[0] - start_time(run)))


def start_time(run):
    """Of the run [s]: that of its first sample."""
    return float(run["output/time"][0]) if "output/time" in run and len(run["output/time"]) else 0.0


def crank_at(run, time):
    """Crank angle at other times of the run [deg]; nan where it has none."""
    try:
        return np.interp(time, dataset(run, "history/time"), crank_angle(run))
    except BadArtefact:
        return np.full(len(time), np.nan)


def mean_rpm(run):
    """Mean speed of the crank over the last cycle, or over a shorter run [1/min]."""
    time, angle = dataset(run, "history/time"), crank_angle(run)
    first = int(np.searchsorted(angle, angle[-1] - CYCLE_DEG))
    return (angle[-1] - angle[first]) / (time[-1] - time[first]) / 6.0 if first + 1 < len(time) else 0.0


def complete_cycles(angle):
    """Whole cycles of 720 deg in recorded crank angles."""
    return int((angle[-1] - angle[0] + FIRST_STEP_DEG) / CYCLE_DEG)


class Loop:
    """Places along the loop of a chain: along the line of its pins at one instant, from where it leaves the first sprocket."""

    def __init__(self, chain, instant):
        pins = chain.pins(instant)
        exit_ = int(np.argmax(leaving(near(chain, chain.over[0], instant, pins))))
        self.line = np.roll(pins, -exit_, axis=0)
        steps = np.roll(self.line, -1, axis=0) - self.line
        self.lengths = np.linalg.norm(steps, axis=1)
        self.begins = np.concatenate([[0.0], np.cumsum(self.lengths)[:-1]])
        self.along = steps / self.lengths[:, None]
        self.length = float(self.lengths.sum())
        self.zones = []  # (name, begin, end [m]) of what the chain runs over, in that order
        for one in chain.over:
            on = np.flatnonzero(np.roll(near(chain, one, instant, pins), -exit_)[1:]) + 1
            if len(on):
                self.zones.append((one.name, self.begins[on[0]], self.begins[on[-1]]))
        self.zones.sort(key=lambda zone: zone[1])

    def where(self, place):
        """"on crank", "between intake and exhaust"; of a place along the loop [m]."""
        for name, begin, end in self.zones:
            if begin <= place <= end:
                return f"on {name}"
        before = [name for name, _, end in self.zones if end < place] or [self.zones[-1][0]]
        after = [name for name, begin, _ in self.zones if begin > place] or [self.zones[0][0]]
        return f"between {before[-1]} and {after[0]}"

    def place(self, points):
        """Place along the loop of points beside it [m]."""
        found = np.empty(len(points))
        for k, point in enumerate(points):
            from_ = point - self.line
            on = np.clip(np.einsum("ij,ij->i", from_, self.along), 0.0, self.lengths)
            gap = np.linalg.norm(from_ - on[:, None] * self.along, axis=1)
            best = int(np.argmin(gap))
            found[k] = (self.begins[best] + on[best]) % self.length
        return found


def leaving(touching):
    """Where a row of True in a closed loop ends: the last one of it."""
    return touching & ~np.roll(touching, -1)


def near(chain, over, instant, pins):
    """Which joints run on a sprocket, or pass a guide, at an instant."""
    pitch = chain.pitch.mean()
    if over.teeth:
        radius = 0.5 * pitch / np.sin(np.pi / over.teeth)
        return np.abs(np.linalg.norm(pins - over.place[instant, :2], axis=1) - radius) < 0.1 * pitch
    line = over.at(instant)
    gap = np.linalg.norm(pins[:, None] - line, axis=2)
    closest = gap.argmin(axis=1)
    return (gap.min(axis=1) < chain.half_height + pitch) & (closest > 0) & (closest < len(line) - 1)
