// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/ranks/shared_part_of_ranks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/ranks/shared_fe_model.hpp"
#include "core/ranks/shared_pencil.hpp"

namespace clatter::condense {
namespace {

using ranks::Entries;
using ranks::Entry;
using ranks::Numbering;
using ranks::RowShares;

class PartOfRanks : public SharedPart {
 public:
  PartOfRanks(const ranks::Ranks& all, RowShares shares, const Numbering& numbering,
              ranks::SharedMatrices matrices)
      : all_(all),
        shares_(shares),
        index_(numbering.index),
        dof_(numbering.dof),
        matrices_(std::move(matrices)),
        order_(numbering.stored),
        interior_(all, shares, matrices_.K, matrices_.M, ranks::Extent::kInterior),
        whole_(all, shares, matrices_.K, matrices_.M, ranks::Extent::kWhole) {
    for (const int64_t row : shares.rows_of(all.rank(), true))
      whole_dofs_.push_back(numbering.dof[static_cast<size_t>(row)]);
  }
  const sparse::MatrixPencil& interior() const override { return interior_; }
  const sparse::MatrixPencil& whole() const override { return whole_; }
  const std::vector<int32_t>& whole_dofs() const override { return whole_dofs_; }
  std::shared_ptr<const sparse::Factor> factor_interior() const override {
    try {
      return interior_.factor_with_boundary();
    } catch (const sparse::NotPositiveDefinite& error) {
      throw sparse::NotPositiveDefinite(
          fmt::format("the boundary does not hold the body: K_ii {}; add a set to the boundary, or "
                      "look for a part of the mesh that is not connected",
                      error.what()),
          error.column);
    }
  }
  const rom::EliminationOrder& order() const override { return order_; }
  const ranks::SharedMatrices& matrices() const { return matrices_; }
  const ranks::SharedPencil& whole_pencil() const { return whole_; }
  std::vector<DofEntry> mass_entries() const override {
    std::vector<DofEntry> out;
    out.reserve(matrices_.M.size());
    for (const Entry& entry : matrices_.M)
      out.emplace_back(dof_[static_cast<size_t>(entry.row)],
                       dof_[static_cast<size_t>(entry.column)], entry.value);
    return out;
  }
  RowProduct product_with(const std::vector<DofEntry>& own_rows) const override {
    Entries entries;
    entries.reserve(own_rows.size());
    for (const DofEntry& entry : own_rows)
      entries.push_back({index_[static_cast<size_t>(entry.row())],
                         index_[static_cast<size_t>(entry.col())], entry.value()});
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return a.row != b.row ? a.row < b.row : a.column < b.column;
    });
    const auto matrix = std::make_shared<ranks::SharedMatrix>(all_, shares_, entries, true);
    return [matrix](const Eigen::MatrixXd& x) { return Eigen::MatrixXd(*matrix * x); };
  }

 private:
  const ranks::Ranks& all_;
  RowShares shares_;
  std::vector<int32_t> index_, dof_;
  ranks::SharedMatrices matrices_;
  rom::EliminationOrder order_;
  ranks::SharedPencil interior_, whole_;
  std::vector<int32_t> whole_dofs_;
};

/// The blocks of the boundary: own rows of A_ib, and all of A_bb.
PartitionedMatrix boundary_blocks(const ranks::Ranks& all, const RowShares& shares,
                                  const Entries& entries) {
  const int64_t n_i = shares.interior(), n_b = shares.boundary();
  PartitionedMatrix out;
  out.bb = Eigen::MatrixXd::Zero(n_b, n_b);
  std::vector<Eigen::Triplet<double>> coupling;
  for (const Entry& entry : entries) {
    if (entry.column < n_i) continue;
    const auto column = static_cast<int32_t>(entry.column - n_i);
    if (entry.row < n_i)
      coupling.emplace_back(static_cast<int32_t>(shares.local(entry.row)), column, entry.value);
    else
      out.bb(entry.row - n_i, column) = entry.value;
  }
  all.sum(out.bb.data(), out.bb.size());
  const auto rows = static_cast<Eigen::Index>(shares.rows_of(all.rank(), false).size());
  out.ib.resize(rows, n_b);
  out.ib.setFromTriplets(coupling.begin(), coupling.end());
  return out;
}

}  // namespace

PartitionedModel share_part(const ranks::Ranks& all, const std::filesystem::path& path,
                            const fe::FeModel& model, const std::vector<std::string>& boundary,
                            const rom::EliminationOrder& order) {
  PartitionedModel part{model, partition_dofs(model, boundary), {}, {}, {}, nullptr};
  DofPartition& dofs = part.dofs;
  const Numbering numbering = ranks::number_dofs(all, path, dofs.interior, dofs.boundary, order);
  const RowShares shares(static_cast<int64_t>(dofs.interior.size()), numbering.boundary,
                         all.size());
  const auto shared = std::make_shared<PartOfRanks>(
      all, shares, numbering, ranks::read_matrices(all, path, numbering, shares));
  const ranks::SharedMatrices& matrices = shared->matrices();
  part.free = ranks::free_motions(all, matrices, shares, {ranks::Extent::kWhole, numbering},
                                  shared->whole_pencil(), model.rigid);
  check_boundary_holds(model, dofs, part.free);
  dofs.interior.clear();
  for (const int64_t row : shares.rows_of(all.rank(), false))
    dofs.interior.push_back(numbering.dof[static_cast<size_t>(row)]);
  part.K = boundary_blocks(all, shares, matrices.K);
  part.M = boundary_blocks(all, shares, matrices.M);
  part.shared = shared;
  return part;
}

}  // namespace clatter::condense
