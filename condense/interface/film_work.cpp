// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/interface/film_work.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/dense/cholesky.hpp"
#include "core/dense/solve.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kCentres[] = {0.1, 0.3, 0.5, 0.7, 0.9};

/// cos^2 about `centre`, zero beyond a right angle.
double around(double angle, double centre) {
  return std::pow(std::max(0.0, std::cos(angle - centre)), 2);
}

/// Half a sine from centre - width / 2 to centre + width / 2.
double along(double position, double centre, double width) {
  const double s = (position - centre) / width + 0.5;
  return s <= 0.0 || s >= 1.0 ? 0.0 : std::sin(std::numbers::pi * s);
}

}  // namespace

VectorXd patch_areas(const rom::ContactGrid& grid) {
  const Index rows = grid.axial.size();
  VectorXd areas(grid.angle.size() * rows);
  for (Index i = 0; i < grid.angle.size(); ++i) {
    const double arc = grid.radius * (grid.angle_edges[2 * i + 1] - grid.angle_edges[2 * i]);
    for (Index j = 0; j < rows; ++j)
      areas[i * rows + j] = arc * (grid.axial_edges[j + 1] - grid.axial_edges[j]);
  }
  return areas;
}

MatrixXd film_pressures(const rom::ContactGrid& grid) {
  const Index rows = grid.axial.size();
  const double bottom = grid.axial_edges[0], height = grid.axial_edges[rows] - bottom;
  MatrixXd pressures(grid.angle.size() * rows, 10);
  Index field = 0;
  for (const double side : {0.0, std::numbers::pi})
    for (const double centre : kCentres) {
      for (Index i = 0; i < grid.angle.size(); ++i)
        for (Index j = 0; j < rows; ++j)
          pressures(i * rows + j, field) =
              around(grid.angle[i], side) *
              along(grid.axial[j], bottom + centre * height, 0.5 * height);
      ++field;
    }
  return pressures;
}

MatrixXd film_forces(const rom::ReducedModel& model, const std::string& grid) {
  const std::vector<int32_t>& dofs = model.set(grid).dofs;
  const MatrixXd resultants =
      patch_areas(model.grid(grid)).asDiagonal() * film_pressures(model.grid(grid));
  MatrixXd forces = MatrixXd::Zero(model.size(), resultants.cols());
  for (size_t k = 0; k < dofs.size(); ++k)
    forces += model.row_of(dofs[k]).transpose() * resultants.row(static_cast<Index>(k));
  return forces;
}

VectorXd static_work(const MatrixXd& K, const MatrixXd& M, const MatrixXd& rigid,
                     const MatrixXd& forces) {
  MatrixXd balanced = forces, held = K;
  if (rigid.cols() > 0) {
    const MatrixXd inertia = M * rigid;
    const MatrixXd mass = rigid.transpose() * inertia;
    const MatrixXd per_mass = dense::solve_symmetric(mass, inertia.transpose());
    balanced -= inertia * dense::solve_symmetric(mass, rigid.transpose() * forces);
    held += K.trace() / M.trace() * inertia * per_mass;
  }
  // Metres and radians have equal weight.
  const VectorXd scale = held.diagonal().cwiseSqrt().cwiseInverse();
  const dense::Cholesky factor(scale.asDiagonal() * held * scale.asDiagonal());
  if (!factor.ok())
    throw NumericsError(
        "film work: the stiffness is not positive definite apart from its free motions");
  const MatrixXd scaled = scale.asDiagonal() * balanced;
  return scaled.cwiseProduct(factor.solve(scaled)).colwise().sum();
}

}  // namespace clatter::condense
