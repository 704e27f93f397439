// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The processes that share the rows of tall matrices.
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/base/matrix.hpp"

namespace clatter::sparse {

/// Each process of a team holds some rows of every tall matrix (n x m), and all of every small one
/// (m x m). What is a sum over rows becomes a sum over the team. This base class is the team of one
/// process, which has all rows.
class RowTeam {
 public:
  virtual ~RowTeam() = default;
  virtual int rank() const { return 0; }
  virtual int size() const { return 1; }
  /// values <- their sum over the team; every process receives the same bits.
  virtual void sum(double* values, int64_t count) const;
  /// values <- the smallest of the team.
  virtual void least(double* values, int64_t count) const;
  /// values <- those of rank 0, so that all take the same decisions.
  virtual void agree(double* values, int64_t count) const;
  /// The rows of all processes, in their order, on rank 0; elsewhere none.
  virtual RowMatrix gather(RowMatrix rows) const;
  virtual std::vector<int32_t> gather(std::vector<int32_t> values) const;
  /// The same, `size` x m, with row k of this process at places[k]; elsewhere size x 0.
  Eigen::MatrixXd gather_at(const std::vector<int32_t>& places, const Eigen::MatrixXd& rows,
                            Eigen::Index size) const;

  Eigen::MatrixXd sum(Eigen::MatrixXd part) const;
  double sum(double part) const;
  double least(double value) const;
  bool any(bool here) const { return sum(here ? 1.0 : 0.0) > 0.0; }
  /// Euclidean norms of the columns of a tall matrix, m.
  Eigen::VectorXd norms(const Eigen::Ref<const Eigen::MatrixXd>& x) const;
};

/// The team of this process alone.
const RowTeam& one_process();

}  // namespace clatter::sparse
