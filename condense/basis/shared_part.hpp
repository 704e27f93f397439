// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A part whose matrices are shared by a team of processes.
#include <Eigen/Core>
#include <memory>

#include "core/rom/elimination_order.hpp"
#include "core/sparse/eigen/matrix_pencil.hpp"
#include "core/sparse/factor/factor.hpp"

namespace clatter::condense {

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
};

}  // namespace clatter::condense
