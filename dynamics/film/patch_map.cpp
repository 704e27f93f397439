// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "dynamics/film/gap.hpp"

namespace clatter::film {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double wrap(double angle) {
  const double rest = std::fmod(angle, kTurn);
  return rest < 0.0 ? rest + kTurn : rest;
}

void require_points(const Eigen::VectorXd& values, const char* what) {
  if (values.size() < 1)
    throw InputError(fmt::format("{}: found no points, expected at least one", what));
  for (Eigen::Index k = 1; k < values.size(); ++k)
    if (!(values[k] > values[k - 1]))
      throw InputError(fmt::format("{}: point {} is {} after {}, expected ascending values", what,
                                   k, values[k], values[k - 1]));
}

// The strip centres as pad angles of a grid, and which strips are adjacent to the next one.
struct Strips {
  Eigen::VectorXd angles;
  std::vector<char> neighbours;
};

Strips strips_of(const rom::ContactGrid& grid) {
  const Eigen::Index n = grid.angle.size();
  Strips strips{grid.angle, std::vector<char>(static_cast<size_t>(n), 0)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index next = (i + 1) % n;
    if (grid.angle_edges.size() != 2 * n) continue;
    const double width = grid.angle_edges[2 * i + 1] - grid.angle_edges[2 * i];
    const double space = wrap(grid.angle_edges[2 * next] - grid.angle_edges[2 * i + 1] + 1e-9);
    strips.neighbours[static_cast<size_t>(i)] = n > 1 && space < 0.5 * width;
  }
  return strips;
}

CylinderStencil stencil_of(const rom::ContactGrid& grid) {
  const Strips strips = strips_of(grid);
  return CylinderStencil(strips.angles, strips.neighbours, grid.axial);
}

}  // namespace

CylinderStencil::CylinderStencil(Eigen::VectorXd angles, std::vector<char> neighbours,
                                 Eigen::VectorXd axials)
    : angles_(std::move(angles)), axials_(std::move(axials)), neighbours_(std::move(neighbours)) {
  require_points(angles_, "angles of a cylinder grid");
  require_points(axials_, "axial points of a cylinder grid");
}

CylinderStencil::Angular CylinderStencil::at_angle(double angle) const {
  const int n = static_cast<int>(angles_.size());
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    const double step = n > 1 ? wrap(angles_[next] - angles_[i]) : kTurn;
    const double past = wrap(angle - angles_[i]);
    if (past > step) continue;
    if (neighbours_[static_cast<size_t>(i)]) return {i, next, past / step};
    const int nearest = past < 0.5 * step ? i : next;
    return {nearest, nearest, 0.0};
  }
  return {0, 0, 0.0};
}

CylinderStencil::Axial CylinderStencil::at_axial(double axial) const {
  const int n = static_cast<int>(axials_.size());
  if (axial <= axials_[0]) return {0, 0, 0.0, 0.0};
  if (axial >= axials_[n - 1]) return {n - 1, n - 1, 0.0, 0.0};
  int k = 1;
  while (axials_[k] < axial) ++k;
  const double step = axials_[k] - axials_[k - 1];
  return {k - 1, k, (axial - axials_[k - 1]) / step, 1.0 / step};
}

PatchMap::PatchMap(const ElasticSurface& surface, const PadGrid& pad)
    : pad_(pad), stencil_(stencil_of(surface.grid)) {
  const rom::ContactGrid& grid = surface.grid;
  const int n_a = static_cast<int>(grid.angle.size()), n_z = static_cast<int>(grid.axial.size());
  if (std::abs(std::abs(grid.axis.z()) - 1.0) > 1e-6)
    throw InputError(fmt::format("contact grid: axis ({:.3g}, {:.3g}, {:.3g}), expected along z",
                                 grid.axis.x(), grid.axis.y(), grid.axis.z()));
  axis_sign_ = grid.axis.z() > 0.0 ? 1.0 : -1.0;
  axis_origin_ = grid.axis_point.z();
  const Eigen::Vector3d across = grid.axis.cross(grid.zero_angle);
  for (int i = 0; i < pad.n_angle(); ++i) {
    const Eigen::Vector3d n = pad_normal(pad.angle(i));
    columns_.push_back(stencil_.at_angle(std::atan2(n.dot(across), n.dot(grid.zero_angle))));
  }
  rigid_.resize(n_a * n_z, 4);
  if (surface.rigid.rows() > 0) {
    if (surface.rigid.rows() != rigid_.rows() || surface.rigid.cols() != 6)
      throw InputError(fmt::format("contact grid: rigid motions are {} x {}, expected {} x 6",
                                   surface.rigid.rows(), surface.rigid.cols(), rigid_.rows()));
    rigid_ << surface.rigid.col(0), surface.rigid.col(1), surface.rigid.col(3),
        surface.rigid.col(4);
  } else {
    for (int i = 0; i < n_a; ++i) {
      const Eigen::Vector3d n =
          std::cos(grid.angle[i]) * grid.zero_angle + std::sin(grid.angle[i]) * across;
      for (int j = 0; j < n_z; ++j) {
        const double z = axis_origin_ + axis_sign_ * grid.axial[j];
        rigid_.row(i * n_z + j) << n.x(), n.y(), -z * n.y(), z * n.x();
      }
    }
  }
  // Rotations are scaled by the bore radius, so that all columns are of one size.
  Eigen::DiagonalMatrix<double, 4> scale(1.0, 1.0, 1.0 / grid.radius, 1.0 / grid.radius);
  const Eigen::MatrixXd scaled = rigid_ * scale;
  inverse_ = scale * scaled.completeOrthogonalDecomposition().pseudoInverse();
  defect_.setZero(pad.size(), 4);
  defect_slope_.setZero(pad.size(), 4);
}

void PatchMap::at(double offset, RowMatrix& map, RowMatrix* slope) {
  const int n_z = stencil_.n_axial();
  // First the correction, which needs R_cells - B R_patches row by row; then B is added.
  auto for_each_entry = [&](auto&& visit) {
    for (int i = 0; i < pad_.n_angle(); ++i) {
      const auto& around = columns_[static_cast<size_t>(i)];
      for (int j = 0; j < pad_.n_axial(); ++j) {
        const auto along = stencil_.at_axial(axis_sign_ * (pad_.axial(j) + offset - axis_origin_));
        const int cell = pad_.cell(i, j);
        for (const auto& [a, w_a] : {std::pair{around.first, 1.0 - around.weight},
                                     std::pair{around.second, around.weight}}) {
          visit(cell, a * n_z + along.first, w_a * (1.0 - along.weight),
                -w_a * along.slope * axis_sign_);
          visit(cell, a * n_z + along.second, w_a * along.weight, w_a * along.slope * axis_sign_);
        }
      }
    }
  };
  for (int i = 0; i < pad_.n_angle(); ++i) {
    const Eigen::Vector3d n = pad_normal(pad_.angle(i));
    for (int j = 0; j < pad_.n_axial(); ++j) {
      const double z = pad_.axial(j) + offset;
      defect_.row(pad_.cell(i, j)) << n.x(), n.y(), -z * n.y(), z * n.x();
      defect_slope_.row(pad_.cell(i, j)) << 0.0, 0.0, -n.y(), n.x();
    }
  }
  for_each_entry([&](int cell, int patch, double weight, double weight_slope) {
    defect_.row(cell) -= weight * rigid_.row(patch);
    if (slope) defect_slope_.row(cell) -= weight_slope * rigid_.row(patch);
  });
  map.noalias() = defect_ * inverse_;
  if (slope) slope->noalias() = defect_slope_ * inverse_;
  for_each_entry([&](int cell, int patch, double weight, double weight_slope) {
    map(cell, patch) += weight;
    if (slope) (*slope)(cell, patch) += weight_slope;
  });
}

}  // namespace clatter::film
