# SPDX-License-Identifier: GPL-3.0-or-later
"""What a report says of chain drives, in sentences."""
import numpy as np

from clatter import chains
from clatter.artefact import BadArtefact, dataset
from clatter.histories import has, history, time_weights
from . import orders

CRITICAL_ORDER = 1.5  # the lowest one of a three-cylinder engine, which excites the first mode of its timing drive


def last_cycle(run):
    """Slice of the histories of the last cycle, or of all."""
    angle = chains.crank_angle(run)
    return slice(int(np.searchsorted(angle, angle[-1] - chains.CYCLE_DEG - 1e-6)), None)


def sentences(run):
    """Of all chains of a run."""
    found = []
    for name in chains.names(run):
        chain, window = chains.read_chain(run, name), last_cycle(run)
        found.append(tension_text(run, chain, window))
        found.append(contact_text(run, chain, window))
        found.append(jump_text(run, name))
        found += [speed_text(run, name, one, window) for one in chain.over[1:] if one.teeth]
    return found


def tension_text(run, chain, window):
    low, high = (history(run, f"{chain.name}_tension_{end}", "N")[window] for end in ("min", "max"))
    instant = int(np.argmin(np.abs(chain.time - dataset(run, "history/time")[window][np.argmax(high)])))
    joint = int(np.argmax(chain.tension[instant]))
    place = chains.Loop(chain, instant)
    where = place.where(place.place(chain.pins(instant)[joint:joint + 1])[0])
    at = crank_text(run, window, np.argmax(high))
    return f"{chain.name}: the joints carry {low.min():.0f} to {high.max():.0f} N; the largest force is {where}{at}"


def crank_text(run, window, index):
    """", at 123 deg of the crank" of a history's row in a window."""
    return f", at {chains.crank_angle(run)[window][index]:.0f} deg of the crank"


def contact_text(run, chain, window):
    """Largest resultant force on each sprocket and guide."""
    peaks = []
    for one in chain.over:
        force = [history(run, f"{chain.name}_{one.name}_force_{axis}", "N")[window] for axis in "xy"]
        peaks.append(f"{np.hypot(*force).max():.0f} N on {one.name}")
    return f"{chain.name}: its largest contact forces are {', '.join(peaks)}"


def jump_text(run, name):
    jumps = dataset(run, f"history/{name}_jumps")
    if not jumps[-1]:
        return f"{name}: no link jumped a tooth"
    first = dataset(run, "history/time")[np.argmax(jumps > 0)]
    return f"{name}: JUMPED on the teeth, counted {jumps[-1]:.0f} times, first at {1e3 * first:.2f} ms"


def speed_text(run, name, one, window):
    speed = history(run, f"{name}_{one.name}_speed", "rad/s")[window]
    mean = time_weights(dataset(run, "history/time")[window]) @ speed
    text = f"{one.name}: its speed varies by {speed.min() - mean:+.2f} to {speed.max() - mean:+.2f} rad/s"
    try:
        _, order, rms, _ = orders.of_run(run, f"{name}_{one.name}_speed")
    except BadArtefact:
        return f"{text}; the run is shorter than a cycle, so orders are not known"
    top = int(np.argmax(rms[1:])) + 1
    return f"{text}; its largest order is {order[top]:g}, amplitude {np.sqrt(2.0) * rms[top]:.2f} rad/s"


def critical_speed(runs):
    """Sentences on where an order of a sprocket's speed is largest, of runs [(file, chain)] of one drive at several speeds."""
    found = []
    first, name = runs[0]
    over = first[f"chain/{name}/over"]
    for one in sorted(over, key=lambda one: over[one].attrs["order"])[1:]:
        history_ = f"{name}_{one}_speed"
        if not all(has(run, history_) for run, _ in runs):
            continue
        spectra = [orders.of_run(run, history_) for run, _ in runs if chains.complete_cycles(chains.crank_angle(run))]
        speeds = [spectrum[0] for spectrum in spectra]
        if len(speeds) < 2 or np.ptp(speeds) < 1.0:
            continue
        values = [np.sqrt(2.0) * orders.of_order(spectrum[1], spectrum[2], CRITICAL_ORDER) for spectrum in spectra]
        speed, amplitude = orders.peak_of(speeds, values)
        inside = min(speeds) < speed < max(speeds)
        found.append(f"{one}: order {CRITICAL_ORDER:g} is largest at {'about ' if inside else 'the end of the range, '}{speed:.0f} rpm, "
                     f"{amplitude:.2f} rad/s ({len(speeds)} speeds, {min(speeds):.0f} to {max(speeds):.0f} rpm)")
    return found
