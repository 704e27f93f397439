// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/dof_partition.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/dense/svd.hpp"
#include "core/fe/dof_label.hpp"

namespace clatter::condense {

DofPartition partition_dofs(const fe::FeModel& model, const std::vector<std::string>& set_names) {
  DofPartition partition;
  std::vector<int32_t> coordinate(static_cast<size_t>(model.size()), -1);
  for (const std::string& name : set_names) {
    if (partition.sets.contains(name)) {
      throw InputError(fmt::format("boundary: set \"{}\" is named twice", name));
    }
    rom::DofSet set = model.set(name);
    if (set.dofs.empty()) throw InputError(fmt::format("boundary: set \"{}\" is empty", name));
    for (size_t k = 0; k < set.dofs.size(); ++k) {
      const int32_t dof = set.dofs[k];
      int32_t& here = coordinate[dof];
      if (here >= 0) {
        partition.repeated.push_back(k < set.labels.size() ? set.labels[k] : name);
      } else {
        here = static_cast<int32_t>(partition.boundary.size());
        partition.boundary.push_back(dof);
      }
      set.dofs[k] = here;
    }
    partition.sets[name] = std::move(set);
    const auto grid = model.grids.find(name);
    if (grid != model.grids.end()) partition.grids[name] = grid->second;
  }
  if (partition.boundary.empty()) {
    throw InputError("boundary: found no set, expected the names of one or more");
  }
  for (int32_t dof = 0; dof < model.size(); ++dof) {
    if (coordinate[dof] < 0) partition.interior.push_back(dof);
  }
  if (partition.interior.empty()) {
    throw InputError("boundary: found every DoF, expected some interior ones");
  }
  return partition;
}

void check_boundary_holds(const fe::FeModel& model, const DofPartition& partition,
                          const fe::FreeMotions& free) {
  if (free.count() == 0) return;
  const Eigen::MatrixXd held = free.q(partition.boundary, Eigen::all);
  const dense::Svd svd = dense::svd(held);
  const Eigen::VectorXd& strength = svd.values;
  const double limit = strength.size() > 0 ? 1e-6 * strength[0] : 0.0;
  Eigen::Index rank = 0;
  while (rank < strength.size() && strength[rank] > limit && strength[rank] > 0.0) ++rank;
  if (rank == free.count()) return;
  const Eigen::VectorXd combination = svd.V.col(free.count() - 1);
  const Eigen::VectorXd motion = free.unit * combination;
  Eigen::Index most = 0;
  (free.q * combination).cwiseAbs().maxCoeff(&most);
  throw InputError(
      fmt::format("boundary: its {} coordinates hold {} of the {} {} rigid motions, "
                  "not the {}, largest at {}: "
                  "add a set that holds it{}",
                  partition.boundary.size(), rank,
                  free.bodies > 1 ? fmt::format("{} bodies'", free.bodies) : "body's", free.count(),
                  fe::motion_name(motion, fe::characteristic_length(model)),
                  fe::describe_dof(model, static_cast<int32_t>(most)),
                  free.bodies > 1 ? ", or join what is not connected" : ""));
}

}  // namespace clatter::condense
