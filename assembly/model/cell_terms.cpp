// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/model/cell_terms.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/log.hpp"

namespace clatter::assembly {
namespace {

/// Of what the cells are made.
struct CellMaterials {
  std::vector<fe::Material> materials;
  std::vector<fe::ShellSection> sections;

  template <class Visit>
  void for_each(const Visit& visit) {
    for (fe::Material& material : materials) visit(material);
    for (fe::ShellSection& section : sections) {
      if (section.bending_material) visit(*section.bending_material);
      if (section.shear_material) visit(*section.shear_material);
      for (fe::ShellLayer& layer : section.layers) visit(layer.material);
    }
  }
};

fe::NodalMatrices assemble(const PartData& part, const Constrained& constrained,
                           const fe::NodePattern& pattern,
                           const std::vector<fe::Material>& materials,
                           const std::vector<fe::ShellSection>& sections) {
  const mesh::Mesh& mesh = part.mesh;
  const fe::MassForm mass = part.recipe.mass;
  fe::NodalMatrices nodal = fe::assemble(mesh, materials, pattern, mass, constrained.rigid_of_node);
  if (mesh.shells.empty()) return nodal;
  const fe::NodalMatrices shells =
      fe::assemble_shells(mesh, materials, sections, shell_ids(part.numbers, mesh.nodes.rows()),
                          mass, constrained.rigid_of_turning_node);
  add(nodal.K, shells.K);
  add(nodal.M, shells.M);
  return nodal;
}

}  // namespace

fe::NodalMatrices cell_matrices(const PartData& part, const Constrained& constrained,
                                const fe::NodePattern& pattern) {
  return assemble(part, constrained, pattern, part.recipe.materials, part.recipe.sections);
}

SparseMatrix loss_of_cells(const PartData& part, const Constrained& constrained,
                           const fe::NodePattern& pattern) {
  constexpr double kStep = 1e-4;
  const CellMaterials own{part.recipe.materials, part.recipe.sections};
  bool any = false;
  CellMaterials(own).for_each([&](const fe::Material& one) { any = any || one.loss_factor > 0.0; });
  if (!any) return {};
  const auto stiffness = [&](double step) {
    CellMaterials of = own;
    of.for_each([&](fe::Material& one) { one = one.scaled(1.0 + step * one.loss_factor); });
    return assemble(part, constrained, pattern, of.materials, of.sections).K;
  };
  SparseMatrix change = stiffness(kStep) - stiffness(-kStep);
  change *= 0.5 / kStep;
  change.prune([](auto, auto, double value) { return value != 0.0; });
  return change;
}

void add_prestress(const PartData& part, const fe::NodePattern& pattern, SparseMatrix& K) {
  const fe::Prestress& state = *part.recipe.prestress;
  const SparseMatrix stress =
      fe::geometric_stiffness(part.mesh, part.recipe.materials, part.recipe.sections, pattern,
                              shell_ids(part.numbers, part.mesh.nodes.rows()), state);
  const Eigen::VectorXd u = state.displacement.reshaped<Eigen::RowMajor>();
  const auto against = [&](const SparseMatrix& A) {
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(A.rows());
    motion.head(u.size()) = u;
    return motion.dot(multiply_symmetric(A, motion).col(0));
  };
  const double elastic = against(K);
  if (elastic > 0.0)
    say(fmt::format(
        "prestress: case {} changes the stiffness of the cells against its own displacements by "
        "{:+.2g} %",
        state.of_case, 100.0 * against(stress) / elastic));
  add(K, stress);
}

fe::ShellIds shell_ids(const DofNumbers& numbers, Eigen::Index n_nodes) {
  fe::ShellIds ids{numbers.count(), std::vector<int32_t>(static_cast<size_t>(n_nodes), -1)};
  for (const int32_t node : numbers.turning()) ids.rotation_of[node] = numbers.rotation_of(node);
  return ids;
}

void add(SparseMatrix& to, const SparseMatrix& more) {
  if (more.rows() == 0) return;
  to.conservativeResize(more.rows(), more.cols());
  to += more;
}

}  // namespace clatter::assembly
