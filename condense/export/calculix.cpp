// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/calculix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "condense/export/node_frames.hpp"
#include "condense/export/pencil_modes.hpp"
#include "core/base/artefact.hpp"
#include "core/base/whole_file.hpp"

namespace clatter::condense {
namespace {

constexpr int kVectorsPerMode = 5;  // of Lanczos in CalculiX's *FREQUENCY: not more than free DoFs

/// A node and its component 1, 2 or 3.
struct NodeComponent {
  int node = 0, component = 0;
};

/// The nodes of the coordinates, and the numbers that follow them.
struct Numbers {
  std::vector<NodeComponent> dofs;
  int mode_node = 1, element = 1;  // first ones of the modes
};

/// Rotations get nodes after those of the map.
Numbers numbers_of(const ExportedPart& part) {
  const DeckOrigin& deck = part.model.deck;
  int last = deck.known() ? rom::round_number_after(deck.largest_node) - 1 : 0;
  for (const rom::MappedDof& dof : part.map) last = std::max(last, dof.node);
  std::map<int, int> rotation_node;
  Numbers numbers;
  for (const rom::MappedDof& dof : part.map) {
    if (dof.component > 3) {
      int& node = rotation_node[dof.node];
      if (node == 0) node = ++last;
      numbers.dofs.push_back({node, dof.component - 3});
    } else {
      numbers.dofs.push_back({dof.node, std::max(dof.component, 1)});
    }
  }
  numbers.mode_node = last + 1;
  const int32_t wanted = part.options.first_element;
  numbers.element = wanted != 0    ? wanted
                    : deck.known() ? rom::round_number_after(deck.largest_element)
                                   : numbers.mode_node;
  return numbers;
}

void write_matrix(const std::filesystem::path& path, const Eigen::MatrixXd& matrix,
                  const std::vector<NodeComponent>& dofs) {
  WholeFile file(path);
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    for (Eigen::Index i = j; i < matrix.rows(); ++i) {
      if (matrix(i, j) == 0.0) continue;
      const NodeComponent &row = dofs[i], &column = dofs[j];
      file.stream() << fmt::format("{},{},{},{},{:.16e}\n", row.node, row.component, column.node,
                                   column.component, matrix(i, j));
    }
  }
  file.commit();
}

void write_head(std::ostream& out, const ExportedPart& part, const Numbers& numbers,
                const std::string& stem) {
  const rom::ReducedModel& model = part.model;
  out << fmt::format("** clatter {}: \"{}\" ({}), {}\n", version(), model.name, model.method,
                     text_of(part.units));
  out << fmt::format(
      "** {} boundary coordinates, then {} modal ones. The same K and M as matrices:\n"
      "** *MATRIX ASSEMBLE,NAME=PART,STIFFNESSFILE={}.K.txt,MASSFILE={}.M.txt (CalculiX after "
      "2.20)\n"
      "** *MATRIX INPUT,NAME=K,INPUT={}.K.txt (Abaqus)\n"
      "** Modes are springs and unit masses below; a rigid motion is held at {} Hz.\n"
      "** Of this part alone *FREQUENCY gives at most {} modes; CalculiX prints zeros for more.\n"
      "** row  node  component  what\n",
      model.n_boundary, model.size() - model.n_boundary, stem, stem, stem, kRigidHoldHz,
      model.size() / kVectorsPerMode);
  for (size_t j = 0; j < part.map.size(); ++j)
    out << fmt::format("** {}  {}  {}  {} {}\n", j + 1, numbers.dofs[j].node,
                       numbers.dofs[j].component,
                       part.map[j].kind == rom::MappedDof::Kind::kRotation ? "rotation of" : "",
                       part.map[j].label);
}

/// Nodes of the boundary coordinates; node j of the modes is `mode_node` + j / 3, component j % 3 +
/// 1.
void write_nodes(std::ostream& out, const ExportedPart& part, const Numbers& numbers) {
  out << "*NODE,NSET=CLATTER_BOUNDARY\n";
  std::set<int> done;
  for (size_t j = 0; j < static_cast<size_t>(part.model.n_boundary); ++j) {
    const int node = numbers.dofs[j].node;
    if (!done.insert(node).second) continue;
    const Eigen::Vector3d& p = part.map[j].position;
    out << fmt::format("{},{:.12e},{:.12e},{:.12e}\n", node, p[0], p[1], p[2]);
  }
  out << "*NODE,NSET=CLATTER_MODES\n";
  for (int k = 0; 3 * k < part.model.size(); ++k)
    out << fmt::format("{},0.,0.,0.\n", numbers.mode_node + k);
}

/// Axes of nodes with components of their own; the nodes of rotations have those of their node.
void write_transforms(std::ostream& out, const ExportedPart& part, const Numbers& numbers) {
  const std::map<int, Eigen::Matrix3d> frames = frames_of(part.map);
  std::set<int> done;
  for (size_t j = 0; j < part.map.size(); ++j) {
    const int node = numbers.dofs[j].node;
    if (!part.map[j].turned || !done.insert(node).second) continue;
    const Eigen::Matrix3d& axes = frames.at(part.map[j].node);
    out << fmt::format(
        "*NSET,NSET=CLATTER_AXES_{0}\n{0}\n*TRANSFORM,NSET=CLATTER_AXES_{0},TYPE=R\n"
        "{1:.12e},{2:.12e},{3:.12e},{4:.12e},{5:.12e},{6:.12e}\n",
        node, axes(0, 0), axes(1, 0), axes(2, 0), axes(0, 1), axes(1, 1), axes(2, 1));
  }
}

/// Unit masses and springs; CalculiX reads 20 columns of a number, hence 14 digits for a spring.
void write_modes(std::ostream& out, const PencilModes& modes, const Numbers& numbers,
                 const UnitSystem& units) {
  const int first = numbers.mode_node, element = numbers.element;
  const auto size = static_cast<int>(modes.Lambda.size());
  const int nodes = (size + 2) / 3;
  out << "*ELEMENT,TYPE=MASS,ELSET=CLATTER_MASS\n";
  for (int k = 0; k < nodes; ++k) out << fmt::format("{},{}\n", element + k, first + k);
  out << "*MASS,ELSET=CLATTER_MASS\n1.\n";
  const double hold = std::pow(2.0 * std::numbers::pi * kRigidHoldHz * units.time, 2);
  for (int j = 0; j < size; ++j)
    out << fmt::format(
        "*ELEMENT,TYPE=SPRING1,ELSET=CLATTER_{}\n{},{}\n*SPRING,ELSET=CLATTER_{}\n{}\n{:.13e}\n",
        j + 1, element + nodes + j, first + j / 3, j + 1, j % 3 + 1,
        j < modes.rigid ? hold : modes.Lambda[j]);
  if (size % 3 != 0) out << fmt::format("*BOUNDARY\n{},{},3\n", first + nodes - 1, size % 3 + 1);
}

void write_equations(std::ostream& out, const rom::ReducedModel& model, const Eigen::MatrixXd& Phi,
                     const Numbers& numbers) {
  const int first = numbers.mode_node;
  for (int i = 0; i < model.n_boundary; ++i) {
    const NodeComponent& dof = numbers.dofs[i];
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

void export_calculix(const ExportedPart& part, const std::filesystem::path& path) {
  const rom::ReducedModel& model = part.model;
  const PencilModes modes = modes_of(model);
  const Numbers numbers = numbers_of(part);
  const std::vector<std::filesystem::path> files = calculix_files(path);
  write_matrix(files[1], model.K_rr, numbers.dofs);
  write_matrix(files[2], model.M_rr, numbers.dofs);
  WholeFile deck(path);
  std::ostream& out = deck.stream();
  write_head(out, part, numbers, path.stem().string());
  write_nodes(out, part, numbers);
  write_transforms(out, part, numbers);
  write_modes(out, modes, numbers, part.units);
  write_equations(out, model, modes.Phi, numbers);
  deck.commit();
}

}  // namespace clatter::condense
