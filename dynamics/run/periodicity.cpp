// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/periodicity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "dynamics/run/checkpoint.hpp"

namespace clatter::dynamics {

CycleComparison::CycleComparison(const Model& model, H5File before, int64_t samples)
    : model_(model),
      before_(std::move(before)),
      samples_(samples),
      all_(model.system.bodies().size(), 0.0),
      change_(all_),
      largest_(model.components.size()) {
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
  if (std::none_of(model_.components.begin(), model_.components.end(),
                   [](const auto& component) { return component->has_secondary_motion(); }))
    return;
  const RowMatrix eta_before = before_.read_rows(kCycleEta, now.first, now.count);
  for (Eigen::Index i = 0; i < now.count; ++i) {
    const Eigen::VectorXd change = (now.eta.row(i) - eta_before.row(i)).transpose();
    const Eigen::VectorXd y = model_.system.interface(change);
    for (size_t c = 0; c < largest_.size(); ++c) {
      if (!model_.components[c]->has_secondary_motion()) continue;
      const Eigen::Vector2d motion = model_.components[c]->secondary_motion(now.time(i), y);
      largest_[c] = largest_[c].value_or(Eigen::Vector2d::Zero()).cwiseMax(motion.cwiseAbs());
    }
  }
}

CycleDifference CycleComparison::difference() const {
  CycleDifference result;
  if (compared_ != samples_) return result;
  for (size_t b = 0; b < all_.size(); ++b)
    result.velocity[model_.system.bodies()[b].name] =
        all_[b] > 0.0 ? std::sqrt(change_[b] / all_[b]) : 0.0;
  for (size_t c = 0; c < largest_.size(); ++c) {
    if (!largest_[c]) continue;
    const std::string name = model_.components[c]->name();
    if (name.empty()) {
      result.lateral = largest_[c]->x();
      result.tilt = largest_[c]->y();
    } else {
      result.lateral_of[name] = largest_[c]->x();
      result.tilt_of[name] = largest_[c]->y();
    }
  }
  return result;
}

}  // namespace clatter::dynamics
