// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A point of one body against a plane of another.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dynamics/body/port.hpp"
#include "dynamics/body/rotation.hpp"
#include "dynamics/element/element.hpp"

namespace clatter::dynamics {

/// Motion of the point as seen by an observer who turns with the plane, in the engine's axes.
struct PlaneMotion {
  Eigen::Vector3d normal;    // unit vector, to the side of the point
  Eigen::Vector3d distance;  // from the plane's port to the point [m]
  Eigen::Vector3d velocity;  // [m/s]
  Eigen::Vector3d slip;      // its part in the plane [m/s]
  double gap = 0.0;          // above the plane; below: negative [m]
  double rate = 0.0;         // of the gap [m/s]
};

/// Port a is a point, port b one of a plane that turns with it. Forces on a have their reaction on
/// b at the point of a, so that force and moment balance to rounding.
class PointOnPlane {
 public:
  /// @param normal of the plane in the axes of b's body, unit vector.
  PointOnPlane(std::unique_ptr<Port> a, std::unique_ptr<Port> b, const Eigen::Vector3d& normal);

  /// y indices of a, then of b; n of them.
  std::vector<int> coordinates() const;
  /// The motion at a state, n each; what follows is at the last one asked for.
  const PlaneMotion& move(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;
  /// Force on the coordinates, n, by `force` on a [N].
  void apply(const Eigen::Vector3d& force, Eigen::VectorXd& on) const;

  /// Derivatives by the coordinates, with v changing by `per_kappa` of y.
  void differentiate(double per_kappa) const;
  const Matrix3X& by_velocity() const { return velocity_; }    // 3 x n
  const Matrix3X& by_normal() const { return normal_; }        // 3 x n
  const Matrix3X& by_turn() const { return turn_; }            // 3 x n, of a turn of the plane
  const Eigen::RowVectorXd& by_gap() const { return gap_; }    // n
  const Eigen::RowVectorXd& by_rate() const { return rate_; }  // n
  /// Tangent, n x n, by `force` and its derivative, 3 x n; after differentiate().
  void add_up(const Eigen::Vector3d& force, const Matrix3X& by_force,
              Eigen::MatrixXd& tangent) const;
  /// Normal and two tangents, as columns; they turn with the plane.
  Eigen::Matrix3d axes() const;
  /// Change of `velocity` by changes of the coordinates' y and v that leave positions as they are.
  void by_jumps(Matrix3X& by_y, Matrix3X& by_v) const;
  /// Power that drives put in against `force` on a [W].
  double input(const Eigen::Vector3d& force) const;

 private:
  std::unique_ptr<Port> a_, b_;
  Eigen::Vector3d plane_;
  // Mutable: what is known of the last motion, which events and power() look at as well.
  mutable PortState at_a_, at_b_;
  mutable PlaneMotion at_;
  mutable Eigen::VectorXd y_a_, y_b_, v_a_, v_b_;
  mutable Matrix3X distance_, velocity_, turn_, normal_;
  mutable Eigen::RowVectorXd gap_, rate_;
  mutable Matrix6X on_b_;
};

}  // namespace clatter::dynamics
