# SPDX-License-Identifier: GPL-3.0-or-later
"""The slap in a sensor's acceleration: its time, height, ringing time and high-frequency content.

Below FROM_HZ a sensor measures the motion of the block on its mounts, which is unrelated to an impact: all figures are of the
acceleration between FROM_HZ and the highest line of the cycle's spectrum.
"""
import numpy as np

from clatter import fields
from clatter.artefact import dataset

FROM_HZ = 300.0
AROUND_S = (-2e-3, 5e-3)  # search window about firing TDC
SMOOTH_S = 0.5e-3         # of the running rms
QUIET = 0.25              # ringing ends when the running rms is below this fraction of its peak
HIGH_HZ = 2000.0


def band_limited(field, sensor, at, from_hz=FROM_HZ, to_hz=None):
    """(time from firing TDC [s], acceleration [m/s2]) of the thrust-side channel; `at` is a complete, periodic cycle."""
    time, values = fields.acceleration(field, sensor, at)
    to_hz = to_hz or dataset(field, f"{at}/frequency_hz")[-1]
    lines = np.fft.rfft(values)
    frequency = np.fft.rfftfreq(len(values), time[1] - time[0])
    lines[(frequency < from_hz) | (frequency > to_hz)] = 0.0
    return time, np.fft.irfft(lines, len(values))


def around_firing(time, values):
    window = (time >= AROUND_S[0]) & (time <= AROUND_S[1])
    return time[window], values[window]


def peak(time, values):
    """(instant [s], height) of the largest |acceleration| around firing TDC."""
    time, values = around_firing(time, np.abs(values))
    top = int(np.argmax(values))
    return time[top], values[top]


def onset(time, values, part):
    """The first instant [s] around firing TDC at which |acceleration| reaches a part, from 0 to 1, of its largest value there; between samples on the
    line through them. Of several peaks of about the same height the largest may be another one after a small change: the first of them is not."""
    time, values = around_firing(time, np.abs(values))
    level = part * np.max(values)
    first = int(np.argmax(values >= level))
    if first == 0 or values[first] == values[first - 1]:
        return time[first]
    return time[first - 1] + (time[first] - time[first - 1]) * (level - values[first - 1]) / (values[first] - values[first - 1])


def rung_out(time, values):
    """When the running rms has fallen to QUIET of its peak around firing TDC [s]; nan if it never does."""
    count = max(1, round(SMOOTH_S / (time[1] - time[0])))
    running = np.sqrt(np.convolve(values**2, np.ones(count) / count, "same"))
    top_time, top = peak(time, running)
    quiet = time[(time > top_time) & (running < QUIET * top)]
    return quiet[0] if len(quiet) else np.nan


def high_rms(field, sensor, at):
    """Rms around firing TDC of the content above HIGH_HZ [m/s2]."""
    _, values = around_firing(*band_limited(field, sensor, at, HIGH_HZ))
    return np.sqrt(np.mean(values**2))
