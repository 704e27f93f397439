// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A part whose rows the ranks of an MPI program share.
#include <filesystem>

#include "condense/basis/partitioned_model.hpp"
#include "core/ranks/shared_pencil.hpp"

namespace clatter::condense {

class SharedPart : public PartitionedModel {
 public:
  /// Reads the matrices of `path` in parts and partitions the model; each rank has the rows of its
  /// part of the elimination order. InputError as LocalPart and read_fe_model.
  /// @param all, model must outlive this; model without matrices, of the same file.
  /// @param known permutation of K_ii, reused where it fits.
  SharedPart(const ranks::Ranks& all, const std::filesystem::path& path, const fe::FeModel& model,
             const std::vector<std::string>& boundary, const rom::EliminationOrder& known);
  const sparse::MatrixPencil& interior() const override { return interior_; }
  const sparse::MatrixPencil& whole() const override { return whole_; }
  InteriorFactor factor_interior() const override;
  rom::InertiaInvariants inertia(const ReducedBasis& basis) const override;

 private:
  ranks::SharedMatrices matrices_;
  ranks::SharedPencil interior_, whole_;
};

}  // namespace clatter::condense
