# SPDX-License-Identifier: GPL-3.0-or-later
"""Frequency weighting of levels."""
import numpy as np


def a_weight(hz):
    """A-weighting as a factor on power, relative to 1 kHz (IEC 61672-1)."""
    f2 = hz * hz
    r = 12194.217**2 * f2**2 / ((f2 + 20.598997**2) * np.sqrt((f2 + 107.65265**2) * (f2 + 737.86223**2))
                                * (f2 + 12194.217**2))
    return 10.0**0.2 * r * r  # 2.0 dB: 1 at 1 kHz
