// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/load_case.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/units.hpp"
#include "core/mesh/face_points.hpp"

namespace clatter::assembly {

Eigen::VectorXd pressure_load(Eigen::Index n_nodes, const SurfaceIntegrals& surface) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * n_nodes);
  for (size_t k = 0; k < surface.nodes.size(); ++k)
    force.segment<3>(3 * surface.nodes[k]) =
        -surface.normal.row(static_cast<Eigen::Index>(k)).transpose();
  return force;
}

Eigen::VectorXd resultant_load(Eigen::Index n_nodes, const SurfaceIntegrals& surface,
                               const Eigen::Vector3d& force) {
  Eigen::VectorXd nodal = Eigen::VectorXd::Zero(3 * n_nodes);
  for (size_t k = 0; k < surface.nodes.size(); ++k)
    nodal.segment<3>(3 * surface.nodes[k]) =
        surface.weight(static_cast<Eigen::Index>(k)) / surface.area * force;
  return nodal;
}

Eigen::VectorXd resultant_load(const RowMatrix& nodes, const mesh::Surface& surface,
                               const Eigen::Vector3d& force, const Eigen::Vector3d& at,
                               double radius, const std::string& where) {
  constexpr double kOff = 0.05;  // of the radius
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(nodes.rows());
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double total = 0.0;
  mesh::for_each_face_point_near(
      nodes, surface, at, radius,
      [&](const auto& face, const auto& N, const Eigen::Vector3d& x, double w, const auto& normal) {
        const double inside = 1.0 - (x - at).squaredNorm() / (radius * radius);
        if (inside <= 0.0) return;
        const double share = inside * inside * w * normal.norm();
        for (Eigen::Index a = 0; a < face.size(); ++a) weight(face(a)) += share * N(a);
        moment += share * (x - at);
        total += share;
      });
  if (total == 0.0)
    throw InputError(
        fmt::format("{}: at: found no part of the surface within {:.4g} mm, expected a point of it",
                    where, radius / kMilli));
  if (const double off = moment.norm() / total; off > kOff * radius)
    warn(
        fmt::format("{}: acts {:.3g} mm from `at`: the surface is curved or ends within the radius",
                    where, off / kMilli));
  return (weight / total * force.transpose()).reshaped<Eigen::RowMajor>();
}

Eigen::VectorXd set_load(Eigen::Index n, const rom::DofSet& set, const Eigen::Vector3d& force,
                         const Eigen::Vector3d& moment, const std::string& where) {
  if (set.kind == "bolt") {
    constexpr double kAlong = 1e-6;  // of the force
    const double along = set.direction.row(0) * force;
    if (std::abs(along) < (1.0 - kAlong) * force.norm() || !moment.isZero(0.0))
      throw InputError(fmt::format(
          "{}: found a load beside the axis ({:g}, {:g}, {:g}) of the bolt, expected a force along "
          "it",
          where, set.direction(0, 0), set.direction(0, 1), set.direction(0, 2)));
    Eigen::VectorXd out = Eigen::VectorXd::Zero(n);
    out(set.dofs.at(0)) = along;
    return out;
  }
  // Nodes are counted per axis, by the DoFs along it, so that the sum along each axis is right.
  Eigen::Vector3d can_push = Eigen::Vector3d::Zero(), can_turn = Eigen::Vector3d::Zero();
  for (size_t k = 0; k < set.dofs.size(); ++k) {
    const Eigen::RowVector3d direction = set.direction.row(static_cast<Eigen::Index>(k));
    if (direction.cwiseAbs().maxCoeff() < 1.0)
      throw InputError(fmt::format(
          "{}: found a set with directions off the axes ({}), expected nodes or a coupling", where,
          set.kind));
    (set.is_rotation[k] ? can_turn : can_push) += direction.transpose().cwiseAbs2();
  }
  for (int d = 0; d < 3; ++d) {
    const bool lost =
        (force(d) != 0.0 && can_push(d) == 0.0) || (moment(d) != 0.0 && can_turn(d) == 0.0);
    if (lost)
      throw InputError(fmt::format(
          "{}: found a load along {}, expected a set with a coordinate along it", where, "xyz"[d]));
  }
  Eigen::VectorXd out = Eigen::VectorXd::Zero(n);
  for (size_t k = 0; k < set.dofs.size(); ++k) {
    const Eigen::Vector3d direction = set.direction.row(static_cast<Eigen::Index>(k)).transpose();
    const bool turns = set.is_rotation[k] != 0;
    const Eigen::Vector3d& load = turns ? moment : force;
    const Eigen::Vector3d& count = turns ? can_turn : can_push;
    for (int d = 0; d < 3; ++d)
      if (load(d) != 0.0) out(set.dofs[k]) += direction(d) * load(d) / count(d);
  }
  return out;
}

}  // namespace clatter::assembly
