// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/centrifugal_load.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "assembly/load/mass_integral.hpp"

namespace clatter::assembly {

Eigen::VectorXd centrifugal_load(const mesh::Mesh& mesh, const std::vector<fe::Material>& materials,
                                 const fe::RotationAxis& axis,
                                 const std::vector<int32_t>& regions) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * mesh.nodes.rows());
  for (const mesh::CellBlock& block : mesh.cells) {
    if (!regions.empty() &&
        std::find(regions.begin(), regions.end(), block.region) == regions.end())
      continue;
    const double density = materials.at(block.region).density;
    for_each_mass_point(mesh, block, density,
                        [&](Eigen::Index c, const auto& N, const Eigen::Vector3d& at, double dm) {
                          const Eigen::Vector3d body = dm * axis.arm(at);
                          for (Eigen::Index a = 0; a < N.size(); ++a)
                            force.segment<3>(3 * block.nodes(c, a)) += N(a) * body;
                        });
  }
  return force;
}

Eigen::Matrix<double, 6, 1> centrifugal_force(const PointMassSpec& mass,
                                              const Eigen::Vector3d& position,
                                              const fe::RotationAxis& axis) {
  Eigen::Matrix<double, 6, 1> out;
  const Eigen::Vector3d& n = axis.direction;
  const Eigen::Vector3d force = mass.mass * axis.arm(position + mass.offset);
  out.head<3>() = force;
  out.tail<3>() = mass.offset.cross(force) - n.cross(Eigen::Vector3d(mass.inertia * n));
  return out;
}

}  // namespace clatter::assembly
