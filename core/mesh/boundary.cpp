// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/boundary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>
#include <set>

#include "core/base/error.hpp"
#include "core/mesh/cell_faces.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::mesh {
namespace {

// "cell 12 (tet10)"
std::string name_of(const Mesh& mesh, const FaceRef& face) {
  const CellBlock& block = mesh.cells[face.block];
  return fmt::format("cell {} ({})", cell_label(block, face.cell), traits(block.type).name);
}

std::vector<int32_t> corner_labels(const Mesh& mesh, const FaceKey& key) {
  std::vector<int32_t> labels;
  for (const int32_t node : key)
    if (node >= 0) labels.push_back(mesh.node_ids.empty() ? node : mesh.node_ids[node]);
  return labels;
}

/// A linear face and a quadratic one with only hanging mid-side nodes move alike.
bool linear_along_edges(const Mesh& mesh, const BoundaryFace& face) {
  const auto hanging = mesh.node_sets.find(kHangingMidSideNodes);
  if (hanging == mesh.node_sets.end()) return false;
  const auto mid_side_nodes = face.nodes().subspan(static_cast<size_t>(traits(face.type).corners));
  return std::all_of(mid_side_nodes.begin(), mid_side_nodes.end(), [&](int32_t node) {
    return std::binary_search(hanging->second.begin(), hanging->second.end(), node);
  });
}

bool is_linear(const Mesh& mesh, const FaceRef& face) {
  return traits(mesh.cells[face.block].type).order == 1;
}

void require_same_nodes(const Mesh& mesh, const FaceRef& a, const FaceRef& b) {
  const auto sorted = [&](const FaceRef& face) {
    std::array<int32_t, kMaxFaceNodes> ids = face_at(mesh, face).ids;
    std::sort(ids.begin(), ids.end());
    return ids;
  };
  if (sorted(a) == sorted(b)) return;
  const BoundaryFace one = face_at(mesh, a), other = face_at(mesh, b);
  if (one.type != other.type && linear_along_edges(mesh, one) && linear_along_edges(mesh, other))
    return;
  throw InputError(fmt::format(
      "mesh '{}': {} and {} share the face with corners {} but not its mid-side nodes, "
      "expected the same nodes on both sides",
      mesh.name, name_of(mesh, a), name_of(mesh, b), fmt::join(corner_labels(mesh, a.key), ", ")));
}

using FaceNodes = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMaxFaceNodes, 3>;

template <class Ids>
FaceNodes face_nodes(const Mesh& mesh, const Ids& ids) {
  FaceNodes x(static_cast<Eigen::Index>(ids.size()), 3);
  for (Eigen::Index i = 0; i < x.rows(); ++i) x.row(i) = mesh.nodes.row(ids[i]);
  return x;
}

std::span<const int32_t> row_of(const IndexMatrix& faces, Eigen::Index f) {
  return {faces.data() + f * faces.cols(), static_cast<size_t>(faces.cols())};
}

struct PointOnFace {
  Eigen::Vector3d x, normal;  // normal = dx/dl1 x dx/dl2, not scaled
};

PointOnFace evaluate(const FaceNodes& nodes, const FaceShape& shape) {
  const Eigen::Matrix<double, 3, 2> tangent = nodes.transpose() * shape.gradient;
  return {nodes.transpose() * shape.value, tangent.col(0).cross(tangent.col(1))};
}

void add_faces(const Mesh& mesh, const FaceBlock& block, const Eigen::Vector3d& about,
               SurfaceIntegrals& sum) {
  const FaceRule& rule = face_rule(block.type);
  std::vector<FaceShape> shapes;
  for (const auto& point : rule.points.rowwise())
    shapes.push_back(face_shape(block.type, point.transpose()));
  for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
    const FaceNodes nodes = face_nodes(mesh, row_of(block.nodes, f)).rowwise() - about.transpose();
    for (size_t q = 0; q < shapes.size(); ++q) {
      const PointOnFace p = evaluate(nodes, shapes[q]);
      const double weight = rule.weights(static_cast<Eigen::Index>(q));
      const double dS = weight * p.normal.norm();
      sum.area += dS;
      sum.centre += dS * (about + p.x);
      sum.normal += weight * p.normal;
      sum.enclosed += weight * p.x.dot(p.normal) / 3.0;
    }
  }
}

// Image, at the centre of a cell's face, of the outward direction of its reference cell. Where det
// J is positive it points out of the cell however curved that is; the direction from the mean of
// the corners need not.
Eigen::Vector3d outward_direction(const Mesh& mesh, const BoundaryFace& face) {
  const CellBlock& cells = mesh.cells[face.block];
  const auto reference = reference_nodes(cells.type);
  const auto cell = cells.nodes.row(face.cell);
  const int corners = traits(face.type).corners;
  Eigen::Vector3d face_centre = Eigen::Vector3d::Zero();
  for (const int32_t id : face.nodes().first(static_cast<size_t>(corners)))
    face_centre +=
        reference.row(std::find(cell.begin(), cell.end(), id) - cell.begin()).transpose();
  face_centre /= corners;
  const Eigen::Vector3d centre =
      reference.topRows(traits(cells.type).corners).colwise().mean().transpose();
  const Eigen::Matrix3d jacobian =
      cell_nodes(mesh, cells, face.cell).transpose() * cell_shape(cells.type, face_centre).gradient;
  return jacobian * (face_centre - centre);
}

}  // namespace

namespace {

/// Two cells of the same corners share all their faces, and hide them from the boundary.
void require_distinct(const Mesh& mesh, const FaceRef& a, const FaceRef& b) {
  const auto corners = [&](const FaceRef& face) {
    const CellBlock& block = mesh.cells[face.block];
    const auto row = block.nodes.row(face.cell);
    std::array<int32_t, 8> ids;
    ids.fill(-1);
    std::copy_n(row.begin(), traits(block.type).corners, ids.begin());
    return ids;
  };
  std::array<int32_t, 8> one = corners(a), other = corners(b);
  const auto sum = [](const auto& ids) {
    return std::accumulate(ids.begin(), ids.end(), int64_t{0});
  };
  if (sum(one) != sum(other)) return;
  std::sort(one.begin(), one.end());
  std::sort(other.begin(), other.end());
  if (one == other)
    throw InputError(
        fmt::format("mesh '{}': {} and {} have the same corners, expected each cell once",
                    mesh.name, name_of(mesh, a), name_of(mesh, b)));
}

}  // namespace

BoundaryFaces boundary_faces(const Mesh& mesh) {
  const std::vector<FaceRef> faces = all_faces(mesh);
  BoundaryFaces boundary;
  for_each_face(faces, [&](auto first, auto last) {
    for (auto next = first; next != last; ++next)
      for (auto other = first; other != next; ++other) require_distinct(mesh, *other, *next);
    if (last - first > 2)
      throw InputError(
          fmt::format("mesh '{}': the face with corners {} belongs to {} cells, "
                      "expected at most two: {}, {}, {}",
                      mesh.name, fmt::join(corner_labels(mesh, first->key), ", "), last - first,
                      name_of(mesh, first[0]), name_of(mesh, first[1]), name_of(mesh, first[2])));
    if (last - first == 1)
      boundary.emplace_hint(boundary.end(), first->key, face_at(mesh, *first));
    else if (!is_linear(mesh, first[0]) || !is_linear(mesh, first[1]))
      require_same_nodes(mesh, first[0], first[1]);
  });
  return boundary;
}

Surface skin_of(const BoundaryFaces& faces, const std::vector<ShellBlock>& shells) {
  SurfaceBuilder skin;
  for (const auto& [key, face] : faces) skin.add(face.type, face.ids);
  for (const ShellBlock& block : shells)
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c)
      skin.add(block.type, row_of(block.nodes, c));
  return skin.finish();
}

Surface shell_surface(const Mesh& mesh, int32_t region) {
  SurfaceBuilder surface;
  for (const ShellBlock& block : mesh.shells)
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c)
      if (region < 0 || block.region == region) surface.add(block.type, row_of(block.nodes, c));
  return surface.finish();
}

SurfaceIntegrals integrate(const Mesh& mesh, const Surface& surface, const Eigen::Vector3d& about) {
  SurfaceIntegrals sum;
  for (const FaceBlock& block : surface.faces) add_faces(mesh, block, about, sum);
  if (sum.area > 0.0) sum.centre /= sum.area;
  return sum;
}

double cell_volume(const Mesh& mesh, int32_t region) {
  double volume = 0.0;
  for (const CellBlock& block : mesh.cells) {
    if (region >= 0 && block.region != region) continue;
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const CellNodes x = cell_nodes(mesh, block, c);
      volume += volume_of(block.type, x.rowwise() - x.row(0));  // keeps digits (hard case F2)
    }
  }
  return volume;
}

int64_t count_inward(const Mesh& mesh, const Surface& skin) {
  const BoundaryFaces boundary = boundary_faces(mesh);
  std::set<FaceKey> shells;
  for (const ShellBlock& block : mesh.shells)
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c)
      shells.insert(face_key(block.type, row_of(block.nodes, c)));
  int64_t inward = 0;
  for (const FaceBlock& block : skin.faces) {
    const Eigen::Vector2d centre = traits(block.type).corners == 3
                                       ? Eigen::Vector2d::Constant(1.0 / 3.0)
                                       : Eigen::Vector2d::Zero();
    const FaceShape shape = face_shape(block.type, centre);
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
      const auto ids = row_of(block.nodes, f);
      const auto found = boundary.find(face_key(block.type, ids));
      if (found == boundary.end()) {
        inward += shells.contains(face_key(block.type, ids)) ? 0 : 1;
        continue;
      }
      const PointOnFace point = evaluate(face_nodes(mesh, ids), shape);
      if (!(point.normal.dot(outward_direction(mesh, found->second)) > 0.0)) ++inward;
    }
  }
  return inward;
}

}  // namespace clatter::mesh
