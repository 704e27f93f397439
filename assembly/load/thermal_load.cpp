// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/thermal_load.hpp"

#include "core/fe/assemble_shells.hpp"
#include "core/fe/element.hpp"
#include "core/fe/shell_directors.hpp"

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

Eigen::VectorXd shell_thermal_load(const PartData& part, const Eigen::VectorXd& dT) {
  const mesh::Mesh& mesh = part.mesh;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(part.numbers.count());
  const std::vector<RowMatrix> directors = fe::shell_directors(mesh.nodes, mesh.shells);
  for (size_t b = 0; b < mesh.shells.size(); ++b) {
    const mesh::ShellBlock& block = mesh.shells[b];
    const fe::Material& material = part.recipe.materials.at(block.region);
    const fe::ShellSection& section = part.recipe.sections.at(block.region);
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const fe::ShellCell sheet = fe::shell_cell(mesh, block, c, directors[b], section, material);
      if (!sheet.stiffness.expands()) break;
      const Eigen::VectorXd cell = fe::shell_thermal_force(sheet, dT(block.nodes.row(c)));
      for (Eigen::Index a = 0; a < block.nodes.cols(); ++a) {
        const int32_t node = block.nodes(c, a);
        force.segment<3>(3 * node) += cell.segment<3>(6 * a);
        force.segment<3>(part.numbers.rotation_of(node)) += cell.segment<3>(6 * a + 3);
      }
    }
  }
  return force;
}

}  // namespace clatter::assembly
