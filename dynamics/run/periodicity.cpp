// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/periodicity.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "dynamics/run/checkpoint.hpp"

namespace clatter::dynamics {

CycleComparison::CycleComparison(const Model& model, H5File before, int64_t samples)
    : model_(model),
      before_(std::move(before)),
      samples_(samples),
      all_(model.system.bodies().size(), 0.0),
      change_(all_) {
  const std::vector<int64_t> expected{samples, model.system.modes()};
  for (const char* name : {kCycleEta, kCycleVelocity}) {
    if (before_.shape(name) == expected) continue;
    throw InputError(fmt::format("{}: {}: expected {} samples of {} modes", before_.path().string(),
                                 name, expected[0], expected[1]));
  }
}

void CycleComparison::add(const SampleBlock& now) {
  const RowMatrix v_before = before_.read_rows(kCycleVelocity, now.first, now.count);
  for (size_t b = 0; b < all_.size(); ++b) {
    const auto at = model_.system.mode_offset(static_cast<int>(b));
    const auto n = model_.system.bodies()[b].modes();
    const auto v = now.v.block(0, at, now.count, n);
    all_[b] += v.squaredNorm();
    change_[b] += (v - v_before.middleCols(at, n)).squaredNorm();
  }
  compared_ += now.count;
  if (model_.pin_y < 0) return;
  const RowMatrix eta_before = before_.read_rows(kCycleEta, now.first, now.count);
  for (Eigen::Index i = 0; i < now.count; ++i) {
    const Eigen::VectorXd change = (now.eta.row(i) - eta_before.row(i)).transpose();
    const Eigen::Vector2d motion =
        model_.secondary_motion(now.time(i), model_.system.interface(change));
    largest_ = largest_.cwiseMax(motion.cwiseAbs());
  }
}

CycleDifference CycleComparison::difference() const {
  CycleDifference result;
  if (compared_ != samples_) return result;
  for (size_t b = 0; b < all_.size(); ++b)
    result.velocity[model_.system.bodies()[b].name] =
        all_[b] > 0.0 ? std::sqrt(change_[b] / all_[b]) : 0.0;
  if (model_.pin_y < 0) return result;
  result.lateral = largest_.x();
  result.tilt = largest_.y();
  return result;
}

}  // namespace clatter::dynamics
