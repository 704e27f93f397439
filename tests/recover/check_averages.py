# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the averaged powers of window `w` of a field file with scipy.signal.welch on its own sensor histories."""
import sys

import h5py
import numpy as np
from scipy.signal import welch

with h5py.File(sys.argv[1]) as file:
    window = file["analysis/w"]
    sensor = window["sensors/sensor_block"]
    length, lines = int(window.attrs["segment_samples"]), len(window["frequency_hz"])
    step = np.diff(window["time"][()]).mean()
    # The tapers of clatter are sampled at the middle of each step.
    taper = 0.5 - 0.5 * np.cos(2 * np.pi * (np.arange(length) + 0.5) / length)
    hop = int(np.floor(length * 0.5 + 0.5))
    for quantity in ("displacement", "velocity", "acceleration"):
        x = sensor[quantity][:, 0]
        frequency, density = welch(x, 1 / step, window=taper, nperseg=length, noverlap=length - hop, detrend="constant",
                                   scaling="density")
        power = density * frequency[1]  # mean square per line, over the taper's noise bandwidth
        assert np.allclose(frequency[:lines], window["frequency_hz"][()], rtol=1e-9)
        found = sensor[f"spectrum/{quantity}_power"][:, 0]
        assert np.allclose(found, power[:lines], rtol=1e-9, atol=1e-12 * power.max()), quantity
    assert int(window.attrs["averages"]) == (len(x) - length) // hop + 1
print("averaged powers agree")
