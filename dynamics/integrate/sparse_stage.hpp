// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The Newton matrix of an implicit stage of many bodies that each meet few others.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/integrate/body_elimination.hpp"
#include "dynamics/integrate/stage_operator.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// J = I - S T, factored body by body (body_elimination.hpp).
///
/// The order follows the blocks of the tangents that are active: a link meets the one sprocket on
/// which it is, not all on which it may be. A wide body, a reduced part with many rows that chains,
/// shafts and mounts touch in a few each, stays to the end; its rows that the same elements touch
/// are a node, so that a link does not meet all of them. Where elimination body by body is not
/// stable all of J is factored as a dense matrix.
class SparseStage {
 public:
  /// `system` with all its bodies and elements.
  explicit SparseStage(const System& system);

  /// Entries of S and T that may differ from 0.
  int nonzeros() const { return nonzeros_; }
  /// Unknowns of wide bodies, which are factored dense.
  int staying() const;
  /// J of this operator with the tangents of the last evaluation; false when it is singular or not
  /// finite.
  [[nodiscard]] bool form(const StageOperator& op);
  /// Whether the last form() factored all of J as a dense matrix.
  bool is_dense() const { return is_dense_; }
  /// x <- J^-1 x, n_y.
  void solve(Eigen::VectorXd& x) const;

 private:
  void find_unknowns();
  void find_couplings();
  void count_nonzeros();
  bool renew_couplings();
  void copy_S(const StageOperator& op);

  /// What is coupled, from which element and group it is.
  struct Source {
    int element = 0, group = 0;
  };
  const System* system_;
  StageGraph graph_;
  std::vector<Source> sources_;         // of graph_.couplings
  std::vector<int> body_;               // in the system, of a body of the graph
  std::vector<std::vector<int>> rows_;  // per body of the graph: of its P, in the order of unknowns
  std::vector<int> unknown_, node_;     // of a y: its unknown, its node
  int nonzeros_ = 0;
  double kappa_ = 0.0;  // of graph_.S; 0: not formed
  std::optional<BodyElimination> by_bodies_, at_once_;
  bool started_ = false, is_dense_ = false;
  mutable std::vector<double> right_;  // working memory: no solve takes memory
};

}  // namespace clatter::dynamics
