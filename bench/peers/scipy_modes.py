# SPDX-License-Identifier: GPL-3.0-or-later
"""scipy_modes.py COUNT: the lowest modes of block.K.npz, block.M.npz [Hz] by SciPy (ARPACK, SuperLU)."""
import sys

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as la

K, M = (sp.load_npz(f"block.{name}.npz").tocsc() for name in "KM")
w, _ = la.eigsh(K, int(sys.argv[1]), M, sigma=-(2 * np.pi * 100.0) ** 2)  # below zero: the rigid modes make K singular
print(*np.sqrt(np.abs(np.sort(w))) / (2 * np.pi))
