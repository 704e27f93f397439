// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/rows/recovery_rows.hpp"

#include <utility>

#include "core/base/named.hpp"
#include "core/base/threads.hpp"

namespace clatter::condense {
namespace {

using RowSparse = Eigen::SparseMatrix<double, Eigen::RowMajor, int32_t>;

/// body(dof, factor) for each DoF that moves point `row / 3` in direction row % 3.
template <class Body>
void for_each_dof(const RowSparse& T, const SkinPoint& point, Eigen::Index direction, Body&& body) {
  for (const auto& [node, weight] : point)
    for (RowSparse::InnerIterator it(T, 3 * int64_t{node} + direction); it; ++it)
      body(static_cast<size_t>(it.col()), weight * it.value());
}

}  // namespace

SkinRecovery::SkinRecovery(const PartitionedModel& part, const std::vector<std::string>& surfaces,
                           const std::vector<std::string>& sets)
    : model_(part.full),
      surfaces_(surfaces),
      sets_(sets),
      row_(static_cast<size_t>(model_.size()), -1),
      boundary_(static_cast<size_t>(model_.size()), -1) {
  const fe::FeModel& model = part.full;
  const DofPartition& partition = part.dofs;
  for (size_t k = 0; k < partition.boundary.size(); ++k)
    boundary_[partition.boundary[k]] = static_cast<int32_t>(k);
  if (!surfaces.empty()) faces_ = skin_faces(model, surfaces);
  const RowSparse by_row = model.T;
  std::vector<char> moves(static_cast<size_t>(model.size()), 0);
  for (const SkinPoint& point : faces_.points)
    for (Eigen::Index d = 0; d < 3; ++d)
      for_each_dof(by_row, point, d, [&](size_t dof, double) { moves[dof] = 1; });
  for (const std::string& name : sets)
    for (const int32_t dof : find_named(model.sets, model.name + ": rows", "set", name).dofs)
      moves[dof] = 1;
  for (size_t k = 0; k < partition.interior.size(); ++k) {
    const auto dof = static_cast<size_t>(partition.interior[k]);
    if (moves[dof] == 0) continue;
    row_[dof] = static_cast<int32_t>(unknowns_.size());
    unknowns_.push_back(static_cast<int32_t>(k));
  }
}

void SkinRecovery::gather(const PartitionedModel& part, RowMatrix& static_rows,
                          RowMatrix& shape_rows) {
  const sparse::RowTeam& team = part.team();
  std::vector<int32_t> dofs;
  for (const int32_t k : unknowns_) dofs.push_back(part.dofs.interior[k]);
  dofs = team.gather(std::move(dofs));
  shape_rows = team.gather(std::move(shape_rows));
  static_rows = team.gather(std::move(static_rows));
  if (team.rank() > 0) {
    faces_ = {};
    sets_.clear();
    return;
  }
  for (size_t k = 0; k < dofs.size(); ++k) row_[dofs[k]] = static_cast<int32_t>(k);
}

rom::Skin SkinRecovery::recover(const RowMatrix& static_rows, const RowMatrix& shape_rows) const {
  rom::Skin skin;
  if (faces_.points.empty()) return skin;
  skin.triangles = faces_.triangles;
  skin.surfaces = surfaces_;
  skin.faces = faces_.of_surface;
  skin.sheet = faces_.sheet;
  const auto n = static_cast<Eigen::Index>(faces_.points.size());
  skin.nodes = RowMatrix::Zero(n, 3);
  for (Eigen::Index p = 0; p < n; ++p)
    for (const auto& [node, weight] : faces_.points[p])
      skin.nodes.row(p) += weight * model_.nodes.row(node);
  const RowSparse by_row = model_.T;
  const Eigen::Index n_b = static_rows.cols(), k = shape_rows.cols();
  skin.T = RowMatrix::Zero(3 * n, n_b + k);
  parallel_pieces(skin.T.rows(), [&](int64_t begin, int64_t end) {
    for (int64_t row = begin; row < end; ++row) {
      const SkinPoint& point = faces_.points[row / 3];
      for_each_dof(by_row, point, row % 3, [&](size_t dof, double factor) {
        if (boundary_[dof] >= 0) {
          skin.T(row, boundary_[dof]) += factor;
          return;
        }
        skin.T.row(row).head(n_b) += factor * static_rows.row(row_[dof]);
        skin.T.row(row).tail(k) += factor * shape_rows.row(row_[dof]);
      });
    }
  });
  return skin;
}

RecoveredSets SkinRecovery::recover_sets(const RowMatrix& static_rows,
                                         const RowMatrix& shape_rows) const {
  RecoveredSets recovered;
  Eigen::MatrixXd& combined = recovered.combined;
  const Eigen::Index n_b = static_rows.cols(), r = n_b + shape_rows.cols();
  for (const std::string& name : sets_) {
    rom::DofSet set = model_.sets.at(name);
    for (int32_t& dof : set.dofs) {
      const auto at = static_cast<size_t>(dof);
      if (boundary_[at] >= 0) {
        dof = boundary_[at];
        continue;
      }
      const Eigen::Index j = combined.rows();
      dof = static_cast<int32_t>(r + j);
      combined.conservativeResize(j + 1, r);
      combined.row(j).head(n_b) = static_rows.row(row_[at]);
      combined.row(j).tail(shape_rows.cols()) = shape_rows.row(row_[at]);
    }
    recovered.sets[name] = set;
    if (const auto grid = model_.grids.find(name); grid != model_.grids.end())
      recovered.grids[name] = grid->second;
    recovered.names.push_back(name);
  }
  return recovered;
}

}  // namespace clatter::condense
