# SPDX-License-Identifier: GPL-3.0-or-later
"""Overall levels over the crank speed, plain and A-weighted: powers above, accelerations below."""
import numpy as np

from . import style


def picture(curves):
    """`curves`: of levels.py, powers and accelerations in any order."""
    groups = [group for group in ([one for one in curves if one.is_power], [one for one in curves if not one.is_power]) if group]
    figure, axes = style.figure(len(groups), height=3.4, sharex=True)
    colour = 0
    for axis, group in zip(axes[:, 0], groups):
        for curve in group:
            speeds, plain, weighted, error = curve.sorted()
            look = {"color": style.COLOURS[colour % len(style.COLOURS)], "marker": "o", "markersize": 3}
            axis.errorbar(speeds, weighted, error if np.isfinite(error).any() else None, capsize=3, label=f"{curve.label()}, dB(A)", **look)
            axis.plot(speeds, plain, linestyle="--", linewidth=1.0, label=f"{curve.label()}, dB", **look)
            colour += 1
        axis.set_ylabel(f"level [dB, dB(A) re {group[0].reference}]")
        style.legend(axis)
    axes[-1, 0].set_xlabel("crank speed [rpm]")
    return figure
