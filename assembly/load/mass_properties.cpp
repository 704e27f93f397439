// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/mass_properties.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "assembly/load/mass_integral.hpp"
#include "core/fe/shell_directors.hpp"
#include "core/rom/rigid_mass.hpp"

namespace clatter::assembly {
namespace {

Eigen::Matrix3d inertia_of(const Eigen::Matrix3d& second) {
  return second.trace() * Eigen::Matrix3d::Identity() - second;
}

}  // namespace

MassMoments integrate_mass(const mesh::Mesh& mesh, const std::vector<fe::Material>& materials) {
  if (mesh.nodes.rows() == 0) return {};
  const Eigen::Vector3d about = mesh.nodes.colwise().mean().transpose();
  double mass = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const mesh::CellBlock& block : mesh.cells) {
    const double density = materials.at(block.region).density;
    for_each_mass_point(mesh, block, density,
                        [&](Eigen::Index, const auto&, const Eigen::Vector3d& at, double dm) {
                          const Eigen::Vector3d arm = at - about;
                          mass += dm;
                          first += dm * arm;
                          second += dm * arm * arm.transpose();
                        });
  }
  if (mass == 0.0) return {};  // shells alone
  const Eigen::Vector3d from = first / mass;
  return {mass, about + from, second - mass * from * from.transpose()};
}

void add_shells(MassMoments& moments, const mesh::Mesh& mesh,
                const std::vector<fe::Material>& materials,
                const std::vector<fe::ShellSection>& sections) {
  if (mesh.shells.empty()) return;
  const Eigen::Vector3d about = mesh.nodes.colwise().mean().transpose();
  const std::vector<RowMatrix> directors = fe::shell_directors(mesh.nodes, mesh.shells);
  double mass = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (size_t b = 0; b < mesh.shells.size(); ++b) {
    const int32_t region = mesh.shells[b].region;
    for_each_shell_point(
        mesh, mesh.shells[b], directors[b], sections[region], [&](const ShellPoint& point) {
          const fe::ShellMass of =
              fe::mass_of(sections[region], materials[region], point.thickness);
          const Eigen::Vector3d arm = point.at - about, &up = point.director;
          mass += point.area * of.total;
          first += point.area * (of.total * arm + of.moment * up);
          second += point.area * (of.total * arm * arm.transpose() +
                                  of.moment * (arm * up.transpose() + up * arm.transpose()) +
                                  of.rotary * up * up.transpose());
        });
  }
  if (mass == 0.0) return;
  const Eigen::Vector3d from = first / mass;
  add_point(moments, mass, about + from, inertia_of(second - mass * from * from.transpose()));
}

void add_point(MassMoments& moments, double mass, const Eigen::Vector3d& position,
               const Eigen::Matrix3d& inertia) {
  const double total = moments.mass + mass;
  if (!(total > 0.0)) return;
  const Eigen::Vector3d arm = position - moments.centre;
  // J = tr(S) I - S has the inverse S = tr(J)/2 I - J; both S move to the common centre (Steiner).
  moments.second += moments.mass / total * mass * arm * arm.transpose() +
                    0.5 * inertia.trace() * Eigen::Matrix3d::Identity() - inertia;
  moments.centre += mass / total * arm;
  moments.mass = total;
}

rom::MassProperties properties_of(const MassMoments& moments) {
  rom::MassProperties out;
  out.mass = moments.mass;
  out.centre = moments.centre;
  out.inertia = inertia_of(moments.second);
  return out;
}

rom::MassProperties properties_of(const SparseMatrix& M, const Eigen::MatrixXd& rigid) {
  const auto about = [&](const Eigen::Vector3d& point) {
    const Eigen::MatrixXd motions = rom::rigid_about(rigid, point);
    return rom::properties_of(motions.transpose() * multiply_symmetric(M, motions), point);
  };
  return about(about(Eigen::Vector3d::Zero()).centre);
}

MassDifference compare(const rom::MassProperties& a, const rom::MassProperties& b) {
  const double gyration = std::sqrt(b.inertia.trace() / (2.0 * b.mass));
  return {std::abs(a.mass - b.mass) / b.mass, (a.centre - b.centre).norm() / gyration,
          (a.inertia - b.inertia).cwiseAbs().maxCoeff() / b.inertia.trace()};
}

}  // namespace clatter::assembly
