// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/stress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "core/fe/cell_strain.hpp"
#include "core/fe/element.hpp"

namespace clatter::fe {
namespace {

using mesh::CellBlock;
using mesh::CellNodes;
using mesh::CellType;

/// Sums over the cells of one region, by node of the model.
struct Sums {
  StressRows stress;
  Eigen::VectorXi cells;
};

/// Stresses at the corners of all cells of a block, one row of 6 x corners per cell.
RowMatrix corner_stress(const RowMatrix& nodes, const CellBlock& block, const Material& material,
                        const Eigen::VectorXd& u, const Eigen::VectorXd& dT) {
  const Eigen::MatrixXd& smoothing = stress_smoothing(block.type);
  const Eigen::Index n = block.nodes.cols(), corners = smoothing.rows();
  RowMatrix out(block.nodes.rows(), 6 * corners);
  parallel_pieces(block.nodes.rows(), [&](int64_t begin, int64_t end) {
    CellNodes x(n, 3);
    Eigen::VectorXd moved(3 * n), rise(dT.size() > 0 ? n : 0);
    for (Eigen::Index c = begin; c < end; ++c) {
      for (Eigen::Index a = 0; a < n; ++a) {
        const int32_t node = block.nodes(c, a);
        x.row(a) = nodes.row(node);
        moved.segment<3>(3 * a) = u.segment<3>(3 * node);
        if (rise.size() > 0) rise(a) = dT(node);
      }
      Eigen::Map<StressRows>(out.row(c).data(), corners, 6).noalias() =
          smoothing * point_stress(block.type, stress_points(block.type), x, material, moved, rise);
    }
  });
  return out;
}

void add_block(const CellBlock& block, const RowMatrix& corner_values, Sums& sums) {
  const mesh::CellTraits& cell = mesh::traits(block.type);
  for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
    const Eigen::Map<const StressRows> corner(corner_values.row(c).data(), cell.corners, 6);
    for (Eigen::Index a = 0; a < cell.nodes; ++a) {
      const int32_t node = block.nodes(c, a);
      ++sums.cells(node);
      if (a < cell.corners) {
        sums.stress.row(node) += corner.row(a);
      } else {
        const auto [i, j] = cell.edges[a - cell.corners];
        sums.stress.row(node) += 0.5 * (corner.row(i) + corner.row(j));
      }
    }
  }
}

RegionStress mean_of(const Sums& sums) {
  RegionStress out;
  for (Eigen::Index a = 0; a < sums.cells.size(); ++a)
    if (sums.cells(a) > 0) out.nodes.push_back(static_cast<int32_t>(a));
  const auto n = static_cast<Eigen::Index>(out.nodes.size());
  out.stress.resize(n, 6);
  out.von_mises.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const int32_t node = out.nodes[k];
    out.stress.row(k) = sums.stress.row(node) / sums.cells(node);
    out.von_mises(k) = von_mises(out.stress.row(k).transpose());
  }
  return out;
}

}  // namespace

double von_mises(const Voigt& s) {
  const Eigen::Vector3d apart(s(0) - s(1), s(1) - s(2), s(2) - s(0));
  return std::sqrt(0.5 * apart.squaredNorm() + 3.0 * s.tail<3>().squaredNorm());
}

StressRows point_stress(CellType type, const CellPoints& points, const CellNodes& x,
                        const Material& material, const Eigen::VectorXd& u,
                        const Eigen::VectorXd& dT) {
  const CellModes modes(x, has_incompatible_modes(type, material.integration));
  const Eigen::VectorXd all = with_inner_modes(type, x, material, u, dT);
  StressRows out(static_cast<Eigen::Index>(points.size()), 6);
  ModeGradient gradient;
  for (Eigen::Index q = 0; q < out.rows(); ++q) {
    const CellPoint& point = points[q];
    const Eigen::Vector3d position = x.transpose() * point.shape.value;
    if (const double det = modes.at(point, gradient); !(det > 0.0))
      throw InputError(fmt::format(
          "stress at ({:.6g}, {:.6g}, {:.6g}) m: found det J = {:.3g}, expected > 0 (inverted "
          "cell)",
          position(0), position(1), position(2), det));
    Voigt strain = strain_matrix(gradient) * all;
    if (dT.size() > 0) strain -= point.shape.value.dot(dT) * material.expansion_at(position);
    out.row(q) = (material.elasticity_at(position) * strain).transpose();
  }
  return out;
}

std::vector<RegionStress> nodal_stress(const RowMatrix& nodes, const FeCells& cells,
                                       const Eigen::VectorXd& u, const Eigen::VectorXd& dT) {
  std::vector<RegionStress> out;
  for (size_t r = 0; r < cells.regions.size(); ++r) {
    if (std::ranges::none_of(cells.blocks, [&](const CellBlock& block) {
          return static_cast<size_t>(block.region) == r;
        }))
      continue;
    Sums sums{StressRows::Zero(nodes.rows(), 6), Eigen::VectorXi::Zero(nodes.rows())};
    for (const CellBlock& block : cells.blocks)
      if (static_cast<size_t>(block.region) == r)
        add_block(block, corner_stress(nodes, block, cells.materials[r], u, dT), sums);
    out.push_back(mean_of(sums));
    out.back().name = cells.regions[r];
  }
  return out;
}

}  // namespace clatter::fe
