// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The planar flexible slider crank of Simeon (1996), problem CRANK of the Test Set for IVP Solvers.
#include <Eigen/Core>

namespace clatter::dynamics::testing {

/// phi2, x3, q1 .. q4 and their rates at the end.
struct CrankEnd {
  Eigen::Matrix<double, 6, 1> at, rate;
  long long steps;
};

/// The state at `end` [s] with joints of a stiffness [N/m] at a tolerance of 10 um and 0.1 m/s.
CrankEnd crank_at(double end, double stiffness, double tolerance);

/// Relative differences from the reference: phi2, x3, q1 .. q4, at most; and phi2', x3', q1'.
struct CrankLimits {
  double at[6], rate[3];
};

/// Compares the state at 0.1 s with the reference.
void expect_reference(const CrankEnd& found, const CrankLimits& limits);

}  // namespace clatter::dynamics::testing
