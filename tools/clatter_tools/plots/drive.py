# SPDX-License-Identifier: GPL-3.0-or-later
"""A chain drive at an instant: links in the colour of their tension, sprockets, guides, arms."""
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.patches import Polygon

from clatter import chains
from . import style

STEEL, EDGE, GUIDE = "#d5d9de", "#6b7480", "#ead9bf"
# Dark to light without its palest end, which would not be seen on paper; readable with colour-blind eyes.
TENSION = LinearSegmentedColormap.from_list("tension", style.plt.get_cmap("viridis")(np.linspace(0.0, 0.93, 256)))
HEIGHT_IN = 8.0


def draw(files):
    """A chain drive at the instant of its largest tension in the last cycle, tensions as colours (one run file with a chain)."""
    run = style.open_one(files, "run")
    chain = chains.read_chain(run)
    return Picture(chain, *titled(run)).show(instant_of_largest_tension(chain))


def titled(run):
    """(title, speed to be named beside it [1/min], 0 where the title has it) of a run."""
    title = style.label(run)
    return title, 0.0 if "rpm" in title else chains.mean_rpm(run)


def instant_of_largest_tension(chain):
    window = chain.last_cycle()
    return int(window[np.argmax(chain.tension[window].max(axis=1))])


def tension_range(chain):
    """(lowest, highest) joint force of the last cycle [N], for colours; wider than nothing."""
    window = chain.tension[chain.last_cycle()]
    low, high = float(min(window.min(), 0.0)), float(window.max())
    return low, high if high > low else low + 1.0


def extent(chain):
    """(left, right, bottom, top) of everything over the last cycle [m], with a margin."""
    points = np.vstack([chain.pins(chain.last_cycle()[::10]).reshape(-1, 2), *[one.at(-1) for one in chain.over]])
    margin = 3.0 * chain.half_height
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    return low[0], high[0], low[1], high[1]


def plate(half, height):
    """The outline of a link's plates about its centre, with a waist: m x 2 [m]."""
    arc = np.linspace(-0.62 * np.pi, 0.62 * np.pi, 9)
    front = np.column_stack([half + height * np.cos(arc), height * np.sin(arc)])
    return np.vstack([front, -front])


def plates(chain, instant):
    """Outlines of all links at an instant: n x m x 2 [m]."""
    at = chain.links[instant]
    cosine, sine = np.cos(at[:, 2]), np.sin(at[:, 2])
    shape = plate(0.5 * chain.pitch.mean(), chain.half_height)
    x, y = shape[:, 0][None], shape[:, 1][None]
    return np.stack([at[:, :1] + cosine[:, None] * x - sine[:, None] * y,
                     at[:, 1:2] + sine[:, None] * x + cosine[:, None] * y], axis=-1)


def link_tension(chain, instant):
    """Mean of the forces in both joints of each link [N]."""
    return 0.5 * (chain.tension[instant] + np.roll(chain.tension[instant], 1))


def caption(chain, instant, rpm):
    """"3400 rpm, crank angle 123.4 deg" of an instant."""
    where = f"t = {1e3 * chain.time[instant]:.2f} ms"
    if not np.isnan(chain.angle[instant]):
        where = f"crank angle {chain.angle[instant]:.1f}°"
    return f"{rpm:.0f} rpm, {where}" if rpm > 0.0 else where


class Picture:
    """The drive as a figure; show() moves it to an instant, so that frames of a film are drawn quickly."""

    def __init__(self, chain, title, rpm):
        self.chain, self.rpm = chain, rpm
        left, right, bottom, top = extent(chain)
        self.figure, self.axis = style.plt.subplots(
            figsize=(HEIGHT_IN * (right - left) / (top - bottom) + 1.9, HEIGHT_IN + 0.9))
        self.axis.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
        self.axis.set_axis_off()
        self.axis.set_title(title, loc="left", pad=20)
        self.caption = self.axis.text(0.0, 1.008, "", transform=self.axis.transAxes, va="bottom", fontsize=9)
        self.parts = [self.add_part(one) for one in chain.over]
        self.norm = Normalize(*tension_range(chain))
        outer = dict(cmap=TENSION, norm=self.norm, edgecolors="#1a1a1a", linewidths=0.5)
        self.links = {False: PolyCollection([], zorder=4, **outer), True: PolyCollection([], zorder=3, **outer)}
        for collection in self.links.values():
            self.axis.add_collection(collection)
        self.pins = self.axis.plot([], [], linestyle="", marker="o", markersize=1.3, color="#1a1a1a", zorder=5)[0]
        bar = self.figure.colorbar(self.links[False], ax=self.axis, shrink=0.55, aspect=28, pad=0.03)
        bar.set_label("tension of a link [N]")
        bar.outline.set_visible(False)

    def add_part(self, one):
        """The patch of a sprocket or guide, with the points that it has in its own axes."""
        thickness = 2.4 * self.chain.half_height
        points = one.outline if one.teeth else one.band(thickness)
        patch = self.axis.add_patch(Polygon(one.at(0, points), facecolor=STEEL if one.teeth else GUIDE, edgecolor=EDGE,
                                            linewidth=0.8, zorder=2 if one.teeth else 1))
        if one.teeth:
            x, y, _ = one.place[0]
            radius = 0.22 * np.linalg.norm(one.outline, axis=1).max()
            hub = self.axis.add_patch(Polygon(circle(radius) + [x, y], facecolor="white", edgecolor=EDGE, linewidth=0.8, zorder=2))
            mark = self.axis.plot([], [], color=EDGE, linewidth=2.0, zorder=2)[0]
            self.axis.text(x, y - 1.5 * radius, one.name, ha="center", va="top", fontsize=9, zorder=6,
                           bbox=dict(boxstyle="round,pad=0.15", facecolor=STEEL, edgecolor="none"))
            return one, patch, points, hub, mark, radius
        self.axis.text(*beside(self.chain, one, thickness), one.name, ha="center", va="center", fontsize=9, zorder=6,
                       rotation=slope(one))
        return one, patch, points, None, None, 0.0

    def show(self, instant):
        for one, patch, points, hub, mark, radius in self.parts:
            patch.set_xy(one.at(instant, points))
            if hub is not None:
                hub.set_xy(circle(radius) + one.place[instant, :2])
                mark.set_data(*one.at(instant, np.array([[2.7 * radius, 0.0], [3.2 * radius, 0.0]])).T)
        shapes, tension = plates(self.chain, instant), link_tension(self.chain, instant)
        for inner, collection in self.links.items():
            chosen = self.chain.inner == inner
            collection.set_verts(list(shapes[chosen]))
            collection.set_array(tension[chosen])
        self.pins.set_data(*self.chain.pins(instant).T)
        force = self.chain.tension[instant]
        self.caption.set_text(f"{caption(self.chain, instant, self.rpm)}; joints {force.min():.0f} to {force.max():.0f} N")
        return self.figure


def beside(chain, one, thickness, instant=0):
    """A point behind the middle of a guide [m]."""
    middle = len(one.outline) // 2
    along = one.outline[middle + 1] - one.outline[middle - 1]
    inside = one.turn * np.array([-along[1], along[0]]) / np.linalg.norm(along)
    return one.at(instant, (one.outline[middle] + (thickness + 2.2 * chain.half_height) * inside)[None])[0]


def slope(one, instant=0):
    """Of a text beside a guide, so that it is not upside down [deg]."""
    line = one.at(instant)
    middle = len(line) // 2
    angle = np.degrees(np.arctan2(*(line[middle + 1] - line[middle - 1])[::-1]))
    return (angle + 90.0) % 180.0 - 90.0


def circle(radius):
    """A polygon about the origin."""
    turn = np.linspace(0.0, 2.0 * np.pi, 49)
    return radius * np.column_stack([np.cos(turn), np.sin(turn)])
