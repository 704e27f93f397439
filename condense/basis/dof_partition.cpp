// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/dof_partition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

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
      int32_t& here = coordinate[static_cast<size_t>(dof)];
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
    if (coordinate[static_cast<size_t>(dof)] < 0) partition.interior.push_back(dof);
  }
  if (partition.interior.empty()) {
    throw InputError("boundary: found every DoF, expected some interior ones");
  }
  return partition;
}

PartitionedMatrix partition_matrix(const SparseMatrix& lower, const DofPartition& partition) {
  const auto n = static_cast<size_t>(lower.cols());
  const auto n_i = static_cast<int>(partition.interior.size());
  const auto n_b = static_cast<int>(partition.boundary.size());
  std::vector<int> block_index(n);
  std::vector<char> is_boundary(n, 0);
  for (int k = 0; k < n_i; ++k) block_index[static_cast<size_t>(partition.interior[k])] = k;
  for (int k = 0; k < n_b; ++k) {
    block_index[static_cast<size_t>(partition.boundary[k])] = k;
    is_boundary[static_cast<size_t>(partition.boundary[k])] = 1;
  }
  std::vector<Eigen::Triplet<double>> ii, ib;
  ii.reserve(static_cast<size_t>(lower.nonZeros()));
  PartitionedMatrix blocks;
  blocks.bb = Eigen::MatrixXd::Zero(n_b, n_b);
  for (int j = 0; j < lower.outerSize(); ++j) {
    const bool column_b = is_boundary[static_cast<size_t>(j)] != 0;
    const int q = block_index[static_cast<size_t>(j)];
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      const bool row_b = is_boundary[static_cast<size_t>(it.row())] != 0;
      const int p = block_index[static_cast<size_t>(it.row())];
      if (row_b && column_b) {
        blocks.bb(p, q) = blocks.bb(q, p) = it.value();
      } else if (row_b) {
        ib.emplace_back(q, p, it.value());
      } else if (column_b) {
        ib.emplace_back(p, q, it.value());
      } else {
        ii.emplace_back(p, q, it.value());  // ascending indices keep p >= q
      }
    }
  }
  blocks.ii.resize(n_i, n_i);
  blocks.ii.setFromTriplets(ii.begin(), ii.end());
  blocks.ib.resize(n_i, n_b);
  blocks.ib.setFromTriplets(ib.begin(), ib.end());
  return blocks;
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

PartitionedModel partition_model(const fe::FeModel& model,
                                 const std::vector<std::string>& boundary) {
  PartitionedModel part{model, partition_dofs(model, boundary), {},
                        {},    fe::free_motions(model),         nullptr};
  check_boundary_holds(model, part.dofs, part.free);
  part.K = partition_matrix(model.K, part.dofs);
  part.M = partition_matrix(model.M, part.dofs);
  return part;
}

const sparse::RowTeam& PartitionedModel::team() const {
  return shared ? shared->interior().team() : sparse::one_process();
}

std::shared_ptr<const sparse::MatrixPencil> PartitionedModel::interior() const {
  if (shared) return {shared, &shared->interior()};
  return std::make_shared<sparse::LocalPencil>(K.ii, M.ii);
}

std::shared_ptr<const sparse::MatrixPencil> PartitionedModel::whole() const {
  if (shared) return {shared, &shared->whole()};
  return std::make_shared<sparse::LocalPencil>(full.K, full.M);
}

std::vector<int32_t> PartitionedModel::interior_of_whole() const {
  if (!shared) return dofs.interior;
  std::vector<int32_t> first(dofs.interior.size());
  std::iota(first.begin(), first.end(), 0);
  return first;
}

Eigen::MatrixXd PartitionedModel::rows_of_whole(const Eigen::MatrixXd& all) const {
  return shared ? Eigen::MatrixXd(all(shared->whole_dofs(), Eigen::all)) : all;
}

}  // namespace clatter::condense
