// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A force between two ports along an axis fixed in the body of one of them.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dynamics/body/port.hpp"

namespace clatter::dynamics {

/// Plunger and housing. With the distance d from the housing's port a to the plunger's port b and
/// the axis u, which turns with the housing's body, the travel is
///
///   s = u . d - s0,    s' = u . (v_b - v_a - w_a x d),    force on b F u, on a -F u at the point b
///
/// so that force and moment balance to rounding and F s' is the power of both.
class PlungerAxis {
 public:
  /// @param axis unit vector in the axes of the housing's body, from the housing to the plunger.
  /// @param offset s0 [m].
  PlungerAxis(std::unique_ptr<Port> housing, std::unique_ptr<Port> plunger,
              const Eigen::Vector3d& axis, double offset);
  /// y indices: of the housing's port, then of the plunger's.
  std::vector<int> coordinates() const;
  int size() const { return housing_->size() + plunger_->size(); }

  /// Travel and its rate at the first size() of y and v.
  void move(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v);
  double travel() const { return travel_; }  // [m]
  double rate() const { return rate_; }      // [m/s]
  /// Forces on the coordinates by F = 1, size().
  const Eigen::VectorXd& direction() const { return direction_; }
  /// ds/dy, size().
  const Eigen::RowVectorXd& gradient() const { return gradient_; }
  /// tangent += F d(direction)/dy, size() x size().
  void add_curvature(double force, Eigen::Ref<Eigen::MatrixXd> tangent);
  /// Power that what drives the ports puts in at a force F [W].
  double driven_power(double force) const;

 private:
  std::unique_ptr<Port> housing_, plunger_;
  Eigen::Vector3d axis_, turned_, distance_;  // turned_: the axis in the engine's axes
  double offset_, travel_ = 0.0, rate_ = 0.0;
  PortState at_housing_, at_plunger_;
  Eigen::VectorXd y_housing_, y_plunger_, v_housing_, v_plunger_;
  Eigen::VectorXd direction_;
  Eigen::RowVectorXd gradient_;
  Matrix6X on_housing_, on_plunger_;  // change of the wrenches by y
};

}  // namespace clatter::dynamics
