# SPDX-License-Identifier: GPL-3.0-or-later
"""The motion of a chain drive: a page of HTML that plays one engine cycle, and numbered frames for a video."""
import base64
import json
import pathlib
from xml.sax.saxutils import escape

import numpy as np

from ..whole_file import whole_file
from . import drive, style

UNIT = 1e-5    # of the page's coordinates [m]
RANGE = 32000  # of the 16-bit numbers in which poses and tensions are kept
COLOURS = 64   # of the scale of tensions


def write_frames(chain, title, rpm, folder, count):
    """PNG files frame_0001.png, ... of so many instants of the last cycle, or of all that are recorded; returns their number."""
    folder = pathlib.Path(folder)
    window = chain.last_cycle()
    chosen = window[np.unique(np.linspace(0, len(window) - 1, min(count, len(window))).round().astype(int))]
    picture = drive.Picture(chain, title, rpm)
    # Programs that make videos need even numbers of pixels.
    dots = 100.0
    pixels = 2.0 * np.ceil(0.5 * dots * picture.figure.get_size_inches())
    picture.figure.set_size_inches(*(pixels + 0.5) / dots)  # of which the integer part counts
    for number, instant in enumerate(chosen, 1):
        with whole_file(folder / f"frame_{number:04d}.png") as part:
            part.parent.mkdir(parents=True, exist_ok=True)
            picture.show(instant).savefig(part, format="png", dpi=dots)
    style.plt.close(picture.figure)
    return len(chosen)


def packed(values):
    """16-bit integers as text."""
    return base64.b64encode(np.ascontiguousarray(np.rint(values), "<i2").tobytes()).decode()


def path(points):
    """Closed path of an outline in the units of the page; y points down there."""
    return "M" + "L".join(f"{x:.0f} {y:.0f}" for x, y in points / UNIT * [1.0, -1.0]) + "Z"


def colours():
    return ["#%02x%02x%02x" % tuple(int(round(255 * part)) for part in drive.TENSION(k / (COLOURS - 1))[:3])
            for k in range(COLOURS)]


def poses(values, step):
    """Places (x, y, angle) as the page has them: x and y in `step` units of the page, y down, [1e-4 rad], turning right."""
    angle = np.remainder(values[..., 2] + np.pi, 2.0 * np.pi) - np.pi
    return np.stack([values[..., 0] / (step * UNIT), -values[..., 1] / (step * UNIT), -angle / 1e-4], axis=-1)


def page(chain, title, rpm):
    """The page as text: complete in itself, drawn by the browser."""
    window = chain.last_cycle()
    left, right, bottom, top = (value / UNIT for value in drive.extent(chain))
    low, high = drive.tension_range(chain)
    tension = np.stack([drive.link_tension(chain, k) for k in window])
    place = np.stack([one.place[window] for one in chain.over], axis=1)
    step = max(np.abs(part[..., :2]).max() for part in (chain.links[window], place)) / (RANGE * UNIT)
    per_newton = RANGE / max(1.0, np.abs(tension).max())
    data = {"frames": len(window), "links": chain.links.shape[1], "parts": len(chain.over),
            "pose": packed(poses(chain.links[window], step)), "tension": packed(tension * per_newton),
            "place": packed(poses(place, step)), "step": step, "newton": 1.0 / per_newton,
            "caption": [drive.caption(chain, k, rpm) for k in window], "low": low, "high": high, "colours": colours()}
    return PAGE.format(title=escape(title), view=f"{left:.0f} {-top:.0f} {right - left:.0f} {top - bottom:.0f}",
                       font=0.021 * (top - bottom), line=6e-4 * (top - bottom), mark=2e-3 * (top - bottom),
                       parts=parts(chain), links=links(chain), names=names(chain, window[0]), scale=scale(low, high),
                       data=json.dumps(data, separators=(",", ":")))


def parts(chain):
    """Sprockets and guides in their own axes, which the page moves."""
    found = []
    for one in chain.over:
        if one.teeth:
            radius = 0.22 * np.linalg.norm(one.outline, axis=1).max()
            found.append(f'<g class="part"><path class="steel" d="{path(one.outline)}"/>'
                         f'<path class="hub" d="{path(drive.circle(radius))}"/>'
                         f'<path class="mark" d="M{2.7 * radius / UNIT:.0f} 0H{3.2 * radius / UNIT:.0f}"/></g>')
        else:
            found.append(f'<g class="part"><path class="guide" d="{path(one.band(2.4 * chain.half_height))}"/></g>')
    return "\n".join(found)


def links(chain):
    """Outlines of the links, inner ones below; data-link is their number."""
    shape = path(drive.plate(0.5 * chain.pitch.mean(), chain.half_height))
    half, pin = 0.5 * chain.pitch.mean() / UNIT, 0.35 * chain.bush_radius / UNIT
    found = []
    for inner in (True, False):
        for link in np.flatnonzero(chain.inner == inner):
            dots = "" if inner else f'<circle cx="{-half:.0f}" r="{pin:.0f}"/><circle cx="{half:.0f}" r="{pin:.0f}"/>'
            found.append(f'<g class="link" data-link="{link}"><path d="{shape}"/>{dots}</g>')
    return "\n".join(found)


def names(chain, instant):
    """Names of sprockets below their hubs, of guides behind them."""
    found = []
    for one in chain.over:
        x, y = one.place[instant, :2] if one.teeth else drive.beside(chain, one, 2.4 * chain.half_height, instant)
        if one.teeth:
            y -= 0.42 * np.linalg.norm(one.outline, axis=1).max()
        turn = 0.0 if one.teeth else -drive.slope(one, instant)
        found.append(f'<text transform="translate({x / UNIT:.0f} {-y / UNIT:.0f}) rotate({turn:.1f})">{escape(one.name)}</text>')
    return "\n".join(found)


def scale(low, high):
    """The colour scale with round figures beside it."""
    ticks = [value for value in style.nice_ticks(low, high) if low <= value <= high]
    stops = "".join(f'<stop offset="{k / (COLOURS - 1):.3f}" stop-color="{colour}"/>' for k, colour in enumerate(colours()))
    at = lambda value: 340.0 - 320.0 * (value - low) / (high - low)  # noqa: E731
    marks = "".join(f'<path d="M30 {at(value):.1f}h6" stroke="#444"/><text x="41" y="{at(value) + 4:.1f}">{value:g}</text>'
                    for value in ticks)
    return (f'<linearGradient id="tension" x1="0" y1="1" x2="0" y2="0">{stops}</linearGradient>'
            f'<rect x="8" y="20" width="22" height="320" fill="url(#tension)"/>{marks}'
            f'<text transform="translate(92 180) rotate(-90)" text-anchor="middle">tension of a link [N]</text>')


def write_page(chain, title, rpm, output):
    with whole_file(output) as part:
        part.write_text(page(chain, title, rpm), encoding="utf-8")


PAGE = (pathlib.Path(__file__).parent / "drive_film.html").read_text(encoding="utf-8")
