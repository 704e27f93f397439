// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/thermal_load.hpp"

#include "core/fe/element.hpp"

namespace clatter::assembly {

Eigen::VectorXd thermal_load(const mesh::Mesh& mesh, const std::vector<fe::Material>& materials,
                             const Eigen::VectorXd& dT) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * mesh.nodes.rows());
  for (const mesh::CellBlock& block : mesh.cells) {
    const fe::Material& material = materials.at(block.region);
    if (material.expansion.isZero(0.0)) continue;
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const Eigen::VectorXd rise = dT(block.nodes.row(c));
      const Eigen::VectorXd cell =
          fe::thermal_force(block.type, mesh::cell_nodes(mesh, block, c), material, rise);
      for (Eigen::Index a = 0; a < rise.size(); ++a)
        force.segment<3>(3 * block.nodes(c, a)) += cell.segment<3>(3 * a);
    }
  }
  return force;
}

}  // namespace clatter::assembly
