// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/ranks/shared_part.hpp"

#include <numeric>

#include "condense/ranks/row_inertia.hpp"

namespace clatter::condense {
namespace {

/// The blocks of the boundary: own rows of A_ib, and all of A_bb.
PartitionedMatrix boundary_blocks(const ranks::SharedMatrices& own, const ranks::Entries& entries) {
  const ranks::RowShares& shares = own.shares;
  const int64_t n_i = shares.interior(), n_b = shares.boundary();
  PartitionedMatrix out;
  out.bb = Eigen::MatrixXd::Zero(n_b, n_b);
  std::vector<Eigen::Triplet<double>> coupling;
  for (const ranks::Entry& entry : entries) {
    if (entry.column < n_i) continue;
    const auto column = static_cast<int32_t>(entry.column - n_i);
    if (entry.row < n_i)
      coupling.emplace_back(static_cast<int32_t>(shares.local(entry.row)), column, entry.value);
    else
      out.bb(entry.row - n_i, column) = entry.value;
  }
  own.ranks.sum(out.bb.data(), out.bb.size());
  const auto rows = static_cast<Eigen::Index>(shares.rows_of(own.ranks.rank(), false).size());
  out.ib.resize(rows, n_b);
  out.ib.setFromTriplets(coupling.begin(), coupling.end());
  return out;
}

}  // namespace

SharedPart::SharedPart(const ranks::Ranks& all, const std::filesystem::path& path,
                       const fe::FeModel& model, const std::vector<std::string>& boundary,
                       const rom::EliminationOrder& known)
    : PartitionedModel(model, boundary),
      matrices_(all, path, dofs.interior, dofs.boundary, known),
      interior_(matrices_, ranks::Extent::kInterior),
      whole_(matrices_, ranks::Extent::kWhole) {
  free = whole_.free_motions(model.rigid);
  check_boundary_holds(model, dofs, free);
  whole_dofs = whole_.own_places();
  dofs.interior.assign(whole_dofs.begin(), whole_dofs.begin() + interior_.rows());
  interior_of_whole.resize(dofs.interior.size());
  std::iota(interior_of_whole.begin(), interior_of_whole.end(), 0);
  K = boundary_blocks(matrices_, matrices_.K);
  M = boundary_blocks(matrices_, matrices_.M);
}

InteriorFactor SharedPart::factor_interior() const {
  InteriorFactor out{interior_.factor_with_boundary(), matrices_.numbering.stored};
  out.order.entries = out.factor_ii->report().entries;
  return out;
}

rom::InertiaInvariants SharedPart::inertia(const ReducedBasis& basis) const {
  return row_inertia(*this, matrices_, basis);
}

}  // namespace clatter::condense
