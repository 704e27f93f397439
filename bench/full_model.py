# SPDX-License-Identifier: GPL-3.0-or-later
"""Frequency responses of a full model: its modes to a cut-off, and solves for those beyond."""
import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as sparse_linalg

import frequency_response as frf

TERMS = 6  # of the series for the modes above: the remainder is (frequency / that of the last mode)^12 of the first term


def factor(matrix):
    """Its solver by LU; symmetric and definite, so that no pivoting is needed."""
    return sparse_linalg.splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0,
                              options={"SymmetricMode": True}).solve


class FullModel:
    """Modes of the full model with the solves for those beyond them."""

    def __init__(self, outer, shapes, eigenvalues, stiffness, mass, shift, loss_factor):
        self.outer, self.shapes, self.eigenvalues = outer, shapes, eigenvalues
        self.stiffness, self.mass, self.shift, self.loss_factor = stiffness, mass, shift, loss_factor
        self.solve = factor((stiffness - shift * mass).tocsc())

    def response(self, force, hz, modes=None, rows=None):
        """Normal displacement of the outer faces (or of other rows) from the first modes and the series for the others."""
        shapes, rows = self.shapes[:modes], self.outer if rows is None else rows
        beyond = frf.chain(self.solve, self.mass, shapes, force, TERMS)
        return (frf.superposed((rows @ shapes.T), self.eigenvalues[:modes], shapes @ force, hz, self.loss_factor)
                + frf.left_out(rows @ beyond, self.shift, hz, self.loss_factor))

    def residual(self, force, hz):
        """|f - ((1 + i eta) K - omega^2 M) u| as displacement of the outer faces under it, over theirs in u."""
        u = self.response(force, np.array([hz]), rows=sparse.identity(len(force), format="csr"))[:, 0]
        left = force - (1 + 1j * self.loss_factor) * (self.stiffness @ u) + (2 * np.pi * hz) ** 2 * (self.mass @ u)
        error = self.solve(np.ascontiguousarray(left.real)) + 1j * self.solve(np.ascontiguousarray(left.imag))
        return float(np.linalg.norm(self.outer @ error) / np.linalg.norm(self.outer @ u))
