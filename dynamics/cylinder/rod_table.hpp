// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The [rod] table of a scene.
#include "core/keys/keys.hpp"
#include "dynamics/body/rigid_rod.hpp"
#include "dynamics/cylinder/rod_spec.hpp"

namespace clatter::dynamics {

/// A rod as a scene describes it.
struct DescribedRod {
  RodSpec spec;
  RodProperties properties;  // of an elastic rod the length alone, until its model is read
};

const keys::Keys<DescribedRod>& rod_keys();

}  // namespace clatter::dynamics
