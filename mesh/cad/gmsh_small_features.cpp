// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cad/gmsh_small_features.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/cad/gmsh_call.hpp"

namespace clatter::mesh {
namespace {

constexpr size_t kNamed = 3;

SmallFeature edge_of(int curve) {
  SmallFeature edge{};
  gmsh::model::occ::getMass(1, curve, edge.size);
  std::vector<double> low, high, x;
  gmsh::model::getParametrizationBounds(1, curve, low, high);
  gmsh::model::getValue(1, curve, {0.5 * (low[0] + high[0])}, x);
  edge.position = {x[0], x[1], x[2]};
  return edge;
}

void sort_by_size(std::vector<SmallFeature>& features) {
  std::stable_sort(features.begin(), features.end(),
                   [](const SmallFeature& a, const SmallFeature& b) { return a.size < b.size; });
}

// A coordinate without the rounding of zero.
double tidy(double value) { return std::abs(value) < 1e-9 ? 0.0 : value; }

std::string describe(const std::vector<SmallFeature>& features, const char* kind, const char* how) {
  std::vector<std::string> texts;
  for (size_t i = 0; i < std::min(kNamed, features.size()); ++i)
    texts.push_back(fmt::format("{:.3g} at ({:.5g}, {:.5g}, {:.5g})", features[i].size,
                                tidy(features[i].position.x()), tidy(features[i].position.y()),
                                tidy(features[i].position.z())));
  return fmt::format("{} {} from {:.3g}{} ({}{})", features.size(), kind, features.front().size,
                     how, fmt::join(texts, ", "), features.size() > kNamed ? ", ..." : "");
}

}  // namespace

SmallFeatures find_small_features(GmshSession& session, const std::vector<FaceFacts>& faces,
                                  double below) {
  return gmsh_call("features", [&] {
    SmallFeatures found;
    std::map<int, SmallFeature> edges;
    for (const FaceFacts& face : faces) {
      std::vector<int> solids, curves;
      gmsh::model::getAdjacencies(2, face.tag, solids, curves);
      double circumference = 0.0;
      for (const int curve : curves)
        circumference += edges.try_emplace(curve, edge_of(curve)).first->second.size;
      const double width = circumference > 0.0 ? 2.0 * face.area / circumference : below;
      if (width < below) found.faces.push_back({width, face.centre});
      const double radius = face.kind == "Plane" ? 0.0 : session.smallest_radius(face.tag);
      if (radius > 0.0 && radius < below) found.radii.push_back({radius, face.centre});
    }
    // The point of a cone or the pole of a sphere is an edge without length.
    constexpr double kPoint = 1e-6;
    for (const auto& [tag, edge] : edges)
      if (edge.size > kPoint * below && edge.size < below) found.edges.push_back(edge);
    sort_by_size(found.edges);
    sort_by_size(found.faces);
    sort_by_size(found.radii);
    return found;
  });
}

std::string describe_small_features(const SmallFeatures& features) {
  std::vector<std::string> kinds;
  if (!features.edges.empty()) kinds.push_back(describe(features.edges, "edges", ""));
  if (!features.faces.empty()) kinds.push_back(describe(features.faces, "faces", " wide"));
  if (!features.radii.empty()) kinds.push_back(describe(features.radii, "radii", ""));
  return fmt::format("{}", fmt::join(kinds, ", "));
}

}  // namespace clatter::mesh
