// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/part/predict_cells.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/log.hpp"

namespace clatter::mesh {
namespace {

constexpr double kTriangle = 0.433;    // area over edge squared
constexpr double kTetrahedron = 0.17;  // volume over edge cubed, measured on Gmsh's Delaunay meshes
constexpr double kGradedTetrahedron = 0.12;  // the same where sizes grow
constexpr double kPerPair = 2.0;             // tetrahedra per triangle where one layer fills a wall
constexpr double kGrowthOnFaces = 0.5;       // of the size per distance from an edge
constexpr double kLeastGrowth = 0.1;         // of the size per distance from a face
constexpr double kLargestGrowth = 0.7;

double curved_size(double radius, const SizeSettings& settings) {
  if (settings.per_turn <= 0) return settings.size;
  const double size = 2.0 * std::numbers::pi * radius / settings.per_turn;
  return std::clamp(size, std::min(settings.min_size, settings.size), settings.size);
}

// Radius of the circle through three points; infinite if they are collinear.
double radius_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double twice_area = (b - a).cross(c - a).norm();
  const double sides = (b - a).norm() * (c - b).norm() * (a - c).norm();
  const bool straight = twice_area <= 1e-6 * (c - a).squaredNorm();
  return straight ? std::numeric_limits<double>::infinity() : sides / (2.0 * twice_area);
}

// Length and smallest size of the edge whose samples begin at `first`.
FaceSizes::Edge edge_sizes(const std::vector<Eigen::Vector3d>& points, size_t first,
                           const SizeSettings& settings) {
  FaceSizes::Edge edge{0.0, settings.size};
  for (size_t i = first; i + 1 < first + kEdgeSamples; ++i) {
    edge.length += (points[i + 1] - points[i]).norm();
    if (i > first)
      edge.size = std::min(
          edge.size, curved_size(radius_of(points[i - 1], points[i], points[i + 1]), settings));
  }
  return edge;
}

double inverse_square_mean(const std::vector<double>& sizes) {
  double sum = 0.0;
  for (const double h : sizes) sum += 1.0 / (h * h);
  return sum / static_cast<double>(sizes.size());
}

double triangles_of(const FaceSizes& face) {
  const double density = inverse_square_mean(face.at_samples);
  const double size = 1.0 / std::sqrt(density);
  double triangles = face.area * density / kTriangle;
  for (const FaceSizes::Edge& edge : face.edges) {
    if (edge.size >= size || edge.length <= 0.0) continue;
    const double band = edge.length / (kTriangle * kGrowthOnFaces) * (1.0 / edge.size - 1.0 / size);
    triangles += std::min(band, face.area / (kTriangle * edge.size * edge.size));
  }
  return triangles;
}

}  // namespace

FaceSizes sizes_on(GmshSession& session, const FaceFacts& face, const SizeSettings& settings) {
  FaceSizes sizes;
  sizes.area = face.area;
  const auto own = settings.face_sizes.find(face.tag);
  const double largest =
      own == settings.face_sizes.end() ? settings.size : std::min(own->second, settings.size);
  if (settings.per_turn > 0 && face.kind != "Plane") {
    for (const double radius : session.radii(face.tag))
      sizes.at_samples.push_back(std::min(largest, curved_size(radius, settings)));
  }
  if (sizes.at_samples.empty()) sizes.at_samples.push_back(largest);
  for (size_t first = 0; first + kEdgeSamples <= face.edge_points.size(); first += kEdgeSamples) {
    FaceSizes::Edge edge = edge_sizes(face.edge_points, first, settings);
    edge.size = std::min(edge.size, largest);
    if (edge.length <= 0.0) continue;
    edge.size = edge.length / std::ceil(edge.length / edge.size);  // an integer number of segments
    sizes.edges.push_back(edge);
  }
  return sizes;
}

double predict_cells(const std::vector<FaceSizes>& faces, double volume, double target) {
  double triangles = 0.0, area = 0.0;
  for (const FaceSizes& face : faces) {
    triangles += triangles_of(face);
    area += face.area;
  }
  const double wall = area > 0.0 ? 2.0 * volume / area : 0.0;
  double inside = volume / (kTetrahedron * target * target * target);
  for (const FaceSizes& face : faces) {
    const double mean = 1.0 / std::sqrt(inverse_square_mean(face.at_samples));
    if (mean >= target || wall <= 0.0) continue;
    const double growth = std::clamp((target - mean) / wall, kLeastGrowth, kLargestGrowth);
    const double layer = (1.0 / (mean * mean) - 1.0 / (target * target)) / (2.0 * growth);
    // Never more than cells of that size through half the wall.
    inside += face.area / kGradedTetrahedron * std::min(layer, 0.5 * wall / (mean * mean * mean));
  }
  return std::max(kPerPair * triangles, inside);
}

namespace {

/// Sizes on all faces, and the box around them.
struct Wanted {
  std::vector<FaceSizes> faces;
  BoxFilter box{Eigen::Vector3d::Constant(1e300), Eigen::Vector3d::Constant(-1e300)};
};

Wanted wanted_of(GmshSession& session, const std::vector<FaceFacts>& faces,
                 const SizeSettings& sizes) {
  Wanted wanted;
  for (const FaceFacts& face : faces) {
    wanted.faces.push_back(sizes_on(session, face, sizes));
    for (const Eigen::Vector3d& x : face.edge_points) {
      wanted.box.min = wanted.box.min.cwiseMin(x);
      wanted.box.max = wanted.box.max.cwiseMax(x);
    }
  }
  return wanted;
}

double require_few(double cells, const BoxFilter& box, const MeshSettings& settings,
                   double metres_per_unit, const std::string& where) {
  const Eigen::Vector3d mm = 1e3 * metres_per_unit * (box.max - box.min);
  say(fmt::format("mesh: about {:.2g} cells expected", cells));
  if (cells <= settings.max_cells) return cells;
  std::string turns;
  if (settings.elements_per_turn > 0)
    turns = fmt::format(" and elements_per_turn = {}", settings.elements_per_turn);
  throw InputError(fmt::format(
      "{}: mesh: element_size_mm = {:g}{} on a part of {:.4g} x {:.4g} x {:.4g} mm makes about "
      "{:.2g} cells, expected at most {:g} (max_cells): check that the size is in mm and the "
      "part's unit is right, or choose larger elements, set min_size_mm, or raise mesh.max_cells",
      where, 1e3 * settings.element_size, turns, mm.x(), mm.y(), mm.z(), cells,
      settings.max_cells));
}

}  // namespace

double require_few_cells(GmshSession& session, double volume, const SizeSettings& sizes,
                         const MeshSettings& settings, double metres_per_unit,
                         const std::string& where) {
  const Wanted wanted = wanted_of(session, session.faces_of_solids(), sizes);
  return require_few(predict_cells(wanted.faces, volume, sizes.size), wanted.box, settings,
                     metres_per_unit, where);
}

double require_few_shells(GmshSession& session, const SizeSettings& sizes, bool triangles,
                          const MeshSettings& settings, double metres_per_unit,
                          const std::string& where) {
  const Wanted wanted = wanted_of(session, session.boundary_faces(), sizes);
  double cells = 0.0;
  for (const FaceSizes& face : wanted.faces) cells += (triangles ? 1.0 : 0.5) * triangles_of(face);
  return require_few(cells, wanted.box, settings, metres_per_unit, where);
}

}  // namespace clatter::mesh
