// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/mbdyn.hpp"

#include <fmt/format.h>

#include "condense/export/node_shapes.hpp"
#include "core/base/artefact.hpp"
#include "core/base/whole_file.hpp"

namespace clatter::condense {
namespace {

void begin_group(std::ostream& out, int number, const char* what) {
  out << fmt::format("**\n** RECORD GROUP {}, {}\n", number, what);
}

void write_numbers(std::ostream& out, const Eigen::VectorXd& values) {
  for (const double value : values) out << fmt::format(" {:.16e}", value);
  out << '\n';
}

void write_head(std::ostream& out, const ExportedPart& part, size_t nodes, int modes) {
  const rom::ReducedModel& model = part.model;
  out << fmt::format("** clatter {}: {} ({}), {}\n", version(), model.name, model.method,
                     text_of(part.units));
  out << "** row  node  kind of coordinate  direction  label\n";
  for (int j = 0; j < model.n_boundary; ++j) {
    const rom::MappedDof& dof = part.map[j];
    out << fmt::format("** {}  {}  {}  {} {} {}  {}\n", j + 1, dof.node,
                       dof.kind == rom::MappedDof::Kind::kRotation ? "rotation" : "displacement",
                       dof.direction[0], dof.direction[1], dof.direction[2], dof.label);
  }
  begin_group(out, 1, "HEADER");
  out << "** revision, nodes; modes: normal, attached, constraint, rejected\n";
  out << fmt::format("   REV0  {}  {}  0  0  0\n", nodes, modes);
}

void write_nodes(std::ostream& out, const std::vector<NodeShape>& nodes, int modes) {
  begin_group(out, 2, "FINITE ELEMENT NODE LIST");
  for (const NodeShape& node : nodes) out << fmt::format(" {}", node.number);
  out << '\n';
  begin_group(out, 3, "INITIAL MODAL DISPLACEMENTS");
  write_numbers(out, Eigen::VectorXd::Zero(modes));
  begin_group(out, 4, "INITIAL MODAL VELOCITIES");
  write_numbers(out, Eigen::VectorXd::Zero(modes));
  constexpr const char* kNames[] = {"NODAL X COORDINATES", "NODAL Y COORDINATES",
                                    "NODAL Z COORDINATES"};
  for (int d = 0; d < 3; ++d) {
    begin_group(out, 5 + d, kNames[d]);
    for (const NodeShape& node : nodes) out << fmt::format("{:.16e}\n", node.position[d]);
  }
}

void write_matrix(std::ostream& out, int group, const char* what, const Eigen::VectorXd& diagonal) {
  begin_group(out, group, what);
  for (Eigen::Index j = 0; j < diagonal.size(); ++j)
    write_numbers(out, diagonal[j] * Eigen::VectorXd::Unit(diagonal.size(), j));
}

}  // namespace

void export_mbdyn(const ExportedPart& part, const std::filesystem::path& path) {
  const rom::ReducedModel& model = part.model;
  const PencilModes modes = elastic_modes_of(model);
  const int count = modes.elastic();
  const std::vector<NodeShape> nodes = node_shapes(part, modes);
  WholeFile file(path);
  std::ostream& out = file.stream();
  write_head(out, part, nodes.size(), count);
  write_nodes(out, nodes, count);
  begin_group(out, 8, "MODE SHAPES");
  for (int k = 0; k < count; ++k) {
    out << fmt::format("** NORMAL MODE SHAPE # {}\n", k + 1);
    for (const NodeShape& node : nodes) write_numbers(out, node.shape.col(k));
  }
  write_matrix(out, 9, "MODAL MASS MATRIX", Eigen::VectorXd::Ones(count));
  write_matrix(out, 10, "MODAL STIFFNESS MATRIX", modes.Lambda);
  begin_group(out, 12, "RIGID BODY INERTIA: MASS, CENTRE OF MASS, INERTIA ABOUT IT");
  out << fmt::format(" {:.16e}\n", model.mass.mass);
  write_numbers(out, model.mass.centre);
  for (int d = 0; d < 3; ++d) write_numbers(out, model.mass.inertia.row(d));
  write_matrix(out, 13, "MODAL DAMPING MATRIX", model.damping_rates(modes.Lambda, modes.Phi));
  file.commit();
}

}  // namespace clatter::condense
