// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// How the gap of one pad depends on the coordinates of both bodies.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/film/gap.hpp"
#include "dynamics/film/piston_liner_options.hpp"

namespace clatter::film {

/// Positions in the coordinates of a contact (PistonLinerBodies), n_e.
struct ContactCoordinates {
  int piston_patches = 0, liner_patches = 0;  // 0: the body is rigid

  int liner() const { return with_fits(piston_patches); }
  int liner_fit() const { return liner() + liner_patches; }
  int pin() const { return liner() + with_fits(liner_patches); }
  int axial() const { return pin() + 6; }
  int size() const { return axial() + (liner_patches > 0 ? 1 : 0); }

 private:
  static int with_fits(int patches) { return patches > 0 ? patches + kFits : 0; }
};

/// The gap's change by displacements, at one height of the pad:
///
///   dh = G y,   dh/dz = G' y
///
/// G has the weights of skirt, liner and pin. Rows are given in the k coordinates on which the gap
/// depends there: the liner's patches beside the pad, those of the skirt, the fits, the pin and the
/// liner's axial coordinate. A row has some twenty entries, however many patches the bodies have.
class GapMap {
 public:
  /// @param height_by_y n_e: the skirt's axial displacement against the liner by the coordinates.
  GapMap(const PistonLinerBodies& bodies, const ContactCoordinates& at, const PadGrid& pad,
         const Eigen::VectorXd& height_by_y);

  /// Moves the pad's z = 0 to engine z `height` [m].
  void move(double height);
  /// The coordinates on which the gap depends, k, ascending.
  const std::vector<int>& columns() const { return columns_; }
  /// The entries of `all` (n_e) in columns().
  void gather(const Eigen::VectorXd& all, Eigen::VectorXd& picked) const;
  /// height_by_y in columns(), k.
  const Eigen::VectorXd& height_by_column() const { return height_by_column_; }

  /// Adds G y to `gap` and G' y to `slope`, n; y has n_e entries.
  void add(const Eigen::VectorXd& y, Eigen::ArrayXd& gap, Eigen::ArrayXd& slope) const;
  /// Adds G' y to `slope`, n.
  void add_slope(const Eigen::VectorXd& y, Eigen::ArrayXd& slope) const;
  /// G'^T times `cells` (n), by columns, k.
  Eigen::VectorXd slope_transposed(const Eigen::VectorXd& cells) const;

  /// Writes a G + b G' + c height_by_y^T, n x k; c has n entries.
  void rows(double a, double b, const Eigen::ArrayXd& c, SparseRows& result) const;

 private:
  void list_columns();
  void find_pattern();

  ContactCoordinates at_;
  SparseRows piston_, liner_, liner_slope_;  // by the coordinates of their own
  std::optional<PatchMap> liner_map_;
  Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> pin_;  // of a rigid piston, n x 6
  Eigen::VectorXd height_by_y_, height_by_column_;
  std::vector<char> always_, used_;  // by coordinate
  std::vector<int> liner_before_;    // patches of liner_ at the height before, entry by entry
  std::vector<int> columns_;
  std::vector<int> column_;  // of a coordinate
  SparseRows pattern_;       // of rows(), n x k
  int cells_ = 0;
};

}  // namespace clatter::film
