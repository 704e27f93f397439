// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Difference of one cycle from the previous one.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/base/h5_file.hpp"
#include "dynamics/run/model.hpp"
#include "dynamics/run/run_certificate.hpp"
#include "dynamics/run/uniform_samples.hpp"

namespace clatter::dynamics {

/// Compares the samples of a cycle with those of the cycle before, block by block while they are
/// taken; the samples of the cycle before are read from its checkpoint (checkpoint.hpp).
class CycleComparison {
 public:
  /// `model` outlives the comparison. @param cycle its length [s]. InputError when `before` does
  /// not have `samples` samples of the model's modes.
  CycleComparison(const Model& model, H5File before, int64_t samples, double cycle);
  /// The next block of the cycle.
  void add(const SampleBlock& now);
  /// Empty until the cycle is complete.
  CycleDifference difference() const;

 private:
  const Model& model_;
  H5File before_;
  int64_t samples_, compared_ = 0;
  std::vector<int> before_body_;      // per body: the one that was there in the cycle before
  std::vector<double> all_, change_;  // per body: sum |v|^2 and sum |v - v'|^2
  /// Per component, of its secondary motion.
  std::vector<std::optional<Eigen::Vector2d>> largest_;
};

}  // namespace clatter::dynamics
