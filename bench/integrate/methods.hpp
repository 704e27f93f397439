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
  std::vector<Eigen::VectorXd> states;  // modal displacements at the samples' times, N each
  long long steps = 0, rejected = 0, evaluations = 0, matrices = 0, events = 0;
};

/// The kernel's three methods; generalised-alpha and the exponential trapezoidal rule; CVODE and
/// IDA with orders to 5 and to 2; IDA without velocities in its error test.
const std::vector<std::string>& method_names();
/// Integrates the scene. InputError for other names, NumericsError when the method fails.
Motion integrate(const BenchScene& scene, const std::string& method, double tolerance);

}  // namespace clatter::bench
