// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/shell_directors.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/mesh/shape.hpp"

namespace clatter::fe {
namespace {

constexpr double kRounding = 1e-6;  // of decks with seven digits

/// A node of a cell.
struct Corner {
  int32_t block, cell, node;
};

/// Unit normals of the cells at their nodes, rows and columns as the directors.
RowMatrix cell_normals(const RowMatrix& nodes, const mesh::ShellBlock& block) {
  const Eigen::Index n = block.nodes.cols();
  std::vector<mesh::FaceShape> shapes;
  const Eigen::MatrixX2d reference = mesh::reference_nodes(block.type);
  for (Eigen::Index i = 0; i < n; ++i)
    shapes.push_back(mesh::face_shape(block.type, reference.row(i).transpose()));
  RowMatrix out(block.nodes.rows(), 3 * n);
  for (Eigen::Index c = 0; c < block.nodes.rows(); ++c)
    for (Eigen::Index i = 0; i < n; ++i) {
      Eigen::Matrix<double, 3, 2> tangent = Eigen::Matrix<double, 3, 2>::Zero();
      // From the first node: far from the origin differences of positions would lose digits.
      for (Eigen::Index k = 1; k < n; ++k)
        tangent += (nodes.row(block.nodes(c, k)) - nodes.row(block.nodes(c, 0))).transpose() *
                   shapes[i].gradient.row(k);
      const Eigen::Vector3d normal = tangent.col(0).cross(tangent.col(1));
      out.row(c).segment<3>(3 * i) = (normal / normal.norm()).transpose();
    }
  return out;
}

/// Corners by node: those of node k are rows first[k] to first[k + 1], in the order of the blocks.
struct CornersOfNodes {
  std::vector<int64_t> first;
  std::vector<Corner> corners;
};

CornersOfNodes corners_of_nodes(Eigen::Index n_nodes, const std::vector<mesh::ShellBlock>& shells) {
  CornersOfNodes out;
  out.first.assign(n_nodes + 1, 0);
  for (const mesh::ShellBlock& block : shells)
    for (const int32_t node : block.nodes.reshaped()) ++out.first[node + 1];
  for (Eigen::Index k = 0; k < n_nodes; ++k) out.first[k + 1] += out.first[k];
  out.corners.resize(out.first.back());
  std::vector<int64_t> next(out.first.begin(), out.first.end() - 1);
  for (int32_t b = 0; b < static_cast<int32_t>(shells.size()); ++b)
    for (int32_t c = 0; c < shells[b].nodes.rows(); ++c)
      for (int32_t i = 0; i < shells[b].nodes.cols(); ++i)
        out.corners[next[shells[b].nodes(c, i)]++] = {b, c, i};
  return out;
}

}  // namespace

std::vector<RowMatrix> shell_directors(const RowMatrix& nodes,
                                       const std::vector<mesh::ShellBlock>& shells) {
  const double fold = std::cos(20.0 * std::numbers::pi / 180.0);
  std::vector<RowMatrix> normals;
  for (const mesh::ShellBlock& block : shells) normals.push_back(cell_normals(nodes, block));
  const CornersOfNodes by_node = corners_of_nodes(nodes.rows(), shells);
  const auto normal_at = [&](const Corner& corner) -> Eigen::Vector3d {
    return normals[corner.block].row(corner.cell).segment<3>(3 * corner.node).transpose();
  };
  std::vector<RowMatrix> out = normals;
  for (Eigen::Index k = 0; k < nodes.rows(); ++k)
    for (int64_t a = by_node.first[k]; a < by_node.first[k + 1]; ++a) {
      const Corner& own = by_node.corners[a];
      const Eigen::Vector3d normal = normal_at(own);
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (int64_t b = by_node.first[k]; b < by_node.first[k + 1]; ++b) {
        const Eigen::Vector3d other = normal_at(by_node.corners[b]);
        const double cosine = normal.dot(other);
        if (std::abs(cosine) > fold) sum += cosine > 0.0 ? other : Eigen::Vector3d(-other);
      }
      sum /= sum.norm();
      out[own.block].row(own.cell).segment<3>(3 * own.node) =
          (sum.array().abs() < kRounding).select(0.0, sum).transpose();
    }
  return out;
}

}  // namespace clatter::fe
