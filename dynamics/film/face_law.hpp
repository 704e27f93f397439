// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Film thickness on a face from those of its two cells, exact for a linear gap.

namespace clatter::film {

/// What a face conducts instead of g^3 [m3], and its derivative by `a`.
inline double face_conductance(double a, double b) { return 2.0 * a * a * b * b / (a + b); }
inline double conductance_slope(double a, double b) {
  return 2.0 * a * b * b * (a + 2.0 * b) / ((a + b) * (a + b));
}
/// What a face carries instead of c [m], and its derivative by `a`.
inline double face_carry(double a, double b) { return 2.0 * a * b / (a + b); }
inline double carry_slope(double a, double b) { return 2.0 * b * b / ((a + b) * (a + b)); }

}  // namespace clatter::film
