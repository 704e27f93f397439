// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The integration methods: of second order, with implicit stages that share one diagonal entry.
#include <string>

namespace clatter::dynamics {

/// Stages 0 (the state at the start), 1 and 2 (the state at the end):
///   x_1 = x_0 + dt (a_10 x'_0 + d x'_1),   x_2 = x_0 + dt (a_20 x'_0 + a_21 x'_1 + d x'_2),
/// weights b = last row, b_hat: embedded weights whose quadrature is of third order.
struct Tableau {
  std::string name;
  int stages;  // implicit ones, 1 or 2; of a single stage the weights of stage 2 are unused
  double c_1, a_10, a_20, a_21, d;
  double b[3], b_hat[3];
};

/// TR-BDF2 as an ESDIRK with gamma = 2 - sqrt 2 (Bank et al. 1985; embedded weights of Hosea and
/// Shampine 1996). The more accurate one for smooth motion; its first stage uses the rates at the
/// end of the last step.
inline const Tableau& tr_bdf2() {
  constexpr double w = 0.35355339059327376;      // sqrt(2) / 4
  constexpr double gamma = 0.58578643762690495;  // 2 - sqrt 2
  static const Tableau table{"tr-bdf2",
                             2,
                             gamma,
                             0.5 * gamma,
                             w,
                             w,
                             0.5 * gamma,
                             {w, w, 0.5 * gamma},
                             {(1.0 - w) / 3.0, (3.0 * w + 1.0) / 3.0, gamma / 6.0}};
  return table;
}

/// The two-stage SDIRK with d = 1 - sqrt(1/2) (Alexander 1977). It uses no rates of the previous
/// step: where a film cell fills or a surface makes contact, rates jump, and a method that
/// extrapolates them gives oscillating pressures. x'_0 enters only the error estimate.
inline const Tableau& sdirk2() {
  constexpr double d = 0.29289321881345248;
  constexpr double b_1 = 1.0 / 6.0 / (d - d * d), b_2 = 0.5 - b_1 * d;
  static const Tableau table{
      "sdirk2", 2, d, 0.0, 0.0, 1.0 - d, d, {0.0, 1.0 - d, d}, {1.0 - b_1 - b_2, b_1, b_2}};
  return table;
}

/// The trapezoidal rule, corrector of predictor_corrector.hpp.
inline const Tableau& predictor_corrector() {
  static const Tableau table{"predictor-corrector", 1, 1.0, 0.5, 0.0, 0.0, 0.5, {0.5, 0.5, 0.0},
                             {0.5, 0.5, 0.0}};
  return table;
}

}  // namespace clatter::dynamics
