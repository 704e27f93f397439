// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Valves on a camshaft of TOML text as a system.
#include <memory>
#include <string>

#include "dynamics/valve/valve_component.hpp"
#include "tests/dynamics/shaft_model.hpp"

namespace clatter::dynamics::testing {

/// A shaft with lobes, and the valves on them.
struct ValveModelOf {
  ShaftModelOf shaft;
  ValveComponent valves;
  ValveModelOf(const std::string& shafts, const std::string& valve);
  System& system() { return shaft.system(); }
};

/// So many valves of the reference on a shaft of 300 mm in two bearings, their lobes one after the
/// other over a turn. @param model of the shaft: "full", "torsion", "rigid".
std::unique_ptr<ValveModelOf> valves_on_a_shaft(const std::string& model, double rpm, int count);

}  // namespace clatter::dynamics::testing
