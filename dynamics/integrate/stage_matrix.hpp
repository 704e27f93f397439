// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The Newton matrix of an implicit stage.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/integrate/dense_lu.hpp"
#include "dynamics/integrate/sparse_stage.hpp"
#include "dynamics/integrate/stage_operator.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// J = I - S T in the interface coordinates, T = sum of the elements' tangents, factored.
///
/// S couples the coordinates of one body, a tangent those of one element or of its groups. Where
/// that leaves most of both empty, as in a chain, it is factored body by body (sparse_stage.hpp).
/// Else J is formed in the rows that elements touch at the moment (the others follow from them),
/// and factored in the columns c in which T is not negligible: x_c = J_cc^-1 b_c, and x = b + S T
/// x_c in the rest, as on a skirt's pad that carries no load.
class StageMatrix {
 public:
  /// `system` with all its bodies and elements.
  explicit StageMatrix(const System& system);

  /// J of this operator with the tangents of the last evaluation; false when it is singular or not
  /// finite.
  [[nodiscard]] bool form(const StageOperator& op);
  /// x <- J^-1 x, n_y; `op` has the kappa of the last form().
  void solve(const StageOperator& op, Eigen::VectorXd& x) const;

  bool is_sparse() const { return sparse_.has_value(); }
  /// Entries of S and T that may differ from 0.
  int nonzeros() const { return nonzeros_; }
  const SparseStage* sparse() const { return sparse_ ? &*sparse_ : nullptr; }
  /// Rows that the elements of the last form() touch; 0: sparse.
  int touched() const { return static_cast<int>(touched_y_.size()); }
  /// Rows of the dense factor.
  int factored() const { return static_cast<int>(columns_.size()); }
  /// Whether the last form() was dense, of this operator's kappa and of what the elements touch
  /// now: then the equations can be solved in those rows alone.
  bool covers(const StageOperator& op) const;
  /// The y of those rows, k.
  const std::vector<int>& touched_y() const { return touched_y_; }
  /// S f in those rows, k; `f` (n_y) is zero in the others.
  void apply_S(const Eigen::VectorXd& f, Eigen::VectorXd& result) const;
  /// x <- J^-1 x in those rows, k.
  void solve_touched(Eigen::VectorXd& x) const;

 private:
  void list_touched();
  bool form_dense(const StageOperator& op);
  void form_S(const StageOperator& op);
  void add_tangents();
  void add_blocks(int element);
  void pick_significant();
  void add_S(const Eigen::VectorXd& f, Eigen::VectorXd& result) const;

  const System* system_;
  std::optional<SparseStage> sparse_;
  int nonzeros_ = 0;

  std::vector<std::vector<int>> touched_;    // per element, as in the form before
  std::vector<int> touched_y_;               // k
  std::vector<int> row_;                     // of a y in touched_y_; -1: not touched
  std::vector<std::vector<int>> body_rows_;  // per body: its touched rows
  std::vector<Eigen::MatrixXd> S_;           // per body, of its touched rows
  double kappa_ = 0.0;                       // of S_; 0: not formed
  Eigen::MatrixXd T_;                        // of the touched rows, k x k
  Eigen::VectorXd size_;                     // root of the diagonal of S, k
  std::vector<int> rows_, columns_;          // of T_ that are not negligible
  std::vector<double> S_part_, T_part_;      // blocks of S_ and T_ in those
  DenseLu lu_;                               // of J in columns_
  // Mutable: working memory of the solves, so that no step takes memory.
  mutable Eigen::VectorXd right_, forces_, moved_;
  mutable std::vector<double> solved_;  // in columns_, whose number changes
};

}  // namespace clatter::dynamics
