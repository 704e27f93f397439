// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Bodies between which no heat flows: the temperature of each must be fixed somewhere.
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// Sets of nodes that heat can flow between.
class HeatBodies {
 public:
  explicit HeatBodies(const mesh::Mesh& mesh);

  void join(int32_t a, int32_t b);
  /// The temperature of this node's body is fixed, by a film or directly.
  void fix(int32_t node) { fixed_.push_back(node); }
  /// A node of a body whose temperature nothing fixes.
  std::optional<int32_t> first_loose() const;

 private:
  int32_t root(int32_t node) const;
  mutable std::vector<int32_t> parent_;
  std::vector<int32_t> fixed_;
};

}  // namespace clatter::assembly
