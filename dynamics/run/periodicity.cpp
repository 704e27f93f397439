// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/periodicity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "dynamics/run/checkpoint.hpp"

namespace clatter::dynamics {

CycleComparison::CycleComparison(const Model& model, H5File before, int64_t samples, double cycle)
    : model_(model),
      before_(std::move(before)),
      samples_(samples),
      all_(model.system.bodies().size(), 0.0),
      change_(all_),
      largest_(model.components.size()) {
  for (int b = 0; b < static_cast<int>(model.system.bodies().size()); ++b) {
    int body = b;
    for (const MovingRow* row : components_of<MovingRow>(model))
      body = row->body_before(body, cycle);
    before_body_.push_back(body);
  }
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
    const auto was = model_.system.mode_offset(before_body_[b]);
    change_[b] += (v - v_before.middleCols(was, n)).squaredNorm();
  }
  compared_ += now.count;
  if (components_of<PistonInLiner>(model_).empty()) return;
  const RowMatrix eta_before = before_.read_rows(kCycleEta, now.first, now.count);
  for (Eigen::Index i = 0; i < now.count; ++i) {
    const Eigen::VectorXd change = (now.eta.row(i) - eta_before.row(i)).transpose();
    const Eigen::VectorXd y = model_.system.interface(change);
    for (size_t c = 0; c < largest_.size(); ++c) {
      const auto* piston = dynamic_cast<const PistonInLiner*>(model_.components[c].get());
      if (piston == nullptr) continue;
      const Eigen::Vector2d motion = piston->secondary_motion(now.time(i), y);
      largest_[c] = largest_[c].value_or(Eigen::Vector2d::Zero()).cwiseMax(motion.cwiseAbs());
    }
  }
}

CycleDifference CycleComparison::difference() const {
  CycleDifference result;
  if (compared_ != samples_) return result;
  std::map<std::string, std::pair<double, double>> sums;  // of bodies that are named together
  for (size_t b = 0; b < all_.size(); ++b) {
    const ModalBody& body = model_.system.bodies()[b];
    auto& [all, change] = sums[body.family.empty() ? body.name : body.family];
    all += all_[b];
    change += change_[b];
  }
  for (const auto& [name, sum] : sums)
    result.velocity[name] = sum.first > 0.0 ? std::sqrt(sum.second / sum.first) : 0.0;
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
