// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/poor_cell_effect.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/mesh/boundary.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::mesh {
namespace {

constexpr int kFields = 6;
using Fields = Eigen::Matrix<double, Eigen::Dynamic, kFields>;

// The quadrature rules of assembly for curved cells, with the same errors.
const CellRule& rule_of(CellType type) {
  switch (type) {
    case CellType::kTet10:
      return tet_rule_14();
    case CellType::kHex20:
      return hex_rule(3);
    case CellType::kWedge15:
      return wedge_rule(6, 3);
    case CellType::kPyramid13:
      return pyramid_rule(4);
    default:
      return fine_rule(type);
  }
}

// q at x, or its derivative along `d` (three rows: its gradient).
Eigen::Matrix<double, 1, kFields> values_at(const Eigen::Vector3d& x) {
  constexpr double s = 1.0 / std::numbers::sqrt2;
  Eigen::Matrix<double, 1, kFields> q;
  q << 0.5 * x[0] * x[0], 0.5 * x[1] * x[1], 0.5 * x[2] * x[2], s * x[0] * x[1], s * x[0] * x[2],
      s * x[1] * x[2];
  return q;
}

Eigen::Matrix<double, 3, kFields> gradients_at(const Eigen::Vector3d& x) {
  constexpr double s = 1.0 / std::numbers::sqrt2;
  Eigen::Matrix<double, 3, kFields> g;
  g << x[0], 0.0, 0.0, s * x[1], s * x[2], 0.0,  //
      0.0, x[1], 0.0, s * x[0], 0.0, s * x[2],   //
      0.0, 0.0, x[2], 0.0, s * x[0], s * x[1];
  return g;
}

/// The nodes of poor cells and the cells around them.
struct Region {
  std::vector<int32_t> number;   // by node: index of its unknown, -1 for the others
  std::vector<CellIndex> cells;  // with at least one such node
  Eigen::Index unknowns = 0;
  Eigen::Vector3d origin;  // nearby: avoids cancellation
};

Region region_of(const Mesh& mesh, const std::vector<CellIndex>& poor) {
  Region region;
  region.number.assign(mesh.nodes.rows(), -1);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [b, c] : poor)
    for (const int32_t node : mesh.cells[b].nodes.row(c)) {
      int32_t& number = region.number[node];
      if (number >= 0) continue;
      number = static_cast<int32_t>(region.unknowns++);
      sum += mesh.nodes.row(node).transpose();
    }
  region.origin = sum / static_cast<double>(region.unknowns);
  for (size_t b = 0; b < mesh.cells.size(); ++b) {
    const IndexMatrix& nodes = mesh.cells[b].nodes;
    for (Eigen::Index c = 0; c < nodes.rows(); ++c)
      if (std::any_of(nodes.row(c).begin(), nodes.row(c).end(),
                      [&](int32_t node) { return region.number[node] >= 0; }))
        region.cells.emplace_back(static_cast<int32_t>(b), static_cast<int32_t>(c));
  }
  return region;
}

/// The least-squares problem: unknown is q_h - q at the nodes, so that fixed nodes are 0.
class BestFit {
 public:
  explicit BestFit(const Region& region) : region_(region) {
    load_ = Fields::Zero(region.unknowns, kFields);
  }

  void add(const Mesh& mesh, const CellIndex& index) {
    const CellBlock& block = mesh.cells[index.first];
    CellNodes x = cell_nodes(mesh, block, index.second);
    x.rowwise() -= region_.origin.transpose();
    Fields nodal(x.rows(), kFields);
    for (Eigen::Index i = 0; i < x.rows(); ++i) nodal.row(i) = values_at(x.row(i).transpose());
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(x.rows(), x.rows());
    Fields load = Fields::Zero(x.rows(), kFields);
    const CellRule& rule = rule_of(block.type);
    for (Eigen::Index p = 0; p < rule.weights.size(); ++p) {
      const CellShape shape = cell_shape(block.type, rule.points.row(p).transpose());
      const Eigen::Matrix3d jacobian = x.transpose() * shape.gradient;  // dx_i / dxi_j
      const double weight = rule.weights[p] * jacobian.determinant();
      const Eigen::Matrix<double, Eigen::Dynamic, 3> gradient = shape.gradient * jacobian.inverse();
      const Eigen::Vector3d here = x.transpose() * shape.value;
      // Error of the interpolation: grad q - grad of sum N_i q(x_i).
      const Eigen::Matrix<double, 3, kFields> error =
          gradients_at(here) - gradient.transpose() * nodal;
      stiffness += weight * gradient * gradient.transpose();
      load += weight * gradient * error;
      interpolation_ += weight * error.colwise().squaredNorm();
    }
    scatter(block.nodes.row(index.second), stiffness, load);
  }

  /// X(q) of each field.
  Eigen::Matrix<double, 1, kFields> excess() const {
    Eigen::SparseMatrix<double> matrix(region_.unknowns, region_.unknowns);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    if (factor.info() != Eigen::Success) return interpolation_;  // an upper bound
    const Fields correction = factor.solve(load_);
    const Eigen::Matrix<double, 1, kFields> gain = load_.cwiseProduct(correction).colwise().sum();
    return (interpolation_ - gain).cwiseMax(0.0).cwiseMin(interpolation_);
  }

 private:
  template <class Nodes>
  void scatter(const Nodes& nodes, const Eigen::MatrixXd& stiffness, const Fields& load) {
    for (Eigen::Index i = 0; i < nodes.size(); ++i) {
      const int32_t row = region_.number[nodes[i]];
      if (row < 0) continue;
      load_.row(row) += load.row(i);
      for (Eigen::Index j = 0; j < nodes.size(); ++j) {
        const int32_t column = region_.number[nodes[j]];
        if (column >= 0 && column <= row) entries_.emplace_back(row, column, stiffness(i, j));
      }
      // If every node is free q_h is known up to a constant; this fixes it.
      entries_.emplace_back(row, row, 1e-12 * stiffness(i, i));
    }
  }

  const Region& region_;
  std::vector<Eigen::Triplet<double>> entries_;
  Fields load_;
  Eigen::Matrix<double, 1, kFields> interpolation_ = Eigen::Matrix<double, 1, kFields>::Zero();
};

}  // namespace

double frequency_effect(const Mesh& mesh, const std::vector<CellIndex>& poor) {
  constexpr double kBending = 3.0;  // |grad grad u|^2 of a bent wall over its curvature squared
  std::vector<CellIndex> looked_at;
  const size_t step = poor.size() / kMostPoorCells + 1;
  for (size_t i = 0; i < poor.size(); i += step)
    if (traits(mesh.cells[poor[i].first].type).order > 1) looked_at.push_back(poor[i]);
  if (looked_at.empty()) return 0.0;
  const Region region = region_of(mesh, looked_at);
  BestFit fit(region);
  for (const CellIndex& index : region.cells) fit.add(mesh, index);
  const double volume = cell_volume(mesh);
  const double thickness = 2.0 * volume / integrate(mesh, mesh.surface("skin")).area;
  const double stiffer = kBending * static_cast<double>(step) * fit.excess().mean() /
                         (volume * thickness * thickness / 12.0);
  return std::sqrt(1.0 + stiffer) - 1.0;
}

}  // namespace clatter::mesh
