// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// All components of which a scene may consist.
#include <string>
#include <vector>

#include "dynamics/component/component.hpp"

namespace clatter::dynamics {

/// One kind of component.
struct ComponentKind {
  std::vector<std::string> tables;  // as they are written: "[block]", "[[body]]"; or a key
  std::string summary;              // its line in dynamics/README.md
  /// Reads the components of a scene; none where it has no such table.
  ComponentList (*read)(const Config& root);
};

/// In the order in which components are added to a model.
const std::vector<ComponentKind>& component_kinds();

/// InputError for a table or key that neither the scene itself nor a component has, with the
/// nearest known one; before the tables are read, whose errors an unknown one may explain.
void check_known(const Config& root);

ComponentList read_components(const Config& root);

}  // namespace clatter::dynamics
