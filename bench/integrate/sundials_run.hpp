// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// CVODE and IDA of SUNDIALS (Hindmarsh et al. 2005) on a first-order system.
#include <Eigen/Core>
#include <memory>

#include "bench/integrate/first_order.hpp"

namespace clatter::bench {

enum class SundialsSolver { kCvode, kIda };

struct SundialsOptions {
  SundialsSolver solver = SundialsSolver::kIda;
  int max_order = 5;               // of the BDF; those above 2 are not A-stable
  bool test_velocities = true;     // IDA: false leaves them out of the error test (suppressalg)
  bool roots_of_contacts = false;  // starts again where a link begins or ends a contact
};

/// Counts since the start.
struct SundialsCounts {
  long steps = 0, rejected = 0, evaluations = 0, jacobians = 0, events = 0;
};

/// Variable-order BDF with Newton's method, the elements' tangents and KLU: CVODE on x' = g / D,
/// IDA on the residual D x' - g. At a root of an event function, found by the solver, the element
/// changes its mode and the solver starts again from the state that it leaves.
class SundialsRun {
 public:
  /// @param x state at `time`. @param limits absolute tolerance of each x (relative 0).
  /// NumericsError when SUNDIALS fails.
  SundialsRun(FirstOrder& system, const SundialsOptions& options, double time,
              const Eigen::VectorXd& x, const Eigen::VectorXd& limits);
  ~SundialsRun();

  /// Integrates to `time`, events included; x there. The solver does not evaluate beyond `end`.
  const Eigen::VectorXd& advance(double time, double end);
  SundialsCounts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clatter::bench
