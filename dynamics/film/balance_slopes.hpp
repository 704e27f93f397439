// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Exact derivatives of the cells' oil balances by the gap, at a solution of the film.
#include <Eigen/Core>

#include "core/base/matrix.hpp"
#include "dynamics/film/film_split.hpp"
#include "dynamics/film/stage_terms.hpp"

namespace clatter::film {

/// Derivatives of the balance of each cell at fixed unknowns. The arguments are read while it is
/// used; `pressure` [Pa] and `fill`, n each, are the solution for `terms` and `split`.
class BalanceSlopes {
 public:
  BalanceSlopes(const StageTerms& terms, const FilmSplit& split, const Eigen::ArrayXd& pressure,
                const Eigen::ArrayXd& fill)
      : terms_(terms), pad_(terms.pad()), split_(split), pressure_(pressure), fill_(fill) {}

  /// Writes minus the derivatives along the k gap fields `dh` (n x k) [m] into the first k columns
  /// of `rows` (zero before), row by PadFaces::row. `height` (k) [m]: by how much each field moves
  /// the pad past the ends of the liner; null: none does. The rows of cells with given values are
  /// zero.
  void subtract(const RowMatrix& dh, const Eigen::VectorXd* height, RowMatrix& rows) const;

  /// Writes minus the derivatives by the mean wall velocity along the axis [s/m] into the first
  /// column of `rows` (zero before); nothing where the wall is at rest.
  void subtract_by_speed(RowMatrix& rows) const;

 private:
  void subtract_storage(const RowMatrix& dh, RowMatrix& rows) const;
  void subtract_faces(const RowMatrix& dh, RowMatrix& rows) const;
  void subtract_rims(const RowMatrix& dh, RowMatrix& rows) const;
  void subtract_grooves(const RowMatrix& dh, RowMatrix& rows) const;
  double known_flow(Eigen::Index flow) const;
  Eigen::ArrayXd by_height() const;

  const StageTerms& terms_;
  const PadFaces& pad_;
  const FilmSplit& split_;
  const Eigen::ArrayXd &pressure_, &fill_;
};

}  // namespace clatter::film
