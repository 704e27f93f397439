// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The Newton matrix of an implicit stage as a sparse matrix.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/integrate/sparse_lu.hpp"
#include "dynamics/integrate/stage_operator.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// J = I - S T for systems of many bodies that each meet few others.
///
/// The rows of a body that S couples are a cluster: one row each for a rigid body in a plane, all
/// rows of a reduced part. In a column of T that touches a cluster all its rows are full. For a
/// wide cluster, a reduced part with many rows under a chain whose links touch three of them, the
/// scaled forces g = D T y on it, D = diag S, are unknowns of their own,
///
///   y_c - S D^-1 g = r,   g - D T y = 0,
///
/// so that T and S keep their own patterns instead of that of their product.
class SparseStage {
 public:
  /// `system` with all its bodies and elements.
  explicit SparseStage(const System& system);

  int unknowns() const { return unknowns_; }
  /// Entries of J that may differ from 0.
  int nonzeros() const { return static_cast<int>(values_.size()); }
  /// Of L and U, after the first form().
  int factor_nonzeros() const { return lu_->factor_nonzeros(); }
  /// J of this operator with the tangents of the last evaluation; false when it is singular or not
  /// finite.
  [[nodiscard]] bool form(const StageOperator& op);
  /// x <- J^-1 x, n_y.
  void solve(Eigen::VectorXd& x) const;

 private:
  /// Rows of a body that S couples.
  struct Cluster {
    int body = 0;
    std::vector<int> rows;      // of the body's P, ascending
    int first = 0;              // unknown of the first row
    int forces = -1;            // unknown of the first force; -1: not wide
    std::vector<int> S_places;  // wide: where column k of -S D^-1 begins in values_
    Eigen::MatrixXd S;
  };
  /// The block of one group of an element in the rows of one cluster.
  struct Part {
    int element = 0, group = 0, cluster = 0;
    std::vector<int> rows;          // of the block: those in this cluster
    std::vector<int> cluster_rows;  // the same as rows of the cluster
    std::vector<int> columns;       // unknowns of the block's columns
    std::vector<int> places;  // in values_: of the cluster's first row, per column; wide: per row
                              // and column, column by column
  };
  void find_clusters();
  void find_parts();
  void find_pattern();
  void add_S();
  void add_part(const Part& part, const Eigen::MatrixXd& T);
  /// The tangent of an element without groups in all its coordinates.
  const Eigen::MatrixXd& entire_tangent(int element);
  void form_S(const StageOperator& op);

  const System* system_;
  std::vector<Cluster> clusters_;
  std::vector<int> cluster_, position_;  // of a y: its cluster, its unknown
  std::vector<Part> parts_;
  int unknowns_ = 0;
  std::vector<int> starts_, rows_;  // the pattern by columns
  std::optional<SparseLu> lu_;      // from the first form() on
  std::vector<double> values_;
  std::vector<int> diagonal_;  // places in values_
  double kappa_ = 0.0;         // of S; 0: not formed
  Eigen::MatrixXd entire_;
  mutable std::vector<double> right_;
};

}  // namespace clatter::dynamics
