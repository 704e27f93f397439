// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Faces of any type as quadratic triangles, the only type that recovery and radiation use.
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/fe/fe_model.hpp"

namespace clatter::condense {

/// A point of the skin as a combination of nodes: one node, the midpoint of a straight edge, or the
/// centre of a quadrilateral by its shape functions.
using SkinPoint = std::vector<std::pair<int32_t, double>>;

struct SkinFaces {
  std::vector<SkinPoint> points;  // nodes of the model ascending, then midpoints
  IndexMatrix triangles;          // f x 6, rows of `points`, outward
  /// Triangles on each surface of the model, ascending; those without one are absent.
  std::map<std::string, std::vector<int32_t>> of_surface;
  std::vector<int32_t> sheet;  // triangles that are shells, ascending
};

/// All faces of the named surfaces, each once. A quadrilateral becomes two triangles along its
/// diagonal, exact on its edges and on the diagonal; a linear triangle gets the midpoints of its
/// edges. InputError for an unknown surface.
SkinFaces skin_faces(const fe::FeModel& model, const std::vector<std::string>& surfaces);

}  // namespace clatter::condense
