# SPDX-License-Identifier: GPL-3.0-or-later
"""A-weighting, and what of a radiated power is heard most."""
import numpy as np


def a_weight(hz):
    """A-weighting as a factor on power, relative to 1 kHz (IEC 61672-1)."""
    f2 = hz * hz
    r = 12194.217**2 * f2**2 / ((f2 + 20.598997**2) * np.sqrt((f2 + 107.65265**2) * (f2 + 737.86223**2))
                                * (f2 + 12194.217**2))
    return 10.0**0.2 * r * r  # 2.0 dB: 1 at 1 kHz


SILENCE = -999.0  # level of no power, or of one that is taken up [dB]


def level_dba(hz, power):
    """A-weighted level of powers [dB(A) re 1 pW]; SILENCE of none."""
    weighted = np.asarray(power) * a_weight(np.asarray(hz, float))
    return np.where(weighted > 0.0, 10.0 * np.log10(np.maximum(weighted, 1e-300) / 1e-12), SILENCE)


def loudest_peaks(hz, power, count, from_hz=0.0):
    """Indices of the highest peaks of an A-weighted power per line from a frequency on, the highest first."""
    weighted = np.asarray(power) * a_weight(np.asarray(hz, float))
    around = np.concatenate([[0.0], weighted, [0.0]])
    peaks = np.flatnonzero((weighted > around[:-2]) & (weighted >= around[2:]) & (np.asarray(hz) >= from_hz))
    return peaks[np.argsort(-weighted[peaks], kind="stable")[:count]]
