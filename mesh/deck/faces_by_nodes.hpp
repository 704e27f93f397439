// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Which face of which cell a two-dimensional cell of a deck lies on.
#include <span>
#include <vector>

#include "core/mesh/cell_faces.hpp"

namespace clatter::mesh::deck {

/// All faces of a mesh, found by their corners.
class FacesByNodes {
 public:
  enum class Fit {
    kNone,        // no cell has a face with these corners
    kOtherNodes,  // it has other mid-side nodes
    kInside,      // both cells belong to one region
    kBetween,     // the cells belong to two regions
    kBoundary,
  };
  struct Found {
    Fit fit = Fit::kNone;
    BoundaryFace face{};          // kBetween: of the two the one that is oriented like the nodes
    bool has_more_nodes = false;  // the nodes are linear, the face has mid-side nodes

    bool is_surface() const { return fit == Fit::kBetween || fit == Fit::kBoundary; }
  };

  explicit FacesByNodes(const Mesh& mesh) : mesh_(mesh), faces_(all_faces(mesh)) {}
  Found find(FaceType type, std::span<const int32_t> nodes) const;

 private:
  const Mesh& mesh_;
  std::vector<FaceRef> faces_;
};

}  // namespace clatter::mesh::deck
