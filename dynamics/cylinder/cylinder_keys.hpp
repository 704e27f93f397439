// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The tables of cylinders that have no file of their own.
#include <string>

#include "core/keys/keys.hpp"
#include "dynamics/cylinder/cylinder_spec.hpp"

namespace clatter::dynamics {

/// [[cylinder]] itself; its tables are those of the scene.
struct CylinderTable {
  std::string name;
  double firing = 0.0;  // [rad]
  bool is_parked = false;
};
const keys::Keys<CylinderTable>& cylinder_keys();

/// The same with those tables.
const keys::Table& cylinder_table();

const keys::Keys<PistonSpec>& piston_keys();
const keys::Keys<GasSpec>& gas_keys();
const keys::Keys<GuideLaw>& guide_keys();

}  // namespace clatter::dynamics
