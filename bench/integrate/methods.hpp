// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The integrators that bench/integrators.py compares.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "bench/integrate/scenes.hpp"

namespace clatter::bench {

/// What an integrator found and what it took.
struct Motion {
  std::vector<ModalState> states;  // at the samples' times
  long long steps = 0, rejected = 0, evaluations = 0, matrices = 0, events = 0;
};

/// The kernel's three methods, adaptive and with fixed steps; generalised-alpha and the exponential
/// trapezoidal rule; CVODE and IDA with orders to 5 and to 2; CVODE with roots of contacts; IDA
/// without velocities in its error test.
const std::vector<std::string>& method_names();
/// Integrates the scene. @param tolerance of the error test; of fixed steps their length [s].
/// InputError for other names, NumericsError when the method fails.
Motion integrate(const BenchScene& scene, const std::string& method, double tolerance);

}  // namespace clatter::bench
