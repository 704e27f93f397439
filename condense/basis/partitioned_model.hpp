// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A part in blocks, which every step of the reduction gets.
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "condense/basis/dof_partition.hpp"
#include "core/base/sparse.hpp"
#include "core/rom/elimination_order.hpp"
#include "core/rom/inertia_invariants.hpp"
#include "core/sparse/eigen/matrix_pencil.hpp"
#include "core/sparse/factor/factor.hpp"

namespace clatter::condense {

class ReducedBasis;

/// A symmetric matrix in blocks, A = [A_ii A_ib; A_bi A_bb]; in a team ib has the rows of this
/// process, and ii is empty.
struct PartitionedMatrix {
  SparseMatrix ii;     // n_i x n_i, lower triangle
  SparseMatrix ib;     // n_i x n_b
  Eigen::MatrixXd bb;  // n_b x n_b, both triangles
};

/// Factor of K_ii with the coupling K_ib, and the permutation that it used.
struct InteriorFactor {
  std::shared_ptr<const sparse::Factor> factor_ii;
  rom::EliminationOrder order;
};

/// A part as this process has it: alone (LocalPart), or with some rows of the interior in a team of
/// processes, where every function is collective. The steps of a reduction know no more of a team
/// than this, Factor and RowTeam.
class PartitionedModel {
 public:
  virtual ~PartitionedModel() = default;
  PartitionedModel(const PartitionedModel&) = delete;
  PartitionedModel& operator=(const PartitionedModel&) = delete;

  /// (K_ii, M_ii).
  virtual const sparse::MatrixPencil& interior() const = 0;
  /// (K, M).
  virtual const sparse::MatrixPencil& whole() const = 0;
  /// Throws NotPositiveDefinite.
  virtual InteriorFactor factor_interior() const = 0;
  /// Shape integrals of a rotating body (frame_inertia.hpp).
  virtual rom::InertiaInvariants inertia(const ReducedBasis& basis) const = 0;

  const sparse::RowTeam& team() const { return whole().team(); }
  /// The rows of whole() of a matrix n x m with one row for each DoF.
  Eigen::MatrixXd rows_of_whole(const Eigen::MatrixXd& all) const {
    return all(whole_dofs, Eigen::all);
  }

  const fe::FeModel& full;
  DofPartition dofs;
  PartitionedMatrix K, M;                  // [N/m], [kg]
  fe::FreeMotions free;                    // rigid motions that the supports leave free
  std::vector<int32_t> whole_dofs;         // DoFs of the rows of whole() in this process
  std::vector<int32_t> interior_of_whole;  // rows of whole() that are those of interior()

 protected:
  /// InputError as partition_dofs.
  PartitionedModel(const fe::FeModel& model, const std::vector<std::string>& boundary)
      : full(model), dofs(partition_dofs(model, boundary)) {}
};

}  // namespace clatter::condense
