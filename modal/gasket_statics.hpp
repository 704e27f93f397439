// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Statics of a model whose gaskets follow their curves, opening included:
//   K q + K_sq^T s + sum_g B_g^T W_g (p_g(c_g) - k_g c_g) = f,   c_g = B_g q + B_s,g s,
// at the integration points of each gasket g: areas W, closures c, pressures p, and k the stiffness
// that K has in place of the curve. Pressures do not fall with the closure, so the energy is convex
// and has one least value. Newton's method with a search along each step finds it; between the
// points of piecewise linear curves it is an active set method, and ends exactly.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/fe/fe_model.hpp"
#include "modal/refined_solve.hpp"

namespace clatter::modal {

struct PressedSolution {
  RefinedSolution solved;                  // of the linear equations of the lines that were found
  std::vector<fe::GasketState> gaskets{};  // one for each of the model
  sparse::FactorReport factor;             // of the last step
  int steps = 0;
  Eigen::VectorXd on_s;  // n_s: the sum above on s [N]
  double energy = 0.0;   // of the gaskets, less that in K [J]
};

/// @param driven f - K_sq^T s (n); @param s supported coordinates (n_s). NumericsError when
/// nothing but open gaskets holds a part; `where` begins it.
PressedSolution solve_pressed(const fe::FeModel& model, const Eigen::VectorXd& driven,
                              const Eigen::VectorXd& s, const std::string& where);

/// A gasket in a solution.
struct GasketSums {
  double area = 0.0, pressed = 0.0;  // [m2]
  double force = 0.0;                // of the pressures [N]
  double highest = 0.0;              // pressure [Pa]
  double opening = 0.0;              // largest, beyond where the curve begins [m]
};
GasketSums sums_of(const fe::FeGasket& gasket, const fe::GasketState& state);

}  // namespace clatter::modal
