// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What elements between two points have in common: [[bushing]] and [[spring]].
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {

/// Two points of bodies with a stiffness and damping between them.
struct PairSpec {
  std::string name;  // "bushing 1", or with its own name, "bushing crank"
  PointSpec a, b;
  double stiffness = 0.0;  // [N/m]
  double damping = 0.0;    // [N s/m]
};

/// Rows name, a, b, stiffness_n_m and damping_n_s_m, of which one acts, unless a table does. The
/// result is that of the stiffness.
template <class S>
keys::Row pair_rows(Keys<S>& key, S& pair) {
  name_row(key, pair.name);
  key.table("a", pair.a, point_keys(), "point of the first body").required();
  key.table("b", pair.b, point_keys(),
            "point of the second body; without position where a is at the start")
      .required();
  key.check([](const Config& table, S& found) {
    if (table.has("stiffness_n_m") && found.stiffness == 0.0 && found.damping == 0.0)
      table.fail("stiffness_n_m", "give stiffness_n_m or damping_n_s_m above 0");
  });
  key.number("damping_n_s_m", pair.damping, kAnyDamping, "damping");
  return key.number("stiffness_n_m", pair.stiffness, kAnyStiffness, "stiffness");
}

/// The ports of both; b is at the same point as a at the start where it gives none.
struct PairPorts {
  std::unique_ptr<Port> a, b;
};
PairPorts ports_of(const PairSpec& pair, ModelBuilder& model);

}  // namespace clatter::dynamics
