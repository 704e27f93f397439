// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cad/gmsh_sizes.hpp"

#include <algorithm>

#include "mesh/cad/gmsh_call.hpp"

namespace clatter::mesh {
namespace {

// A local size of a face also applies to its curves: faces are meshed from their edges.
std::map<int, double> curve_sizes(const std::map<int, double>& face_sizes) {
  std::map<int, double> sizes;
  for (const auto& [face, size] : face_sizes) {
    std::vector<int> up, curves;
    gmsh::model::getAdjacencies(2, face, up, curves);
    for (int curve : curves) {
      const auto known = sizes.find(curve);
      if (known == sizes.end() || size < known->second) sizes[curve] = size;
    }
  }
  return sizes;
}

// The size that the spots allow at x.
double spot_size(const std::vector<FineSpot>& spots, double size, const Eigen::Vector3d& x) {
  constexpr double kGrowth = 0.5;  // per length: neighbours differ by less than a factor of 2
  for (const FineSpot& spot : spots) {
    const double beyond = std::max(0.0, (x - spot.centre).norm() - spot.radius);
    size = std::min(size, spot.size + kGrowth * beyond);
  }
  return size;
}

// Gmsh's fields: the distance from sample points of a face or curve, and a size that grows with it.
// @return the number of the second one.
double add_growth(const char* list, int entity, int points, double size, double growth,
                  double largest) {
  namespace field = gmsh::model::mesh::field;
  const int distance = field::add("Distance"), threshold = field::add("Threshold");
  field::setNumbers(distance, list, {static_cast<double>(entity)});
  field::setNumber(distance, "NNodesByEdge", points);
  field::setNumber(threshold, "IField", distance);
  field::setNumber(threshold, "LcMin", size);
  field::setNumber(threshold, "LcMax", largest);
  field::setNumber(threshold, "DistMin", 0.0);
  field::setNumber(threshold, "DistMax", (largest - size) / growth);
  return threshold;
}

void set_gradations(const SizeSettings& settings) {
  constexpr int kSampling = 40;  // points along each direction of a face
  namespace field = gmsh::model::mesh::field;
  std::vector<double> growths;
  for (const Gradation& g : settings.gradations)
    growths.push_back(add_growth("FacesList", g.face, kSampling, g.size, g.growth, settings.size));
  for (const CurveGradation& g : settings.curves)
    growths.push_back(add_growth("EdgesList", g.curve, g.points, g.size, g.growth, settings.size));
  if (growths.empty()) return;
  const int smallest = field::add("Min");
  field::setNumbers(smallest, "FieldsList", growths);
  field::setAsBackgroundMesh(smallest);
}

}  // namespace

void set_sizes(const SizeSettings& settings) {
  constexpr double kMeshAdapt = 1, kFrontalDelaunay = 6;
  gmsh::option::setNumber("Mesh.Algorithm",
                          settings.adaptive_faces ? kMeshAdapt : kFrontalDelaunay);
  gmsh::option::setNumber("Mesh.MeshSizeMax", settings.size);
  gmsh::option::setNumber("Mesh.MeshSizeMin", settings.min_size);
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", settings.per_turn);
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", settings.curves.empty());
  gmsh::model::mesh::removeSizeCallback();
  set_gradations(settings);
  if (settings.face_sizes.empty() && settings.spots.empty()) return;
  const auto local_size = [settings, curves = curve_sizes(settings.face_sizes)](
                              int dim, int tag, const Eigen::Vector3d& x) {
    const double size = spot_size(settings.spots, settings.size, x);
    if (dim != 1 && dim != 2) return size;
    const auto& sizes = dim == 2 ? settings.face_sizes : curves;
    const auto found = sizes.find(tag);
    return found == sizes.end() ? size : std::min(size, found->second);
  };
  // Gmsh 4.8 takes the smaller of its own size and the one returned; since 4.9 it passes its own as
  // a sixth argument, which the one returned replaces (hard case G10).
  gmsh::model::mesh::setSizeCallback(
      [local_size](int dim, int tag, double x, double y, double z, auto... own_size) {
        return std::min({local_size(dim, tag, {x, y, z}), own_size...});
      });
}

}  // namespace clatter::mesh
