// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Linear constraints by elimination: expresses every displacement by the model's coordinates.
//
// A DoF has a number (id): nodal displacements 3 a + d first, then six per reference point, then
// the generalised coordinates in order of addition. Three kinds of relations eliminate DoFs:
//   dependence   u_d = sum_k c_k u_k: rigid couplings, equations, ties;
//   coupling     q = C u: as many pivot displacements as it has rows (column-pivoted QR of C; a
//                displacement is a pivot at most once) are replaced by the coordinates q,
//                  u_piv = C_piv^-1 (q - C_rest u_rest);
//   support      s = u, or s = D u in a direction of its own: a coordinate that is held.
// Together u = T q + T_s s; with s = 0: K' = T^T K T, M' = T^T M T, f' = T^T f. A coupling excludes
// no displacement field, so K' and M' describe the same body; recovery is exact in each case.
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "assembly/coupling/coupling.hpp"
#include "core/base/sparse.hpp"

namespace clatter::assembly {

/// The transformation from all displacements to the model's coordinates q: first the displacements
/// that remain, by id, then the generalised ones in order of addition (without the group means that
/// a coupling's rows replaced); and likewise to the supported coordinates s.
struct Elimination {
  SparseMatrix T;                   // n_dofs x n
  SparseMatrix T_s;                 // n_dofs x n_s
  std::vector<int32_t> reduced_of;  // coordinate of each id, or -1
  std::vector<int32_t> support_of;  // supported coordinate of each id, or -1
  std::vector<int32_t> pivots;      // eliminated displacements and point DoFs, ascending
  SparseMatrix pivot_rows;          // pivots x n: their rows of T
  SparseMatrix pivot_rows_s;        // pivots x n_s: their rows of T_s
  double growth = 1.0;              // largest |entry| of T between displacements

  int size() const { return static_cast<int>(T.cols()); }
  int supports() const { return static_cast<int>(T_s.cols()); }
};

/// Collects the relations, then builds the transformation.
class Eliminator {
 public:
  /// `n_dofs` displacements of nodes and points; `fixed` are supported; `kept` stay coordinates
  /// (sensors, plain nodes, points) and are never pivots.
  Eliminator(int64_t n_dofs, const std::vector<int32_t>& fixed, const std::vector<int32_t>& kept);

  /// New coordinates without a relation (a reference node of its own); returns the first id.
  int32_t add_coordinates(int count);

  /// u[dof] = sum values[k] u[dofs[k]]. The caller (ConstraintGraph) ensures that `dof` depends on
  /// nothing yet and that dependences form no cycle.
  void depend(int32_t dof, const Functional& on);

  /// Adds a coupling: its means, then its rows, which get the next generalised ids in this order;
  /// returns the id of its first row. InputError, beginning with `where`, when its rows depend on
  /// supports or earlier couplings, or when it would fill the matrices beyond 32-bit indices.
  int32_t add(const Coupling& coupling, const std::string& where);

  /// The same with existing DoFs `ids` instead of new coordinates: they stay in the model and
  /// displacements of the face are eliminated. False when too few can be: then only the means have
  /// been added.
  bool add_onto(const Coupling& coupling, const std::vector<int32_t>& ids,
                const std::string& where);

  /// Supports s = rows u; returns the id of the first s. InputError, beginning with `where`, when
  /// no displacement is left to eliminate. Points' DoFs may be eliminated here, otherwise not.
  int32_t hold(const std::vector<Functional>& rows, const std::string& where);

  /// Coordinates q = rows u in place of as many DoFs of the rows; returns the id of the first q.
  /// Errors as for hold().
  int32_t turn(const std::vector<Functional>& rows, const std::string& where);

  /// Removes a coordinate that occurs in no relation.
  void drop(int32_t id);
  bool is_dropped(int32_t id) const;

  /// The functional in terms of the DoFs that are still in the model.
  Functional express(const Functional& functional);
  bool is_coordinate(int32_t id) const;
  bool is_held(int32_t id) const;
  bool is_eliminated(int32_t id) const { return state_[id] >= 0; }
  /// Ids of the ranges [first, last) and those that they depend on, as flags.
  std::vector<bool> moves_any(const std::vector<std::pair<int64_t, int64_t>>& ids) const;

  Elimination finish() const;

 private:
  int32_t replace(const std::vector<Functional>& rows, int32_t state, const std::string& where);

  using SparseRow = std::vector<std::pair<int32_t, double>>;  // ids ascending

  int32_t allocate(int count, int32_t state);
  SparseRow expand(const Functional& functional);
  void add_mean(const Functional& mean, const std::string& where);
  std::vector<Functional> add_means(const Coupling& coupling, const std::string& where);
  bool eliminate(const std::vector<Functional>& functionals, const std::vector<int32_t>& q_ids);
  [[noreturn]] static void refuse(const std::string& where, size_t count);
  void check_fill(const std::string& where) const;
  std::vector<int32_t> choose_pivots(const Eigen::MatrixXd& C,
                                     const std::vector<int32_t>& ids) const;
  void add_pivot(int32_t id, SparseRow row);
  void substitute(const std::vector<int32_t>& fresh);
  SparseRow gather();

  int64_t n_dofs_;
  int64_t fill_ = 0;            // entries that the couplings may add to K
  std::vector<int32_t> state_;  // per id: kFree, kKept, kFixed, kDropped or pivot number
  std::vector<SparseRow> pivot_rows_;
  std::vector<std::vector<int32_t>> users_;  // per id: pivot numbers whose rows (may) hold it
  std::vector<double> sum_;                  // scatter space of expand()
  std::vector<int32_t> touched_;
};

/// A symmetric matrix A on all DoFs in the model's coordinates. Of a stiffness, the equations are
/// K_qq q + K_sq^T s = f and K_sq q + K_ss s = f_s + reactions.
struct CoordinateBlocks {
  SparseMatrix qq;  // T^T A T, n x n, lower triangle
  SparseMatrix sq;  // T_s^T A T, n_s x n
  SparseMatrix ss;  // T_s^T A T_s, n_s x n_s, lower triangle
};

/// T^T A T (lower triangle) of symmetric A (`lower`, on the first A.cols() DoFs). A's memory is
/// used for the result: `lower` is left empty.
SparseMatrix transform(SparseMatrix&& lower, const Elimination& elimination);

/// The same with the blocks of the supported coordinates.
CoordinateBlocks transform_with_supports(SparseMatrix&& lower, const Elimination& elimination);

}  // namespace clatter::assembly
