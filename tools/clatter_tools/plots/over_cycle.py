# SPDX-License-Identifier: GPL-3.0-or-later
"""Histories of a run over the crank angle of its last cycle."""
import numpy as np

from clatter import chains
from clatter.artefact import BadArtefact, dataset
from clatter.histories import angle_zero, centred, has, time_weights
from . import style


class LastCycle:
    """What of a run's histories is shown, and over what: from firing TDC where the run has a crank, else from the beginning of
    the last 720 deg of the first sprocket, or of a shorter run; over time without a crank."""

    def __init__(self, run):
        self.run = run
        self.label = f"crank angle [deg], 0 = {angle_zero(run)}" if has(run, "crank_angle_deg") else "crank angle in the last cycle [deg]"
        try:
            angle = chains.crank_angle(run)
        except BadArtefact:
            self.x, self.label = 1e3 * dataset(run, "history/time"), "time [ms]"
            self.window, self.order = slice(None), slice(None)
            return
        self.window = slice(int(np.searchsorted(angle, angle[-1] - chains.CYCLE_DEG - 1e-6)), None)
        if has(run, "crank_angle_deg"):
            self.x, self.order = centred(angle[self.window])
        else:
            whole = chains.complete_cycles(angle) > 0
            self.x = angle[self.window] - (angle[-1] - chains.CYCLE_DEG if whole else 0.0)
            self.order = slice(None)

    def history(self, name, unit):
        """A history in that order; BadArtefact if it has another unit."""
        return chains.history(self.run, name, unit)[self.window][self.order]

    def fluctuation(self, name, unit):
        """The same less its mean over time."""
        values, time = chains.history(self.run, name, unit)[self.window], dataset(self.run, "history/time")[self.window]
        return (values - time_weights(time) @ values)[self.order]

    def finish(self, axis):
        """Limits, ticks and label of the axis below."""
        style.crank_axis(axis, self.x, angle_zero(self.run))
        axis.set_xlabel(self.label)


def named(run, begin, *ends):
    """Histories whose names begin and end so, sorted."""
    return sorted(name for name in run.get("history", {}) if name.startswith(begin) and name.endswith(ends))
