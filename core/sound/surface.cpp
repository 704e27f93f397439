// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/surface.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/error.hpp"

namespace clatter::sound {
namespace {

using Edge = std::pair<int32_t, int32_t>;  // from, to

void check_tables(const RowMatrix& nodes, const IndexMatrix& triangles) {
  if (nodes.cols() != 3 || triangles.cols() != 3 || triangles.rows() == 0)
    throw InputError(
        fmt::format("surface: found nodes with {} coordinates and {} faces with {} corners, "
                    "expected 3, at least one, and 3",
                    nodes.cols(), triangles.rows(), triangles.cols()));
  std::vector<char> used(static_cast<size_t>(nodes.rows()), 0);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int a = 0; a < 3; ++a) {
      const int32_t node = triangles(f, a);
      if (node < 0 || node >= nodes.rows())
        throw InputError(fmt::format("surface: face {}: found node {}, expected 0 to {}", f, node,
                                     nodes.rows() - 1));
      used[node] = 1;
    }
  for (Eigen::Index n = 0; n < nodes.rows(); ++n) {
    if (!nodes.row(n).allFinite())
      throw InputError(fmt::format("surface: node {}: found a coordinate that is not finite", n));
    if (!used[n])
      throw InputError(fmt::format("surface: node {}: found no face with it, expected one", n));
  }
}

/// The face of each directed edge.
std::map<Edge, int32_t> directed_edges(const IndexMatrix& triangles) {
  std::map<Edge, int32_t> face_of;
  for (int32_t f = 0; f < triangles.rows(); ++f)
    for (int a = 0; a < 3; ++a) {
      const Edge edge{triangles(f, a), triangles(f, (a + 1) % 3)};
      const auto [other, first] = face_of.emplace(edge, f);
      if (!first)
        throw InputError(fmt::format(
            "surface: edge ({}, {}): found in the same direction in faces {} and {}, expected "
            "two faces with opposite directions",
            edge.first, edge.second, other->second, f));
    }
  for (const auto& [edge, f] : face_of)
    if (!face_of.contains({edge.second, edge.first}))
      throw InputError(
          fmt::format("surface: edge ({}, {}) of face {}: found no face on its other side, "
                      "expected a closed surface",
                      edge.first, edge.second, f));
  return face_of;
}

void measure_face(Surface& surface, Eigen::Index f) {
  const Eigen::Vector3d a = surface.nodes.row(surface.triangles(f, 0));
  const Eigen::Vector3d b = surface.nodes.row(surface.triangles(f, 1));
  const Eigen::Vector3d c = surface.nodes.row(surface.triangles(f, 2));
  const Eigen::Vector3d twice = (b - a).cross(c - a);
  const double longest =
      std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
  surface.longest_edge = std::max(surface.longest_edge, longest);
  // Flatter triangles have neither a normal nor shape functions that survive rounding.
  if (!(twice.norm() > 1e-6 * longest * longest))
    throw InputError(
        fmt::format("surface: face {}: found corners on a line (area {:.3g} m2), "
                    "expected a triangle",
                    f, 0.5 * twice.norm()));
  surface.face_area[f] = 0.5 * twice.norm();
  surface.face_normal.row(f) = twice.normalized();
  surface.face_centre.row(f) = (a + b + c) / 3.0;
}

/// Volume below a face, seen from `origin`.
double cone_volume(const Surface& surface, Eigen::Index f, const Eigen::Vector3d& origin) {
  return (surface.face_centre.row(f).transpose() - origin).dot(surface.face_normal.row(f)) *
         surface.face_area[f] / 3.0;
}

/// The smallest face of the shell of each face.
std::vector<int32_t> shells(const std::map<Edge, int32_t>& face_of, Eigen::Index n_faces) {
  std::vector<int32_t> root(static_cast<size_t>(n_faces));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int32_t f) {
    while (root[f] != f) {
      auto& up = root[f];
      f = up = root[up];
    }
    return f;
  };
  for (const auto& [edge, f] : face_of) {
    const int32_t a = find(f), b = find(face_of.at({edge.second, edge.first}));
    root[std::max(a, b)] = std::min(a, b);
  }
  for (int32_t f = 0; f < n_faces; ++f) root[f] = find(f);
  return root;
}

void check_volumes(const Surface& surface, const std::map<Edge, int32_t>& face_of) {
  const std::vector<int32_t> shell = shells(face_of, surface.face_count());
  std::map<int32_t, double> volumes;
  for (Eigen::Index f = 0; f < surface.face_count(); ++f)
    volumes[shell[f]] += cone_volume(surface, f, surface.middle);
  for (const auto& [face, volume] : volumes)
    if (!(volume > 0.0))
      throw InputError(fmt::format(
          "surface: the shell of face {}: found an enclosed volume of {:.4g} m3, expected faces "
          "that are outward, and no cavity",
          face, volume));
}

}  // namespace

Surface closed_surface(const RowMatrix& nodes, const IndexMatrix& triangles) {
  check_tables(nodes, triangles);
  const std::map<Edge, int32_t> face_of = directed_edges(triangles);
  Surface surface;
  surface.nodes = nodes;
  surface.triangles = triangles;
  surface.face_area.resize(triangles.rows());
  surface.face_normal.resize(triangles.rows(), 3);
  surface.face_centre.resize(triangles.rows(), 3);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) measure_face(surface, f);
  surface.area = surface.face_area.sum();
  surface.middle = 0.5 * (nodes.colwise().minCoeff() + nodes.colwise().maxCoeff()).transpose();
  surface.radius = (nodes.rowwise() - surface.middle.transpose()).rowwise().norm().maxCoeff();
  double squares = 0.0;
  for (const auto& [edge, f] : face_of)
    squares += (nodes.row(edge.first) - nodes.row(edge.second)).squaredNorm();
  surface.mean_edge = std::sqrt(squares / static_cast<double>(face_of.size()));
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    surface.volume += cone_volume(surface, f, surface.middle);
  check_volumes(surface, face_of);
  return surface;
}

double mesh_limit_hz(const Surface& surface, double sound_speed, double edges_per_wavelength) {
  return sound_speed / (edges_per_wavelength * surface.mean_edge);
}

double winding_number(const Surface& surface, const Eigen::Vector3d& point) {
  double half_angles = 0.0;
  for (Eigen::Index f = 0; f < surface.face_count(); ++f) {
    Eigen::Matrix3d to;  // columns: from the point to the corners
    for (int a = 0; a < 3; ++a)
      to.col(a) = surface.nodes.row(surface.triangles(f, a)).transpose() - point;
    const Eigen::Vector3d r = to.colwise().norm();
    const double below = r.prod() + to.col(0).dot(to.col(1)) * r[2] +
                         to.col(1).dot(to.col(2)) * r[0] + to.col(2).dot(to.col(0)) * r[1];
    half_angles += std::atan2(to.determinant(), below);
  }
  return half_angles / (2.0 * std::numbers::pi);
}

double distance_to_face(const Surface& surface, Eigen::Index face, const Eigen::Vector3d& point) {
  const Eigen::Vector3d normal = surface.face_normal.row(face);
  double nearest = std::numeric_limits<double>::infinity();
  bool above = true;  // the foot of the point is on the face
  for (int a = 0; a < 3; ++a) {
    const Eigen::Vector3d from = surface.nodes.row(surface.triangles(face, a));
    const Eigen::Vector3d along =
        surface.nodes.row(surface.triangles(face, (a + 1) % 3)).transpose() - from;
    const double at = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (point - from - at * along).norm());
    above = above && normal.cross(along).dot(point - from) >= 0.0;
  }
  if (!above) return nearest;
  return std::abs(normal.dot(point - surface.face_centre.row(face).transpose()));
}

double distance_to(const Surface& surface, const Eigen::Vector3d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (Eigen::Index f = 0; f < surface.face_count(); ++f)
    nearest = std::min(nearest, distance_to_face(surface, f, point));
  return nearest;
}

}  // namespace clatter::sound
