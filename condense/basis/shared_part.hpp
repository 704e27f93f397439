// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A part whose matrices are shared by a team of processes.
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <memory>
#include <vector>

#include "core/rom/elimination_order.hpp"
#include "core/sparse/eigen/matrix_pencil.hpp"
#include "core/sparse/factor/factor.hpp"

namespace clatter::condense {

/// An entry of a matrix, its row and column by DoFs of the model.
using DofEntry = Eigen::Triplet<double, int32_t>;

/// A x of a matrix that need not be symmetric; rows of x and of the result as those of whole().
using RowProduct = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& x)>;

/// What only the team can compute of a part. Each process has the rows DofPartition::interior of
/// the interior.
class SharedPart {
 public:
  virtual ~SharedPart() = default;
  /// K_ii and M_ii.
  virtual const sparse::MatrixPencil& interior() const = 0;
  /// K and M; its rows in this process are those of the interior, then boundary ones.
  virtual const sparse::MatrixPencil& whole() const = 0;
  /// DoFs of the rows of whole() in this process.
  virtual const std::vector<int32_t>& whole_dofs() const = 0;
  /// Factor of K_ii with the coupling K_ib, and the permutation that it used.
  virtual std::shared_ptr<const sparse::Factor> factor_interior() const = 0;
  virtual const rom::EliminationOrder& order() const = 0;
  /// M in the rows of this process.
  virtual std::vector<DofEntry> mass_entries() const = 0;
  /// Product with a matrix of which each process gives its rows, whole_dofs(); collective.
  virtual RowProduct product_with(const std::vector<DofEntry>& own_rows) const = 0;
};

}  // namespace clatter::condense
