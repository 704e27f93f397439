// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A part of which one process has all rows.
#include "condense/basis/partitioned_model.hpp"

namespace clatter::condense {

class LocalPart : public PartitionedModel {
 public:
  /// Partitions a model by the named boundary sets. InputError as partition_dofs and
  /// check_boundary_holds.
  /// @param model must outlive this.
  /// @param known permutation of K_ii, reused where it fits (hard case C7), instead of computing
  /// one.
  LocalPart(const fe::FeModel& model, const std::vector<std::string>& boundary,
            rom::EliminationOrder known = {});
  const sparse::MatrixPencil& interior() const override { return interior_; }
  const sparse::MatrixPencil& whole() const override { return whole_; }
  InteriorFactor factor_interior() const override;
  rom::InertiaInvariants inertia(const ReducedBasis& basis) const override;

 private:
  rom::EliminationOrder known_;
  sparse::LocalPencil interior_, whole_;
};

}  // namespace clatter::condense
