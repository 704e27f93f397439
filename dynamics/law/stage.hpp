// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// One implicit stage of the integrator, as laws and elements see it.
#include <Eigen/Core>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace clatter::dynamics {

/// One implicit stage of the integrator: x_i = x_n + sum_{j<i} weights[j] x'_j + kappa x'_i holds
/// for displacements, velocities and for the internal states of elements alike.
struct Stage {
  double time;                  // [s]
  double kappa;                 // dt * a_ii [s]
  int index;                    // i; 0 is the starting implicit Euler stage of a run, then 1, 2
  std::vector<double> weights;  // dt * a_ij, j < index [s]
  // The system's interface coordinates, n_y each; null where a run starts and after an event.
  const Eigen::VectorXd* y_begin = nullptr;  // at the begin of the step
  const Eigen::VectorXd* v_begin = nullptr;
  const Eigen::VectorXd* v_known = nullptr;  // v_i = v_known + kappa v'_i

  /// When the step began [s].
  double begin() const {
    double elapsed = kappa;
    for (const double weight : weights) elapsed += weight;
    return time - elapsed;
  }
};

/// A trial state is not admissible (film thickness <= 0, inner solve failed): the step is reduced.
class StepRefused : public std::exception {
 public:
  /// `kind`: by which refusals are counted, without values ("film: gap below the film's minimum");
  /// `detail`: the values of this one.
  StepRefused(std::string kind, std::string detail)
      : kind_(std::move(kind)), detail_(std::move(detail)) {}

  const std::string& kind() const { return kind_; }
  const std::string& detail() const { return detail_; }
  const char* what() const noexcept override { return kind_.c_str(); }

 private:
  std::string kind_, detail_;
};

}  // namespace clatter::dynamics
