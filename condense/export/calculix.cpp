// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/calculix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "condense/export/pencil_modes.hpp"
#include "core/base/artefact.hpp"
#include "core/base/whole_file.hpp"
#include "core/rom/dof_map.hpp"

namespace clatter::condense {
namespace {

/// A node and its component 1, 2 or 3.
struct NodeComponent {
  int node = 0, component = 0;
};

/// Displacements keep the nodes of the map; rotations and modal coordinates get nodes after them.
std::vector<NodeComponent> node_components(const std::vector<rom::MappedDof>& map) {
  int last = 0;
  for (const rom::MappedDof& dof : map) last = std::max(last, dof.node);
  std::vector<NodeComponent> dofs;
  for (const rom::MappedDof& dof : map) {
    const bool along_axis = dof.component >= 1 && dof.component <= 3;
    const bool rotation = dof.component > 3;
    dofs.push_back({rotation ? ++last : dof.node, along_axis ? dof.component : 1});
  }
  return dofs;
}

void write_matrix(const std::filesystem::path& path, const Eigen::MatrixXd& matrix,
                  const std::vector<NodeComponent>& dofs) {
  WholeFile file(path);
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    for (Eigen::Index i = j; i < matrix.rows(); ++i) {
      if (matrix(i, j) == 0.0) continue;
      const NodeComponent &row = dofs[static_cast<size_t>(i)],
                          &column = dofs[static_cast<size_t>(j)];
      file.stream() << fmt::format("{},{},{},{},{:.16e}\n", row.node, row.component, column.node,
                                   column.component, matrix(i, j));
    }
  }
  file.commit();
}

void write_head(std::ostream& out, const rom::ReducedModel& model,
                const std::vector<rom::MappedDof>& map, const std::vector<NodeComponent>& dofs,
                const std::string& stem) {
  out << fmt::format("** clatter {}: \"{}\" ({}), SI: m, kg, s, N\n", version(), model.name,
                     model.method);
  out << fmt::format(
      "** {} boundary coordinates, then {} modal ones. The same K and M as matrices:\n"
      "** *MATRIX ASSEMBLE,NAME=PART,STIFFNESSFILE={}.K.txt,MASSFILE={}.M.txt (CalculiX after "
      "2.20)\n"
      "** *MATRIX INPUT,NAME=K,INPUT={}.K.txt (Abaqus)\n"
      "** Modes are springs and unit masses below; a rigid motion is held at {} Hz.\n"
      "** row  node  component  what\n",
      model.n_boundary, model.size() - model.n_boundary, stem, stem, stem, kRigidHoldHz);
  for (size_t j = 0; j < map.size(); ++j)
    out << fmt::format("** {}  {}  {}  {} {}\n", j + 1, dofs[j].node, dofs[j].component,
                       map[j].kind == rom::MappedDof::Kind::kRotation ? "rotation of" : "",
                       map[j].label);
}

/// Nodes of the boundary coordinates; node j of the modes is `first` + j / 3, component j % 3 + 1.
void write_nodes(std::ostream& out, const rom::ReducedModel& model,
                 const std::vector<rom::MappedDof>& map, const std::vector<NodeComponent>& dofs,
                 int first) {
  out << "*NODE,NSET=CLATTER_BOUNDARY\n";
  std::vector<bool> done(static_cast<size_t>(first), false);
  for (int j = 0; j < model.n_boundary; ++j) {
    const auto node = static_cast<size_t>(dofs[static_cast<size_t>(j)].node);
    if (done[node]) continue;
    done[node] = true;
    const Eigen::Vector3d& p = map[static_cast<size_t>(j)].position;
    out << fmt::format("{},{:.12e},{:.12e},{:.12e}\n", node, p[0], p[1], p[2]);
  }
  out << "*NODE,NSET=CLATTER_MODES\n";
  for (int k = 0; 3 * k < model.size(); ++k) out << fmt::format("{},0.,0.,0.\n", first + k);
}

/// Unit masses and springs; CalculiX reads 20 columns of a number, hence 14 digits for a spring.
void write_modes(std::ostream& out, const PencilModes& modes, int first) {
  const auto size = static_cast<int>(modes.Lambda.size());
  const int nodes = (size + 2) / 3;
  out << "*ELEMENT,TYPE=MASS,ELSET=CLATTER_MASS\n";
  for (int k = 0; k < nodes; ++k) out << fmt::format("{},{}\n", first + k, first + k);
  out << "*MASS,ELSET=CLATTER_MASS\n1.\n";
  const double hold = std::pow(2.0 * std::numbers::pi * kRigidHoldHz, 2);
  for (int j = 0; j < size; ++j)
    out << fmt::format(
        "*ELEMENT,TYPE=SPRING1,ELSET=CLATTER_{}\n{},{}\n*SPRING,ELSET=CLATTER_{}\n{}\n{:.13e}\n",
        j + 1, first + nodes + j, first + j / 3, j + 1, j % 3 + 1,
        j < modes.rigid ? hold : modes.Lambda[j]);
  if (size % 3 != 0) out << fmt::format("*BOUNDARY\n{},{},3\n", first + nodes - 1, size % 3 + 1);
}

void write_equations(std::ostream& out, const rom::ReducedModel& model, const Eigen::MatrixXd& Phi,
                     const std::vector<NodeComponent>& dofs, int first) {
  for (int i = 0; i < model.n_boundary; ++i) {
    const NodeComponent& dof = dofs[static_cast<size_t>(i)];
    out << fmt::format("*EQUATION\n{}\n{},{},-1.\n", Phi.cols() + 1, dof.node, dof.component);
    for (int j = 0; j < Phi.cols(); ++j)
      out << fmt::format("{},{},{:.12e}\n", first + j / 3, j % 3 + 1, Phi(i, j));
  }
}

}  // namespace

std::vector<std::filesystem::path> calculix_files(const std::filesystem::path& path) {
  const auto beside = [&](const char* ending) {
    return std::filesystem::path(path).replace_extension(ending);
  };
  return {path, beside(".K.txt"), beside(".M.txt")};
}

std::vector<std::filesystem::path> export_calculix(const rom::ReducedModel& model,
                                                   const std::filesystem::path& path) {
  const PencilModes modes = modes_of(model);
  const std::vector<rom::MappedDof> map = rom::map_of(model);
  const std::vector<NodeComponent> dofs = node_components(map);
  int first = 1;  // node of the modes
  for (const NodeComponent& dof : dofs) first = std::max(first, dof.node + 1);
  const std::vector<std::filesystem::path> files = calculix_files(path);
  write_matrix(files[1], model.K_rr, dofs);
  write_matrix(files[2], model.M_rr, dofs);
  WholeFile deck(path);
  std::ostream& out = deck.stream();
  write_head(out, model, map, dofs, path.stem().string());
  write_nodes(out, model, map, dofs, first);
  write_modes(out, modes, first);
  write_equations(out, model, modes.Phi, dofs, first);
  deck.commit();
  return files;
}

}  // namespace clatter::condense
