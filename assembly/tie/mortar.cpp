// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/tie/mortar.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "assembly/tie/clip.hpp"
#include "assembly/tie/face_search.hpp"
#include "core/mesh/quadrature.hpp"

namespace clatter::assembly {
namespace {

constexpr double kShift = 0.2;         // a of the modified basis
constexpr double kLeastCover = 0.1;    // of a face
constexpr double kLeastWeight = 0.05;  // of a node
constexpr double kLeastPiece = 1e-12;  // of a facet's area: rounding at a common edge
constexpr double kFacing = -0.1;       // cosine between the normals: above it they are not opposite
constexpr double kNoCoefficient = 1e-13;  // rounding of coefficients of order one

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1>;

/// S of N^ = S N; the identity on linear faces.
Small modified_basis(mesh::FaceType type) {
  const mesh::FaceTraits& traits = mesh::traits(type);
  Small S = Small::Identity(traits.nodes, traits.nodes);
  if (traits.order == 1) return S;
  for (int e = 0; e < traits.corners; ++e) {  // mid-side node of corners e and e + 1
    const int middle = traits.corners + e;
    S(e, middle) = S((e + 1) % traits.corners, middle) = kShift;
    S(middle, middle) = 1.0 - 2.0 * kShift;
  }
  return S;
}

/// int N^ dA over an entire face; its area in `area`.
SmallVector full_weights(const TieFace& face, const Small& S, double& area) {
  SmallVector sum = SmallVector::Zero(face.size());
  const mesh::FaceRule& rule = mesh::face_rule(face.type);
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const mesh::FaceShape shape = mesh::face_shape(face.type, rule.points.row(q).transpose());
    const Eigen::Matrix<double, 3, 2> tangent = face.x.transpose() * shape.gradient;
    sum += rule.weights(q) * tangent.col(0).cross(tangent.col(1)).norm() * shape.value;
  }
  area = sum.sum();
  return S * sum;
}

/// The integrals of one slave face over its covered parts.
struct FaceIntegrals {
  Small gram;                               // int N^ N^T dA
  std::map<int32_t, SmallVector> coupling;  // master node k: int N^ N_k dA
  double area = 0.0;
};

/// Integrates over all covered parts of a slave face.
class Integrator {
 public:
  Integrator(const std::vector<TieFace>& master, double distance, Projection& out)
      : master_(master), distance_(distance), search_(master, distance), out_(out) {}

  FaceIntegrals integrate(const TieFace& slave, const Small& S) {
    FaceIntegrals sums;
    sums.gram = Small::Zero(slave.size(), slave.size());
    Eigen::AlignedBox3d box = box_of(slave);
    const std::vector<int32_t> near = search_.near(box);
    for (const Facet& facet : facets_of(slave.type)) {
      const Plane plane = plane_of(slave, facet);
      const Polygon subject = polygon_of(slave, facet, plane);
      for (const int32_t m : near)
        for (const Facet& other : facets_of(master_[m].type))
          add_pair(slave, S, plane, subject, master_[m], other, sums);
    }
    return sums;
  }

 private:
  static Polygon polygon_of(const TieFace& face, const Facet& facet, const Plane& plane) {
    Polygon polygon;
    for (int k = 0; k < facet.size; ++k)
      polygon.push_back(plane.project(face.x.row(facet.corners[k]).transpose()));
    return polygon;
  }

  void add_pair(const TieFace& slave, const Small& S, const Plane& plane, const Polygon& subject,
                const TieFace& master, const Facet& facet, FaceIntegrals& sums) {
    if (plane_of(master, facet).normal.dot(plane.normal) > kFacing) return;
    Polygon window = polygon_of(master, facet, plane);
    std::reverse(window.begin(), window.end());  // the faces are opposite
    const Polygon piece = clip(subject, window);
    if (signed_area(piece) <= kLeastPiece * signed_area(subject)) return;
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& corner : piece)
      centre += corner / static_cast<double>(piece.size());
    double gap = 0.0;
    mesh::FaceShape on_slave, on_master;
    if (!shapes_at(slave, master, plane, centre, on_slave, on_master, gap)) return;
    if (std::abs(gap) > distance_) return;
    out_.largest_gap = std::max(out_.largest_gap, std::abs(gap));
    for (size_t k = 0; k < piece.size(); ++k)
      add_triangle(slave, S, plane, centre, piece[k], piece[(k + 1) % piece.size()], master, sums);
  }

  /// Shape functions of both faces on the plane's normal through a point.
  static bool shapes_at(const TieFace& slave, const TieFace& master, const Plane& plane,
                        const Eigen::Vector2d& at, mesh::FaceShape& on_slave,
                        mesh::FaceShape& on_master, double& gap) {
    Eigen::Vector2d xi = reference_centre(slave.type), eta = reference_centre(master.type);
    if (!find_reference(slave, plane, at, xi) || !find_reference(master, plane, at, eta))
      return false;
    on_slave = mesh::face_shape(slave.type, xi);
    on_master = mesh::face_shape(master.type, eta);
    const Eigen::Vector3d apart =
        master.x.transpose() * on_master.value - slave.x.transpose() * on_slave.value;
    gap = plane.normal.dot(apart);
    return true;
  }

  static void add_triangle(const TieFace& slave, const Small& S, const Plane& plane,
                           const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                           const Eigen::Vector2d& c, const TieFace& master, FaceIntegrals& sums) {
    const double det = signed_area({a, b, c}) * 2.0;
    if (!(det > 0.0)) return;
    const mesh::FaceRule& rule = mesh::triangle_rule_16();
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d at = a + rule.points(q, 0) * (b - a) + rule.points(q, 1) * (c - a);
      mesh::FaceShape on_slave, on_master;
      double gap = 0.0;
      if (!shapes_at(slave, master, plane, at, on_slave, on_master, gap)) continue;
      const double weight = det * rule.weights(q);
      const SmallVector value = S * on_slave.value;
      sums.gram += weight * value * value.transpose();
      sums.area += weight;
      for (int k = 0; k < master.size(); ++k) {
        SmallVector& sum = sums.coupling[master.nodes[k]];
        if (sum.size() == 0) sum = SmallVector::Zero(value.size());
        sum += weight * on_master.value(k) * value;
      }
    }
  }

  const std::vector<TieFace>& master_;
  double distance_;
  FaceSearch search_;
  Projection& out_;
};

/// Rows of all slave nodes in the modified basis.
struct NodeSums {
  double full = 0.0;                       // int N^_j dA over all slave faces
  double weight = 0.0;                     // D_jj, over what is covered
  std::map<int32_t, double> on;            // M_jk
  std::array<int32_t, 2> ends = {-1, -1};  // corners adjacent to a mid-side node
};

void add_face(const TieFace& face, const FaceIntegrals& integrals,
              std::map<int32_t, NodeSums>& sums) {
  // gram of 1: the weights of the face, so that duals sum to one exactly.
  const SmallVector weights = integrals.gram * SmallVector::Ones(face.size());
  const Eigen::LDLT<Small> factor(integrals.gram);
  for (const auto& [k, column] : integrals.coupling) {
    const SmallVector dual = weights.asDiagonal() * factor.solve(column).eval();
    for (int j = 0; j < face.size(); ++j) sums[face.nodes[j]].on[k] += dual(j);
  }
  for (int j = 0; j < face.size(); ++j) sums[face.nodes[j]].weight += weights(j);
}

void note_ends(const TieFace& face, std::map<int32_t, NodeSums>& sums) {
  const mesh::FaceTraits& traits = mesh::traits(face.type);
  for (int e = 0; traits.order == 2 && e < traits.corners; ++e)
    sums[face.nodes[traits.corners + e]].ends = {face.nodes[e],
                                                 face.nodes[(e + 1) % traits.corners]};
}

bool is_tied(const NodeSums& sums) { return sums.weight > kLeastWeight * sums.full; }

/// row += share * u^ of a node: its projection, or the node itself where it is not tied.
void add_share(double share, int32_t node, const NodeSums& sums, ProjectedNode& row) {
  if (!is_tied(sums)) {
    row.on[node] += share;
    row.jump -= share;
    return;
  }
  for (const auto& [k, value] : sums.on) row.on[k] += share * value / sums.weight;
}

ProjectedNode row_of(int32_t node, const std::map<int32_t, NodeSums>& all) {
  const NodeSums& own = all.at(node);
  ProjectedNode row;
  row.node = node;
  if (own.ends[0] < 0) {
    add_share(1.0, node, own, row);
  } else {
    add_share(1.0 - 2.0 * kShift, node, own, row);
    for (const int32_t end : own.ends) add_share(kShift, end, all.at(end), row);
  }
  for (const auto& [k, value] : row.on) row.around.push_back(k);
  std::erase_if(row.on, [](const auto& entry) { return std::abs(entry.second) < kNoCoefficient; });
  return row;
}

}  // namespace

double mean_size(const std::vector<TieFace>& faces) {
  double total = 0.0;
  for (const TieFace& face : faces) {
    double area = 0.0;
    full_weights(face, modified_basis(face.type), area);
    total += area;
  }
  return std::sqrt(total / static_cast<double>(std::max<size_t>(1, faces.size())));
}

Projection project(const std::vector<TieFace>& slave, const std::vector<TieFace>& master,
                   double distance) {
  Projection out;
  Integrator integrator(master, distance, out);
  std::map<int32_t, NodeSums> sums;
  for (const TieFace& face : slave) {
    const Small S = modified_basis(face.type);
    double area = 0.0;
    const SmallVector full = full_weights(face, S, area);
    for (int j = 0; j < face.size(); ++j) sums[face.nodes[j]].full += full(j);
    note_ends(face, sums);
    out.slave_area += area;
    const FaceIntegrals integrals = integrator.integrate(face, S);
    if (integrals.area < kLeastCover * area) continue;
    out.covered += integrals.area;
    add_face(face, integrals, sums);
  }
  for (const auto& [node, own] : sums) {
    if (is_tied(own))
      out.tied.push_back(row_of(node, sums));
    else
      out.untied.push_back(node);
  }
  return out;
}

}  // namespace clatter::assembly
