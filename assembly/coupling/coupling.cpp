// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/coupling/coupling.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "assembly/coupling/dof_numbers.hpp"
#include "assembly/coupling/member_group.hpp"
#include "core/base/error.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::assembly {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kUndefined = 1e-8;  // smallest over largest eigenvalue of the scaled A
constexpr double kTakesPart = 1e-6;  // of an undefined motion in a requested direction

/// Motion of a position with the reference: rows x y z rx ry rz.
Matrix6 member_motion(const Eigen::Vector3d& position, const Eigen::Vector3d& centre) {
  Matrix6 motion = Matrix6::Identity();
  motion.topRows<3>() = rigid_motion(position, centre);
  return motion;
}

/// Weighted centre of the members and their root mean square distance from it.
struct Extent {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;
  double weight = 0.0;
};

Extent extent_of(const std::vector<Member>& members) {
  Extent extent;
  for (const Member& member : members) {
    extent.centre += member.weight * member.position;
    extent.weight += member.weight;
  }
  extent.centre /= extent.weight;
  for (const Member& member : members)
    extent.radius += member.weight * (member.position - extent.centre).squaredNorm();
  extent.radius = std::sqrt(extent.radius / extent.weight);
  if (!(extent.radius > 0.0)) extent.radius = 1.0;
  return extent;
}

/// A^+ of the normal equations; motions that the members leave undefined must not contribute to the
/// requested rows of `shift`.
Matrix6 inverse_on_range(const Matrix6& A, const Extent& extent, const Matrix6& shift,
                         const std::vector<int>& directions, const std::string& where) {
  // Scaled by the members' extent, so that displacements and rotations are comparable.
  Eigen::Matrix<double, 6, 1> scale;
  scale << 1.0, 1.0, 1.0, Eigen::Vector3d::Constant(1.0 / extent.radius);
  scale /= std::sqrt(extent.weight);
  const dense::Eigenpairs eigen =
      dense::symmetric_eigen(scale.asDiagonal() * A * scale.asDiagonal());
  const Matrix6 vectors = eigen.vectors;
  Eigen::Matrix<double, 6, 1> inverse = Eigen::Matrix<double, 6, 1>::Zero();
  for (int k = 0; k < 6; ++k) {
    if (eigen.values(k) > kUndefined * eigen.values(5)) {
      inverse(k) = 1.0 / eigen.values(k);
      continue;
    }
    const Eigen::Matrix<double, 6, 1> loose = shift * (scale.asDiagonal() * vectors.col(k)).eval();
    for (const int d : directions)
      if (std::abs(loose(d)) > kTakesPart * scale(d))
        throw InputError(fmt::format(
            "{}: found nodes that do not define {} of the reference (on a line or at a point), "
            "expected a face with area or nodes that define it",
            where, kDofNames[d]));
  }
  return scale.asDiagonal() * vectors * inverse.asDiagonal() * vectors.transpose() *
         scale.asDiagonal();
}

}  // namespace

std::vector<Functional> Coupling::nodal_rows() const {
  if (means.empty()) return rows;
  std::vector<Functional> nodal;
  for (const Functional& row : rows) {
    Functional flat;
    for (size_t k = 0; k < row.dofs.size(); ++k) {
      const Functional& mean = means[row.dofs[k]];
      for (size_t a = 0; a < mean.dofs.size(); ++a) {
        flat.dofs.push_back(mean.dofs[a]);
        flat.values.push_back(row.values[k] * mean.values[a]);
      }
    }
    nodal.push_back(std::move(flat));
  }
  return nodal;
}

Eigen::Matrix<double, 3, 6> rigid_motion(const Eigen::Vector3d& x, const Eigen::Vector3d& point) {
  const Eigen::Vector3d r = x - point;
  Eigen::Matrix<double, 3, 6> motion;
  motion.leftCols<3>().setIdentity();
  motion.rightCols<3>() << 0.0, r.z(), -r.y(), -r.z(), 0.0, r.x(), r.y(), -r.x(), 0.0;
  return motion;
}

Coupling distribute(const std::vector<Member>& members, const Eigen::Vector3d& point,
                    const std::vector<int>& directions, const std::string& where) {
  const Extent extent = extent_of(members);
  const std::vector<MemberGroup> groups = group_members(members);
  Eigen::MatrixXd weighted = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(groups.size()), 6);
  Matrix6 A = Matrix6::Zero();
  for (size_t p = 0; p < groups.size(); ++p) {
    Matrix6 R = Matrix6::Zero();
    for (size_t k = 0; k < groups[p].members.size(); ++k)
      R += groups[p].shares[k] *
           member_motion(members[groups[p].members[k]].position, extent.centre);
    for (int d = 0; d < 6; ++d) {
      if (!members[groups[p].members[0]].has(d)) continue;
      const double arm = d < 3 ? 1.0 : extent.radius;
      weighted.row(6 * static_cast<Eigen::Index>(p) + d) = groups[p].weight * arm * arm * R.row(d);
      A += groups[p].weight * arm * arm * R.row(d).transpose() * R.row(d);
    }
  }
  const Matrix6 shift = member_motion(point, extent.centre);
  const Eigen::MatrixXd C =
      shift * inverse_on_range(A, extent, shift, directions, where) * weighted.transpose();
  Coupling coupling;
  set_rows(C(directions, Eigen::all), groups, members, coupling);
  return coupling;
}

rom::DofSet reference_set(const std::string& name, const std::string& kind,
                          const Eigen::Vector3d& point, const std::vector<int>& directions) {
  rom::DofSet set;
  const auto count = static_cast<Eigen::Index>(directions.size());
  set.kind = kind;
  set.position = point.transpose().replicate(count, 1);
  set.direction = Eigen::MatrixXd::Zero(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) {
    const int d = directions[k];
    set.labels.push_back(name + "." + kDofNames[d]);
    set.direction(k, d % 3) = 1.0;
    set.is_rotation.push_back(d < 3 ? 0 : 1);
  }
  return set;
}

Coupling distributing_coupling(const std::string& name, const std::string& kind,
                               const RowMatrix& coordinates, const SurfaceIntegrals& surface,
                               const std::optional<Eigen::Vector3d>& point, int n_dofs,
                               const std::string& where) {
  const Eigen::Vector3d centre = point.value_or(surface.centroid);
  std::vector<int> directions(static_cast<size_t>(n_dofs));
  std::iota(directions.begin(), directions.end(), 0);
  Coupling coupling = distribute(members_of(coordinates, surface), centre, directions, where);
  coupling.set = reference_set(name, kind, centre, directions);
  return coupling;
}

Coupling mean_displacement(const std::string& name, const RowMatrix& coordinates,
                           const SurfaceIntegrals& surface, const Eigen::Vector3d& direction,
                           const std::optional<std::pair<double, double>>& range,
                           const std::string& where) {
  std::vector<Member> members;
  for (const Member& member : members_of(coordinates, surface)) {
    const double along = member.position.dot(direction);
    if (!range || (along >= range->first && along <= range->second)) members.push_back(member);
  }
  if (members.empty())
    throw InputError(
        fmt::format("{}: found no node of the surface in the range, expected some", where));
  const Extent extent = extent_of(members);
  const std::vector<MemberGroup> groups = group_members(members);
  Eigen::MatrixXd row = Eigen::MatrixXd::Zero(1, 6 * static_cast<Eigen::Index>(groups.size()));
  for (size_t p = 0; p < groups.size(); ++p)
    row.middleCols<3>(6 * static_cast<Eigen::Index>(p)) =
        groups[p].weight / extent.weight * direction.transpose();
  Coupling coupling;
  set_rows(row, groups, members, coupling);
  coupling.set.kind = "mean";
  coupling.set.labels = {name};
  coupling.set.position = extent.centre.transpose();
  coupling.set.direction = direction.transpose();
  coupling.set.is_rotation = {0};
  return coupling;
}

}  // namespace clatter::assembly
