// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The [rod] table of a scene.
#include "core/base/config.hpp"
#include "dynamics/body/rigid_rod.hpp"
#include "dynamics/cylinder/rod_spec.hpp"

namespace clatter::dynamics {

/// A rod as a scene describes it.
struct DescribedRod {
  RodSpec spec;
  RodProperties properties;  // of an elastic rod the length alone, until its model is read
};

/// Reads [rod]. Keys that its model does not use are checked, and optional.
DescribedRod read_rod(const Config& table);

}  // namespace clatter::dynamics
