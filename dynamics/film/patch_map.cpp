// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/dense/least_squares.hpp"
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
  Strips strips{grid.angle, std::vector<char>(n, 0)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index next = (i + 1) % n;
    if (grid.angle_edges.size() != 2 * n) continue;
    const double width = grid.angle_edges[2 * i + 1] - grid.angle_edges[2 * i];
    const double space = wrap(grid.angle_edges[2 * next] - grid.angle_edges[2 * i + 1] + 1e-9);
    strips.neighbours[i] = n > 1 && space < 0.5 * width;
  }
  return strips;
}

/// `closed`: across the spaces between strips, too.
CylinderStencil stencil_of(const rom::ContactGrid& grid, bool closed) {
  Strips strips = strips_of(grid);
  if (closed && strips.neighbours.size() > 1)
    std::fill(strips.neighbours.begin(), strips.neighbours.end(), 1);
  return CylinderStencil(strips.angles, strips.neighbours, grid.axial);
}

/// Makes room for `entries` entries in n rows.
void start_rows(SparseRows& rows, int n, int columns, Eigen::Index entries) {
  if (rows.rows() != n || rows.cols() != columns) rows.resize(n, columns);
  rows.resizeNonZeros(entries);
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
    if (neighbours_[i]) return {i, next, past / step};
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

Eigen::MatrixXd radial_motions(const ElasticSurface& surface) {
  const rom::ContactGrid& grid = surface.grid;
  const Eigen::Index n_a = grid.angle.size(), n_z = grid.axial.size();
  Eigen::MatrixXd motions(n_a * n_z, kFits);
  if (surface.rigid.rows() > 0) {
    if (surface.rigid.rows() != motions.rows() || surface.rigid.cols() != 6)
      throw InputError(fmt::format("contact grid: rigid motions are {} x {}, expected {} x 6",
                                   surface.rigid.rows(), surface.rigid.cols(), motions.rows()));
    motions << surface.rigid.leftCols<2>(), surface.rigid.middleCols<2>(3);
    return motions;
  }
  const Eigen::Vector3d across = grid.axis.cross(grid.zero_angle);
  for (Eigen::Index i = 0; i < n_a; ++i) {
    const Eigen::Vector3d n =
        std::cos(grid.angle[i]) * grid.zero_angle + std::sin(grid.angle[i]) * across;
    for (Eigen::Index j = 0; j < n_z; ++j) {
      const double z = grid.axis_point.z() + grid.axis.z() * grid.axial[j];
      motions.row(i * n_z + j) << n.x(), n.y(), -z * n.y(), z * n.x();
    }
  }
  return motions;
}

Eigen::MatrixXd rigid_fit(const ElasticSurface& surface) {
  // Rotations are scaled by the bore radius, so that all columns are of one size.
  const double turn = 1.0 / surface.grid.radius;
  const Eigen::DiagonalMatrix<double, kFits> scale(1.0, 1.0, turn, turn);
  const Eigen::MatrixXd scaled = radial_motions(surface) * scale;
  return scale * dense::pseudo_inverse(scaled);
}

PatchMap::PatchMap(const ElasticSurface& surface, const PadGrid& pad)
    : pad_(pad),
      stencil_(stencil_of(surface.grid, pad.periodic())),
      rigid_(radial_motions(surface)) {
  const rom::ContactGrid& grid = surface.grid;
  if (std::abs(std::abs(grid.axis.z()) - 1.0) > 1e-6)
    throw InputError(fmt::format("contact grid: axis ({:.3g}, {:.3g}, {:.3g}), expected along z",
                                 grid.axis.x(), grid.axis.y(), grid.axis.z()));
  axis_sign_ = grid.axis.z() > 0.0 ? 1.0 : -1.0;
  axis_origin_ = grid.axis_point.z();
  rows_.resize(pad.n_axial());
  const Eigen::Vector3d across = grid.axis.cross(grid.zero_angle);
  for (int i = 0; i < pad.n_angle(); ++i) {
    const Eigen::Vector3d n = pad_normal(pad.angle(i));
    const auto around = stencil_.at_angle(std::atan2(n.dot(across), n.dot(grid.zero_angle)));
    columns_.push_back(points(around.first, around.second, around.weight, 0.0));
  }
}

PatchMap::Points PatchMap::points(int first, int second, double weight, double slope) {
  if (first == second) return {{{{first, 1.0, 0.0}, {}}}, 1};
  const Point one{first, 1.0 - weight, -slope}, other{second, weight, slope};
  if (first < second) return {{{one, other}}, 2};
  return {{{other, one}}, 2};
}

void PatchMap::at(double offset, SparseRows& map, SparseRows* slope) {
  const int n_z = stencil_.n_axial(), n = patches();
  const Eigen::Index most = static_cast<Eigen::Index>(pad_.size()) * (4 + kFits);
  start_rows(map, pad_.size(), columns(), most);
  if (slope != nullptr) start_rows(*slope, pad_.size(), columns(), most);
  for (int j = 0; j < pad_.n_axial(); ++j) {
    const double z = pad_.axial(j) + offset;
    const CylinderStencil::Axial along = stencil_.at_axial(axis_sign_ * (z - axis_origin_));
    rows_[j] = points(along.first, along.second, along.weight, along.slope * axis_sign_);
  }
  int next = 0;
  for (int i = 0; i < pad_.n_angle(); ++i) {
    const Points& around = columns_[i];
    const Eigen::Vector3d normal = pad_normal(pad_.angle(i));
    for (int j = 0; j < pad_.n_axial(); ++j) {
      const Points& along = rows_[j];
      const double z = pad_.axial(j) + offset;
      Eigen::RowVector4d defect(normal.x(), normal.y(), -z * normal.y(), z * normal.x()),
          defect_slope(0.0, 0.0, -normal.y(), normal.x());
      map.outerIndexPtr()[pad_.cell(i, j)] = next;
      const auto put = [&](int at, double value, double change) {
        map.innerIndexPtr()[next] = at;
        map.valuePtr()[next] = value;
        if (slope != nullptr) slope->valuePtr()[next] = change;
        ++next;
      };
      for (int a = 0; a < around.count; ++a)
        for (int k = 0; k < along.count; ++k) {
          const Point &angular = around.of[a], &axial = along.of[k];
          const int patch = angular.at * n_z + axial.at;
          const double value = angular.weight * axial.weight, change = angular.weight * axial.slope;
          put(patch, value, change);
          defect -= value * rigid_.row(patch);
          defect_slope -= change * rigid_.row(patch);
        }
      for (int k = 0; k < kFits; ++k) put(n + k, defect[k], defect_slope[k]);
    }
  }
  map.outerIndexPtr()[pad_.size()] = next;
  map.resizeNonZeros(next);
  if (slope == nullptr) return;
  std::copy_n(map.outerIndexPtr(), pad_.size() + 1, slope->outerIndexPtr());
  std::copy_n(map.innerIndexPtr(), next, slope->innerIndexPtr());
  slope->resizeNonZeros(next);
}

}  // namespace clatter::film
