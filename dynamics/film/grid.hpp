// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The cells on which one pad's film is solved.
#include <Eigen/Core>

namespace clatter::film {

/// Rectangular grid of cells on a cylinder: angle x axial, cell-centred, edges not necessarily
/// equidistant.
///
/// Cell (i, j) has the number i * n_axial + j; i counts along the circumference, j along the axis.
class PadGrid {
 public:
  /// `angle_edges` [rad], n_angle + 1, ascending; `axial_edges` [m], n_axial + 1, ascending;
  /// `radius` [m] > 0. `periodic`: the first and last angular edge are the same line (span 2 pi).
  /// Throws InputError when the edges do not ascend or a periodic grid does not close.
  PadGrid(Eigen::VectorXd angle_edges, Eigen::VectorXd axial_edges, double radius,
          bool periodic = false);

  /// Equidistant grid over [angle_begin, angle_end] x [axial_begin, axial_end].
  static PadGrid uniform(double angle_begin, double angle_end, int n_angle, double axial_begin,
                         double axial_end, int n_axial, double radius, bool periodic = false);

  int n_angle() const { return static_cast<int>(angle_edges_.size()) - 1; }
  int n_axial() const { return static_cast<int>(axial_edges_.size()) - 1; }
  int size() const { return n_angle() * n_axial(); }
  int cell(int i, int j) const { return i * n_axial() + j; }
  bool periodic() const { return periodic_; }
  double radius() const { return radius_; }

  const Eigen::VectorXd& angle_edges() const { return angle_edges_; }
  const Eigen::VectorXd& axial_edges() const { return axial_edges_; }
  double angle(int i) const { return 0.5 * (angle_edges_[i] + angle_edges_[i + 1]); }
  double axial(int j) const { return 0.5 * (axial_edges_[j] + axial_edges_[j + 1]); }
  /// Width of column i along the circumference [m].
  double arc(int i) const { return radius_ * (angle_edges_[i + 1] - angle_edges_[i]); }
  /// Height of row j along the axis [m].
  double height(int j) const { return axial_edges_[j + 1] - axial_edges_[j]; }
  /// Cell areas [m2], n.
  const Eigen::ArrayXd& area() const { return area_; }

 private:
  Eigen::VectorXd angle_edges_, axial_edges_;
  double radius_;
  bool periodic_;
  Eigen::ArrayXd area_;
};

}  // namespace clatter::film
