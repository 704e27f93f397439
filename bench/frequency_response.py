# SPDX-License-Identifier: GPL-3.0-or-later
"""Frequency response by superposition, and how far two responses are apart. Responses are points x frequencies."""
import numpy as np
import scipy.sparse as sparse


def superposed(shapes, eigenvalues, participation, hz, loss_factor):
    """Displacement per unit force [m/N] from modes of unit modal mass: shapes (points x modes), eigenvalues [rad2/s2],
    participation (what each mode moves where the force acts); stiffness K (1 + i loss_factor)."""
    omega = 2 * np.pi * np.asarray(hz)
    return real_times_complex(shapes, participation[:, None]
                              / (np.asarray(eigenvalues)[:, None] * (1 + 1j * loss_factor) - omega**2))


def left_out(chain, shift, hz, loss_factor):
    """What the modes add that a superposition left out. Column j of `chain` (points x terms) is (K'^-1 M)^j K'^-1 f_c
    with K' = K - shift M and f_c the force less the part of the modes that were kept. In that space
    (1 + i eta) K' u = f_c + (omega^2 - (1 + i eta) shift) M u, whose Neumann series converges as
    |omega^2 - shift| / (lambda - shift), lambda the first omitted mode."""
    omega = 2 * np.pi * np.asarray(hz)
    factor = omega**2 / (1 + 1j * loss_factor) - shift
    return real_times_complex(chain, factor ** np.arange(chain.shape[1])[:, None] / (1 + 1j * loss_factor))


def chain(solve, mass, shapes, force, terms):
    """(K'^-1 M)^j K'^-1 f_c as columns, for left_out. Rows of `shapes` are the kept modes: their components due to rounding
    are removed from every column, since the series would amplify them."""
    def without_kept(vector):
        return vector - shapes.T @ (shapes @ (mass @ vector))

    columns = [without_kept(solve(force))]
    while len(columns) < terms:
        columns.append(without_kept(solve(mass @ columns[-1])))
    return np.column_stack(columns)


def real_times_complex(a, b):
    """Two real products: numpy would convert `a` to complex and do twice the work."""
    return a @ b.real + 1j * (a @ b.imag)


def normal_motion(nodes, faces):
    """Faces x 3 nodes: normal displacement at the centre of six-node triangles times the root of the area, so that sums of
    squares are integrals over the area."""
    a, b, c = (nodes[faces[:, k]] for k in range(3))
    area = np.cross(b - a, c - a) / 2
    rooted = area / np.sqrt(np.linalg.norm(area, axis=1))[:, None]
    value = np.array([-1.0, -1.0, -1.0, 4.0, 4.0, 4.0]) / 9  # of the shape functions at the centre
    rows = np.broadcast_to(np.arange(len(faces))[:, None, None], (len(faces), 6, 3))
    columns = 3 * faces[:, :, None] + np.arange(3)
    entries = value[:, None] * rooted[:, None, :]
    return sparse.csr_matrix((entries.ravel(), (rows.ravel(), columns.ravel())), shape=(len(faces), 3 * len(nodes)))


def relative_difference(found, reference, hz):
    """Root of the energy of the difference over that of the reference, over points and, by trapezoids, over Hz."""
    return float(np.sqrt(np.trapz(energy(found - reference), hz) / np.trapz(energy(reference), hz)))


def energy(response):
    """Sum of squares over the points, for each frequency."""
    return np.einsum("pf,pf->f", response.real, response.real) + np.einsum("pf,pf->f", response.imag, response.imag)


def third_octaves(hz):
    """(lower edge, mid, upper edge) [Hz] of the bands, to base ten, within the range of frequencies."""
    bands = [1000.0 * 10 ** (k / 10) for k in range(-30, 20)]
    edges = [(mid * 10**-0.05, mid, mid * 10**0.05) for mid in bands]
    return [band for band in edges if hz[0] <= band[0] and band[2] <= hz[-1]]


def band_levels(response, hz):
    """Level [dB] of the mean over the points and each third octave, for a force of white spectrum."""
    squares = energy(response) / len(response)
    total = np.concatenate([[0.0], np.cumsum(np.diff(hz) * (squares[1:] + squares[:-1]) / 2)])
    return np.array([10 * np.log10((np.interp(upper, hz, total) - np.interp(lower, hz, total)) / (upper - lower))
                     for lower, _, upper in third_octaves(hz)])
