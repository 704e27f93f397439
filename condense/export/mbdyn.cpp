// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/mbdyn.hpp"

#include <fmt/format.h>

#include <map>

#include "condense/export/pencil_modes.hpp"
#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/base/whole_file.hpp"
#include "core/rom/dof_map.hpp"

namespace clatter::condense {
namespace {

using Kind = rom::MappedDof::Kind;

/// Numbers of the nodes and, for each, its coordinates.
using Nodes = std::map<int, std::vector<int>>;

Nodes nodes_of(const std::vector<rom::MappedDof>& map) {
  Nodes nodes;
  for (size_t j = 0; j < map.size(); ++j)
    if (map[j].kind != Kind::kModal) nodes[map[j].node].push_back(static_cast<int>(j));
  return nodes;
}

void begin_group(std::ostream& out, int number, const char* what) {
  out << fmt::format("**\n** RECORD GROUP {}, {}\n", number, what);
}

void write_numbers(std::ostream& out, const Eigen::VectorXd& values) {
  for (const double value : values) out << fmt::format(" {:.16e}", value);
  out << '\n';
}

void write_head(std::ostream& out, const rom::ReducedModel& model,
                const std::vector<rom::MappedDof>& map, size_t nodes, int modes) {
  out << fmt::format("** clatter {}: {} ({}), SI: m, kg, s, N\n", version(), model.name,
                     model.method);
  out << "** row  node  kind of coordinate  direction  label\n";
  for (int j = 0; j < model.n_boundary; ++j) {
    const rom::MappedDof& dof = map[static_cast<size_t>(j)];
    out << fmt::format("** {}  {}  {}  {} {} {}  {}\n", j + 1, dof.node,
                       dof.kind == Kind::kRotation ? "rotation" : "displacement", dof.direction[0],
                       dof.direction[1], dof.direction[2], dof.label);
  }
  begin_group(out, 1, "HEADER");
  out << "** revision, nodes; modes: normal, attached, constraint, rejected\n";
  out << fmt::format("   REV0  {}  {}  0  0  0\n", nodes, modes);
}

void write_nodes(std::ostream& out, const Nodes& nodes, const std::vector<rom::MappedDof>& map,
                 int modes) {
  begin_group(out, 2, "FINITE ELEMENT NODE LIST");
  for (const auto& [node, coordinates] : nodes) out << fmt::format(" {}", node);
  out << '\n';
  begin_group(out, 3, "INITIAL MODAL DISPLACEMENTS");
  write_numbers(out, Eigen::VectorXd::Zero(modes));
  begin_group(out, 4, "INITIAL MODAL VELOCITIES");
  write_numbers(out, Eigen::VectorXd::Zero(modes));
  constexpr const char* kNames[] = {"NODAL X COORDINATES", "NODAL Y COORDINATES",
                                    "NODAL Z COORDINATES"};
  for (int d = 0; d < 3; ++d) {
    begin_group(out, 5 + d, kNames[d]);
    for (const auto& [node, coordinates] : nodes)
      out << fmt::format("{:.16e}\n", map[static_cast<size_t>(coordinates.front())].position[d]);
  }
}

/// x y z rx ry rz of a node in a mode.
Eigen::VectorXd shape_of(const std::vector<int>& coordinates,
                         const std::vector<rom::MappedDof>& map, const Eigen::VectorXd& phi) {
  Eigen::VectorXd shape = Eigen::VectorXd::Zero(6);
  for (const int j : coordinates) {
    const rom::MappedDof& dof = map[static_cast<size_t>(j)];
    shape.segment<3>(dof.kind == Kind::kRotation ? 3 : 0) += phi[j] * dof.direction;
  }
  return shape;
}

void write_matrix(std::ostream& out, int group, const char* what, const Eigen::VectorXd& diagonal) {
  begin_group(out, group, what);
  for (Eigen::Index j = 0; j < diagonal.size(); ++j)
    write_numbers(out, diagonal[j] * Eigen::VectorXd::Unit(diagonal.size(), j));
}

}  // namespace

std::vector<std::filesystem::path> export_mbdyn(const rom::ReducedModel& model,
                                                const std::filesystem::path& path) {
  const PencilModes modes = modes_of(model);
  const int count = model.size() - modes.rigid;
  const Eigen::VectorXd Lambda = modes.Lambda.tail(count);
  const std::vector<rom::MappedDof> map = rom::map_of(model);
  const Nodes nodes = nodes_of(map);
  if (nodes.empty())
    throw InputError(
        fmt::format("{}: found no boundary coordinate with a position, expected one or "
                    "more",
                    model.name));
  WholeFile file(path);
  std::ostream& out = file.stream();
  write_head(out, model, map, nodes.size(), count);
  write_nodes(out, nodes, map, count);
  begin_group(out, 8, "MODE SHAPES");
  for (int k = 0; k < count; ++k) {
    out << fmt::format("** NORMAL MODE SHAPE # {}\n", k + 1);
    for (const auto& [node, coordinates] : nodes)
      write_numbers(out, shape_of(coordinates, map, modes.Phi.col(modes.rigid + k)));
  }
  write_matrix(out, 9, "MODAL MASS MATRIX", Eigen::VectorXd::Ones(count));
  write_matrix(out, 10, "MODAL STIFFNESS MATRIX", Lambda);
  begin_group(out, 12, "RIGID BODY INERTIA: MASS, CENTRE OF MASS, INERTIA ABOUT IT");
  out << fmt::format(" {:.16e}\n", model.mass.mass);
  write_numbers(out, model.mass.centre);
  for (int d = 0; d < 3; ++d) write_numbers(out, model.mass.inertia.row(d));
  write_matrix(out, 13, "MODAL DAMPING MATRIX",
               Eigen::VectorXd(model.alpha * Lambda.array() + model.beta) +
                   model.modal_damping.rates(Lambda));
  file.commit();
  return {path};
}

}  // namespace clatter::condense
