// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nearest_face.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/mesh/shape.hpp"

namespace clatter::mesh::deck {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMaxFaceNodes, 3>;

constexpr int kIterations = 30;
constexpr double kConverged = 1e-12;  // of the reference face
constexpr double kInside = 1e-9;
constexpr double kMostBoxes = 1e3, kFarthest = 1e15;

Positions positions_of(const NodeFace& face, const RowMatrix& nodes) {
  Positions x(traits(face.type).nodes, 3);
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    x.row(i) = nodes.row(face.nodes[static_cast<size_t>(i)]);
  return x;
}

bool is_inside(FaceType type, const Vector2d& at) {
  if (traits(type).corners == 3) return at.minCoeff() >= -kInside && at.sum() <= 1.0 + kInside;
  return at.cwiseAbs().maxCoeff() <= 1.0 + kInside;
}

/// Where the line from a face to the point is normal to it, by the method of Gauss and Newton.
Vector2d foot_of(FaceType type, const Positions& x, const Vector3d& point) {
  Vector2d at = traits(type).corners == 3 ? Vector2d::Constant(1.0 / 3.0) : Vector2d::Zero();
  for (int i = 0; i < kIterations; ++i) {
    const FaceShape shape = face_shape(type, at);
    const Eigen::Matrix<double, 3, 2> tangent = x.transpose() * shape.gradient;
    const Vector3d beside = point - x.transpose() * shape.value;
    const Vector2d step =
        (tangent.transpose() * tangent).inverse() * (tangent.transpose() * beside);
    if (!step.allFinite()) break;
    at += step.cwiseMax(-1.0).cwiseMin(1.0);
    if (step.norm() < kConverged) break;
  }
  return at;
}

/// The nearest point of the edge from one point of the reference face to another.
Vector2d foot_on_edge(FaceType type, const Positions& x, const Vector3d& point, const Vector2d& a,
                      const Vector2d& b) {
  double t = 0.5;
  for (int i = 0; i < kIterations; ++i) {
    const FaceShape shape = face_shape(type, a + t * (b - a));
    const Vector3d along = x.transpose() * (shape.gradient * (b - a));
    const double step =
        along.dot(point - x.transpose() * shape.value) / std::max(along.squaredNorm(), 1e-300);
    const double next = std::clamp(t + step, 0.0, 1.0);
    if (std::abs(next - t) < kConverged) break;
    t = next;
  }
  return a + t * (b - a);
}

}  // namespace

FacePoint nearest_point(const NodeFace& face, const RowMatrix& nodes, const Vector3d& point) {
  const Positions x = positions_of(face, nodes);
  const auto position = [&](const Vector2d& at) {
    return Vector3d(x.transpose() * face_shape(face.type, at).value);
  };
  FacePoint best;
  best.face = face;
  best.at = foot_of(face.type, x, point);
  if (!is_inside(face.type, best.at)) {
    const Eigen::MatrixX2d corners = reference_nodes(face.type).topRows(traits(face.type).corners);
    double least = -1.0;
    for (Eigen::Index i = 0; i < corners.rows(); ++i) {
      const Vector2d at =
          foot_on_edge(face.type, x, point, corners.row(i), corners.row((i + 1) % corners.rows()));
      const double distance = (position(at) - point).norm();
      if (least >= 0.0 && distance >= least) continue;
      least = distance;
      best.at = at;
    }
  }
  best.x = position(best.at);
  best.distance = (best.x - point).norm();
  const Eigen::Matrix<double, 3, 2> tangent =
      x.transpose() * face_shape(face.type, best.at).gradient;
  best.normal = tangent.col(0).cross(tangent.col(1)).normalized();
  return best;
}

ShellSearch::ShellSearch(const Mesh& mesh) : mesh_(mesh) {
  int64_t count = 0;
  const auto for_each = [&](const auto& visit) {
    for (size_t b = 0; b < mesh.shells.size(); ++b)
      for (Eigen::Index c = 0; c < mesh.shells[b].nodes.rows(); ++c) {
        const RowMatrix x = mesh.nodes(mesh.shells[b].nodes.row(c), Eigen::all);
        visit(b, c, Vector3d(x.colwise().minCoeff()), Vector3d(x.colwise().maxCoeff()));
      }
  };
  for_each([&](size_t, Eigen::Index, const Vector3d& low, const Vector3d& high) {
    size_ += (high - low).norm();
    ++count;
  });
  if (count == 0) return;
  size_ /= static_cast<double>(count);
  for_each([&](size_t b, Eigen::Index c, const Vector3d& low, const Vector3d& high) {
    const Box first = box_of(low), last = box_of(high);
    if (!(boxes_between(first, last) <= kMostBoxes)) return large_.push_back({b, c});
    for (int64_t i = first[0]; i <= last[0]; ++i)
      for (int64_t j = first[1]; j <= last[1]; ++j)
        for (int64_t k = first[2]; k <= last[2]; ++k) cells_[{i, j, k}].push_back({b, c});
  });
}

ShellSearch::Box ShellSearch::box_of(const Vector3d& at) const {
  Box box{};
  for (size_t d = 0; d < 3; ++d)
    box[d] = static_cast<int64_t>(
        std::floor(std::clamp(at[static_cast<Eigen::Index>(d)] / size_, -kFarthest, kFarthest)));
  return box;
}

double ShellSearch::boxes_between(const Box& first, const Box& last) {
  double boxes = 1.0;
  for (size_t d = 0; d < 3; ++d) boxes *= static_cast<double>(last[d] - first[d] + 1);
  return boxes;
}

std::optional<FacePoint> ShellSearch::nearest(
    const Vector3d& point, double reach,
    const std::function<bool(size_t block, Eigen::Index row)>& takes) const {
  std::optional<FacePoint> best;
  if (!(size_ > 0.0)) return best;
  const auto look_at = [&](const std::vector<Cell>& cells) {
    for (const Cell& cell : cells) {
      if (!takes(cell.block, cell.row)) continue;
      const ShellBlock& block = mesh_.shells[cell.block];
      NodeFace face{block.type, {}};
      std::ranges::copy(block.nodes.row(cell.row), face.nodes.begin());
      const FacePoint found = nearest_point(face, mesh_.nodes, point);
      if (!(found.distance <= reach) || (best && found.distance >= best->distance)) continue;
      best = found;
      best->block = cell.block;
      best->row = cell.row;
    }
  };
  look_at(large_);
  const Vector3d around = Vector3d::Constant(reach);
  const Box first = box_of(point - around), last = box_of(point + around);
  if (!(boxes_between(first, last) < static_cast<double>(cells_.size()))) {
    for (const auto& [box, cells] : cells_) look_at(cells);
    return best;
  }
  for (int64_t i = first[0]; i <= last[0]; ++i)
    for (int64_t j = first[1]; j <= last[1]; ++j)
      for (auto at = cells_.lower_bound({i, j, first[2]});
           at != cells_.end() && at->first <= Box{i, j, last[2]}; ++at)
        look_at(at->second);
  return best;
}

}  // namespace clatter::mesh::deck
