# SPDX-License-Identifier: GPL-3.0-or-later
"""Third-octave spectra as stairs with nominal frequencies below."""
import numpy as np

from clatter.artefact import dataset, text

FLOOR_DB = 70.0  # range of levels in a picture


def draw_stairs(axis, field, at, levels, **look):
    """Stairs over the bands of a piece; levels of zero quantities lie below the picture."""
    edges = np.append(dataset(field, f"{at}/third_octave/lower_hz"), dataset(field, f"{at}/third_octave/upper_hz")[-1])
    axis.stairs(levels, np.log10(edges), baseline=None, linewidth=1.5, **look)


def finish(axis, field, at, all_levels, from_hz=0.0, range_db=FLOOR_DB):
    """Ticks at every third band by nominal name from that of `from_hz` on, limits from the levels that are drawn there."""
    shown = dataset(field, f"{at}/third_octave/mid_hz") >= from_hz
    mid = np.log10(dataset(field, f"{at}/third_octave/mid_hz"))[shown]
    names = [text(name) for name in dataset(field, f"{at}/third_octave/nominal")[shown]]
    start = next((i for i, name in enumerate(names) if float(name) in (31.5, 63, 125, 250, 500, 1000)), 0)
    axis.set_xticks(mid[start::3], [short(name) for name in names[start::3]])
    axis.set_xlim(mid[0] - 0.05, mid[-1] + 0.05)
    audible = np.concatenate([np.asarray(levels)[shown] for levels in all_levels])
    top = audible.max() + 5
    axis.set_ylim(max(audible[audible > -900].min() - 10, top - range_db), top)
    axis.set_xlabel("third-octave band [Hz]")


def short(name):
    """"16000" as "16k"."""
    return f"{float(name) / 1000:g}k" if float(name) >= 1000 else name
