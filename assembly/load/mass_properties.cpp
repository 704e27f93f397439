// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/mass_properties.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "assembly/load/mass_integral.hpp"

namespace clatter::assembly {
namespace {

Eigen::Matrix3d inertia_of(const Eigen::Matrix3d& second) {
  return second.trace() * Eigen::Matrix3d::Identity() - second;
}

}  // namespace

MassMoments integrate_mass(const mesh::Mesh& mesh, const std::vector<fe::Material>& materials) {
  MassMoments sum;
  for (const mesh::CellBlock& block : mesh.cells) {
    const double density = materials.at(static_cast<size_t>(block.region)).density;
    for_each_mass_point(mesh, block, density,
                        [&](Eigen::Index, const auto&, const Eigen::Vector3d& at, double dm) {
                          sum.mass += dm;
                          sum.first += dm * at;
                          sum.second += dm * at * at.transpose();
                        });
  }
  return sum;
}

void add_point(MassMoments& moments, double mass, const Eigen::Vector3d& position,
               const Eigen::Matrix3d& inertia) {
  moments.mass += mass;
  moments.first += mass * position;
  // J = tr(S) I - S has the inverse S = tr(J)/2 I - J.
  moments.second += mass * position * position.transpose() +
                    0.5 * inertia.trace() * Eigen::Matrix3d::Identity() - inertia;
}

rom::MassProperties properties_of(const MassMoments& moments) {
  rom::MassProperties out;
  out.mass = moments.mass;
  out.centre = moments.first / moments.mass;
  out.inertia = inertia_of(moments.second - moments.mass * out.centre * out.centre.transpose());
  return out;
}

rom::MassProperties properties_of(const SparseMatrix& M, const Eigen::MatrixXd& rigid) {
  const Eigen::Matrix<double, 6, 6> mass = rigid.transpose() * multiply_symmetric(M, rigid);
  rom::MassProperties out;
  out.mass = mass.topLeftCorner<3, 3>().trace() / 3.0;
  // Column 3 + j holds the momentum of a unit spin about j: e_j x (m c).
  out.centre =
      Eigen::Vector3d(mass(1, 5) - mass(2, 4), mass(2, 3) - mass(0, 5), mass(0, 4) - mass(1, 3)) /
      (2.0 * out.mass);
  const double m = out.mass;
  out.inertia = mass.bottomRightCorner<3, 3>() -
                inertia_of(Eigen::Matrix3d(m * out.centre * out.centre.transpose()));
  return out;
}

MassDifference compare(const rom::MassProperties& a, const rom::MassProperties& b) {
  const double gyration = std::sqrt(b.inertia.trace() / (2.0 * b.mass));
  return {std::abs(a.mass - b.mass) / b.mass, (a.centre - b.centre).norm() / gyration,
          (a.inertia - b.inertia).cwiseAbs().maxCoeff() / b.inertia.trace()};
}

}  // namespace clatter::assembly
