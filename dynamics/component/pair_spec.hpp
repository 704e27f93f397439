// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What elements between two points have in common: [[bushing]] and [[spring]].
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/config.hpp"
#include "dynamics/component/model_builder.hpp"

namespace clatter::dynamics {

/// Two points of bodies with a stiffness and damping between them.
struct PairSpec {
  std::string name;  // "bushing 1", or with its own name, "bushing crank"
  PointSpec a, b;
  double stiffness = 0.0;  // [N/m]
  double damping = 0.0;    // [N s/m]
};

/// The keys of the table `number` (from 1) of `kind`: name, a, b, stiffness_n_m, damping_n_s_m.
PairSpec read_pair(const Config& table, const std::string& kind, size_t number);

/// The keys name, a and b of it.
PairSpec read_pair_points(const Config& table, const std::string& kind, size_t number);

/// The ports of both; b is at the same point as a at the start where it gives none.
struct PairPorts {
  std::unique_ptr<Port> a, b;
};
PairPorts ports_of(const PairSpec& pair, ModelBuilder& model);

}  // namespace clatter::dynamics
