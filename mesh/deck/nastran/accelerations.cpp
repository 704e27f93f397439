// SPDX-License-Identifier: GPL-3.0-or-later
// ACCEL1, and ACCEL that varies: P = M a, a of some grids, or of all by their positions.
#include <Eigen/Geometry>
#include <algorithm>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::Vector3d;

// Linear between the positions, constant beyond.
double factor_at(const std::vector<std::pair<double, double>>& factors, double x) {
  const auto after =
      std::find_if(factors.begin(), factors.end(), [&](const auto& one) { return one.first >= x; });
  if (after == factors.begin()) return factors.front().second;
  if (after == factors.end()) return factors.back().second;
  const auto& [x0, f0] = *(after - 1);
  const auto& [x1, f1] = *after;
  return f0 + (f1 - f0) * (x - x0) / (x1 - x0);
}

// Of nodes and points; scalar points have none.
Eigen::Matrix3Xd accelerations_of(Model& model, const RawAcceleration& raw) {
  const System& system = model.systems.get(raw.system, raw.origin);
  if (system.kind != System::Kind::kRectangular)
    model.source.fail(raw.origin, "ACCEL: expected a rectangular coordinate system");
  const Vector3d full = system.axes * vector(raw.vector);
  const auto count = static_cast<NodeIndex>(model.node_map.node_count() +
                                            static_cast<NodeIndex>(model.deck.points.size()));
  model.spend(24 * int64_t{count}, raw.origin);
  Eigen::Matrix3Xd a = Eigen::Matrix3Xd::Zero(3, count);
  if (raw.along < 0) {
    for (const NodeIndex index : model.node_indices(raw.grids, raw.origin, false))
      a.col(index) = full;
  }
  for (NodeIndex index = 0; raw.along >= 0 && index < count; ++index) {
    const Vector3d at = model.node_map.position(index) - system.origin;
    a.col(index) = factor_at(raw.factors, system.axes.col(raw.along).dot(at)) * full;
  }
  for (size_t p = 0; p < model.deck.points.size(); ++p)
    if (model.raw.scalar_points.contains(model.deck.points[p].id))
      a.col(model.node_map.node_count() + static_cast<NodeIndex>(p)).setZero();
  for (const auto& [point, grid] : model.hung) a.col(point) = a.col(grid);
  return a;
}

}  // namespace

void add_accelerations(Model& model, Step& step, const RawAcceleration& raw, double factor) {
  const Eigen::Matrix3Xd a = factor * accelerations_of(model, raw);
  if (std::ranges::any_of(model.deck.beams, [](const Beam& beam) { return beam.has_mass(); }))
    model.source.fail(raw.origin,
                      "ACCEL: found bars with mass, whose accelerations it cannot give, expected a "
                      "GRAV");
  if (!a.allFinite()) model.source.fail(raw.origin, "ACCEL: its numbers are too large");
  const NodeIndex nodes = model.node_map.node_count();
  if (step.accelerations.rows() == 0) step.accelerations = RowMatrix::Zero(nodes, 3);
  step.accelerations += a.leftCols(nodes).transpose();
  const auto push = [&](NodeIndex index, int direction, double value) {
    model.spend(64, raw.origin);
    if (value != 0.0) step.forces.push_back({index, direction, value, {}});
  };
  for (const Mass& mass : model.deck.masses) {
    const Vector3d force = mass.mass * a.col(mass.node_index);
    const Vector3d moment = mass.offset.cross(force);
    for (int d = 0; d < 3; ++d) {
      push(mass.node_index, d, force[d]);
      push(mass.node_index, 3 + d, moment[d]);
    }
  }
  for (const NodalMatrix& matrix : model.deck.matrices) {
    if (!matrix.is_mass) continue;
    Eigen::VectorXd of_rows = Eigen::VectorXd::Zero(matrix.values.rows());
    for (size_t i = 0; i < matrix.terms.size(); ++i)
      if (const auto& term = matrix.terms[i]; term.direction < 3)
        of_rows(static_cast<Eigen::Index>(i)) = a(term.direction, term.node_index);
    const Eigen::VectorXd forces = matrix.values * of_rows;
    for (size_t i = 0; i < matrix.terms.size(); ++i)
      push(matrix.terms[i].node_index, matrix.terms[i].direction,
           forces(static_cast<Eigen::Index>(i)));
  }
}

}  // namespace clatter::mesh::deck::nastran
