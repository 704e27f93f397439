// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Geometric features that force smaller cells than requested.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "mesh/cad/gmsh_session.hpp"

namespace clatter::mesh {

/// An edge with its length, or a face with its width (2 area / perimeter) or its radius.
struct SmallFeature {
  double size;
  Eigen::Vector3d position;
};

/// Each list ascending by size, in the part's unit.
struct SmallFeatures {
  std::vector<SmallFeature> edges, faces, radii;
  size_t count() const { return edges.size() + faces.size() + radii.size(); }
};

/// Features of the boundary `faces` that are smaller than `below`.
SmallFeatures find_small_features(GmshSession& session, const std::vector<FaceFacts>& faces,
                                  double below);

/// "3 edges from 0.05 (0.05 at (1, 2, 3), ...), 12 faces from 0.3 wide (...), 2 radii from 0.1
/// (...)" in the part's unit; empty when there are none.
std::string describe_small_features(const SmallFeatures& features);

}  // namespace clatter::mesh
