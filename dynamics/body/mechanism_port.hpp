// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Points of a slider-crank as deviations from the ideal mechanism.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/body/port.hpp"
#include "dynamics/given/crank.hpp"

namespace clatter::dynamics {

// The position and velocity of these ports count from the point of the ideal mechanism where both
// ports of a joint are, so that micrometres keep their digits beside its strokes. Their joint is in
// the plane (y, z) of the crank; rotations and angular velocities are the full ones.

/// Weights of coordinates in the displacement (x, y, z) and rotation (about x, y, z) of a point.
struct PointWeights {
  std::vector<int> coordinates;             // y indices, n_p
  Matrix6X weights = Matrix6X::Zero(6, 0);  // 6 x n_p

  void add(int coordinate, const Vector6& weight);
  void add(int coordinate, double lateral, double stroke);
  /// The coordinate is the rotation about x.
  void add_turn(int coordinate) { add(coordinate, Vector6::Unit(3)); }
};

/// A point that moves by weights of coordinates: a node, a mean of nodes; without coordinates at
/// rest.
class WeightedPort : public Port {
 public:
  explicit WeightedPort(PointWeights point);
  void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              PortState& state) override;

 private:
  Matrix6X weights_;
};

/// An end of the rod, of an elastic one displaced by u, both in the rod's own axes:
///
///   d = (dy, dz) + R(phi + dphi) (arm + u) - R(phi) arm,   phi the angle of the ideal rod
///
/// The rotation of the ideal rod is prescribed motion.
class RodPort : public Port {
 public:
  /// @param coordinates y indices of the rod's (dy, dz, dphi), and of an elastic one of u along y
  /// and z. @param arm (y, z) of the end from the centre of mass [m].
  RodPort(std::vector<int> coordinates, const SliderCrank& crank, const Eigen::Vector2d& arm);
  void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              PortState& state) override;
  void add_curvature(const Eigen::VectorXd& y, const Vector6& wrench,
                     Eigen::Ref<Eigen::MatrixXd> tangent) override;

 private:
  SliderCrank crank_;
  Eigen::Vector2d arm_, out_;  // and R (arm + u) at the last motion()
  Eigen::Matrix2d R_;
};

/// The crank pin, of a free crank turned by a of any size about +x from its ideal position p(t):
///
///   d = d_c + (R(a) - 1) p,   d' = d_c' + a' R(a) J p + (R(a) - 1) p',   J = R(90 deg)
///
/// with the displacement d_c of the crank's axis in the cylinder's plane. (R - 1) p' and the
/// clock's speed are prescribed motion.
class CrankPinPort : public Port {
 public:
  /// @param centre the axis, by its coordinates. @param turn y index of a; none: a = 0.
  CrankPinPort(PointWeights centre, std::optional<int> turn, const SliderCrank& crank);
  void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              PortState& state) override;
  void add_curvature(const Eigen::VectorXd& y, const Vector6& wrench,
                     Eigen::Ref<Eigen::MatrixXd> tangent) override;

 private:
  Matrix6X centre_;  // weights of its coordinates
  bool turns_;
  SliderCrank crank_;
  Eigen::Vector2d out_ = Eigen::Vector2d::Zero();  // R(a) p at the last motion()
};

}  // namespace clatter::dynamics
