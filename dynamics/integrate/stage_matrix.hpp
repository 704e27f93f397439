// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The Newton matrix of an implicit stage.
#include <Eigen/Core>
#include <Eigen/LU>
#include <optional>
#include <vector>

#include "dynamics/integrate/sparse_lu.hpp"
#include "dynamics/integrate/stage_operator.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// J = I - S T in the interface coordinates, T = sum of the elements' tangents, factored.
///
/// S couples the coordinates of one body, a tangent those of one element: the rows of a body are
/// full in the columns of all elements that touch it and empty elsewhere. Where that leaves most of
/// J empty, as in a chain, it is factored as a sparse matrix whose pattern is analysed once. Else
/// the rows and columns that elements touch at the moment are factored as a dense matrix; the other
/// rows follow from them.
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
  /// Entries of J that may differ from 0.
  int nonzeros() const { return nonzeros_; }
  /// Rows of the dense matrix of the last form().
  int touched() const { return static_cast<int>(dense_.rows()); }
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
  /// One element's part in the rows of one body.
  struct Part {
    int element = 0, body = 0;
    std::vector<int> rows;       // of the tangent: those of this body
    std::vector<int> body_rows;  // the same as rows of the body's P
    std::vector<int> S_rows;     // dense: the same as rows of S_
    std::vector<int> columns;    // y positions of the tangent's columns
    std::vector<int> starts;     // sparse: where the body's rows of those columns begin in values_
  };
  void order();
  std::vector<Part> parts_of(int element, const std::vector<int>& touched) const;
  void find_pattern();
  void list_touched();
  bool form_dense(const StageOperator& op);
  bool form_sparse(const StageOperator& op);
  void form_S(const StageOperator& op);
  Eigen::Map<const Eigen::MatrixXd> product(const Part& part);

  const System* system_;
  std::vector<int> position_;  // of a y in J: bodies one after the other
  std::vector<int> first_;     // position of a body's first row
  std::vector<Part> all_;      // parts of entire elements
  int nonzeros_ = 0;

  std::optional<SparseLu> sparse_;
  std::vector<double> values_;
  std::vector<int> diagonal_;  // positions in values_

  std::vector<Part> parts_;                  // dense: of what is touched
  std::vector<std::vector<int>> body_rows_;  // per body: its touched rows
  std::vector<int> dense_row_;               // per position: its row in dense_; -1: not touched
  std::vector<std::vector<int>> touched_;    // per element, as in the form before
  std::vector<int> touched_y_;               // per row of dense_: its y
  std::vector<Eigen::MatrixXd> S_;           // per body, of its touched rows; sparse: of all
  double kappa_ = 0.0;                       // of S_; 0: not formed
  Eigen::MatrixXd dense_;
  std::vector<double> S_part_, T_part_, product_;  // matrices of one part
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  mutable Eigen::VectorXd right_, solved_, forces_, moved_;
};

}  // namespace clatter::dynamics
