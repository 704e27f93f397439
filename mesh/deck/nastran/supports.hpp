// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the cards of a set hold: directions are those of each grid's displacement system. Nodes of
// solids have no rotations; grids without a node index have no DoFs.
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {

class Supports {
 public:
  /// `name`: of the supports, numbered if there are several.
  Supports(Model& model, std::string name) : model_(model), name_(std::move(name)) {}

  /// One card.
  void read(const RawHold& hold);
  void add_node(NodeIndex node_index, DofMask dofs, double value, Origin origin);
  /// One Support for each value, set of directions and system. InputError for a DoF with two
  /// values.
  std::vector<Support> list();
  /// Grids of cards that no cell, coupling or spring uses.
  int64_t unused() const { return unused_; }

 private:
  struct Held {
    NodeIndex node_index = 0;
    DofMask dofs = 0;
    Origin origin = 0;
    double value = 0.0;
  };

  void merge(size_t begin, size_t end);
  [[noreturn]] void refuse(const Held& held, double other) const;

  Model& model_;
  std::string name_;
  std::vector<Held> held_;
  int64_t unused_ = 0;
  std::map<std::tuple<int32_t, double, DofMask>, Support> groups_;
};

}  // namespace clatter::mesh::deck::nastran
