// SPDX-License-Identifier: GPL-3.0-or-later
// The file of a static solution, schema "clatter/static/1".
#include <algorithm>

#include "core/base/artefact.hpp"
#include "core/fe/fe_statics_file.hpp"
#include "core/mesh/mesh_file.hpp"
#include "modal/certificates.hpp"
#include "modal/statics.hpp"

namespace clatter::modal {
namespace {

/// A vector as rows of `width` numbers.
RowMatrix rows_of(const Eigen::VectorXd& values, Eigen::Index width) {
  return Eigen::Map<const RowMatrix>(values.data(), values.size() / width, width);
}

void write_stress(H5File& file, const StaticCase& solved) {
  for (const fe::RegionStress& stress : solved.stress) {
    if (!file.has("stress_nodes/" + stress.name))
      file.write("stress_nodes/" + stress.name, stress.nodes);
    file.write("cases/" + solved.name + "/stress/" + stress.name, RowMatrix(stress.stress));
    file.write("cases/" + solved.name + "/von_mises/" + stress.name, stress.von_mises);
  }
}

}  // namespace

void write_static(H5File& file, const fe::FeModel& model, const StaticSolution& solution) {
  file.set("/", "name", model.name);
  file.write("nodes", model.nodes);
  mesh::write_surfaces(file, model.surfaces);
  if (!model.cells.node_ids.empty()) file.write("node_ids", model.cells.node_ids);
  if (!model.rotations.nodes.empty()) file.write("rotation_nodes", model.rotations.nodes);
  if (model.supports.size() > 0) fe::write_supported(file, model.supports);
  if (!model.points.names.empty()) {
    file.write("points/names", model.points.names);
    file.write("points/position", model.points.position);
  }
  rom::write_dof_sets(file, {}, model.grids);
  fe::write_gasket_points(file, model.gaskets);
  double backward = 0.0, forward = 0.0, balance = 0.0;
  for (const StaticCase& one : solution.cases) {
    const std::string group = "cases/" + one.name + "/";
    file.write(group + "displacement", rows_of(one.displacement, 3));
    if (one.rotation.size() > 0) file.write(group + "rotation", rows_of(one.rotation, 3));
    if (one.temperature_rise.size() > 0)
      file.write(group + "temperature_rise", one.temperature_rise);
    if (one.points.size() > 0) file.write(group + "points", rows_of(one.points, 6));
    if (one.reactions.size() > 0) {
      file.write(group + "reactions", one.reactions);
      file.write(group + "support_sums", one.support_sums);
    }
    file.write(group + "applied", one.applied);
    write_stress(file, one);
    for (size_t g = 0; g < one.gaskets.size(); ++g)
      fe::write_gasket_state(file, one.name, model.gaskets[g].name, one.gaskets[g]);
    file.set("cases/" + one.name, "energy", one.energy);
    file.set("cases/" + one.name, "backward_error", one.backward_error);
    file.set("cases/" + one.name, "forward_error", one.forward_error);
    file.set("cases/" + one.name, "balance", one.balance);
    backward = std::max(backward, one.backward_error);
    forward = std::max(forward, one.forward_error);
    balance = std::max(balance, one.balance);
  }
  write_certificate(
      file, StaticCertificate{.cases = static_cast<double>(solution.cases.size()),
                              .backward_error_max = backward,
                              .forward_error_max = forward,
                              .balance_max = balance,
                              .factor_entries = static_cast<double>(solution.factor.entries),
                              .factor_rcond = solution.factor.rcond});
}

}  // namespace clatter::modal
