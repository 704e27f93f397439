// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// All components of which a scene may consist.
#include <string>
#include <vector>

#include "core/keys/keys.hpp"
#include "dynamics/component/component.hpp"

namespace clatter::dynamics {

/// One kind of component.
struct ComponentKind {
  /// Its tables in a scene: form "[block]", "[[body]]", and the keys; of a key of the scene itself
  /// its name and no table.
  struct Entry {
    std::string form;
    const keys::Table* keys = nullptr;
    std::string name() const;  // "body" of "[[body]]"
  };
  std::vector<Entry> tables;
  std::string summary;  // its line in dynamics/README.md
  /// Reads the components of a scene; none where it has no such table.
  ComponentList (*read)(const Config& root);
};

/// In the order in which components are added to a model.
const std::vector<ComponentKind>& component_kinds();

/// All keys and tables that a scene may have.
const keys::Table& scene_table();

/// InputError for a table or key that neither the scene itself nor a component has, with the
/// nearest known one; before the tables are read, whose errors an unknown one may explain.
void check_known(const Config& root);

ComponentList read_components(const Config& root);

}  // namespace clatter::dynamics
