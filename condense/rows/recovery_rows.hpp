// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The rows of the basis for the displacements of the skin and of sets besides the boundary.
#include <map>
#include <string>
#include <vector>

#include "condense/basis/partitioned_model.hpp"
#include "condense/rows/skin_faces.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// Sets besides the boundary, as ReducedModel holds them.
struct RecoveredSets {
  std::vector<std::string> names;
  std::map<std::string, rom::DofSet> sets;  // DoFs are boundary coordinates, or r + row of combined
  std::map<std::string, rom::ContactGrid> grids;
  Eigen::MatrixXd combined;  // c x r
};

/// Joins the named surfaces of the model into one skin of quadratic triangles (skin_faces.hpp); a
/// face in two of them is used once. Holds the rows of the basis that the skin needs.
class SkinRecovery {
 public:
  /// InputError for an unknown surface or set.
  SkinRecovery(const PartitionedModel& part, const std::vector<std::string>& surfaces,
               const std::vector<std::string>& sets);
  /// Interior DoFs (indices into part.dofs.interior) that move the skin and the sets, ascending.
  const std::vector<int32_t>& unknowns() const { return unknowns_; }
  /// Brings the rows of all processes to rank 0, where recover() and recover_sets() then work with
  /// them; elsewhere nothing is left to recover.
  /// @param static_rows Psi at unknowns(); shape_rows the same of X; both become those at the
  /// unknowns of all processes.
  void gather(const PartitionedModel& part, RowMatrix& static_rows, RowMatrix& shape_rows);
  /// The skin with T_skin = T(skin nodes, :) V.
  /// @param static_rows rows x n_b and shape_rows rows x k, as gather() left them.
  rom::Skin recover(const RowMatrix& static_rows, const RowMatrix& shape_rows) const;
  /// The sets with their displacements.
  RecoveredSets recover_sets(const RowMatrix& static_rows, const RowMatrix& shape_rows) const;

 private:
  const fe::FeModel& model_;
  std::vector<std::string> surfaces_, sets_;
  SkinFaces faces_;
  std::vector<int32_t> unknowns_;
  std::vector<int32_t> row_;       // by DoF of the model: its row of Psi and X, or -1
  std::vector<int32_t> boundary_;  // by DoF of the model: its coordinate, or -1
};

}  // namespace clatter::condense
